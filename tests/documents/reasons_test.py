#!/usr/bin/env python3
"""Tests the comparison of documents and code: it names each reason, line or key that one of them lacks."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from tree_check import Bites  # noqa: E402

from reasons import violations  # noqa: E402

JUDGEMENT = '''std::string_view why_lost(const Evidence& evidence) {
  if (evidence.far) return "too far";
  return "";
}

Judgement judged() {
  if (searching) return Judgement{Health::lost, why_lost(evidence)};
  return {Health::degraded, "nothing seen"};
}
'''
TROUBLES = '''constexpr std::string_view to_string(ImageTrouble trouble) {
  switch (trouble) {
    case ImageTrouble::dark:
      return "dark";
  }
  return "?";
}
std::string_view to_string(Other other) { return "no reason"; }
'''
ROWS = "| reason | cause |\n|---|---|\n| `too far` | x |\n| `nothing seen` | x |\n| `dark` | x |\n"
GOOD = {
    "slam/judgement.cpp": JUDGEMENT,
    "slam/sample/troubles.hpp": TROUBLES,
    "docs/troubleshooting.md": f"# Help\n\n## Reasons of all kinds\n\n{ROWS}\n## Devices\n\n| `silent` | x |\n",
    "docs/tuning.md": "# Tuning\n\n## The text\n\n| `run` | x |\n| `saved` | x |\n\n## The JSON\n\n| `steps`, `map` | x |\n",
    "tools/replay/summary.cpp": 'text += line("run", words);\n',
    "tools/azimuth/replay_outputs.cpp": 'fmt::print("saved       {}\\n", file);\n',
    "tools/azimuth/replay_command.cpp": "\n",
    "tools/evaluate/report_json.cpp": 'json["steps"] = {{"map", 1}};\n',
}

BAD = [  # file, its text, where and what the message must name
    ("slam/judgement.cpp", JUDGEMENT.replace("too far", "too near"), "docs/troubleshooting.md: ", "too"),
    ("slam/more.cpp", 'x = {Health::lost, "new"};\n', "docs/troubleshooting.md: ", 'lacks "new"'),
    ("slam/more.cpp", 'out.reason = "new";\n', "docs/troubleshooting.md: ", 'lacks "new"'),
    ("slam/more.cpp", 'Trust trust(const E& e) {\n  return {"new"};\n}\n', "docs/troubleshooting.md: ", 'lacks "new"'),
    ("slam/more.cpp", "out.reason = text_of(x);\n", "slam/more.cpp: ", "not understood"),
    ("slam/more.cpp", "return {Health::lost, text_of(x)};\n", "slam/more.cpp: ", "not understood"),
    ("docs/troubleshooting.md", f"## Reasons\n\n{ROWS}| `gone` | x |\n", "docs/troubleshooting.md: ", 'nobody gives "gone"'),
    ("docs/troubleshooting.md", f"## Reasons\n\n{ROWS}| `dark` | x |\n", "docs/troubleshooting.md: ", "twice"),
    ("tools/replay/summary.cpp", 'line("run", x); line("by name", x);\n', "docs/tuning.md: ", 'line "by name"'),
    ("tools/azimuth/replay_outputs.cpp", "\n", "docs/tuning.md: ", 'line "saved"'),
    ("tools/evaluate/report_json.cpp", 'json["steps"] = {{"map", 1}, {"share", 2}};\n', "docs/tuning.md: ", 'key "share"'),
]


class ReasonsCheck(Bites, unittest.TestCase):
    GOOD = GOOD
    violations = staticmethod(violations)

    def test_every_difference_is_named(self):
        for path, text, where, named in BAD:
            with self.subTest(path=path, text=text):
                found = self.found_with({path: text})
                self.assertTrue(any(each.startswith(where) and named in each for each in found), found)


if __name__ == "__main__":
    unittest.main()
