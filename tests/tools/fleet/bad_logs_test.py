#!/usr/bin/env python3
"""Runs the workflow of tools/fleet/ over good and bad field logs. It must compare the good ones and name each bad one
with its fault in the text, the JSON and the page. If two reports are of one run, it must leave one out and name it.

usage: bad_logs_test.py SOURCE_TREE AZIMUTH      exit code 0: good, 1: not, 77: snakemake is missing
"""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from bad_logs import bad_logs, events, log_of
from workflow import Workflow

TREE, AZIMUTH = Path(sys.argv[1]), Path(sys.argv[2])
GOOD = 2
FLEET = """
corpus: [{{path: "{corpus}/*.lcm", tags: [field]}}, {{path: "{corpus}/left.lcm"}}, {{path: "{corpus}/good1.lcm", tags: [first]}}]
variants:
  before: {{azimuth: {azimuth}}}
  after: {{azimuth: {azimuth}}}
  few: {{azimuth: {azimuth}, tags: [first]}}
baseline: before
time_s: 60
memory_mb: 1500
costs: false
out: out
"""
INCOMPLETE = {"cut": "[0-9]+ damaged bytes", "damaged": ".*[0-9]+ damaged bytes", "partly_older": "[0-9]+ malformed messages"}
FAILED = {"all_older": "exit code 2: ", "no_rig": "exit code 2: .*rig", "empty": "exit code 2: .*is not an LCM log", "noise": "exit code 2: .*is not an LCM log"}


class BadLogs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.corpus = cls.folder / "corpus"
        cls.corpus.mkdir()
        for seed in range(1, GOOD + 1):
            subprocess.run([AZIMUTH, "simulate", cls.corpus / f"good{seed}.lcm", "--world", "lab", "--seed", str(seed), "--seconds", "20"],
                           stdout=subprocess.DEVNULL, check=True)
        for name, log in bad_logs((cls.corpus / "good1.lcm").read_bytes()).items():
            (cls.corpus / f"{name}.lcm").write_bytes(log)
        cls.workflow = Workflow(TREE, AZIMUTH, cls.corpus, cls.folder / "fleet")
        (cls.workflow.folder / "fleet.yaml").write_text(FLEET.format(corpus=cls.corpus, azimuth=cls.workflow.azimuth))
        cls.said = cls.workflow.run()

    def test_events_are_written_as_they_were_read(self):
        log = (self.corpus / "good1.lcm").read_bytes()
        self.assertEqual(log_of(events(log)), log)

    def test_each_is_named_and_the_rest_is_done(self):
        text = self.workflow.tables()["after.txt"].decode()
        self.assertIn(f"compared    {GOOD + len(INCOMPLETE)} runs: 0 worse, 0 better, 0 new, 0 missing\n", text)
        for name, why in INCOMPLETE.items():
            self.assertRegex(text, rf"(?m)^incomplete  {self.corpus}/{name}\.lcm: {why}$")
        for name, why in FAILED.items():
            self.assertRegex(text, rf"(?m)^failed      {self.corpus}/{name}\.lcm: {why}")
        self.assertNotRegex(text, "(?m)^(failed|incomplete) .*good")
        self.assertIn("fleet: corpus: nothing matches", self.said)

    def test_runs_that_a_variant_is_not_for_are_not_missing(self):
        text = self.workflow.tables()["few.txt"].decode()
        self.assertIn("compared    1 run: 0 worse, 0 better, 0 new, 0 missing\n", text)
        self.assertNotRegex(text, "(?m)^(failed|incomplete|missing) ")

    def test_page_and_json_say_the_same(self):
        absent = json.loads(self.workflow.tables()["after.json"])["absent"]
        page = self.workflow.tables()["after.html"].decode()
        self.assertEqual({Path(each["name"]).stem for each in absent["incomplete"]}, set(INCOMPLETE))
        for side in ("failed", "failed_before"):
            self.assertEqual({Path(each["name"]).stem for each in absent[side]}, set(FAILED))
        for each in absent["incomplete"] + absent["failed"]:
            self.assertIn(f'"name":"{each["name"]}","why":"{each["why"]}"', page)

    def test_of_two_reports_of_one_run_one_is_left_out(self):
        reports = self.folder / "twice"
        shutil.copytree(self.workflow.folder / "out/reports/after", reports)
        first = next(reports.glob("*good1*.json"))
        shutil.copy(first, reports / "zz.json")
        text = subprocess.run([AZIMUTH, "report", "compare", reports], stdout=subprocess.PIPE, text=True, check=True).stdout
        self.assertIn(f"twice       {self.corpus}/good1.lcm: {reports}/zz.json left out, {first} used\n", text)
        self.assertIn(f"compared    {GOOD + len(INCOMPLETE)} runs\n", text)


if __name__ == "__main__":
    if not shutil.which("snakemake"):
        print("SKIPPED: no snakemake here: scripts/setup --fleet installs it")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
