#!/usr/bin/env python3
"""Counts the cases of ctest's JUnit files, names what failed and what was skipped.

usage: count_tests.py FILE...    last line: `N passed, N failed, N skipped`; exit code 1 when one failed or none ran
"""

import sys
import xml.etree.ElementTree as ElementTree


def outcome(case):
    """ctest writes run, fail, notrun or disabled; a skipped case is `notrun` with a <skipped> child."""
    if case.find("skipped") is not None or case.get("status") == "disabled":
        return "skipped"
    return "passed" if case.get("status") == "run" and case.find("failure") is None else "failed"


def main():
    names = {"passed": [], "failed": [], "skipped": []}
    for path in sys.argv[1:]:
        for case in ElementTree.parse(path).getroot().iter("testcase"):
            names[outcome(case)].append(case.get("name"))
    for kind in ("skipped", "failed"):
        for name in names[kind]:
            print(f"{kind}: {name}")
    print(", ".join(f"{len(names[kind])} {kind}" for kind in ("passed", "failed", "skipped")))
    sys.exit(1 if names["failed"] or not names["passed"] else 0)


if __name__ == "__main__":
    main()
