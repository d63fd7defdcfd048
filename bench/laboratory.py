#!/usr/bin/env python3
"""What the laboratory in the browser costs, beside the program: bench/laboratory.py build/web/index.html build/endoflow [--repeats N].

Each repeat opens the page in a fresh Chromium that has come to rest, waits for the standard case's budding, and runs the program on the same
case with one thread. Medians of the repeats; ratios are taken inside one repeat. CPU times hold on a machine that does
other things too: those of the worker's thread, of the page's whole process with drawing and the compilation of
WebAssembly, and of the program; until the first motion, those of the page's own thread and of the worker, which wait
for each other.
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

REST = 2  # s: a browser that has just been started loads its own parts for about one

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


def threads(pid):
    """{thread's id: (name, CPU seconds)} of a process."""
    found = {}
    for task in Path(f"/proc/{pid}/task").iterdir():
        fields = (task / "stat").read_text().rsplit(")", 1)[1].split()
        found[int(task.name)] = ((task / "comm").read_text().strip(), (int(fields[11]) + int(fields[12])) / TICK)
    return found


def children(pid):
    """Ids of the processes that descend from one."""
    born = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    return [grandchild for child in map(int, born) for grandchild in (child, *children(child))]


def renderer(visited):
    """Process of the page's browser in which the engine's worker lives."""
    (found,) = [
        pid
        for pid in children(visited._process.pid)
        if any(name.startswith("DedicatedWorker") for name, _ in threads(pid).values())
    ]
    return found


def worker_seconds(pid):
    return sum(seconds for name, seconds in threads(pid).values() if name.startswith("DedicatedWorker"))


def page_costs(page):
    """One visit until the standard case has budded."""
    with browser.Browser(1366, 768) as visited:
        visited._call("Page.addScriptToEvaluateOnNewDocument", {"source": WATCH})
        time.sleep(REST)
        visited.open(page, "window.seen?.motion > 0")
        pid = renderer(visited)
        first_cpu = worker_seconds(pid) + threads(pid)[pid][1]
        while visited.evaluate("laboratory.state") != "stopped":
            time.sleep(0.2)
        everything = sum(seconds for _, seconds in threads(pid).values())
        lines = Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines()
        memory = sum(int(line.split()[1]) * 1024 for line in lines if line.startswith("Pss:"))
        seen = json.loads(visited.evaluate("JSON.stringify(seen)"))
        gaps = [b - a for a, b in zip(seen["frames"], seen["frames"][1:])]
        return {
            "first_motion_s": seen["motion"] / 1e3,
            "first_motion_cpu_s": first_cpu,
            "worker_cpu_s": worker_seconds(pid),
            "page_cpu_s": everything,
            "engine_wall_s": visited.evaluate("laboratory.run.seconds"),
            "pictures_per_s": 1e3 * len(gaps) / sum(gaps),
            "late_pictures": sum(gap > 25 for gap in gaps) / len(gaps),
            "memory_engine_mb": visited.evaluate("laboratory.run.memory") / 1e6,
            "memory_script_mb": visited._call("Runtime.getHeapUsage")["usedSize"] / 1e6,
            "memory_process_mb": memory / 1e6,
            "budding_us": visited.evaluate("laboratory.run.events.budding.time_us"),
        }


def program_costs(program):
    """The same case by the program: CPU seconds of its process."""
    with tempfile.TemporaryDirectory() as scratch:
        case = Path(scratch) / "case.toml"
        case.write_text("")
        settings = ["boundary_integral.threads=1", "output.field_interval=0", "output.stop_at_budding=true"]
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
        row["worker_to_program"] = row["worker_cpu_s"] / row["program_cpu_s"]
        row["page_to_program"] = row["page_cpu_s"] / row["program_cpu_s"]
        row["load"] = os.getloadavg()[0]
        found.append(row)
    content = options.page.read_bytes()
    print(f"{'file_mb':20} {len(content) / 1e6:10.3f}\n{'file_gzip_mb':20} {len(gzip.compress(content, 6)) / 1e6:10.3f}")
    for name in found[0]:
        values = sorted(row[name] for row in found)
        print(f"{name:20} {statistics.median(values):10.7g}   ({values[0]:.7g} to {values[-1]:.7g})")


if __name__ == "__main__":
    main()
