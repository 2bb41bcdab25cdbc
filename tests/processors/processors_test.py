#!/usr/bin/env python3
"""Runs the programs on processors of other models, emulated: each starts, estimates, and says the same as every other model of its kind.

usage: processors_test.py CASE AZIMUTHD AZIMUTH AZIMUTH_SIM NEEDS_AVX2      exit code 0: good, 1: not, 77: no emulator here
"""

import re
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

TREE = Path(__file__).resolve().parents[2]
EMULATOR = "qemu-x86_64-static"
CASE, (AZIMUTHD, AZIMUTH, AZIMUTH_SIM, NEEDS_AVX2) = sys.argv[1], (str(Path(each).resolve()) for each in sys.argv[2:6])

# From the first with 64 bits on. The last two are of no maker: one thing alone is missing.
WITHOUT_FMA = ("Conroe", "Nehalem", "SandyBridge", "Opteron_G1", "Haswell,-fma", "Haswell,-avx2")
WITH_FMA = ("Haswell", "Skylake-Client", "EPYC-Rome")

# Each reaches other loops: those of the filter; of colours; of lamps; of natural features.
RUNS = {
    "named": ["--seconds", "5"],
    "colours": ["--seconds", "4", "--camera", "mirror", "--size", "0.3"],
    "lamps": ["--seconds", "4", "--camera", "fisheye", "--size", "0.3", "--world", "hall"],
    "features": ["--seconds", "4", "--camera", "mirror", "--size", "0.3"],
}


def fail(message):
    sys.exit(f"{CASE}: {message}")


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, cwd=TREE)


def emulated(model, *command):
    return run(EMULATOR, "-cpu", model, *command)


def said(done, what):
    if done.returncode:
        fail(f"{what}: {done.returncode}, {done.stdout}")
    return done.stdout


def make_runs(folder):
    for name, options in RUNS.items():
        said(run(AZIMUTH, "simulate", f"{folder}/{name}", *options), name)
    rig = Path(folder) / "features/rig.toml"
    rig.write_text(rig.read_text(encoding="utf-8").replace('"colour"', '"sift"'), encoding="utf-8")


def digests(folder, on, runner):
    """Of every run, by its name."""
    found = {}
    for name in RUNS:
        report = said(runner(AZIMUTH, "replay", f"{folder}/{name}"), f"{on}, {name}")
        found[name] = re.search(r"^digest +(\w+)$", report, flags=re.M).group(1)
    return found


def agree(models, others=None):
    """All of the models start all programs, and estimate the same, as `others` do."""
    with tempfile.TemporaryDirectory() as folder:
        make_runs(folder)
        expected = others(folder) if others else None
        for model in models:
            for program in (AZIMUTHD, AZIMUTH, AZIMUTH_SIM):
                said(emulated(model, program, "--version"), f"{model}, {program}")
            found = digests(folder, model, lambda *command, model=model: emulated(model, *command))
            if found != (expected := expected or found):
                fail(f"{model}: {found} in place of {expected}")
            print(model, found)


def without_fma():
    agree(WITHOUT_FMA)


def with_fma():
    """This machine too, if it is one."""
    flags = set(Path("/proc/cpuinfo").read_text(encoding="utf-8").split())
    here = (lambda folder: digests(folder, "here", run)) if {"avx2", "fma"} <= flags else None
    agree(WITH_FMA, here)


def bites():
    """A loop for another processor would end the program."""
    said(emulated("Haswell", NEEDS_AVX2), "Haswell")
    code = emulated("Nehalem", NEEDS_AVX2).returncode
    if code not in (-signal.SIGILL, 128 + signal.SIGILL):
        fail(f"AVX2 on a processor that has none: {code}")


if __name__ == "__main__":
    if not shutil.which(EMULATOR):
        print(f"skipped: no {EMULATOR} here (package qemu-user-static)")
        sys.exit(77)
    {"without_fma": without_fma, "with_fma": with_fma, "bites": bites}[CASE]()
