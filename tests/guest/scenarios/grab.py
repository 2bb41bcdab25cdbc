"""Runs frame_grab and reads its output about the images that the daemon's camera drivers deliver."""

import signal
import subprocess
import time
from typing import NamedTuple

from bench import Failed, expect, expect_equal, tell
from devices import PROGRAMS, PROMPT


class Image(NamedTuple):
    sequence: int
    stamp_us: int
    number: int  # first four bytes of the image, where usb_camera writes its image counter
    corrupt: int  # number of corrupt images so far
    whole: int  # 1: all bytes are those of a test image of usb_camera
    digest: str


class Grab:
    """Runs frame_grab with the priority of the daemon's threads. Images and counters are known after it has ended."""

    def __init__(self, kind, *settings, frames=100, for_s=40, until_failed=False):
        command = [str(PROGRAMS / "frame_grab"), kind, *settings, "--frames", str(frames), "--for", str(for_s)]
        self._for_s = for_s
        self.started_us = time.monotonic_ns() // 1000
        self._process = subprocess.Popen(PROMPT + command + ["--until-failed"] * until_failed, stdout=subprocess.PIPE,
                                         stderr=subprocess.PIPE, text=True)
        self.images, self.counters, self.events = [], {}, ""

    def pause(self, seconds):
        """Takes no image for `seconds`."""
        self._process.send_signal(signal.SIGSTOP)
        time.sleep(seconds)
        self._process.send_signal(signal.SIGCONT)

    def finish(self):
        try:
            told, self.events = self._process.communicate(timeout=self._for_s + 20)
        finally:
            self._process.kill()
        self.ended_us = time.monotonic_ns() // 1000
        for line in told.splitlines():
            words = line.split()
            if words[0] == "images":
                self.counters = dict(zip(words[::2], map(int, words[1::2])))
            else:
                self.images.append(Image(*map(int, words[:5]), words[5]))
        if self._process.returncode != 0:
            raise Failed(f"frame_grab: exit code {self._process.returncode}, {len(self.images)} images, "
                         f"{self.counters}\n{self.events}")
        return self

    def gaps(self, field):
        """The number of values of `field` that are missing between the first and the last."""
        values = [getattr(image, field) for image in self.images]
        return values[-1] - values[0] - (len(values) - 1)


def ascends(values):
    return all(a < b for a, b in zip(values, values[1:]))


def check_order(grab):
    """Expects that sequence numbers and stamps increase, and that the stamps lie within the time of the grab."""
    images = grab.images
    expect(ascends([image.sequence for image in images]), "sequence numbers ascend")
    stamps = [image.stamp_us for image in images]
    expect(ascends(stamps), "stamps ascend")
    expect(grab.started_us < stamps[0] and stamps[-1] < grab.ended_us,
           f"stamps from {stamps[0]} to {stamps[-1]} lie between {grab.started_us} and {grab.ended_us}")
    lost = grab.counters["missing"] + grab.counters["corrupt"] + grab.counters["dropped"]
    expect_equal(grab.gaps("sequence"), lost, "gaps in the sequence numbers, beside what the driver counted")


def check_pattern(grab):
    """Expects that the images are those of usb_camera, undamaged and in order."""
    expect(all(image.whole for image in grab.images), "every byte of every image is as it was sent")
    expect(ascends([image.number for image in grab.images]), "the images come in the order in which they were sent")


def tell_of(name, grab):
    stamps = [image.stamp_us for image in grab.images]
    steps_ms = sorted((b - a) / 1000 for a, b in zip(stamps, stamps[1:]))
    tell(f"{name}: {len(stamps)} images in {(stamps[-1] - stamps[0]) / 1e6:.1f} s, {steps_ms[0]:.1f} to {steps_ms[-1]:.1f} ms "
         f"apart (median {steps_ms[len(steps_ms) // 2]:.1f}); gaps {grab.gaps('sequence')}; {grab.counters}")
    if grab.events.count("\n") > 1:
        tell(f"it said: {'; '.join(sorted(set(grab.events.strip().splitlines())))}")
