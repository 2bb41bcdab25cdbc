#!/usr/bin/env python3
"""Tests that tools/fleet/replay_job.py turns a failed replay into a report with the reason and ends with exit code 0,
so that the workflow continues.

usage: replay_job_test.py SOURCE_TREE      exit code 0: good, 1: not
"""

import json
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

TREE = Path(sys.argv[1])


class ReplayJob(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self.scratch.name)
        self.addCleanup(self.scratch.cleanup)

    def report(self, *command, time_s=50, memory_mb=1000):
        """Runs the job, checks that the report is the only file that it leaves, and returns the report."""
        report = self.folder / "report.json"
        subprocess.run([sys.executable, "-B", TREE / "tools/fleet/replay_job.py", report, "run7", str(time_s), str(memory_mb), *command,
                        "replay", "runs/7", "--tag", "hall", "--tag", "night"], check=True, timeout=55)
        self.assertEqual([file.name for file in self.folder.iterdir() if file.name.startswith("report")], ["report.json"])
        return json.loads(report.read_text())

    def failure(self, *command, **limits):
        report = self.report(*command, **limits)
        self.assertEqual((report["name"], report["tags"]), ("run7", ["hall", "night"]))
        return report["failure"]

    def python(self, program):
        """A command that runs a Python program and ignores the arguments that are appended."""
        return [sys.executable, "-c", program]

    def test_takes_too_long(self):
        begun = time.monotonic()
        self.assertEqual(self.failure(*self.python("import time; time.sleep(50)"), time_s=0.5), "took more than 0.5 s")
        self.assertLess(time.monotonic() - begun, 40, "it was ended, not waited for")

    def test_takes_too_much_memory(self):
        greedy = self.python("""
import sys
try:
    b"x" * 400_000_000
except MemoryError:
    sys.exit("azimuth: std::bad_alloc")
sys.exit("it had the memory")
""")
        self.assertEqual(self.failure(*greedy, memory_mb=300), "out of memory: more than 300 MB")
        self.assertEqual(self.failure(*greedy, memory_mb=900), "exit code 1: it had the memory")

    def test_is_aborted_for_want_of_memory(self):
        said = "terminate called after throwing an instance of 'std::bad_alloc'"
        self.assertEqual(self.failure(*self.python(f"import sys, os; print({said!r}, file=sys.stderr, flush=True); os.abort()")),
                         "out of memory: more than 1000 MB")

    def test_is_killed(self):
        for signal in ("SIGKILL", "SIGSEGV", "SIGABRT"):
            self.assertEqual(self.failure(*self.python(f"import os, signal; os.kill(os.getpid(), signal.{signal})")), f"killed by {signal}")
        self.assertEqual(self.failure(*self.python("import os; os.kill(os.getpid(), 40)")), "killed by signal 40")

    def test_fails(self):
        self.assertEqual(self.failure(*self.python("import sys; print('rig.toml: missing\\nmore', file=sys.stderr); sys.exit(2)")),
                         "exit code 2: rig.toml: missing")
        self.assertEqual(self.failure("false"), "exit code 1: it said nothing")
        self.assertEqual(self.failure("/no/azimuth"), "/no/azimuth: No such file or directory")

    def test_leaves_half_a_report(self):
        self.assertEqual(self.failure(*self.written('{"name": "ru', "import os; os.abort()")), "killed by SIGABRT")

    def test_says_nothing_is_wrong_but_writes_no_report(self):
        (self.folder / "report.json.partial").write_text("{}")     # left by an attempt that was killed
        self.assertEqual(self.failure("true"), "it wrote no report")

    def test_report_is_the_programs(self):
        for code in (0, 3):     # 3: the end of the drive is missing
            self.assertEqual(self.report(*self.written('{"steps": 7}', f"sys.exit({code})")), {"steps": 7})

    def written(self, text, then):
        return self.python(f"import sys; open(sys.argv[sys.argv.index('--report') + 1], 'w').write({text!r}); {then}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
