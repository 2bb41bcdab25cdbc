#!/usr/bin/env python3
"""Starts a Slurm cluster of one node with two CPUs and runs the workflow of tools/fleet/ on it. The tables must be
bit-identical to those of a run on the cores of this machine, also if the workflow is killed and started again while its
jobs continue, and if a user cancels a job.

usage: in_namespaces.sh slurm_test.py SOURCE_TREE AZIMUTH FOLDER      exit code 0: good, 1: not, 77: a program is missing
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import cluster
from workflow import Workflow, kill, simulate_corpus

TREE, AZIMUTH, FOLDER = (Path(argument) for argument in sys.argv[1:4])
RUNS, CPUS, MEMORY_MB = 4, 2, 4100     # memory for two parallel replays
ON_SLURM = ("--profile", TREE / "tools/fleet/slurm")


class Slurm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.environ["CI"] = "true"     # makes snakemake poll its jobs every second instead of every ten seconds
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory(dir=FOLDER, prefix="slurm-")))
        simulate_corpus(AZIMUTH, cls.folder / "corpus", RUNS)
        cls.local = cls.workflow("local")
        cls.local.run()
        cls.cluster = cls.enterClassContext(cluster.Cluster(cls.folder / "cluster", CPUS, MEMORY_MB))

    @classmethod
    def workflow(cls, name, **how):
        return Workflow(TREE, AZIMUTH, cls.folder / "corpus", cls.folder / name, **how)

    def test_same_tables_as_on_the_cores_of_one_machine(self):
        workflow = self.workflow("whole", runner=ON_SLURM)
        workflow.run()
        self.assertEqual(workflow.tables(), self.local.tables())
        self.assertEqual(len(workflow.done()), 2 * RUNS)
        self.assertIn("Nothing to be done", workflow.run())

    def test_killed_while_its_jobs_go_on(self):
        workflow = self.workflow("killed", runner=ON_SLURM)
        kill(workflow.start_and_hold(RUNS))
        workflow.release()
        finished = len(workflow.done())
        workflow.run("--unlock")
        workflow.run("--rerun-incomplete")
        self.assertEqual(workflow.tables(), self.local.tables())
        twice = len(workflow.done()) - 2 * RUNS
        print(f"killed with {finished} of {2 * RUNS} replays finished; {twice} were done again")
        self.assertLessEqual(twice, CPUS, "only those whose end snakemake was just being told of")

    def test_cancelled_job_is_done_again(self):
        workflow = self.workflow("cancelled", runner=ON_SLURM)
        process = workflow.start_and_hold(RUNS)
        self.cancel_one()
        workflow.release()
        said, _ = process.communicate(timeout=400)
        self.assertEqual(process.returncode, 0, said)
        self.assertIn("Trying to restart job", said)
        self.assertEqual(workflow.tables(), self.local.tables())

    def cancel_one(self):
        """Cancels one running job. A job may end before it can be cancelled; then the next one is tried."""
        while True:
            for job in self.said("squeue", "--noheader", "--states=RUNNING", "--format=%i").split():
                self.said("scancel", job)
                while "JobState=COMPLETING" in (state := self.said("scontrol", "--oneliner", "show", "job", job)):
                    time.sleep(0.1)
                if "JobState=CANCELLED" in state:
                    return
            time.sleep(0.1)

    @staticmethod
    def said(*command):
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout


if __name__ == "__main__":
    missing = [program for program in ("snakemake", *cluster.PROGRAMS) if not shutil.which(program, path=cluster.path())]
    if missing:
        print(f"SKIPPED: no {', '.join(missing)} here: scripts/setup --fleet installs it")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
