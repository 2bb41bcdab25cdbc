#!/usr/bin/env python3
"""Opens the report's page as `azimuth view` serves it, with separate data: one run, two runs, a map alone, and a server
that refuses. The browser's console must stay empty.

usage: recorded_page_test.py AZIMUTH RUNS PAGE_FOLDER SCREENSHOTS      exit code 0: good, 1: not, 77: the browser is missing
"""

import json
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import web_driver
from fake_view import FakeView
from live_page_test import KEY, PATIENCE, accessible, expect

BAR = "document.querySelector('.bar input')"


def data_of(azimuth, runs, folder):
    """Returns the data that `azimuth replay` embeds in its page, which `azimuth view` serves separately."""
    page = Path(folder) / "page.html"
    subprocess.run([azimuth, "replay", *runs, "--quiet", "--html", page], check=True)
    text = page.read_text(encoding="utf-8")
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S)[1])


def map_alone(run):
    """Turns the data of a run into those of a map file, whose columns have no rows."""
    series = {name: [] for name in run["series"]}
    return {**run, "name": "hall.map", "steps": 0, "metrics": [], "series": series, "health": [], "pictures": [], "starts_at_us": 0}


def steered(browser):
    run = browser.run
    run(f"{KEY} key({BAR}, 'Home')")
    browser.until(f"Number({BAR}.value) === 0", PATIENCE, "Home")
    run("document.querySelector('[title=\"A step on\"]').click()")
    browser.until(f"Number({BAR}.value) > 0 && Number({BAR}.value) < 2", PATIENCE, "a step")
    run(f"{KEY} key(document.body, 'n')")
    browser.until(f"Number({BAR}.value) > 0", PATIENCE, "the next change of health")
    run(f"{KEY} key({BAR}, 'Home'); document.querySelector('.bar select').value = '10'; document.querySelector('.bar select').dispatchEvent(new Event('change'))")
    begin_s = time.monotonic()
    run("document.querySelector('.bar button').click()")
    time.sleep(1.5)
    run("document.querySelector('.bar button').click()")
    played_s, took_s = float(run(f"return {BAR}.value")), time.monotonic() - begin_s
    expect(0.3 * took_s < played_s / 10 < 1.1 * took_s, f"played {played_s:.1f} s at ten times in {took_s:.1f} s")
    run("location.hash = '#t=7.5'")
    browser.until(f"Math.abs(Number({BAR}.value) - 7.5) < 0.01", PATIENCE, "the moment in the address")
    svg = run("const node = document.querySelector('.menu'); return node.querySelectorAll('button').length")
    expect(svg == 4, "what the map can be saved as")


def shares_are_counted(browser):
    found = browser.run("""
      const { shareWithin } = await import('/modules/run_charts.js');
      return [shareWithin([0, -1, null, 3], [1, 1, 1, 1]), shareWithin(Array(20).fill(0.5), Array(20).fill(1)), shareWithin([null], [1]),
        [...document.querySelectorAll('.chart h3')].map((node) => node.textContent).find((words) => words.startsWith('Error in x'))];""")
    expect(found[:3] == ["only 66 % of it within 2σ", "100 % of it within 2σ", "2σ"], f"{found}")
    expect(re.fullmatch(r"Error in x, (only )?\d+ % of it within 2σ m", found[3] or ""), f"the chart's heading: {found[3]}")


def map_comes_first_on_a_phone(browser, screenshots):
    browser.size(390, 844, True)
    tops = browser.run("""return ['.card.map', '.tiles', '.chart'].map((name) => document.querySelector(name).getBoundingClientRect().top)""")
    expect(tops == sorted(tops), f"map, tiles and charts begin at {tops}")
    wide = browser.run("return document.documentElement.scrollWidth - innerWidth")
    expect(wide <= 0, f"phone: {wide} pixels wider than the window")
    browser.screenshot(screenshots / "recorded-phone.png")
    browser.size(1400, 900)


def one_run(browser, screenshots):
    browser.until("document.querySelector('.panel.alone') && document.querySelectorAll('canvas').length > 7", 10 * PATIENCE, "map and charts")
    steered(browser)
    accessible(browser, "a run")
    shares_are_counted(browser)
    map_comes_first_on_a_phone(browser, screenshots)


def two_runs(browser, _):
    browser.until("document.querySelectorAll('.panel').length === 2", 10 * PATIENCE, "two runs")
    over, once = browser.run("""
      const canvas = document.querySelector('main > .map canvas'), chip = document.querySelector('main > .map .chip:last-of-type');
      const frame = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      await frame();
      const before = canvas.toDataURL();
      chip.click();
      await frame();
      return [before !== canvas.toDataURL(), chip.getAttribute('aria-pressed')];""")
    expect(over and once == "false", "a run is hidden in the map of both")
    accessible(browser, "two runs")


def only_a_map(browser, _):
    browser.until("document.querySelectorAll('canvas').length === 1", 10 * PATIENCE, "the map")
    expect(not browser.run("return Boolean(document.querySelector('.bar'))"), "no time")
    expect(browser.run("return document.querySelector('.map canvas').getAttribute('aria-label')").startswith("Map with 24 landmarks"), "the map in words")
    browser.until("""(() => {
      const canvas = document.querySelector('.map canvas'), blank = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height });
      return canvas.toDataURL() !== blank.toDataURL(); })()""", 5 * PATIENCE, "landmarks are drawn")


def problems(azimuth, runs, page, screenshots):
    screenshots.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, web_driver.Browser(folder) as browser:
        lab, both = data_of(azimuth, [runs / "lab"], folder), data_of(azimuth, [runs / "lab", runs / "alike"], folder)
        for name, run, check in (("run", lab, one_run), ("two-runs", both, two_runs), ("map", {**lab, "runs": [map_alone(lab["runs"][0])]}, only_a_map)):
            view = FakeView(page, run=run)
            browser.open(view.start())
            try:
                check(browser, screenshots)
            except AssertionError as error:
                yield f"{name}: {error}"
            browser.screenshot(screenshots / f"recorded-{name}.png")
            yield from (f"{name}: console: {words}" for words in browser.complaints())
            view.stop()


def main():
    if not web_driver.is_here():
        print("no chromium with a chromedriver here to open the page with")
        return 77
    found = list(problems(sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]), Path(sys.argv[4])))
    print("\n".join(found) or "as it should be")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
