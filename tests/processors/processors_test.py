#!/usr/bin/env python3
"""Runs the programs on emulated processors of other models. On each, they must start and give the same estimates as on
all models of its kind.

usage: processors_test.py CASE AZIMUTHD AZIMUTH AZIMUTH_SIM NEEDS_AVX2      exit code 0: good, 1: not, 77: the emulator or the package is missing
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

# Models from the first one with 64 bits on. The last two are artificial: each lacks a single feature.
WITHOUT_FMA = ("Conroe", "Nehalem", "SandyBridge", "Opteron_G1", "Haswell,-fma", "Haswell,-avx2")
WITH_FMA = ("Haswell", "Skylake-Client", "EPYC-Rome")
# The processors of a Raspberry Pi 3, 4 and 5, and a model with all features. All of them have fused multiply-add.
ARM64 = ("cortex-a53", "cortex-a72", "cortex-a76", "max")

# Runs that use different loops: those of the EKF, of colours, of lamps and of natural features.
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
    """The digests of all runs, keyed by name."""
    found = {}
    for name in RUNS:
        report = said(run(*replay, f"{folder}/{name}"), f"{on}, {name}")
        found[name] = re.search(r"^digest +(\w+)$", report, flags=re.M).group(1)
    return found


def digests_here(folder):
    """The digests of this machine; empty if it has no fused multiply-add and therefore rounds differently."""
    flags = set(Path("/proc/cpuinfo").read_text(encoding="utf-8").split())
    return digests(folder, "here", AZIMUTH, "replay") if {"avx2", "fma"} <= flags else {}


def agree(models, programs=(AZIMUTH, AZIMUTHD, AZIMUTH_SIM), as_here=RUNS):
    """All models must start all programs and give equal digests; for the runs `as_here`, also the digests of this
    machine."""
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
    """Tests the programs of the last package of scripts/package --arch arm64."""
    debs = sorted((TREE / "build/package-arm64").glob("azimuth_*.deb"))
    if not debs:
        skip("no package in build/package-arm64 (scripts/package --arch arm64 makes it)")
    with tempfile.TemporaryDirectory() as folder:
        said(run("dpkg-deb", "-x", str(debs[0]), folder), debs[0])
        agree(ARM64, [f"{folder}/usr/bin/{name}" for name in ("azimuth", "azimuthd", "azimuth-sim")])


def bites():
    """Checks that an instruction which the processor lacks ends the program."""
    said(emulated("Haswell", NEEDS_AVX2), "Haswell")
    code = emulated("Nehalem", NEEDS_AVX2).returncode
    if code not in (-signal.SIGILL, 128 + signal.SIGILL):
        fail(f"AVX2 on a processor that has none: {code}")


if __name__ == "__main__":
    if not shutil.which(EMULATOR[0]):
        skip(f"no {EMULATOR[0]} here (package qemu-user-static)")
    {"without_fma": without_fma, "with_fma": with_fma, "arm64": arm64, "bites": bites}[CASE]()
