#!/usr/bin/env python3
"""Opens a page of `azimuth report compare --html` in a headless browser. It must name missing runs, draw everything and
sort by a clicked column. Its security policy must refuse nothing, and no script may fail.

usage: compare_page_test.py AZIMUTH      exit code 0: good, 1: not, 77: chromium is missing
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from browser_test import opened

ROGUE = "<script>'\"&"  # a name that tests the escaping

# Simulates a user's input and writes the result into the document. The page's policy is removed, because it would
# refuse this script.
STEERING = """
window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 1);
const said = [];
const wait = () => new Promise((done) => setTimeout(done, 50));
const pixels = (canvas) => canvas.toDataURL();
const blank = (canvas) => Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height }).toDataURL();
const check = (words, good) => { if (!good) said.push(words); };
const firstRun = () => document.querySelector('.tall tbody th').firstChild.textContent;
addEventListener('load', async () => {
  await wait();
  const canvases = [...document.querySelectorAll('canvas')];
  check('two charts', canvases.length === 2);
  for (const canvas of canvases) check('empty: ' + canvas.getAttribute('aria-label'), pixels(canvas) !== blank(canvas));
  check('the worst is first', firstRun() === 'run 3');
  const then = canvases.map(pixels);
  [...document.querySelectorAll('thead button')].find((button) => button.textContent === 'map RMSE').click(); await wait();
  check('sorted by the map', firstRun() === 'run 5');
  check('drawn anew', canvases.every((canvas, i) => pixels(canvas) !== then[i]));
  const box = canvases[1].getBoundingClientRect();
  canvases[1].dispatchEvent(new PointerEvent('pointermove', { clientX: box.right - 5, clientY: box.top + 20, bubbles: true }));
  check('told of a run', document.body.textContent.includes('was 0.100 m: '));
  document.body.dataset.steered = said.length ? said.join('; ') : 'as it should be';
});
"""


def report(name, position_m, map_m):
    return {"name": name, "tags": ["lab"], "run": "x", "seed": 1, "pose": {"rmse_m": position_m}, "map": {"rmse_m": map_m}, "time_us": {}}


def write_reports(folder, changed):
    folder.mkdir()
    for i in range(8):
        position_m, map_m = changed.get(i, (0.1, 0.1))
        (folder / f"{i}.json").write_text(json.dumps(report(f"run {i}", position_m, map_m)))
    return folder


def problems(azimuth, chromium, folder):
    before, after = write_reports(folder / "before", {}), write_reports(folder / "after", {3: (0.2, 0.09), 5: (0.1, 0.15)})
    (before / "8.json").write_text(json.dumps(report(ROGUE, 0.1, 0.1)))
    (after / "9.json").write_text('{"name": "cut')
    page = folder / "page.html"
    subprocess.run([azimuth, "report", "compare", after, "--baseline", before, "--quiet", "--html", page], check=True)
    dom, complaints = opened(chromium, page, folder)
    yield from complaints
    for wanted in ("&lt;script&gt;'\"&amp;", "9.json: is cut short", "Missing, in the baseline alone (1)", "8 runs compared"):
        if wanted not in dom:
            yield f"the page does not say {wanted}"
    text = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page.read_text(encoding="utf-8"))
    steered = folder / "steered.html"
    steered.write_text(text.replace("</head>", f"<script>{STEERING}</script></head>"), encoding="utf-8")
    dom, complaints = opened(chromium, steered, folder)
    yield from complaints
    outcome = re.search(r'data-steered="([^"]*)"', dom)
    if not outcome or outcome[1] != "as it should be":
        yield f"steered: {outcome[1] if outcome else 'no end came of it'}"


def main():
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not chromium:
        print("no chromium here to open the page with")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        found = list(problems(sys.argv[1], chromium, Path(folder)))
    print("\n".join(found) or "drawn")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
