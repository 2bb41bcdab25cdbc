#!/usr/bin/env python3
"""Tests the check of type names: it finds each second type of a name, and no code that only resembles one."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from tree_check import Bites  # noqa: E402

from one_definition import violations  # noqa: E402

GOOD = {
    "slam/ceiling/lamp_map.hpp": """#pragma once
namespace azimuth {

struct Pose2;  // declared here, defined elsewhere
struct Lamp {
  struct Place {};
};
enum class Health : unsigned char { lost, tracking };
using Lamps = Lamp*;
inline Lamp make_lamp() { return {}; }
}  // namespace azimuth
""",
    # Uses of the same names that are allowed: nested types, other namespaces, unnamed namespaces, declarations and
    # specialisations.
    "slam/ekf/others.hpp": """#pragma once
#define HEALTH struct Health {};
namespace azimuth {

struct Lamp;
class Place {
  struct Lamp {};
  enum class Health { good };
};
// struct Lamp {
inline const char* said() { return "struct Lamp {"; }
namespace sim {
struct Lamp {};
}  // namespace sim
struct Lamp* find(struct Lamp* lamp);
}  // namespace azimuth
""",
    "tools/lens_fit/lens.cpp": "namespace azimuth {\nnamespace {\nstruct Lamp {};\n}\nvoid f() { struct Lamp {}; }\n}\n",
}

BAD = [  # text after the first line, and the name in the message
    ("namespace azimuth {\nstruct Lamp {};\n}", "azimuth::Lamp"),
    ("namespace azimuth {\nclass Lamp final : public Base {};\n}", "azimuth::Lamp"),
    ("namespace azimuth {\ntemplate <class T, class U = V<T>>\nclass Lamp {};\n}", "azimuth::Lamp"),
    ("namespace azimuth {\nenum class Lamp { on };\n}", "azimuth::Lamp"),
    ("namespace azimuth {\nstruct [[nodiscard]] Lamp {};\n}", "azimuth::Lamp"),
    ("namespace azimuth {\nusing Lamp = int;\n}", "azimuth::Lamp"),
    ("namespace azimuth {\nvoid f(int = 3) {}\nunion Lamp {};\n}", "azimuth::Lamp"),
    ("namespace azimuth::sim {\nstruct Lamp {};\n}", "azimuth::sim::Lamp"),
]


class OneDefinition(Bites, unittest.TestCase):
    GOOD = GOOD
    violations = staticmethod(violations)

    def test_every_second_type_of_a_name_is_found(self):
        for text, name in BAD:
            with self.subTest(text=text):
                line = next(i for i, one in enumerate(text.splitlines(), 2) if "Lamp" in one)
                self.expect_one({"tools/lens_fit/more.hpp": f"#pragma once\n{text}\n"},
                                f"tools/lens_fit/more.hpp:{line}:", f" {name} is defined in ")


if __name__ == "__main__":
    unittest.main()
