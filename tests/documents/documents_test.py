#!/usr/bin/env python3
"""Tests the check of documents: it finds each bad citation in a small tree at its place, and the good tree is clean."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from tree_check import Bites  # noqa: E402

from documents import violations  # noqa: E402

GOOD = {
    "README.md": "# Us\n\n## Run folders\n\n[notes](docs/notes.md#a-heading-with-code), `[no](link)`, [out](https://example.org/x.md)\n",
    "docs/mathematics.md": "# Part I: one\n\n## I.1 State\n## I.12 Looks\n\n# Part II: two\n\n## II.3 Step\n",
    "docs/notes.md": "# Notes\n\n## A heading, with `code`\n\n## Twice\n\n## Twice\n\n[back](../README.md), [here](#twice-1), `slam/*.hpp`, `slam/`\n",
    "slam/a.hpp": ("// See mathematics I.1 and II.3, mathematics I.1 to I.12, mathematics part II, docs/notes.md, README, \"Run folders\", mathematics\n"
                   "/// I.12; also mathematics II.3, part I. The mathematics of a section.\n"),
}

BAD = [  # file, line, what the message must name
    ("slam/b.hpp", "// mathematics I.2", "no section I.2"),
    ("slam/b.hpp", "// mathematics I.1 to I.14", "no section I.14"),
    ("slam/b.hpp", "// mathematics I.1, part IV", "no part IV"),
    ("slam/b.hpp", "// mathematics part V", "no part V"),
    ("slam/CMakeLists.txt", "# mathematics VI.1", "no section VI.1"),
    ("slam/b.hpp", "// docs/other.md", "no docs/other.md"),
    ("slam/b.hpp", '// docs/notes.md, "Nothing"', 'no heading "Nothing"'),
    ("slam/b.hpp", '// README, "Other folders"', 'no heading "Other folders"'),
    ("slam/b.hpp", "// CONTRIBUTING says so", "no CONTRIBUTING.md"),
    ("slam/b.hpp", "// see DESIGN", "DESIGN is no document"),
    ("slam/b.hpp", "// see notes.md", "notes.md is no document"),
    ("docs/b.md", "[x](other.md)", "other.md is not there"),
    ("docs/b.md", "[x](notes.md#nowhere)", "no such heading"),
    ("docs/b.md", "![x](map.png)", "map.png is not there"),
    ("docs/b.md", "touch `slam/a.{hpp,cpp}` for that", "slam/a.cpp is not there"),
    ("docs/b.md", "touch `slam/NAME/c.hpp`, then `slam/c*.hpp`", "slam/c*.hpp is not there"),
]


class DocumentsCheck(Bites, unittest.TestCase):
    GOOD = GOOD
    violations = staticmethod(violations)

    def test_every_bad_citation_is_found_at_its_place(self):
        for path, line, named in BAD:
            with self.subTest(path=path, line=line):
                self.expect_one({path: f"first line\n{line}\n"}, f"{path}:2: ", named)


if __name__ == "__main__":
    unittest.main()
