#!/usr/bin/env python3
"""Films a page of `azimuth view` in a headless browser as an animated WebP, see scripts/film."""

import argparse
import base64
import struct
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "tools" / "page"))
import web_driver  # noqa: E402


def picture(browser, quality):
    shot = browser.devtools("Page.captureScreenshot", format="webp", quality=quality)
    return base64.b64decode(shot["data"])


def chunks(webp):
    """Splits a RIFF file into [(name, bytes)]."""
    at, end = 12, 8 + struct.unpack("<I", webp[4:8])[0]
    while at + 8 <= end:
        size = struct.unpack("<I", webp[at + 4:at + 8])[0]
        yield webp[at:at + 4], webp[at + 8:at + 8 + size]
        at += 8 + size + size % 2


def chunk(name, body):
    return name + struct.pack("<I", len(body)) + body + b"\0" * (len(body) % 2)


def three(number):
    return struct.pack("<I", number)[:3]


def animated(pictures, width, height, frame_ms, last_ms):
    """Makes an endless animation of the pictures; the last one stays longer."""
    frames = []
    for i, webp in enumerate(pictures):
        image = b"".join(chunk(name, body) for name, body in chunks(webp) if name in (b"ALPH", b"VP8 ", b"VP8L"))
        for_ms = last_ms if i + 1 == len(pictures) else frame_ms
        frames.append(chunk(b"ANMF", three(0) + three(0) + three(width - 1) + three(height - 1) + three(for_ms) + b"\x02" + image))
    head = chunk(b"VP8X", b"\x02\0\0\0" + three(width - 1) + three(height - 1)) + chunk(b"ANIM", b"\xff\xff\xff\xff" + struct.pack("<H", 0))
    body = b"WEBP" + head + b"".join(frames)
    return b"RIFF" + struct.pack("<I", len(body)) + body


def filmed(browser, address, wishes):
    browser.scheme(wishes.scheme)
    browser.open(address)
    browser.until(wishes.wait, 60, "the page has something to show")
    pictures, next_s = [], time.monotonic()
    for _ in range(wishes.frames):
        time.sleep(max(0.0, next_s - time.monotonic()))
        pictures.append(picture(browser, wishes.quality))
        next_s += wishes.every
    return pictures


def main():
    parser = argparse.ArgumentParser(prog="scripts/film")
    parser.add_argument("address")
    parser.add_argument("out", type=Path)
    parser.add_argument("--frames", type=int, default=60)
    parser.add_argument("--every", type=float, default=1.0, metavar="SECONDS")
    parser.add_argument("--frame-ms", type=int, default=120)
    parser.add_argument("--quality", type=int, default=60)
    parser.add_argument("--most-bytes", type=int, default=3_000_000)
    parser.add_argument("--size", default="1200x720")
    parser.add_argument("--scheme", choices=("light", "dark"), default="light")
    parser.add_argument("--wait", default="window.azimuthView ? window.azimuthView.store.poses.length > 5 : document.querySelector('canvas')",
                        help="what must hold before the first picture, in JavaScript")
    wishes = parser.parse_args()
    if not web_driver.is_here():
        sys.exit("scripts/film: needs chromium and chromedriver: scripts/setup --dev")
    width, height = (int(part) for part in wishes.size.split("x"))
    with tempfile.TemporaryDirectory() as folder, web_driver.Browser(folder, width, height) as browser:
        film = animated(filmed(browser, wishes.address, wishes), width, height, wishes.frame_ms, 2000)
    if len(film) > wishes.most_bytes:
        sys.exit(f"scripts/film: {len(film)} bytes are more than {wishes.most_bytes}: fewer --frames, a lower --quality or a smaller --size")
    wishes.out.write_bytes(film)
    print(f"{wishes.out}: {wishes.frames} pictures, {len(film) / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
