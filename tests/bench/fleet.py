#!/usr/bin/env python3
"""Measures the overhead of the workflow of tools/fleet/ beyond its replays, for simulated field logs of ten minutes.

usage: fleet.py AZIMUTH FOLDER [--logs N] [--set KEY=VALUE]... [--cores N] [--kill SEED] [--slurm]
       --kill: also starts a second workflow, kills it and all its processes after a random part of the first one's time (drawn from SEED),
               restarts it, compares its tables with the first one's, and counts the logs that were replayed twice
       --slurm: also runs the workflow on a local Slurm cluster; needs its own namespaces: tests/tools/fleet/in_namespaces.sh tests/bench/fleet.py ...

FOLDER keeps the logs; missing ones are simulated. The overhead is the occupied time of the cores minus the sum of the replays' own times.
Other load on the machine lengthens both.
"""

import argparse
import json
import os
import random
import subprocess
import sys
import time
from pathlib import Path

TREE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TREE / "tests/tools/fleet"))
import cluster  # noqa: E402
from workflow import kill  # noqa: E402

SECONDS = 600
MEMORY_MB = 4600     # per job on the cluster

# A wrapper of azimuth that records the time of each replay.
TIMED = """#!/bin/bash
begun=${{EPOCHREALTIME/[.,]/}}
"{azimuth}" "$@" || exit
[ "$1" != replay ] || echo "$2 $((${{EPOCHREALTIME/[.,]/}} - begun))" >> {times}
"""


def simulate(azimuth, folder, count):
    folder.mkdir(parents=True, exist_ok=True)
    begun, made = time.monotonic(), 0
    for seed in range(1, count + 1):
        log = folder / f"{seed:04}.lcm"
        if not log.exists():
            subprocess.run([azimuth, "simulate", log, "--world", "lab", "--laps", "30", "--seconds", str(SECONDS), "--seed", str(seed)],
                           stdout=subprocess.DEVNULL, check=True)
            made += 1
    if made:
        print(f"{made} logs of {SECONDS} s simulated at {made * SECONDS / (time.monotonic() - begun):.0f} times real time")


class Fleet:
    def __init__(self, name, given, where):
        self.folder, self.where = given.folder / name, where
        subprocess.run(["rm", "-rf", self.folder], check=True)
        self.folder.mkdir(parents=True)
        self.times = self.folder / "times"
        azimuth = self.folder / "azimuth"
        azimuth.write_text(TIMED.format(azimuth=given.azimuth.resolve(), times=self.times.resolve()))
        azimuth.chmod(0o755)
        logs = given.folder.resolve() / "logs"
        corpus = [{"path": f"{logs}/{seed:04}.lcm"} for seed in range(1, given.logs + 1)]
        (self.folder / "fleet.json").write_text(json.dumps({
            "corpus": corpus, "variants": {"now": {"azimuth": str(azimuth.resolve()), "set": given.set}}, "baseline": "now", "costs": False, "out": "out"}))

    def start(self, *more):
        said = open(self.folder / "said", "a", encoding="utf-8")
        return subprocess.Popen([TREE / "tools/fleet/run", "fleet.json", *self.where, *more], cwd=self.folder, stdout=said, stderr=said, start_new_session=True)

    def run(self, *more):
        begun = time.monotonic()
        if self.start(*more).wait() != 0:
            sys.exit(f"{self.folder}/said: it failed")
        return time.monotonic() - begun

    def replayed(self):
        """Returns (log, seconds) of each completed replay."""
        lines = self.times.read_text().splitlines() if self.times.exists() else []
        return [(log, int(microseconds) / 1e6) for log, microseconds in map(str.split, lines)]

    def tables(self):
        return {file.name: file.read_bytes() for file in sorted((self.folder / "out/tables").iterdir())}

    def told(self, name, cores, took_s):
        times = [seconds for _, seconds in self.replayed()]
        over_s = cores * took_s - sum(times)
        print(f"{name}: {len(times)} replays of {sum(times) / len(times):.2f} s each in {took_s:.0f} s on {cores} cores; "
              f"beyond them {over_s:.0f} s of a core, {100 * over_s / sum(times):.1f} %, {over_s / len(times):.2f} s a replay", flush=True)


def killed(given, where, whole, took_s):
    fleet = Fleet("killed", given, where)
    process = fleet.start()
    after_s = took_s * random.Random(given.kill).uniform(0.1, 0.9)
    time.sleep(after_s)
    kill(process)
    finished = len(fleet.replayed())
    fleet.run("--unlock")
    fleet.run("--rerun-incomplete")
    logs = [log for log, _ in fleet.replayed()]
    same = "the same" if fleet.tables() == whole.tables() else "OTHER"
    print(f"killed after {after_s:.0f} s with {finished} of {given.logs} replays finished, and begun again: {same} tables, {len(logs) - len(set(logs))} "
          "replayed twice", flush=True)


def on_slurm(given, whole):
    os.environ["CI"] = "true"     # makes snakemake poll its jobs every second instead of every ten
    with cluster.Cluster(given.folder / "cluster", given.cores, given.cores * MEMORY_MB):
        fleet = Fleet("slurm", given, ["--slurm"])
        fleet.told("Slurm", given.cores, fleet.run())
    print(f"tables on Slurm: {'the same' if fleet.tables() == whole.tables() else 'OTHER'}")


def main():
    parser = argparse.ArgumentParser(usage="see the top of tests/bench/fleet.py")
    parser.add_argument("azimuth", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--logs", type=int, default=500)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--cores", type=int, default=2)
    parser.add_argument("--kill", type=int)
    parser.add_argument("--slurm", action="store_true")
    given = parser.parse_args()
    simulate(given.azimuth, given.folder / "logs", given.logs)
    where = ["--cores", str(given.cores)]
    whole = Fleet("whole", given, where)
    took_s = whole.run()
    whole.told("cores", given.cores, took_s)
    print(f"begun again, with nothing to do: {whole.run():.1f} s")
    if given.kill is not None:
        killed(given, where, whole, took_s)
    if given.slurm:
        on_slurm(given, whole)


if __name__ == "__main__":
    main()
