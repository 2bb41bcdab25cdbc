"""Shared by the checks of the source tree: their main program, and tests that each check finds violations."""

import sys
import tempfile
from pathlib import Path


def run(violations, needs, clean):
    """Main program: prints all violations in the given tree, which must contain `needs`; exit code 0 or 1."""
    if len(sys.argv) != 2 or not (Path(sys.argv[1]) / needs).exists():
        sys.exit(f"usage: {Path(sys.argv[0]).name} SOURCE_TREE (the folder that holds {needs})")
    found = list(violations(Path(sys.argv[1])))
    print("\n".join(found) if found else clean)
    sys.exit(1 if found else 0)


class Bites:
    """Mixin for a unittest.TestCase with `violations` and with `GOOD`, a tree without violations (text by path)."""

    def found_with(self, extra):
        """Violations in the good tree after adding or replacing the files `extra`."""
        with tempfile.TemporaryDirectory() as folder:
            tree = Path(folder)
            for path, text in {**self.GOOD, **extra}.items():
                (tree / path).parent.mkdir(parents=True, exist_ok=True)
                (tree / path).write_text(text, encoding="utf-8")
            return list(self.violations(tree))

    def test_good_tree_is_clean(self):
        self.assertEqual(self.found_with({}), [])

    def expect_one(self, extra, where, named):
        """Expects one violation: its message starts with `where` and contains `named`."""
        found = self.found_with(extra)
        self.assertEqual(len(found), 1, found)
        self.assertIn(named, found[0])
        self.assertTrue(found[0].startswith(where), found[0])
