#!/usr/bin/env python3
"""Opens pages of `azimuth replay --html` in a headless browser. Everything must be drawn, the page's security policy
must refuse nothing, and no script may fail.

usage: browser_test.py AZIMUTH RUNS      exit code 0: good, 1: not, 77: chromium is missing
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

KEPT_S = 20.0

# Simulates a user's input and writes the result into the document. The page's policy is removed, because it would
# refuse this script.
STEERING = """
window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 1);  // a window that is not there has few frames
const said = [];
const wait = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
const key = (node, name) => node.dispatchEvent(new KeyboardEvent('keydown', { key: name, bubbles: true, cancelable: true }));
const pixels = (canvas) => canvas.toDataURL();
const blank = (canvas) => Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height }).toDataURL();
const check = (words, good) => { if (!good) said.push(words); };
addEventListener('load', async () => {
  await wait();
  const chart = document.querySelector('.chart:not(.health) canvas'), map = document.querySelector('.map canvas'), bar = document.querySelector('.bar input');
  for (const canvas of document.querySelectorAll('canvas')) check('empty: ' + canvas.getAttribute('aria-label'), pixels(canvas) !== blank(canvas));
  key(chart, 'Home'); await wait();
  check('Home', Number(bar.value) === 0);
  const [mapThen, chartThen] = [pixels(map), pixels(chart)];
  key(chart, 'ArrowRight'); await wait();
  check('a step', Number(bar.value) > 0 && Number(bar.value) < 2);
  const box = chart.getBoundingClientRect();
  chart.dispatchEvent(new PointerEvent('pointermove', { clientX: box.left + 0.6 * box.width, clientY: box.top + 20, bubbles: true })); await wait();
  check('pointing', Number(bar.value) > 8 && Number(bar.value) < 15);
  check('one cursor', pixels(map) !== mapThen && pixels(chart) !== chartThen);
  for (const name of ['+', '0', '-']) {
    const then = pixels(map);
    key(map, name); await wait();
    check('map ' + name, pixels(map) !== then);
  }
  const then = pixels(chart);
  key(chart, '+'); await wait();
  check('zoomed time', pixels(chart) !== then);
  for (const chip of document.querySelectorAll('.chip')) {
    const before = pixels(map);
    chip.click(); await wait();
    check('layer ' + chip.textContent, chip.getAttribute('aria-pressed') === 'false' || pixels(map) !== before);
  }
  key(document.body, ' '); await wait(); await wait();
  check('plays', document.querySelector('.bar button').textContent === 'Pause');
  key(document.body, ' ');
  document.body.dataset.steered = said.length ? said.join('; ') : 'as it should be';
});
"""


def short_run(runs, name, folder, as_name):
    """Copies the first KEPT_S seconds of a shipped run; `as_name` contains characters that test the escaping."""
    run = folder / as_name
    shutil.copytree(runs / name, run)
    for table in ("odometry", "bearings", "truth"):
        file = run / f"{table}.csv"
        if not file.exists():
            continue
        head, *lines = file.read_text().splitlines(keepends=True)
        file.write_text("".join([head, *(line for line in lines if float(line.split(",")[0]) <= KEPT_S)]))
    return run


def opened(chromium, page, folder):
    shown = subprocess.run(
        [chromium, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", f"--user-data-dir={folder / 'profile'}",
         "--window-size=1400,1400", "--virtual-time-budget=20000", "--dump-dom", page.as_uri()],
        capture_output=True, text=True, timeout=90)
    return shown.stdout, [line for line in shown.stderr.splitlines() if ":CONSOLE" in line and "willReadFrequently" not in line]


def steering_problems(page, chromium, folder):
    text = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page.read_text(encoding="utf-8"))
    steered = folder / "steered.html"
    steered.write_text(text.replace("</head>", f"<script>{STEERING}</script></head>"), encoding="utf-8")
    dom, complaints = opened(chromium, steered, folder)
    yield from complaints
    outcome = re.search(r'data-steered="([^"]*)"', dom)
    if not outcome or outcome[1] != "as it should be":
        yield f"steered: {outcome[1] if outcome else 'no end came of it'}"


def problems(azimuth, chromium, runs, folder):
    lab = short_run(runs, "lab", folder, "<script>'\"&")
    alike = short_run(runs, "alike", folder, "alike")
    for given, wanted in (([lab], [r"class=\"panel alone\"", r"class=\"card tile\""]), ([lab, alike], [r"class=\"panels\"", r"class=\"card compare\""])):
        page = folder / "page.html"
        subprocess.run([azimuth, "replay", *given, "--quiet", "--html", page], check=False)
        dom, complaints = opened(chromium, page, folder)
        yield from complaints
        canvases = len(re.findall("<canvas", dom))
        if canvases < 8 * len(given):
            yield f"{canvases} canvases for {len(given)} runs"
        yield from (f"{len(given)} runs: no {word}" for word in wanted if not re.search(word, dom))
        yield from steering_problems(page, chromium, folder)
        if "&lt;script&gt;'\"&amp;" not in dom:
            yield "the run's name does not stand as it is"


def main():
    azimuth, runs = sys.argv[1], Path(sys.argv[2])
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not chromium:
        print("no chromium here to open the page with")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        found = list(problems(azimuth, chromium, runs, Path(folder)))
    print("\n".join(found) or "drawn")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
