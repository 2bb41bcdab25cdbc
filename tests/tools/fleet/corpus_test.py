#!/usr/bin/env python3
"""Tests which runs a variant is replayed over, with which options, and which changes cause a new replay.

usage: corpus_test.py SOURCE_TREE      exit code 0: good, 1: not
"""

import os
import shlex
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(sys.argv[1]) / "tools/fleet"))
import corpus  # noqa: E402


class Corpus(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        for run in ("a1", "a2", "b1"):
            (self.folder / run).mkdir()
            (self.folder / run / "rig.toml").write_text(run)
        (self.folder / "program").write_text("program")
        (self.folder / "robot.toml").write_text("settings")

    def runs(self, *entries):
        runs, empty = corpus.runs_of([{"path": f"{self.folder}/{path}", "tags": tags} for path, tags in entries])
        return {Path(run).name: tags for run, tags in runs.items()}, [Path(each).name for each in empty]

    def jobs(self, **variant):
        runs, _ = corpus.runs_of([{"path": f"{self.folder}/a*", "tags": ["a"]}, {"path": f"{self.folder}/*1", "tags": ["first"]}])
        return list(corpus.jobs_of(runs, variant))

    def test_run_that_two_entries_name_has_the_tags_of_both(self):
        self.assertEqual(self.runs(("a*", ["a"]), ("*1/", ["first"]), ("c*", [])),
                         ({"a1": ("a", "first"), "a2": ("a",), "b1": ("first",)}, ["c*"]))

    def test_variant_with_tags_is_for_runs_with_any_of_them(self):
        def names(**variant):
            return [Path(job.path).name for job in self.jobs(**variant)]
        self.assertEqual(names(), ["a1", "a2", "b1"])
        self.assertEqual(names(tags=["a"]), ["a1", "a2"])
        self.assertEqual(names(tags=["a", "first"]), ["a1", "a2", "b1"])
        self.assertEqual(names(tags=["night"]), [])

    def test_command_is_what_a_shell_takes(self):
        job = self.jobs()[0]
        words = shlex.split(corpus.command_of({"azimuth": "a b", "set": ["x='y z'"]}, job, "out/r.json", 60, 4000))
        self.assertEqual(words[3:], ["out/r.json", job.name, "60", "4000", "a b", "replay", job.path, "--tag", "a", "--tag", "first", "--set=x='y z'"])

    def test_each_seed_is_a_job(self):
        jobs = self.jobs(seeds=[1, 2])
        self.assertEqual([job.seed for job in jobs], [1, 2] * 3)
        self.assertEqual(len({job.key for job in jobs}), 6)
        self.assertEqual(len({job.name for job in jobs}), 3, "by which they are pairs")

    def test_runs_of_one_name_in_two_folders_are_two(self):
        for folder in ("x.1", "x_1"):
            (self.folder / folder / "run").mkdir(parents=True)
        runs, _ = corpus.runs_of([{"path": f"{self.folder}/x*/run"}])
        jobs = list(corpus.jobs_of(runs, {}))
        self.assertEqual((len({job.key for job in jobs}), len({job.name for job in jobs})), (2, 2))

    def test_options(self):
        job = self.jobs(seeds=[3])[0]
        variant = {"options": ["--no-names"], "set": ["a=1", "b='x y'"], "config": "robot.toml"}
        self.assertEqual(corpus.options_of(variant, job), ["--no-names", "--set=a=1", "--set=b='x y'", "--config=robot.toml", "--seed=3"])

    def test_state_changes_with_all_that_the_report_depends_on(self):
        variant = {"azimuth": str(self.folder / "program"), "config": str(self.folder / "robot.toml"), "set": ["a=1"]}
        job = self.jobs()[0]
        states = [corpus.state_of(variant, job)]

        def changed(what):
            states.append(corpus.state_of(variant, job))
            self.assertEqual(len(set(states)), len(states), what)
        self.assertEqual(corpus.state_of(variant, job), states[0])
        (self.folder / "program").write_text("another program")
        changed("the program")
        (self.folder / "robot.toml").write_text("other settings")
        changed("the configuration")
        os.utime(self.folder / "a1/rig.toml", (1, 1))
        changed("the run")
        (self.folder / "a1/000.lcm").write_text("more")
        changed("a further segment")
        variant["set"] = ["a=2"]
        changed("a setting")
        variant["options"] = ["--no-names"]
        changed("an option")

    def test_names(self):
        for name in ("a", "a=1+b=x", "wide-gate_2.5"):
            self.assertFalse(corpus.unusable_name(name), name)
        for name in ("", "a,b", "a:b", "a/b", "a b", "a\n"):
            self.assertTrue(corpus.unusable_name(name), repr(name))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
