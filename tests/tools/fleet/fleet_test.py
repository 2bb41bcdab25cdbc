#!/usr/bin/env python3
"""Runs the workflow of tools/fleet/ over a small simulated corpus: completely; killed midway and started again, which
must give bit-identical tables without repeating a finished replay; after changes, which must repeat only the affected
replays; and with replays that take too long, take too much memory or are killed.

usage: fleet_test.py SOURCE_TREE AZIMUTH      exit code 0: good, 1: not, 77: snakemake is missing
"""

import os
import shutil
import sys
import tempfile
import time
import unittest
from pathlib import Path

from workflow import CORES, Workflow, kill, simulate_corpus

TREE, AZIMUTH = Path(sys.argv[1]), Path(sys.argv[2])
RUNS = 6


# Shell code that lets three replays fail: by time, by memory and by a signal.
BAD = r"""case "$1 $2" in
  "replay "*/run2) exec sleep 100 ;;
  "replay "*/run3) exec python3 -c 'import sys
try: b"x" * 1_600_000_000
except MemoryError: sys.exit("azimuth: std::bad_alloc")' ;;
  "replay "*/run4) kill -KILL $$ ;;
esac"""


class Fleet(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.corpus = cls.folder / "corpus"
        simulate_corpus(AZIMUTH, cls.corpus, RUNS)

    def test_whole_killed_and_changed(self):
        whole = Workflow(TREE, AZIMUTH, self.corpus, self.folder / "whole")
        whole.run()
        tables = whole.tables()
        self.assertEqual(len(tables), 6)
        self.assertEqual(len(whole.done()), 2 * RUNS)
        text = tables["after.txt"].decode()
        self.assertIn(f"compared    {RUNS} runs: ", text)
        self.assertIn(f"failed      {self.corpus}/cut: exit code 2: {self.corpus}/cut/odometry.csv: cannot be", text)
        self.assertIn("tag first, 1 run", text)
        self.assertIn("0 worse, 0 better", tables["before.txt"].decode())
        self.killed_and_begun_again(tables)
        self.only_what_changed(whole)

    def test_those_that_come_to_nothing_are_named_and_the_rest_is_done(self):
        workflow = Workflow(TREE, AZIMUTH, self.corpus, self.folder / "bad", first=BAD)
        workflow.run()
        self.assertEqual(len(workflow.done()), 2 * (RUNS - 3))
        text = workflow.tables()["after.txt"].decode()
        self.assertIn(f"compared    {RUNS - 3} runs: ", text)
        self.assertIn(f"failed      {self.corpus}/run2: took more than 20 s", text)
        self.assertIn(f"failed      {self.corpus}/run3: out of memory: more than 1500 MB", text)
        self.assertIn(f"failed      {self.corpus}/run4: killed by SIGKILL", text)

    def test_without_a_baseline_there_are_reports(self):
        workflow = Workflow(TREE, AZIMUTH, self.corpus, self.folder / "reports")
        fleet = (workflow.folder / "fleet.yaml").read_text().replace("baseline: before\n", "").replace("set: [", "tags: [first], options: [--no-names], set: [")
        (workflow.folder / "fleet.yaml").write_text(fleet)
        workflow.run()
        listed = (workflow.folder / "out/reports.txt").read_text().splitlines()
        self.assertEqual(sorted(listed), sorted(str(file.relative_to(workflow.folder)) for file in workflow.folder.glob("out/reports/*/*.json")))
        self.assertEqual([Path(file).parent.name for file in listed], ["before"] * (RUNS + 1) + ["after"], "of run1 alone")
        self.assertEqual(len([done for done in workflow.done() if " --no-names " in done]), 1)

    def killed_and_begun_again(self, tables):
        workflow = Workflow(TREE, AZIMUTH, self.corpus, self.folder / "killed")
        kill(workflow.start_and_hold(RUNS))
        workflow.release()
        finished = workflow.done()
        self.assertGreaterEqual(len(finished), RUNS)
        self.assertLess(len(finished), 2 * RUNS, "it was killed midway")
        workflow.run("--unlock")
        workflow.run("--rerun-incomplete")
        self.assertEqual(workflow.tables(), tables)
        twice = len(workflow.done()) - 2 * RUNS
        print(f"killed with {len(finished)} of {2 * RUNS} replays finished; {twice} in flight were done again")
        self.assertLessEqual(twice, CORES, "only those that snakemake had not yet seen the end of")

    def only_what_changed(self, workflow):
        self.assertIn("Nothing to be done", workflow.run())
        self.assertEqual(len(workflow.done()), 2 * RUNS)
        workflow.configure(3)
        workflow.run()
        self.assertEqual(len(workflow.done()), 3 * RUNS, "the variant whose settings changed")
        os.utime(self.corpus / "run2/odometry.csv", (1, 1))
        workflow.run()
        self.assertEqual(len(workflow.done()), 3 * RUNS + 2, "the run that changed, with both")


if __name__ == "__main__":
    if not shutil.which("snakemake"):
        print("SKIPPED: no snakemake here: scripts/setup --fleet installs it")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
