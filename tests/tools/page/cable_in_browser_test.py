#!/usr/bin/env python3
"""Runs azimuth-sim, azimuthd and `azimuth view` as processes with a headless browser. When a cable, the robot, the
daemon or the server goes away, the page must say so within two seconds and continue on the same map when it is back.

usage: cable_in_browser_test.py SOURCE_TREE AZIMUTH AZIMUTHD AZIMUTH_SIM SCREENSHOT [BUSY]
BUSY: number of processes that keep the processors busy during the test.
Needs a network namespace whose loopback interface carries multicast. Exit code 0: good, 1: not, 77: the browser is missing.
"""

import contextlib
import json
import math
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import web_driver

TREE, AZIMUTH, AZIMUTHD, AZIMUTH_SIM, SCREENSHOT = (Path(each) for each in sys.argv[1:6])
BUSY = int(sys.argv[6]) if len(sys.argv) > 6 else 0
SAYS_WITHIN_S = 2.0
PATIENCE_S = 30.0  # for events without a promised delay
OUT_S = 4          # duration for which a cable is out

VIEW = "window.azimuthView"
BANNER = "document.querySelector('.banner')"
WELL = f"{BANNER}.hidden && document.querySelector('.connection').classList.contains('open')"

HEALTH = "document.querySelector('.now .state').textContent"


def says(words):
    return f"!{BANNER}.hidden && {BANNER}.textContent.includes({json.dumps(words)})"


class Robot:
    """Runs azimuth-sim. A later instance in the same folder has the same device, sockets and run folder."""

    def __init__(self, folder, run="drive"):
        self.folder = folder
        self.process = subprocess.Popen(
            [AZIMUTH_SIM, "--device", folder / "pioneer", "--camera-socket", folder / "camera.sock", "--control", folder / "control.sock",
             "--run-folder", folder / run, "--quiet"], stdout=subprocess.DEVNULL)
        self.rig = folder / run / "rig.toml"
        wait_for(lambda: self.rig.exists() and (folder / "pioneer").exists(), "azimuth-sim does not start")

    def obey(self, command):
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as control:
            control.connect(str(self.folder / "control.sock"))
            control.sendall(command.encode() + b"\n")
            if command.split("=")[0] not in control.recv(512).decode():
                raise AssertionError(f"azimuth-sim does not know {command}")


def wait_for(condition, words):
    end_s = time.monotonic() + PATIENCE_S
    while not condition():
        if time.monotonic() > end_s:
            raise AssertionError(words)
        time.sleep(0.05)


