#!/usr/bin/env python3
"""Tests the arguments and files that tools/fleet/run passes to Snakemake, which a stand-in records.

usage: run_test.py SOURCE_TREE      exit code 0: good, 1: not
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TREE = Path(sys.argv[1]).resolve()
SNAKEMAKE = """#!/bin/sh
printf '%s\\n' "$@" > words
"""


class Run(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        (self.folder / "snakemake").write_text(SNAKEMAKE)
        (self.folder / "snakemake").chmod(0o755)

    def run_with(self, *words, path=None):
        return subprocess.run([sys.executable, "-B", TREE / "tools/fleet/run", *words], cwd=self.folder, capture_output=True, text=True, check=False,
                              env=os.environ | {"PATH": path or f"{self.folder}:{os.environ['PATH']}"})

    def words(self, *words):
        done = self.run_with(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.folder / "words").read_text().splitlines()

    def sweep(self, *words):
        files = self.words("fleet.yaml", *words)
        at = files.index("--configfile")
        self.assertEqual(files[at + 1], "fleet.yaml")
        return json.loads((self.folder / files[at + 2]).read_text())["sweep"]

    def test_words(self):
        flow = ["-s", str(TREE / "tools/fleet/Snakefile"), "--configfile", "fleet.yaml"]
        self.assertEqual(self.words("fleet.yaml"), [*flow, "--cores", "all", "--scheduler", "greedy"])
        self.assertEqual(self.words("fleet.yaml", "--cores", "2", "--dry-run"), [*flow, "--scheduler", "greedy", "--cores", "2", "--dry-run"])
        self.assertEqual(self.words("fleet.yaml", "--scheduler", "ilp", "--profile", "p"), [*flow, "--scheduler", "ilp", "--profile", "p"])
        self.assertEqual(self.words("fleet.yaml", "--slurm", "--unlock"), [*flow, "--profile", str(TREE / "tools/fleet/slurm"), "--unlock"])

    def test_sweep(self):
        self.assertEqual(self.sweep("--sweep", "ekf.max_landmarks=4,9.5,16", "--sweep", "smoother.thinning_s=0.1..4:log", "--sweep", "estimator=ekf,smoother",
                                    "--sweep", "a=1..9:whole", "--sweep", "b=-1..1", "--sweep", "c=true", "--sampling", "halton", "--samples", "40",
                                    "--criterion", "anees", "--hold-out", "night"),
                         {"settings": {"ekf.max_landmarks": [4, 9.5, 16], "smoother.thinning_s": {"from": 0.1, "to": 4, "log": True},
                                       "estimator": ["ekf", "smoother"], "a": {"from": 1, "to": 9, "whole": True}, "b": {"from": -1, "to": 1}, "c": [True]},
                          "sampling": "halton", "samples": 40, "criterion": "anees", "hold_out": "night"})
        self.assertEqual(self.sweep("--samples", "7"), {"samples": 7})

    def test_mistakes(self):
        for word, told in (("ekf.max_landmarks", "wants KEY=VALUE"), ("=4", "wants KEY=VALUE"), ("a=", "wants KEY=VALUE"),
                           ("a=x..4", "a range wants two numbers")):
            done = self.run_with("fleet.yaml", "--sweep", word)
            self.assertEqual(done.returncode, 2)
            self.assertIn(told, done.stderr)
            self.assertFalse((self.folder / "words").exists())
        done = self.run_with("fleet.yaml", path="/nowhere")
        self.assertEqual((done.returncode, done.stderr), (1, "tools/fleet/run: there is no snakemake here: scripts/setup --fleet installs it\n"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
