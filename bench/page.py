#!/usr/bin/env python3
"""What a report page costs in headless Chromium: size, first paint, pictures per second while the time slider moves.

    bench/page.py REPORT.html [--pictures DIR] [--repeats N]

Every figure is the median of the repeats, each in a new browser. --pictures saves what a laptop (1366 x 768) and a
projector (1024 x 768) show, light and dark, and the whole page. The aims: below 5 MB, first paint within 1 s, at least 30
pictures a second. On a machine that does other things too, the browser waits like everyone else: look at the load.
Exit code 0, or 2 for a bad command line.
"""

import argparse
import os
import statistics
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "comparisons"))

from browser import Browser, chromium  # noqa: E402

READY = "document.documentElement?.dataset.ready === 'true'"

SCREENS = {"laptop": (1366, 768), "projector": (1024, 768)}

#: Two browser frames later everything that was drawn has been painted.
PAINTED = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))"

#: Milliseconds from the start of the navigation to the first paint, the first content and the end of the scripts. A busy
#: browser writes down when it painted some frames later.
TIMES = """new Promise((done) => {
  function look() {
    const paint = Object.fromEntries(performance.getEntriesByType('paint').map((entry) => [entry.name, entry.startTime]));
    const [page] = performance.getEntriesByType('navigation');
    const times = [paint['first-paint'], paint['first-contentful-paint'], page.loadEventEnd];
    if (times.every((time) => time > 0)) done(times);
    else requestAnimationFrame(look);
  }
  look();
})"""

#: Moves the slider by one frame before each of the browser's own, from first to last, as a drag does; the answer is the number of
#: pictures, the time they took and the longest wait for one, in ms. The browser calls for the next frame only when it has
#: taken over the last one, so this counts pictures that are shown; at most as many as the screen has (60 a second).
DRAG = """new Promise((done) => {
  const slider = document.getElementById('time'), last = Number(slider.max);
  let frame = 0, start = 0, before = 0, longest = 0;
  function step(now) {
    if (frame === 0) start = now; else longest = Math.max(longest, now - before);
    before = now;
    if (frame > last) { done([frame, now - start, longest]); return; }
    slider.value = String(frame++);
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    requestAnimationFrame(step);
  }
  requestAnimationFrame(step);
})"""

#: Work of the page itself for a picture, in ms: all frames in a row, the picture read back at the end of each.
WORK = """(() => {
  const slider = document.getElementById('time'), last = Number(slider.max);
  const context = document.getElementById('membranes').getContext('2d');
  const start = performance.now();
  for (let frame = 0; frame <= last; ++frame) {
    slider.value = String(frame);
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    document.body.getBoundingClientRect();
    context.getImageData(0, 0, 1, 1);
  }
  return (performance.now() - start) / (last + 1);
})()"""


def measured(report):
    """One repeat: {name: value} in a new browser."""
    with Browser(*SCREENS["laptop"]) as browser:
        browser.prefer("light")
        browser.open(report, READY)
        browser.evaluate(PAINTED)
        first, content, loaded = browser.evaluate(TIMES)
        found = {"first paint, ms": first, "first content, ms": content, "all of it there, ms": loaded}
        if browser.evaluate("Number(document.getElementById('time')?.max ?? 0)"):
            pictures, duration, longest = browser.evaluate(DRAG)
            found |= {"pictures": pictures, "pictures a second": 1000 * pictures / duration}
            found |= {"longest wait for one, ms": longest, "own work for one, ms": browser.evaluate(WORK)}
        if browser.problems:
            print(f"problems: {browser.problems}", file=sys.stderr)
        return found


def save_pictures(report, directory):
    """Screenshots of every screen, light and dark."""
    directory.mkdir(parents=True, exist_ok=True)
    with Browser() as browser:
        for scheme in ("light", "dark"):
            browser.prefer(scheme)
            for screen, size in SCREENS.items():
                browser.resize(*size)
                browser.open(report, READY)
                browser.evaluate(PAINTED)
                browser.screenshot(directory / f"{screen}-{scheme}.png")
                browser.screenshot(directory / f"{screen}-{scheme}-page.png", whole_page=True)


def main(arguments):
    """Measure and print; returns the exit code."""
    parser = argparse.ArgumentParser(prog="page.py", description="What a report page costs in headless Chromium.")
    parser.add_argument("report", metavar="REPORT.html", type=Path)
    parser.add_argument("--pictures", metavar="DIR", type=Path, help="save screenshots there")
    parser.add_argument("--repeats", metavar="N", type=int, default=3)
    options = parser.parse_args(arguments)
    if not options.report.is_file():
        parser.error(f"{options.report} is not there")
    if not chromium():
        parser.error("chromium is not installed (Debian package chromium)")
    print(f"size, MB                  {options.report.stat().st_size / 1e6:8.2f}")
    repeats = [measured(options.report) for _ in range(options.repeats)]
    for name in repeats[0]:
        values = [repeat[name] for repeat in repeats]
        print(f"{name:25} {statistics.median(values):8.1f}   ({', '.join(f'{value:.1f}' for value in values)})")
    print(f"load                      {os.getloadavg()[0]:8.1f}")
    if options.pictures:
        save_pictures(options.report, options.pictures)
        print(f"screenshots in {options.pictures}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
