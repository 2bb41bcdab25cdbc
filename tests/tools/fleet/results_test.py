#!/usr/bin/env python3
"""Checks that the tables of scripts/results are up to date: the documents hold the tables that follow from the kept
numbers, and replays give these numbers. Only scripts/results does the replays that take long.

usage: results_test.py SOURCE_TREE AZIMUTH shipped|DATA      replays the shipped runs, or the runs in the folder DATA
       results_test.py SOURCE_TREE                           checks the documents and the kept numbers without a replay
exit code 0: up to date, 1: stale, 77: the folder DATA is missing
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

TREE = Path(sys.argv[1]).resolve()
sys.path[:0] = [str(TREE / "tools/fleet"), str(TREE / "tools/fleet/results")]
import corpus  # noqa: E402
import documents  # noqa: E402
import numbers_kept  # noqa: E402
import tables  # noqa: E402

ENDS_LOST = 3     # the exit code of a replay that wrote its report, but ends with a lost robot
STALE = "scripts/results makes the tables anew"
NEAR = 1e-3     # relative; other processors may round differently, and no table shows as many digits
SEVERAL = 3     # number of runs of one kind that are replayed here
TAKES_LONG = {("smoother-no-names", run) for run in ("runs/lab", tables.COURSE, *tables.MRCLAM)} | {("sift-patterns", tables.OFFICE)}


def differences(kept, now):
    """Yields the differences between the numbers of one run, in words."""
    for name in sorted(kept.keys() | now.keys()):
        before, after = kept.get(name), now.get(name)
        if isinstance(before, float) and isinstance(after, float):
            if abs(after - before) > NEAR * abs(before) + 1e-6:
                yield f"{name} is {after}, was {before}"
        elif before != after:
            yield f"{name} is {after}, was {before}"


class Documents(unittest.TestCase):
    def test_hold_what_follows_from_the_numbers(self):
        made = tables.made_of(numbers_kept.kept())
        for document in documents.DOCUMENTS:
            text = (TREE / document).read_text(encoding="utf-8")
            self.assertEqual(documents.with_tables(text, made), text, f"{document} is stale: {STALE}")

    def test_hold_each_table_once(self):
        texts = [(TREE / document).read_text(encoding="utf-8") for document in documents.DOCUMENTS]
        self.assertEqual(sorted(name for text in texts for _, name, _ in documents.BLOCK.findall(text)), sorted(tables.TABLES))
        self.assertEqual(sum(text.count("<!-- made by") for text in texts), len(tables.TABLES), "a mark that is none")

    def test_change_with_the_numbers(self):
        numbers = numbers_kept.kept()
        numbers["smoother"]["runs/lab"]["rmse_m"] *= 1.1
        changed = {name for name, table in tables.made_of(numbers).items() if table != tables.made_of(numbers_kept.kept())[name]}
        self.assertEqual(changed, {"smoother"})

    def test_numbers_are_written_as_they_are_kept(self):
        self.assertEqual(numbers_kept.text_of(numbers_kept.kept()), numbers_kept.FILE.read_text(encoding="utf-8"))

    def test_unknown_table(self):
        with self.assertRaisesRegex(documents.Mistake, "beauty: there is no such table"):
            documents.with_tables("<!-- made by scripts/results: beauty -->\n\nx\n<!-- to here -->\n", {})

    def test_difference(self):
        self.assertEqual(list(differences({"a": 1.0, "b": 2}, {"a": 1.0005, "b": 2})), [])
        self.assertEqual(list(differences({"a": 1.0, "b": 2, "c": 1.0}, {"a": 1.002, "b": 3})), ["a is 1.002, was 1.0", "b is 3, was 2", "c is None, was 1.0"])


class Replays(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        shipped = sys.argv[3] == "shipped"
        (self.folder / ("runs" if shipped else "data")).symlink_to(TREE / "runs" if shipped else Path(sys.argv[3]).resolve())

    def jobs(self):
        """Lists (variant, its settings, job) of the replays."""
        described = json.loads((TREE / "tools/fleet/results/fleet.json").read_text(encoding="utf-8"))
        os.chdir(self.folder)     # the patterns of a corpus are relative to the working folder
        self.addCleanup(os.chdir, TREE)
        runs, _ = corpus.runs_of(described["corpus"])
        several = sorted(run for prefix in tables.SEVERAL for run in [each for each in sorted(runs) if each.startswith(prefix)][SEVERAL:])
        return [(variant, settings, job) for variant, settings in described["variants"].items() for job in corpus.jobs_of(runs, settings)
                if job.path not in several and job.seed in (None, 1) and (variant, job.path) not in TAKES_LONG]

    def replayed(self, variant, settings, job):
        report = self.folder / f"{variant}-{job.key}.json"
        done = subprocess.run([sys.argv[2], "replay", job.path, "--quiet", "--name", job.name, "--report", report, *corpus.options_of(settings, job)],
                              cwd=self.folder, check=False)
        self.assertIn(done.returncode, (0, ENDS_LOST), job.path)
        return numbers_kept.numbers_of(json.loads(report.read_text(encoding="utf-8")))

    def test_give_the_numbers_that_are_kept(self):
        kept, jobs = numbers_kept.kept(), self.jobs()
        self.assertGreater(len(jobs), 7)
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            found = list(pool.map(lambda job: self.replayed(*job), jobs))
        stale = [f"{job.path} by {variant}: {what}" for (variant, _, job), numbers in zip(jobs, found)
                 for what in differences(kept.get(variant, {}).get(numbers_kept.name_of(job.name, job.seed), {}), numbers)]
        print(f"{len(jobs)} replays, {len(stale)} numbers are not those of the tables")
        self.assertEqual(stale, [], STALE)


if __name__ == "__main__":
    if len(sys.argv) == 2:
        del Replays
    else:
        del Documents
        if sys.argv[3] != "shipped" and not (Path(sys.argv[3]) / "lab-runs").is_dir():
            print(f"SKIPPED: {sys.argv[3]} has no lab-runs (AZIMUTH_DATA)")
            sys.exit(77)
    unittest.main(argv=sys.argv[:1])
