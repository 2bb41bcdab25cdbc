#!/usr/bin/env python3
"""Runs a sweep over a small simulated corpus. It must find the known best setting and replay only this one over the
held-out runs. A wider sweep must only do the new replays.

usage: sweep_workflow_test.py SOURCE_TREE AZIMUTH      exit code 0: good, 1: not, 77: snakemake is missing
"""

import json
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

from workflow import Workflow, simulate_corpus

TREE, AZIMUTH = Path(sys.argv[1]), Path(sys.argv[2])
RUNS, HELD_OUT = 4, 1     # run1 has the tag "first"
TRAINING = RUNS - HELD_OUT

# On drives of 20 s, a thinning to one update per five seconds is worse than a thinning to one per two seconds.
SWEEP = """
sweep:
  settings: {{{{smoother.thinning_s: {values}}}}}
  criterion: {criterion}
  hold_out: first
"""


class Sweep(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        simulate_corpus(AZIMUTH, Path(scratch.name) / "corpus", RUNS)
        self.workflow = Workflow(TREE, AZIMUTH, Path(scratch.name) / "corpus", Path(scratch.name) / "sweep")

    def sweep(self, values, criterion="position_rmse_m"):
        """Runs a sweep; returns its table as JSON and as text, and the number of replays that it did."""
        before = len(self.workflow.done())
        self.workflow.configure(2, more=SWEEP.format(values=values, criterion=criterion))
        self.workflow.run()
        text = (self.workflow.folder / "out/sweep/sweep.txt").read_text()
        return json.loads((self.workflow.folder / "out/sweep/sweep.json").read_text()), text, len(self.workflow.done()) - before

    def test_best_is_found_and_tried_on_what_was_held_out(self):
        table, text, done = self.sweep([5, 2])
        self.assertEqual(table["best"], "smoother.thinning_s=2")
        self.assertEqual([each["settings"] for each in table["settings"]], ["smoother.thinning_s=2", "smoother.thinning_s=5"])
        self.assertEqual([each["pairs"] for each in table["settings"]], [TRAINING, TRAINING])
        for each in table["settings"]:
            self.assertLess(each["low"], each["high"])
        self.assertEqual((table["held_out"]["pairs"], table["held_out"]["tag"]), (HELD_OUT, "first"))
        self.assertIn(f"held out    {HELD_OUT} run with tag first: too few to tell", text)
        self.assertEqual(done, 2 * RUNS + 2 * TRAINING + HELD_OUT, "two variants, two settings, the better of them on what was held out")

        table, _, done = self.sweep([5, 2, 0.2])
        self.assertEqual(table["best"], "smoother.thinning_s=0.2")
        self.assertEqual(done, TRAINING + HELD_OUT, "the new one")

        self.typed(0.2, 4)

        with self.assertRaisesRegex(AssertionError, "fleet: sweep: criterion: beauty: is none of position_rmse_m, "):
            self.sweep([5, 2], criterion="beauty")

    def typed(self, *values):
        """Runs the sweep from the command line of tools/fleet/run, which must not repeat earlier replays."""
        before = len(self.workflow.done())
        self.workflow.configure(2)
        swept = ["--sweep", f"smoother.thinning_s={','.join(map(str, values))}", "--hold-out", "first"]
        self.workflow.run(*swept)
        self.assertEqual(len(self.workflow.done()) - before, TRAINING, "the new one")
        self.workflow.run(*swept, "--sweep", "ekf.max_landmarks=11")
        self.assertEqual(len(self.workflow.done()) - before, TRAINING + len(values) * TRAINING + HELD_OUT, "now of two keys")
        page = (self.workflow.folder / "out/sweep/sweep.html").read_text()
        self.assertIn("<h2>smoother.thinning_s</h2>", page)
        self.assertEqual(page.count("<circle"), 2 * (len(values) + HELD_OUT), "one plot of each key")

    def test_mistakes_are_told_before_anything_is_done(self):
        with self.assertRaisesRegex(AssertionError, "fleet: sweep: settings: smoother.thinning_s: wants a list of values or"):
            self.sweep(5)
        self.workflow.configure(2, more="")
        with self.assertRaisesRegex(AssertionError, "fleet: variants: a,b: a name has letters, digits and"):
            self.workflow.run("--config", "variants={'a,b': {'azimuth': 'x'}}")
        self.assertEqual(self.workflow.done(), [])


if __name__ == "__main__":
    if not shutil.which("snakemake"):
        print("SKIPPED: no snakemake here: scripts/setup --fleet installs it")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
