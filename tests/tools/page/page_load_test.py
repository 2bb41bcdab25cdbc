#!/usr/bin/env python3
"""Measures the frame rate of the page without a GPU with 5,000 landmarks, 100,000 points of the path and 30 poses per
second: the whole map shown, following the robot, and during zooming and turning. tests/bench/ measures the speed; this
test only requires that the page moves.

usage: page_load_test.py PAGE_FOLDER [SCREENSHOT.png]      exit code 0: it moves, 1: not, 77: the browser is missing
"""

import sys
import tempfile
import time
from pathlib import Path

import web_driver
from fake_view import FakeView
from live_page_test import PATIENCE
from synthetic_robot import SyntheticRobot

LEAST_FPS = 5.0  # also on a busy machine
MOMENTS = {
    "the whole map": "const { map } = window.azimuthView; map.become('all')",
    "all of the time": "window.azimuthView.link.reset()",
    "following the robot": "const { map } = window.azimuthView; map.become('follow'); map.view.scale = 30",
    "zooming and turning": """const { map } = window.azimuthView;
        window.hand = setInterval(() => { map.view.zoom(1 + 0.04 * Math.sin(performance.now() / 500)), map.view.rotate(0.01), map.become('free'); }, 30)""",
}


def measured(browser, script, seconds):
    browser.run(script)
    time.sleep(0.5)
    browser.run("window.azimuthView.frames.clear()")
    time.sleep(seconds)
    return browser.run("return window.azimuthView.frames.figures()")


def problems(page, screenshot):
    view = FakeView(page, SyntheticRobot(landmarks=5000, size_m=40.0), past_s=3300.0, points=99000)
    address = view.start()
    with tempfile.TemporaryDirectory() as folder, web_driver.Browser(folder) as browser:
        browser.open(address)
        took_s = browser.until("window.azimuthView && window.azimuthView.store.poses.length > 98900", 20 * PATIENCE, "the way is read")
        print(f"99,000 points are there after {took_s:.1f} s")
        for moment, script in MOMENTS.items():
            frames = measured(browser, script, 6.0)
            print(f"{moment}: {frames['fps']:.0f} frames/s; from one to the next {frames['median']:.0f} ms (median), {frames['p95']:.0f} ms (95 %), "
                  f"{frames['worst']:.0f} ms at most")
            if not frames["fps"] > LEAST_FPS:
                yield f"{moment}: it does not move"
        browser.run("clearInterval(window.hand)")
        kept = browser.run("return window.azimuthView.store.poses.length")
        browser.until(f"window.azimuthView.store.poses.length !== {kept}", PATIENCE, "it goes on")
        if screenshot:
            browser.screenshot(screenshot)
        yield from (f"console: {words}" for words in browser.complaints())


def main():
    if not web_driver.is_here():
        print("no chromium with a chromedriver here to open the page with")
        return 77
    found = list(problems(Path(sys.argv[1]), Path(sys.argv[2]) if len(sys.argv) > 2 else None))
    print("\n".join(found) or "it moves")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
