#!/usr/bin/env python3
"""What the laboratory in the browser costs, beside the program: bench/laboratory.py build/web/index.html build/endoflow [--repeats N].

Each repeat opens the page in a fresh Chromium, waits for the standard case's budding, and runs the program on the same
case with one thread. Medians of the repeats; ratios are taken inside one repeat. CPU times are those of the worker's
thread and of the program's process, from their beginning, so that they hold on a machine that does other things too.
"""

import argparse
import gzip
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "comparisons"))
import browser

TICK = os.sysconf("SC_CLK_TCK")

# Times of the pictures [ms since the page was opened], and which of them was the first to show a membrane that had moved.
WATCH = """
window.seen = {frames: [], motion: null};
const look = (now) => {
  const page = window.laboratory;
  if (page?.state === "running") seen.frames.push(now);
  if (seen.motion === null && page?.run?.frames.length > 1 && page.pictures > 1) seen.motion = now;
  requestAnimationFrame(look);
};
requestAnimationFrame(look);
"""


def threads():
    """(pid, name, CPU seconds) of every thread of this user's processes that are called chromium."""
    for process in Path("/proc").iterdir():
        if not process.name.isdigit():
            continue
        try:
            if "chromium" not in (process / "comm").read_text():
                continue
            for task in (process / "task").iterdir():
                fields = (task / "stat").read_text().rsplit(")", 1)[1].split()
                yield int(process.name), (task / "comm").read_text().strip(), (int(fields[11]) + int(fields[12])) / TICK
        except OSError:
            continue  # it ended meanwhile


def is_below(pid, ancestor):
    """Whether a process is a descendant of another one."""
    while pid > 1 and pid != ancestor:
        try:
            pid = int(Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[1])
        except OSError:
            return False
    return pid == ancestor


def page_costs(page):
    """One visit until the standard case has ended."""
    with browser.Browser(1366, 768) as visited:
        visited._call("Page.addScriptToEvaluateOnNewDocument", {"source": WATCH})
        visited.open(page, "window.laboratory?.state === 'ended'")
        worker = [
            (pid, seconds)
            for pid, name, seconds in threads()
            if name.startswith("DedicatedWorker") and is_below(pid, visited._process.pid)
        ]
        ((renderer, cpu),) = worker
        proportional = next(
            int(line.split()[1]) * 1024
            for line in Path(f"/proc/{renderer}/smaps_rollup").read_text().splitlines()
            if line.startswith("Pss:")
        )
        seen = json.loads(visited.evaluate("JSON.stringify(seen)"))
        heap = visited._call("Runtime.getHeapUsage")["usedSize"]
        engine = visited.evaluate("laboratory.run.memory")
        wall = visited.evaluate("laboratory.run.seconds")
        budding = visited.evaluate("laboratory.run.events.budding.time_us")
    gaps = [b - a for a, b in zip(seen["frames"], seen["frames"][1:])]
    return {
        "first_motion_s": seen["motion"] / 1e3,
        "worker_cpu_s": cpu,
        "engine_wall_s": wall,
        "pictures_per_s": 1e3 * len(gaps) / sum(gaps),
        "late_pictures": sum(gap > 25 for gap in gaps) / len(gaps),
        "memory_engine_mb": engine / 1e6,
        "memory_page_mb": heap / 1e6,
        "memory_process_mb": proportional / 1e6,
        "budding_us": budding,
    }


def program_costs(program):
    """The same case by the program: CPU seconds of its process."""
    with tempfile.TemporaryDirectory() as scratch:
        case = Path(scratch) / "case.toml"
        case.write_text("")
        settings = ["boundary_integral.threads=1", "output.field_interval=0"]
        command = [program, "run", "boundary-integral", case, "-o", Path(scratch) / "run"]
        command += [word for setting in settings for word in ("--set", setting)]
        begin = time.monotonic()
        before = os.times()
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        after = os.times()
        budding = json.loads((Path(scratch) / "run" / "run.json").read_text())["events"]["budding"]["time_us"]
    cpu = after.children_user + after.children_system - before.children_user - before.children_system
    return {"program_cpu_s": cpu, "program_wall_s": time.monotonic() - begin, "program_budding_us": budding}


def main():
    parser = argparse.ArgumentParser(description="What the laboratory in the browser costs, beside the program.")
    parser.add_argument("page", metavar="PAGE", type=Path)
    parser.add_argument("program", metavar="PROGRAM", type=Path)
    parser.add_argument("--repeats", metavar="N", type=int, default=3)
    options = parser.parse_args()
    found = []
    for _ in range(options.repeats):
        row = page_costs(options.page) | program_costs(options.program.resolve())
        row["cpu_ratio"] = row["worker_cpu_s"] / row["program_cpu_s"]
        row["load"] = os.getloadavg()[0]
        found.append(row)
    content = options.page.read_bytes()
    print(f"{'file_mb':20} {len(content) / 1e6:10.3f}\n{'file_gzip_mb':20} {len(gzip.compress(content, 6)) / 1e6:10.3f}")
    for name in found[0]:
        values = sorted(row[name] for row in found)
        print(f"{name:20} {statistics.median(values):10.7g}   ({values[0]:.7g} to {values[-1]:.7g})")


if __name__ == "__main__":
    main()
