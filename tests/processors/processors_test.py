#!/usr/bin/env python3
"""Runs the programs on processors of other models, emulated: each starts, estimates, and says the same as every other model of its kind.

usage: processors_test.py CASE AZIMUTHD AZIMUTH AZIMUTH_SIM NEEDS_AVX2      exit code 0: good, 1: not, 77: no emulator here, or no package to try
"""

import re
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

TREE = Path(__file__).resolve().parents[2]
CASE, (AZIMUTHD, AZIMUTH, AZIMUTH_SIM, NEEDS_AVX2) = sys.argv[1], (str(Path(each).resolve()) for each in sys.argv[2:6])
SYSROOT = TREE / "build/sysroot/arm64"
EMULATOR = ["qemu-aarch64-static", "-L", str(SYSROOT)] if CASE == "arm64" else ["qemu-x86_64-static"]

# From the first with 64 bits on. The last two are of no maker: one thing alone is missing.
WITHOUT_FMA = ("Conroe", "Nehalem", "SandyBridge", "Opteron_G1", "Haswell,-fma", "Haswell,-avx2")
WITH_FMA = ("Haswell", "Skylake-Client", "EPYC-Rome")
# Of a Raspberry Pi 3, 4 and 5, and all that there is; every one of them has fused multiply-add.
ARM64 = ("cortex-a53", "cortex-a72", "cortex-a76", "max")

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


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def emulated(model, *command):
    return run(*EMULATOR, "-cpu", model, *command)


def said(done, what):
    if done.returncode:
        fail(f"{what}: {done.returncode}, {done.stdout}")
    return done.stdout


def make_runs(folder):
    for name, options in RUNS.items():
        said(run(AZIMUTH, "simulate", f"{folder}/{name}", *options), name)
    rig = Path(folder) / "features/rig.toml"
    rig.write_text(rig.read_text(encoding="utf-8").replace('"colour"', '"sift"'), encoding="utf-8")


def digests(folder, on, *replay):
    """Of every run, by its name."""
    found = {}
    for name in RUNS:
        report = said(run(*replay, f"{folder}/{name}"), f"{on}, {name}")
        found[name] = re.search(r"^digest +(\w+)$", report, flags=re.M).group(1)
    return found


def digests_here(folder):
    """None where this machine rounds otherwise, without fused multiply-add."""
    flags = set(Path("/proc/cpuinfo").read_text(encoding="utf-8").split())
    return digests(folder, "here", AZIMUTH, "replay") if {"avx2", "fma"} <= flags else {}


def agree(models, programs=(AZIMUTH, AZIMUTHD, AZIMUTH_SIM), as_here=RUNS):
    """All of the models start all programs, and estimate the same, of the runs `as_here` what this machine does."""
    with tempfile.TemporaryDirectory() as folder:
        make_runs(folder)
        expected = {name: digest for name, digest in digests_here(folder).items() if name in as_here}
        for model in models:
            for program in programs:
                said(emulated(model, program, "--version"), f"{model}, {program}")
            found = digests(folder, model, *EMULATOR, "-cpu", model, programs[0], "replay")
            expected = {**found, **expected}
            if found != expected:
                fail(f"{model}: {found} in place of {expected}")
            print(model, found, flush=True)


def without_fma():
    agree(WITHOUT_FMA, as_here=())


def with_fma():
    agree(WITH_FMA)


def arm64():
    """The programs of the package that scripts/package --arch arm64 made last."""
    debs = sorted((TREE / "build/package-arm64").glob("azimuth_*.deb"))
    if not debs:
        skip("no package in build/package-arm64 (scripts/package --arch arm64 makes it)")
    with tempfile.TemporaryDirectory() as folder:
        said(run("dpkg-deb", "-x", str(debs[0]), folder), debs[0])
        agree(ARM64, [f"{folder}/usr/bin/{name}" for name in ("azimuth", "azimuthd", "azimuth-sim")])


def bites():
    """A loop for another processor would end the program."""
    said(emulated("Haswell", NEEDS_AVX2), "Haswell")
    code = emulated("Nehalem", NEEDS_AVX2).returncode
    if code not in (-signal.SIGILL, 128 + signal.SIGILL):
        fail(f"AVX2 on a processor that has none: {code}")


if __name__ == "__main__":
    if not shutil.which(EMULATOR[0]):
        skip(f"no {EMULATOR[0]} here (package qemu-user-static)")
    {"without_fma": without_fma, "with_fma": with_fma, "arm64": arm64, "bites": bites}[CASE]()
