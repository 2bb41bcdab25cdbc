#!/usr/bin/env python3
"""Runs scripts/film with a stand-in for azimuth view. The film must have the requested number of pictures, in which the
robot moves. A film that becomes too large must be refused without leaving a file.

usage: film_test.py SOURCE_TREE      exit code 0: good, 1: not, 77: the browser is missing
"""

import struct
import subprocess
import sys
import tempfile
from pathlib import Path

TREE = Path(sys.argv[1])
sys.path[:0] = [str(TREE / "tests/tools/page"), str(TREE / "scripts/lib")]
import film  # noqa: E402
import web_driver  # noqa: E402
from fake_view import FakeView  # noqa: E402
from synthetic_robot import SyntheticRobot  # noqa: E402

WIDTH, HEIGHT, FRAMES, FRAME_MS = 800, 500, 4, 90


def filmed(address, out, *more):
    return subprocess.run([TREE / "scripts/film", address, out, "--frames", str(FRAMES), "--every", "0.4", "--frame-ms", str(FRAME_MS), "--size",
                           f"{WIDTH}x{HEIGHT}", *more], capture_output=True, text=True, timeout=120, check=False)


def three(data):
    return struct.unpack("<I", data[:3] + b"\0")[0]


def problems(address, folder):
    out = folder / "film.webp"
    said = filmed(address, out)
    if said.returncode:
        yield f"exit code {said.returncode}: {said.stderr}"
        return
    data = out.read_bytes()
    if data[:4] != b"RIFF" or data[8:12] != b"WEBP" or struct.unpack("<I", data[4:8])[0] != len(data) - 8:
        yield "no WebP of that length"
    parts = list(film.chunks(data))
    heads, pictures = [body for name, body in parts if name == b"VP8X"], [body for name, body in parts if name == b"ANMF"]
    if len(heads) != 1 or (three(heads[0][4:]) + 1, three(heads[0][7:]) + 1) != (WIDTH, HEIGHT):
        yield f"not of {WIDTH}x{HEIGHT} pixels"
    if [three(body[12:]) for body in pictures[:-1]] != [FRAME_MS] * (FRAMES - 1):
        yield f"{len(pictures)} pictures, shown for {[three(body[12:]) for body in pictures]} ms"
    if len({body[16:] for body in pictures}) < FRAMES:
        yield "nothing moves"
    small = folder / "small.webp"
    said = filmed(address, small, "--most-bytes", "1000")
    if said.returncode == 0 or "more than 1000" not in said.stderr or small.exists():
        yield f"a film that is too large: exit code {said.returncode}, {said.stderr}"


def main():
    if not web_driver.is_here():
        print("SKIPPED: no chromium and chromedriver here")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        view = FakeView(TREE / "tools/page", SyntheticRobot(), past_s=30, points=600)
        found = list(problems(view.start(), Path(folder)))
    if found:
        sys.exit("\n".join(found))
    print("filmed")


if __name__ == "__main__":
    main()
