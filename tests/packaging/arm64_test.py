#!/usr/bin/env python3
"""Runs one check of the last arm64 package of scripts/package --arch arm64. Its programs run under emulation with the
libraries that they were linked with.

usage: arm64_test.py CASE AZIMUTH      AZIMUTH: the program of this machine; exit code 0: good, 1: not, 77: the package or a tool is missing
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TREE = Path(__file__).resolve().parents[2]
MADE = TREE / "build/package-arm64"
SYSROOT = TREE / "build/sysroot/arm64"
EMULATOR = "qemu-aarch64-static"
PROGRAMS = ("azimuth", "azimuthd", "azimuth-sim")
AZIMUTH = Path(sys.argv[2]).resolve()


def fail(message):
    sys.exit(f"{sys.argv[1]}: {message}")


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def run(*command):
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, cwd=TREE)


def said(*command):
    done = run(*command)
    if done.returncode:
        fail(f"{' '.join(map(str, command))}: {done.returncode}, {done.stdout}")
    return done.stdout


def emulated(package, program, *arguments):
    if not shutil.which(EMULATOR):
        skip(f"no {EMULATOR} here")
    return run(EMULATOR, "-L", SYSROOT, package / "usr/bin" / program, *arguments)


def control(deb, _):
    """The package names its architecture and depends on the libraries of this architecture."""
    if said("dpkg-deb", "-f", deb, "Architecture").strip() != "arm64":
        fail("not for arm64")
    needed = {re.split(r"[ (:]", each.strip())[0] for each in said("dpkg-deb", "-f", deb, "Depends").split(",")}
    for library in ("libc6", "libstdc++6", "liblcm1", "libsystemd0", "libusb-1.0-0", "libmicrohttpd12", "systemd"):
        if library not in needed:
            fail(f"does not need {library}: {sorted(needed)}")


def programs(_, package):
    """The programs are for arm64 and stripped."""
    for name in PROGRAMS:
        file = package / "usr/bin" / name
        header, sections = said("readelf", "-h", file), said("readelf", "-SW", file)
        if "AArch64" not in header:
            fail(f"{name}: {header}")
        if ".symtab" in sections or ".debug" in sections:
            fail(f"{name} is not stripped")


def start(_, package):
    for name in PROGRAMS:
        done = emulated(package, name, "--version")
        if done.returncode or not re.match(r"azimuth\S* \d+\.\d+\.\d+", done.stdout):
            fail(f"{name}: {done.returncode}, {done.stdout}")


def replay(_, package):
    """A replay of the shipped run gives the report of this machine's program, bit-identical if this machine has FMA."""
    done = emulated(package, "azimuth", "replay", TREE / "runs/lab")
    here = said(AZIMUTH, "replay", TREE / "runs/lab")
    if done.returncode or figures(done.stdout) != figures(here):
        fail(f"{done.returncode}, {done.stdout}\nand here\n{here}")


def figures(report):
    flags = set(Path("/proc/cpuinfo").read_text(encoding="utf-8").split())
    differ = ("step time",) if {"avx2", "fma"} <= flags else ("step time", "digest")
    return [line for line in report.splitlines() if not line.startswith(differ)]


def doctor(_, package):
    """`azimuth doctor` may find faults of the machine, but must end normally."""
    done = emulated(package, "azimuth", "doctor")
    if done.returncode not in (0, 1) or not done.stdout.strip():
        fail(f"{done.returncode}, {done.stdout}")


def main():
    debs = sorted(MADE.glob("azimuth_*.deb"))
    if not debs:
        skip(f"no package in {MADE.relative_to(TREE)} (scripts/package --arch arm64 makes it)")
    with tempfile.TemporaryDirectory() as folder:
        said("dpkg-deb", "-x", debs[0], folder)
        globals()[sys.argv[1]](debs[0], Path(folder))


if __name__ == "__main__":
    main()
