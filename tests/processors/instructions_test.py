#!/usr/bin/env python3
"""Counts and prints the arm64 instructions of a call of each time-critical loop, with and without vector instructions.
The ratio must be at most 0.45. The time under emulation means nothing, but the count is the same on every machine.

usage: instructions_test.py WITH_VECTORS WITHOUT      exit code 0: good, 1: not, 77: the emulator is missing
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

TREE = Path(__file__).resolve().parents[2]
SYSROOT = TREE / "build/sysroot/arm64"
EMULATOR = "qemu-aarch64-static"
MOST = 0.45  # largest ratio of the instructions with vectors to those without


def run(*command):
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, text=True, check=True).stdout


def instructions(program, loop, calls):
    """The number of executed instructions of the whole program. With these options the emulator logs every single
    instruction."""
    read_end, write_end = os.pipe()
    command = [EMULATOR, "-L", SYSROOT, "-singlestep", "-d", "exec,nochain", "-D", f"/dev/fd/{write_end}", program, loop, str(calls)]
    with subprocess.Popen([str(word) for word in command], pass_fds=[write_end]) as running:
        os.close(write_end)
        with open(read_end, "rb") as log:
            count = sum(piece.count(b"Trace ") for piece in log)
    if running.returncode:
        sys.exit(f"{program} {loop}: {running.returncode}")
    return count


def of_a_call(program, loop):
    """The number of instructions of one call. The difference of two runs removes the program's start, end and data."""
    return (instructions(program, loop, 3) - instructions(program, loop, 1)) // 2


def main():
    with_vectors, without = sys.argv[1:3]
    too_many = []
    print(f"{'instructions of a call, arm64':32}{'with vectors':>14}{'without':>12}{'part':>8}")
    for loop in run(EMULATOR, "-L", SYSROOT, with_vectors).splitlines():
        few, many = of_a_call(with_vectors, loop), of_a_call(without, loop)
        print(f"{loop:32}{few:14}{many:12}{few / many:8.2f}", flush=True)
        if few > MOST * many:
            too_many.append(loop)
    if too_many:
        sys.exit(f"more than {MOST} of the instructions without vectors: {', '.join(too_many)}")


if __name__ == "__main__":
    if not shutil.which(EMULATOR):
        print(f"skipped: no {EMULATOR} here (package qemu-user-static)")
        sys.exit(77)
    main()