def start_daemon(folder, rig):
    return subprocess.Popen(
        [AZIMUTHD, "--config", TREE / "config/simulated-robot.toml", "--rig", rig, "--record", folder / "log",
         "--set", f"daemon.pioneer.device={folder / 'pioneer'}", "--set", f"daemon.live.camera_socket={folder / 'camera.sock'}",
         "--set", f"daemon.map.file={folder / 'map.azmap'}", "--set", "daemon.map.save_interval_s=2"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def goes_away(browser, what, take_away, words, bring_back=lambda: None):
    """Removes a part with `take_away` and brings it back. The page must say so in time and recover by itself, without
    taking the daemon for a new one and without losing the path."""
    points = browser.run(f"return {VIEW}.store.poses.length")
    browser.until(WELL, PATIENCE_S, f"{what}: all is well before")
    take_away()
    said_s = browser.until(says(words), SAYS_WITHIN_S, f"{what}: \"{words}\" is said")
    browser.until(f"{HEALTH} !== 'tracking'", SAYS_WITHIN_S, f"{what}: health follows")
    bring_back()
    back_s = browser.until(WELL, PATIENCE_S, f"{what}: it is over")
    print(f"{what}: said after {said_s:.2f} s, over {back_s:.1f} s later")
    newest = browser.run(f"return {VIEW}.store.poses.last('t')")
    browser.until(f"{VIEW}.store.poses.last('t') > {newest} + 0.3", PATIENCE_S, f"{what}: the robot goes on")
    if browser.run(f"return {VIEW}.store.poses.length") < points:
        raise AssertionError(f"{what}: the way before is forgotten")


def used_as_expected(browser):
    """Returns [observed azimuth, expected azimuth, gate] of the shown bearings that were used, if the expectations come
    from the daemon."""
    return browser.run(f"""const {{ own, bearings, expected }} = {VIEW}.store.bearings ?? {{}};
      const of = new Map((own ? expected : []).map((row) => [row[0], row]));
      return (bearings ?? []).filter((row) => row[4] === 'used' && of.has(row[5])).map((row) => [row[0], of.get(row[5])[1], of.get(row[5])[4]]);""")


def shows_what_the_daemon_expects(browser):
    wait_for(lambda: used_as_expected(browser), "no bearing is shown that was used as the daemon expected")
    far = [row for row in used_as_expected(browser) if abs(math.remainder(row[0] - row[1], math.tau)) > row[2]]
    if far:
        raise AssertionError(f"used, but outside of their gates: {far}")
    browser.until(f"!{VIEW}.charts.find(({{ spec }}) => spec.key === 'nis').node.hidden", PATIENCE_S, "NIS is charted")
    nis = browser.run(f"return {VIEW}.store.figures.get('nis').filter(Number.isFinite)")
    mean = sum(nis) / len(nis)
    if not 0.1 < mean < 3.0:
        raise AssertionError(f"NIS of {mean:.2f} on the average")
    print(f"NIS {mean:.2f} on the average of {len(nis)} seconds")


def shows_what_is_kept(browser):
    devices = "document.querySelector('.devices').textContent"
    browser.until(f"/MB of 8.0 GB; .* free/.test({devices})", PATIENCE_S, "how much of its quota the field log takes")
    browser.until(f"/Map file/.test({devices}) && /written \\d+\\.\\d s ago/.test({devices})", PATIENCE_S, "how old the map file is")


def watched(browser, folder, robot, view):
    daemon = start_daemon(folder, robot.rig)
    yield daemon
    browser.until(f"{VIEW}?.store.map.landmarks.length > 8 && {VIEW}.store.pose?.health === 1", PATIENCE_S, "it has a map")
    browser.complaints()  # drops the messages of the browser's start page
    if browser.run(f"return {VIEW}.link.begin") < -1.0:
        raise AssertionError("time begins before the drive does")
    for fault in ("unplug", "silence"):
        began_s = time.monotonic()
        goes_away(browser, f"cable: {fault}", lambda fault=fault: robot.obey(f"{fault}={OUT_S}"), "Odometer: ")
        if time.monotonic() - began_s < OUT_S:
            raise AssertionError(f"cable: {fault}: said to be over while it was out")
    for name, process, words in (("the daemon stands still", daemon, "from the daemon"), ("the server stands still", view, "from azimuth view"),
                                 ("the camera's process stands still", robot.process, "Camera: ")):
        goes_away(browser, name, lambda process=process: process.send_signal(signal.SIGSTOP), words,
                  lambda process=process: process.send_signal(signal.SIGCONT))
    shows_what_the_daemon_expects(browser)
    shows_what_is_kept(browser)
    robot.process.kill()
    robot.process.wait()
    for words in ("Odometer: ", "Camera: "):
        print(f"the robot is switched off: \"{words}\" after {browser.until(says(words), SAYS_WITHIN_S, words):.2f} s")
    browser.screenshot(SCREENSHOT)
    yield Robot(folder, "another").process
    print(f"another one is there: well {browser.until(WELL, PATIENCE_S, 'another robot'):.1f} s later")
    wrong = browser.complaints()
    if wrong:
        raise AssertionError(f"console: {wrong}")


def main():
    if not web_driver.is_here():
        print("SKIPPED: no chromium and chromedriver here")
        sys.exit(77)
    SCREENSHOT.parent.mkdir(parents=True, exist_ok=True)
    with contextlib.ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))

        def until_the_end(process):
            def end():
                process.send_signal(signal.SIGCONT)
                process.terminate()
                process.wait(20)
            stack.callback(end)
            return process

        robot = Robot(folder)
        until_the_end(robot.process)
        view = until_the_end(subprocess.Popen([AZIMUTH, "view", "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True))
        address = re.search(r"http://\S+", view.stdout.readline())[0]
        browser = stack.enter_context(web_driver.Browser(str(folder)))
        browser.open(address)
        for _ in range(BUSY):
            until_the_end(subprocess.Popen([sys.executable, "-c", "while True: pass"]))
        for process in watched(browser, folder, robot, view):
            until_the_end(process)


if __name__ == "__main__":
    main()
