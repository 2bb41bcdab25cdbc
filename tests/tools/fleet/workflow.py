"""The workflow of tools/fleet/ over a small simulated corpus, for tests."""

import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

CORES = 2

# A wrapper of azimuth that records its finished replays. If the file `held` exists, it waits after that number of
# replays.
COUNTING = """#!/bin/sh
{first}
while [ "$1" = replay ] && [ -e {held} ] && [ "$(cat {done} | wc -l)" -ge "$(cat {held})" ]; do sleep 0.05; done
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
time_s: 20
memory_mb: 1500
costs: false
out: {out}
{more}
"""


def simulate_corpus(azimuth, corpus, runs):
    """Simulates `runs` runs, and adds a run `cut` that has only a rig."""
    corpus.mkdir()
    for seed in range(1, runs + 1):
        subprocess.run([azimuth, "simulate", corpus / f"run{seed}", "--world", "lab", "--seed", str(seed), "--seconds", "20"],
                       stdout=subprocess.DEVNULL, check=True)
    (corpus / "cut").mkdir()
    shutil.copy(corpus / "run1/rig.toml", corpus / "cut")


class Workflow:
    """Runs the workflow. `runner` are the arguments for the place of execution; `first` is shell code that runs before
    each replay."""

    def __init__(self, tree, azimuth, corpus, folder, runner=("--cores", str(CORES)), first=":"):
        folder.mkdir()
        self.tree, self.corpus, self.folder, self.runner, self.done_file = Path(tree), corpus, folder, runner, folder / "done"
        self.azimuth = folder / "azimuth"
        self.held_file = folder / "held"
        self.azimuth.write_text(COUNTING.format(first=first, azimuth=azimuth, done=self.done_file, held=self.held_file))
        self.azimuth.chmod(0o755)
        self.configure(2)

    def configure(self, thinning_s, more=""):
        (self.folder / "fleet.yaml").write_text(FLEET.format(corpus=self.corpus, azimuth=self.azimuth, thinning_s=thinning_s, out="out",
                                                             more=more.format(azimuth=self.azimuth)))

    def start(self, *more):
        return subprocess.Popen([self.tree / "tools/fleet/run", "fleet.yaml", *self.runner, *more],
                                cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)

    def run(self, *more):
        process = self.start(*more)
        said, _ = process.communicate(timeout=400)
        assert process.returncode == 0, said
        return said

    def start_and_hold(self, replays):
        """Starts the workflow and returns when at least `replays` replays have finished. Further replays wait for
        release()."""
        self.done_file.touch()
        self.held_file.write_text(str(replays))
        process = self.start()
        while len(self.done()) < replays:
            if process.poll() is not None:
                raise AssertionError(f"it ended with {len(self.done())} replays finished:\n{process.communicate()[0]}")
            time.sleep(0.02)
        return process

    def release(self):
        self.held_file.unlink()

    def done(self):
        return self.done_file.read_text().splitlines() if self.done_file.exists() else []

    def tables(self):
        return {file.name: file.read_bytes() for file in sorted((self.folder / "out/tables").iterdir())}


def kill(process):
    """Kills the process and all its children, as a power failure does."""
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
