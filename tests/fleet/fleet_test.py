#!/usr/bin/env python3
"""Runs the workflow of fleet/ over a small simulated corpus: whole; killed midway and begun again, where the tables must be the same
bit for bit and nothing is done twice that had been finished; and after changes, where only what changed is done.

usage: fleet_test.py SOURCE_TREE AZIMUTH      exit code 0: so it is, 1: not, 77: there is no snakemake here
"""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

TREE, AZIMUTH = Path(sys.argv[1]), Path(sys.argv[2])
RUNS, CORES = 6, 2

# An azimuth that writes down which reports it has finished.
COUNTING = """#!/bin/sh
"{azimuth}" "$@" || exit
[ "$1" != replay ] || echo "$2 $*" >> {done}
"""

FLEET = """
corpus:
  - {{path: "{corpus}/run*", tags: [lab]}}
  - {{path: "{corpus}/*1", tags: [first]}}
  - {{path: "{corpus}/cut"}}
variants:
  before: {{azimuth: {azimuth}}}
  after: {{azimuth: {azimuth}, set: ["smoother.thinning_s={thinning_s}"]}}
baseline: before
costs: false
out: {out}
"""


class Workflow:
    def __init__(self, corpus, folder):
        folder.mkdir()
        self.corpus, self.folder, self.done_file = corpus, folder, folder / "done"
        self.azimuth = folder / "azimuth"
        self.azimuth.write_text(COUNTING.format(azimuth=AZIMUTH, done=self.done_file))
        self.azimuth.chmod(0o755)
        self.configure(2)

    def configure(self, thinning_s):
        (self.folder / "fleet.yaml").write_text(FLEET.format(corpus=self.corpus, azimuth=self.azimuth, thinning_s=thinning_s, out="out"))

    def start(self, *more):
        return subprocess.Popen(["snakemake", "-s", TREE / "fleet/Snakefile", "--configfile", "fleet.yaml", "--cores", str(CORES), *more],
                                cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)

    def run(self, *more):
        process = self.start(*more)
        said, _ = process.communicate(timeout=400)
        assert process.returncode == 0, said
        return said

    def done(self):
        return self.done_file.read_text().splitlines() if self.done_file.exists() else []

    def tables(self):
        return {file.name: file.read_bytes() for file in sorted((self.folder / "out/tables").iterdir())}


def kill(process):
    """With everything that it has started, as when a machine loses its power."""
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()


class Fleet(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        cls.corpus = cls.folder / "corpus"
        cls.corpus.mkdir()
        for seed in range(1, RUNS + 1):
            subprocess.run([AZIMUTH, "simulate", cls.corpus / f"run{seed}", "--world", "lab", "--seed", str(seed), "--seconds", "20"],
                           stdout=subprocess.DEVNULL, check=True)
        (cls.corpus / "cut").mkdir()     # a run of which only its rig came across
        shutil.copy(cls.corpus / "run1/rig.toml", cls.corpus / "cut")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_whole_killed_and_changed(self):
        whole = Workflow(self.corpus, self.folder / "whole")
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

    def killed_and_begun_again(self, tables):
        workflow = Workflow(self.corpus, self.folder / "killed")
        process = workflow.start()
        while len(workflow.done()) < RUNS and process.poll() is None:
            time.sleep(0.02)
        kill(process)
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
        print("no snakemake here: scripts/setup --fleet installs it")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
