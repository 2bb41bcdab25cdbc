#!/usr/bin/env python3
"""Divides the tests with the label `statistics` or `nightly`, which take too long for every change, into twenty shares
of equal length. Each commit runs one share, so that twenty consecutive commits run all of them.

usage: test_shares.py share BUILD [TURN]   TURN (0 to 19, default: the commit's), and those that ctest is to run, for its
                                           option -I; then, for people, which these are
       test_shares.py left-out BUILD       for people: what a run without them leaves out, and how to run it
       test_shares.py measured BUILD       writes the times of the last scripts/test into tests/seconds.txt

The shares depend only on tests/seconds.txt, so that they stay the same from commit to commit. A test without a time
gets its share from its name, and counts with a typical time. """

import json
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
import zlib
from pathlib import Path

TREE = Path(__file__).resolve().parents[2]
LONG = {"statistics", "nightly"}
TURNS = 20
USUAL_S = 20.0  # typical time of a test without a measured time
CORES = 2       # of the machine for which times are printed


def listed(build):
    """The long tests as (number, name). ctest numbers tests in the order of its list."""
    said = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True, text=True, check=True)
    for number, test in enumerate(json.loads(said.stdout)["tests"], 1):
        labels = next((each["value"] for each in test.get("properties", []) if each["name"] == "LABELS"), [])
        if LONG & set(labels):
            yield number, test["name"]


def seconds_by_name(file):
    """Reads lines `SECONDS NAME` to a dictionary {name: seconds}."""
    lines = (line.split(maxsplit=1) for line in file.read_text(encoding="utf-8").splitlines() if not line.startswith("#"))
    return {name: float(seconds) for seconds, name in lines}


def deal(seconds):
    """Assigns a share to each test: the longest test first, each to the share with the smallest sum so far."""
    turns, filled = {}, [0.0] * TURNS
    for name in sorted(seconds, key=lambda name: (-seconds[name], name)):
        turn = filled.index(min(filled))
        turns[name] = turn
        filled[turn] += seconds[name]
    return turns


def turn_of(name, dealt):
    return dealt[name] if name in dealt else zlib.crc32(name.encode()) % TURNS


def git(tree, *arguments):
    try:
        said = subprocess.run(["git", *arguments], cwd=tree, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return None
    return said.stdout.strip() if said.returncode == 0 else None


def turn_of_commit(tree):
    """The share of a commit: the number of earlier commits modulo twenty, or the day if there is no history."""
    if git(tree, "rev-parse", "--is-shallow-repository") == "false" and (count := git(tree, "rev-list", "--count", "HEAD")):
        return int(count) % TURNS
    return int(time.time() / 86400) % TURNS


def minutes(names, seconds):
    total_s = sum(seconds.get(name, USUAL_S) for name in names)
    return max(1, round(total_s / 60 / CORES))


def share(build, seconds, turn):
    dealt = deal(seconds)
    every = list(listed(build))
    mine = [(number, name) for number, name in every if turn_of(name, dealt) == turn]
    print(turn)
    print(",".join(str(number) for number, _ in mine))
    print(f"share {turn} of 0 to {TURNS - 1}: {len(mine)} of {len(every)} statistics and nightly tests, "
          f"some {minutes([name for _, name in mine], seconds)} min on {CORES} cores")
    for _, name in mine:
        print(f"  {name}")


def left_out(build, seconds):
    names = [name for _, name in listed(build)]
    print(f"left out: {len(names)} tests labelled statistics or nightly, some {minutes(names, seconds)} min on {CORES} cores: "
          "`scripts/test --all` runs them too, `scripts/test --share` a twentieth of them")


def measured(build, file):
    """Writes the measured times. Tests that did not run keep their times, and removed tests are dropped."""
    seconds = seconds_by_name(file)
    results = ElementTree.parse(Path(build) / "test-results.xml").getroot().iter("testcase")
    seconds |= {case.get("name"): float(case.get("time")) for case in results if case.get("status") == "run"}
    kept = sorted(((seconds[name], name) for _, name in listed(build) if name in seconds), key=lambda one: (-one[0], one[1]))
    head = [line for line in file.read_text(encoding="utf-8").splitlines() if line.startswith("#")]
    file.write_text("\n".join(head + [f"{time_s:.1f} {name}" for time_s, name in kept]) + "\n", encoding="utf-8")


def main(does, build, turn=None):
    file = TREE / "tests/seconds.txt"
    if does == "share":
        share(build, seconds_by_name(file), turn_of_commit(TREE) if turn is None else int(turn))
    elif does == "left-out":
        left_out(build, seconds_by_name(file))
    elif does == "measured":
        measured(build, file)
    else:
        sys.exit(f"test_shares.py: unknown argument: {does}")


if __name__ == "__main__":
    main(*sys.argv[1:])
