#!/usr/bin/env python3
"""Counts the cases in JUnit files of ctest. Prints failed cases with the end of their output, and skipped ones with the
reason.

usage: count_tests.py [--say LINE] FILE...    last line: `N passed, N failed, N skipped`, before it what else is to be said;
                                              exit code 1 when one failed or none ran
"""

import argparse
import re
import sys
import xml.etree.ElementTree as ElementTree

# The reasons of skipped tests as GoogleTest, the scripts that start tests and the Python tests print them.
REASON = re.compile(r"(?:: Skipped\n|^SKIPPED: |^skipped: )(.*)", re.MULTILINE)

LAST_LINES = 20     # of the output of a failed case


def outcome(case):
    """The outcome of a case. ctest writes run, fail, notrun or disabled; a skipped case is `notrun` with a <skipped>
    child."""
    if case.find("skipped") is not None or case.get("status") == "disabled":
        return "skipped"
    return "passed" if case.get("status") == "run" and case.find("failure") is None else "failed"


def reason(case):
    if case.get("status") == "disabled":
        return ": disabled; why stands where it is defined"
    said = REASON.search(case.findtext("system-out") or "")
    return f": {said[1].strip()}" if said and said[1].strip() else ""


def said_last(case):
    lines = (case.findtext("system-out") or "").strip().splitlines()
    return "".join(f"\n    {line}".rstrip() for line in lines[-LAST_LINES:])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--say")
    parser.add_argument("files", nargs="*")
    given = parser.parse_args()
    cases = {"passed": [], "failed": [], "skipped": []}
    for path in given.files:
        for case in ElementTree.parse(path).getroot().iter("testcase"):
            cases[outcome(case)].append(case)
    for case in cases["skipped"]:
        print(f"skipped: {case.get('name')}{reason(case)}")
    for case in cases["failed"]:
        print(f"failed: {case.get('name')}{said_last(case)}")
    if given.say:
        print(given.say)
    print(", ".join(f"{len(cases[kind])} {kind}" for kind in ("passed", "failed", "skipped")))
    sys.exit(1 if cases["failed"] or not cases["passed"] else 0)


if __name__ == "__main__":
    main()
