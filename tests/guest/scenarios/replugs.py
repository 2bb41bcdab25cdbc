"""Unplugs devices and plugs them in again while the service runs."""

import os
import random
import re
import statistics
import time

import service
from bench import expect, expect_equal, run, tell, wait_until
from lcm import HEALTH
from set_up import error_m

RECOVERY_S = 2.0
REPLUGS = 20 if os.uname().machine == "x86_64" else 3  # the emulation of other processors is slower
MAPPED = 8  # landmarks before the fault; with fewer, the pose soon becomes too uncertain for the health "tracking"


def replug(devices, heard, times=REPLUGS, seed=1):
    """Replugs each device `times` times in random order. Returns the seconds from the return of its node to tracking,
    by device."""
    order = [name for name in devices for _ in range(times)]
    chance = random.Random(seed)
    chance.shuffle(order)
    took = {name: [] for name in devices}
    for name in order:
        devices[name].unplug()
        time.sleep(chance.uniform(0.3, 1.5))
        devices[name].plug()
        there = time.monotonic()
        took[name].append(wait_until(lambda: heard.tracks_since(there), 20, f"tracking after {name} was replugged", 0.02))
        if took[name][-1] > RECOVERY_S:
            tell(f"{name}, late by {took[name][-1] - RECOVERY_S:.2f} s")
            tell_around(there, heard)
        time.sleep(chance.uniform(0.2, 1.0))
    for name, seconds in took.items():
        tell(f"{name}: tracking {statistics.median(seconds):.2f} s after replug (median), "
             f"{max(seconds):.2f} s at worst, of {len(seconds)}")
    return took


def tell_around(there_s, heard):
    """Prints the received poses and log lines around a slow recovery, with the seconds after the fault."""
    steps = [(p.time_s - there_s, HEALTH[p.health]) for p in heard.poses if not p.predicted and p.time_s > there_s - 2]
    tell("steps: " + ", ".join(f"{t:+.2f} {health}" for t, health in steps))
    for line in run("journalctl", "-u", "azimuthd", "--no-pager", "-o", "short-monotonic").splitlines():
        stamp = re.match(r"\[\s*([0-9.]+)\]", line)
        if stamp and float(stamp[1]) > there_s - 3:
            tell(f"{float(stamp[1]) - there_s:+.2f} {line.partition(': ')[2]}")


def expect_quick(took):
    late = {name: [s for s in seconds if s > RECOVERY_S] for name, seconds in took.items()}
    expect(not any(late.values()), f"later than {RECOVERY_S} s: {late}")


def replugged_unharmed(devices, robot, heard):
    """Replugs the devices after there is a map, and expects that the process, the map and the number of descriptors
    stay."""
    wait_until(lambda: heard.status["landmarks"] >= MAPPED, 60, f"a map of {MAPPED} landmarks")
    pid, open_before, landmarks = service.pid(), service.descriptors(), heard.status["landmarks"]
    took = replug(devices, heard)
    settled = time.monotonic()
    time.sleep(10)
    status = heard.status
    rms_m, points = error_m(heard, robot, settled)
    tell(f"landmarks {landmarks} before, {status['landmarks']} after; descriptors {open_before} before, "
         f"{service.descriptors()} after; reconnects {status['odometer_reconnects']} and {status['camera_reconnects']}; "
         f"{rms_m:.3f} m rms over the last {points} steps, {HEALTH[status['health']]}")
    expect_equal(service.pid(), pid, "the process")
    expect_equal(service.restarts(), 0, "restarts")
    expect(service.descriptors() <= open_before, "no descriptor leaks")
    expect(status["landmarks"] >= landmarks, "the map is intact")
    expect_quick(took)
