#!/usr/bin/env python3
"""Tests test_names.py."""

import unittest

from test_names import bad_names, bad_values


class Names(unittest.TestCase):
    def test_names_as_they_should_be(self):
        self.assertEqual(bad_names(["Suite.Case", "Each/Suite.Case/hyperbolic_flat", "packaging.users", "a-b"]), [])

    def test_bytes_blanks_and_parameters_are_bad(self):
        for name in ("Suite.Case/80-byte object <01-00>", "Suite.Case/x  # GetParam() = x", "Suite.\x07", "Suite.\xe9"):
            self.assertEqual(len(bad_names([name])), 1, name)


class Values(unittest.TestCase):
    def test_printed_values_are_good(self):
        self.assertEqual(bad_values("Each/Suite.\n  Case/small  # GetParam() = small\n  Case/1  # GetParam() = (1, 0.5)\n"),
                         [])

    def test_bytes_and_addresses_are_bad(self):
        self.assertEqual(bad_values("Suite.\n  Case/0  # GetParam() = 4-byte object <01-00 00-00>\n"),
                         ["parameter: Suite.'Case/0  # GetParam() = 4-byte object <01-00 00-00>'"])
        self.assertEqual(len(bad_values("Suite.\n  Case/0  # GetParam() = 0x55d0c0ffee00 pointing to \"a\"\n")), 1)
        self.assertEqual(len(bad_values("Suite.\n  Case/0  # GetParam() = \x01\n")), 1)


if __name__ == "__main__":
    unittest.main()
