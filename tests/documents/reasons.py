#!/usr/bin/env python3
"""Compares documents with the code that they explain: docs/troubleshooting.md must have every reason of a health and no
other, and docs/tuning.md every line and every key of a report.

usage: reasons.py SOURCE_TREE      exit code 0: they agree, 1: not, one `file: message` each
"""

import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import tree_check  # noqa: E402

REASONS, REPORT = "docs/troubleshooting.md", "docs/tuning.md"
LITERAL = re.compile(r'"([^"]*)"')
# Functions whose texts are reasons, up to the closing brace in the first column.
FUNCTION = re.compile(r"^(?:constexpr )?(?:std::string_view (?:\w+::)?(?:why_\w+|to_string\((?=ImageTrouble|SampleTrouble))"
                      r"|Trust trust\()[^;{]*\{(.*?)^\}", flags=re.M | re.S)
# Other places that set a reason: a health with its reason, and assignments.
GIVEN = re.compile(r"Health::\w+,\s*([^;]*?)\};|(?:\.reason|\.doubt)\s*=(?!=)\s*([^;]*);", flags=re.S)
# Expressions that take a reason from the functions above or from another judgement.
FOLLOWED = re.compile(r'"[^"]*"|\b(?:why_\w+|to_string)\([^()]*\)|\b(?:judgement|evidence|trust)\.\w+|\bmapper_->doubt\(\)|\breason\b|\bblind\b|\b\w+\.is_away\(\)')


def of_code(text):
    """Returns (reasons, expressions whose text cannot be traced) of one file."""
    reasons = {literal for body in FUNCTION.findall(text) for literal in LITERAL.findall(body)}
    strange = []
    for found in GIVEN.finditer(text):
        value = found[1] if found[1] is not None else found[2]
        reasons.update(LITERAL.findall(value))
        if not FOLLOWED.search(value) or re.sub(r"[?:()\s]|\.empty", "", FOLLOWED.sub("", value)):
            strange.append(found[0])
    return reasons - {"", "?"}, strange


def section(text, title):
    """The sections whose headings begin with `title`."""
    return "\n".join(re.findall(rf"^## {title}.*?(?=^## |\Z)", text, flags=re.M | re.S))


def first_cells(text):
    return re.findall(r"^\| `([^`]+)` \|", text, flags=re.M)


def reason_violations(tree):
    known = set()
    for file in [*sorted((tree / "slam").rglob("*.[ch]pp")), *(tree / "daemon/publish").glob("status.cpp")]:
        reasons, strange = of_code(file.read_text(encoding="utf-8"))
        known |= reasons
        for text in strange:
            yield f"{file.relative_to(tree)}: where this reason comes from is not understood: {' '.join(text.split())}"
    if not known:
        yield "slam: not one reason is found"
    rows = first_cells(section((tree / REASONS).read_text(encoding="utf-8"), "Reasons"))
    for reason in sorted(known - set(rows)):
        yield f'{REASONS}: lacks "{reason}"'
    for reason in sorted(set(rows) - known):
        yield f'{REASONS}: nobody gives "{reason}" as a reason'
    for reason in sorted({row for row in rows if rows.count(row) > 1}):
        yield f'{REASONS}: has "{reason}" twice'


def report_violations(tree):
    document = (tree / REPORT).read_text(encoding="utf-8")
    lines = set()
    for file in ("tools/replay/summary.cpp", "tools/azimuth/replay_outputs.cpp", "tools/azimuth/replay_command.cpp"):
        lines.update(re.findall(r'(?:\bline\(|time_summary\(|fmt::print\()\s*"([a-z0-9][a-z0-9 ]*?)(?: {2,}[^"]*)?"', (tree / file).read_text(encoding="utf-8")))
    rows = set(first_cells(section(document, "The text")))
    for line in sorted(lines - rows):
        yield f'{REPORT}: lacks the line "{line}"'
    for row in sorted(rows - lines):
        yield f'{REPORT}: no report has a line "{row}"'
    code = (tree / "tools/evaluate/report_json.cpp").read_text(encoding="utf-8")
    keys = set(re.findall(r'\{"(\w+)",|json\["(\w+)"\]', code))
    spans = set(re.findall(r"`(\w+)`", section(document, "The JSON")))
    for key in sorted({a or b for a, b in keys} - spans):
        yield f'{REPORT}: lacks the key "{key}"'


def violations(tree):
    yield from reason_violations(tree)
    yield from report_violations(tree)


if __name__ == "__main__":
    tree_check.run(violations, needs=REASONS, clean="reasons: documents and code agree")
