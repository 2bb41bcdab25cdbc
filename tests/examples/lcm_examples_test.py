#!/usr/bin/env python3
"""Lets both examples listen to azimuthd, which plays the beginning of the shipped run. They must receive the same
poses, the map and the health.

usage: lcm_examples_test.py SOURCE_TREE AZIMUTHD LISTEN LCM_GEN      needs a network namespace whose loopback carries multicast
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PLAYED_S = 10.0
LEAST_HEARD = 0.5  # share of the poses; datagrams may be lost on a busy machine

TREE, AZIMUTHD, LISTEN, LCM_GEN = (Path(each) for each in sys.argv[1:5])


def shortened_run(folder):
    run = folder / "run"
    shutil.copytree(TREE / "runs/lab", run)
    for name in ("odometry.csv", "bearings.csv", "truth.csv"):
        head, *rows = (run / name).read_text().splitlines(keepends=True)
        (run / name).write_text(head + "".join(row for row in rows if float(row.split(",")[0]) <= PLAYED_S))
    return run


def listeners(folder):
    """Starts the C++ and the Python example and waits until both report that they listen."""
    types = [TREE / f"drivers/lcmtypes/{name}.lcm" for name in ("pose_cov_t", "map_chunk_t", "landmark_t")]
    subprocess.run([LCM_GEN, "-p", "--ppath", folder, *types], check=True, stdout=subprocess.DEVNULL)
    started = []
    for command, environment in (([LISTEN], None),
                                 ([sys.executable, "-B", TREE / "docs/examples/lcm/listen.py"], {"PYTHONPATH": str(folder)})):
        process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)
        if process.stdout.readline() != "listening\n":
            sys.exit(f"{command}: does not listen")
        started.append(process)
    return started


def steps(text):
    """The lines with poses, keyed by their step."""
    return {int(found[1]): found[0] for found in re.finditer(r"^step (\d+)  x .*$", text, flags=re.M)}


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        in_cpp, in_python = listeners(folder)
        played = subprocess.run([AZIMUTHD, "--play", shortened_run(folder), "--speed", "5", "--print-poses"], stdout=subprocess.PIPE, text=True, check=False)
        heard = []
        for process in (in_cpp, in_python):
            process.terminate()
            heard.append(process.communicate(timeout=20)[0])
    sent = len(re.findall(r"^t [\d.]+ s  ", played.stdout, flags=re.M))
    by_cpp, by_python = steps(heard[0]), steps(heard[1])
    if played.returncode or sent < 20:
        sys.exit(f"azimuthd sent {sent} poses, exit code {played.returncode}")
    if min(len(by_cpp), len(by_python)) < LEAST_HEARD * sent:
        sys.exit(f"of {sent} poses {len(by_cpp)} were heard in C++ and {len(by_python)} in Python")
    if different := [step for step in by_cpp.keys() & by_python.keys() if by_cpp[step] != by_python[step]]:
        sys.exit(f"not the same:\n{by_cpp[different[0]]}\n{by_python[different[0]]}")
    if not re.search(r"^map of [1-9]\d* landmarks$", heard[1], flags=re.M):
        sys.exit(f"no map was heard:\n{heard[1]}")
    if not re.search(r"^health 1 $", heard[0], flags=re.M):
        sys.exit(f"no health of tracking was heard:\n{heard[0]}")
    print(f"of {sent} poses {len(by_cpp)} heard in C++, {len(by_python)} in Python")


if __name__ == "__main__":
    main()
