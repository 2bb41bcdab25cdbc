#!/usr/bin/env python3
"""Writes the tables that come of replays into the documents, between `<!-- made by scripts/results: NAME -->` and `<!--
to here -->`.

usage: documents.py FOLDER      where the workflow ran: numbers.json and the documents are written anew
"""

import json
import re
import sys
from pathlib import Path

import numbers_kept
import tables

TREE = Path(__file__).resolve().parents[3]
DOCUMENTS = ("docs/results.md", "README.md")
BLOCK = re.compile(r"(<!-- made by scripts/results: (\w+) -->\n\n).*?(\n<!-- to here -->\n)", flags=re.S)


class Mistake(Exception):
    pass


def run_of(report, file):
    seed = re.search(r"\.seed(\d+)$", file.stem)
    return numbers_kept.name_of(report["name"], seed and seed[1])


def read(folder):
    """Reads {variant: {run: numbers}} from the workflow's reports. No replay may have failed."""
    numbers = {}
    for file in sorted(folder / line for line in (folder / "fleet/reports.txt").read_text(encoding="utf-8").splitlines()):
        report = json.loads(file.read_text(encoding="utf-8"))
        if "failure" in report:
            raise Mistake(f"{report['name']}: {report['failure']}: to try it again, delete {file}")
        numbers.setdefault(file.parent.name, {})[run_of(report, file)] = numbers_kept.numbers_of(report)
    return numbers


def with_tables(text, made):
    """The document with the tables in `made` inserted into its blocks."""
    for _, name, _ in BLOCK.findall(text):
        if name not in made:
            raise Mistake(f"{name}: there is no such table, but {', '.join(made)}")
    return BLOCK.sub(lambda block: block[1] + made[block[2]] + block[3], text)


def main():
    try:
        numbers = read(Path(sys.argv[1]))
        made = tables.made_of(numbers)
        numbers_kept.FILE.write_text(numbers_kept.text_of(numbers), encoding="utf-8")
        for document in DOCUMENTS:
            file = TREE / document
            file.write_text(with_tables(file.read_text(encoding="utf-8"), made), encoding="utf-8")
    except Mistake as mistake:
        sys.exit(f"documents.py: {mistake}")


if __name__ == "__main__":
    main()
