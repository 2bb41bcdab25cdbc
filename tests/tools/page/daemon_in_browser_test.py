#!/usr/bin/env python3
"""Runs `azimuth view` and azimuthd as processes with a headless browser, from before the drive to its end. The page
must show the robot at the pose that another subscriber received, tell the end of the drive and follow a restarted
daemon. The browser's console must stay empty.

usage: daemon_in_browser_test.py SOURCE_TREE AZIMUTH AZIMUTHD LISTEN SCREENSHOT
Needs a network namespace whose loopback interface carries multicast. Exit code 0: good, 1: not, 77: the browser is missing.
"""

import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import web_driver

TREE, AZIMUTH, AZIMUTHD, LISTEN, SCREENSHOT = (Path(each) for each in sys.argv[1:6])
NEAR_M, NEAR_RAD = 0.05, math.radians(2.0)
PATIENCE_S = 20.0  # generous for a busy machine; docs/results.md has the measured delay

SHOWN = "window.azimuthView.map.shownPose()"
BANNER = "document.querySelector('.banner')"
STEP = re.compile(r"^step \d+  x (-?[\d.]+) y (-?[\d.]+) m  heading (-?[\d.]+) rad", re.MULTILINE)


def play():
    subprocess.run([AZIMUTHD, "--play", TREE / "runs/lab", "--speed", "20"], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL, timeout=120)


def last_heard(heard):
    """Returns x [m], y [m] and heading [rad] of the newest pose that the other subscriber received."""
    x, y, heading = STEP.findall(heard.read_text())[-1]
    return float(x), float(y), float(heading)


def wrong_with_marker(browser, heard):
    x, y, heading = last_heard(heard)
    try:
        browser.until(f"(() => {{ const p = {SHOWN}; return p && Math.hypot(p.x - {x}, p.y - {y}) < {NEAR_M}; }})()", PATIENCE_S)
    except AssertionError:
        yield f"the robot is shown at {browser.run(f'return {SHOWN}')}, heard at {x}, {y}"
        return
    turned = math.remainder(browser.run(f"return {SHOWN}.heading") - heading, math.tau)
    if abs(turned) > NEAR_RAD:
        yield f"its heading is shown {math.degrees(turned):.1f} degrees off"


def watched(browser, address, heard):
    browser.open(address)
    browser.complaints()  # drops the messages of the browser's start page
    for drive in ("the first drive", "the daemon started anew"):
        play()
        yield from (f"{drive}: {words}" for words in wrong_with_marker(browser, heard))
        browser.until(f"!{BANNER}.hidden && {BANNER}.textContent.includes('daemon')", PATIENCE_S, f"{drive}: its end is not told")
    browser.screenshot(SCREENSHOT)
    yield from (f"console: {words}" for words in browser.complaints())


def main():
    if not web_driver.is_here():
        print("SKIPPED: no chromium and chromedriver here")
        sys.exit(77)
    SCREENSHOT.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        heard = Path(name) / "heard"
        with open(heard, "wb") as out:
            listener = subprocess.Popen([LISTEN], stdout=out)
        view = subprocess.Popen([AZIMUTH, "view", "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        try:
            address = re.search(r"http://\S+", view.stdout.readline())[0]
            with web_driver.Browser(name) as browser:
                wrong = list(watched(browser, address, heard))
        finally:
            for process in (listener, view):
                process.terminate()
                process.wait(20)
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"followed two drives at {address}")


if __name__ == "__main__":
    main()
