#!/usr/bin/env python3
"""Runs scripts/demo --view with the programs of this build, in a tree where nothing has to be built. The script must
play a run, then serve it at the printed address, and stop on a signal.

usage: demo_view_test.py SOURCE_TREE BUILD_TREE
Needs a network namespace whose loopback interface carries multicast. Exit code 0: good, 1: not, 77: lcm-logger is missing.
"""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
from pathlib import Path

TREE, BUILD = Path(sys.argv[1]), Path(sys.argv[2])
ADDRESS = "http://localhost:8017"
PATIENCE_S = 120.0


def place(folder):
    """Makes a tree for the script in which nothing has to be installed or built; returns the environment."""
    shutil.copytree(TREE / "scripts", folder / "scripts")
    for name in ("runs", "config"):
        (folder / name).symlink_to(TREE / name)
    (folder / "build").mkdir()
    (folder / "build/release").symlink_to(BUILD)
    for stand_in in ("scripts/setup", "bin/cmake"):
        file = folder / stand_in
        file.parent.mkdir(exist_ok=True)
        file.write_text("#!/bin/sh\nexit 0\n")
        file.chmod(0o755)
    return os.environ | {"PATH": f"{folder / 'bin'}:{os.environ['PATH']}", "DISPLAY": "", "WAYLAND_DISPLAY": ""}


def asked(path):
    with urllib.request.urlopen(ADDRESS + path, timeout=10) as answer:
        return answer.read()


def wait_until_served(demo):
    end_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < end_s and demo.poll() is None:
        try:
            return asked("/health")
        except (urllib.error.URLError, ConnectionError):
            time.sleep(0.2)
    raise AssertionError("nothing is served")


def problems(demo):
    if json.loads(wait_until_served(demo)).get("shows") != "recorded":
        yield "the page is not that of a recording"
    run = json.loads(asked("/run.json"))
    if "lab" not in json.dumps(run)[:2000]:
        yield "it is not the run that was played"
    demo.send_signal(signal.SIGTERM)
    if demo.wait(20) != 0:
        yield f"stopped with exit code {demo.returncode}"


def main():
    if not shutil.which("lcm-logger"):
        print("SKIPPED: no lcm-logger here")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        environment = place(folder)
        with open(folder / "said", "w+", encoding="utf-8") as said:
            demo = subprocess.Popen([folder / "scripts/demo", "--run", "runs/lab", "--speed", "40", "--view"], cwd=folder, env=environment,
                                    stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.STDOUT)
            try:
                found = list(problems(demo))
            except AssertionError as error:
                found = [str(error)]
            finally:
                if demo.poll() is None:
                    demo.kill()
                    demo.wait()
            said.seek(0)
            words = said.read()
        if f"the drive at {ADDRESS}" not in words:
            found.append("it does not say where to look")
        if not (folder / "build/demo/lab.lcmlog").exists():
            found.append("the messages are not recorded")
    if found:
        sys.exit("\n".join([*found, words]))
    print(f"played, and shown at {ADDRESS}")


if __name__ == "__main__":
    main()
