#!/usr/bin/env python3
"""Checks the names of the tests in ctest and the names of their parameters in GoogleTest: they must be readable, easy
to type and the same in every run.

usage: test_names.py CTEST BUILD_FOLDER      exit code 0: all are good, 1: not, with the bad ones named
"""

import json
import re
import subprocess
import sys

GOOD_NAME = re.compile(r"[A-Za-z0-9_.,/<>:-]+")
# The text of GoogleTest for a value that it cannot print, and for a pointer, which differs between runs.
RAW_VALUE = re.compile(r"-byte object <|0x[0-9a-f]{6,}")


def bad_names(names):
    return [f"name: {name!a}" for name in names if not GOOD_NAME.fullmatch(name)]


def bad_values(listing):
    """The lines of `PROGRAM --gtest_list_tests` with an unreadable value."""
    bad, suite = [], ""
    for line in listing.splitlines():
        if not line.startswith(" "):
            suite = line.strip()
        elif RAW_VALUE.search(line) or not line.isprintable():
            bad.append(f"parameter: {suite}{line.strip()!a}")
    return bad


def tests_of(ctest, build):
    listed = subprocess.run([ctest, "--test-dir", build, "--show-only=json-v1"], stdout=subprocess.PIPE, check=True)
    return json.loads(listed.stdout.decode("utf-8", "backslashreplace"))["tests"]


def listing_of(program):
    asked = subprocess.run([program, "--gtest_list_tests"], stdout=subprocess.PIPE, check=True)
    return asked.stdout.decode("utf-8", "backslashreplace")


def main():
    tests = tests_of(*sys.argv[1:3])
    bad = bad_names(test["name"] for test in tests)
    programs = {test["command"][0] for test in tests
                if any(word.startswith("--gtest_filter=") for word in test.get("command", []))}
    for program in sorted(programs):
        bad += bad_values(listing_of(program))
    if bad:
        sys.exit("\n".join(bad))
    if len(tests) < 100 or not programs:
        sys.exit(f"only {len(tests)} tests of {len(programs)} programs: nothing was checked")
    print(f"{len(tests)} names, {len(programs)} programs")


if __name__ == "__main__":
    main()
