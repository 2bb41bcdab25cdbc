#!/usr/bin/env python3
"""Runs one check of the shipped systemd units.

usage: units_test.py CASE AZIMUTHD AZIMUTH AZIMUTH_SIM [AZIMUTH_ROS2]      exit code 0: good, 1: not, 77: a tool is missing
"""

import shutil
import sys
import tempfile
from pathlib import Path

from package_case import AZIMUTH, AZIMUTH_ROS2, AZIMUTHD, SYSTEMD, TREE, UNIT, fail, need, run, settings_of

MAX_EXPOSURE = 17  # in tenths of the exposure of systemd-analyze security
MAX_VIEW_EXPOSURE = 15


def unit_is_valid():
    need("systemd-analyze")
    with tempfile.TemporaryDirectory() as folder:
        unit = Path(folder) / UNIT.name
        unit.write_text(UNIT.read_text().replace("/usr/bin/azimuthd", str(AZIMUTHD)))
        verified = run("systemd-analyze", "verify", "--man=no", unit)
        if verified.returncode or verified.stdout:
            fail(verified.stdout)
        unit.write_text(unit.read_text().replace("WatchdogSec=", "WatchdogSecs="))
        if not run("systemd-analyze", "verify", "--man=no", unit).stdout:
            fail("a mistake in the unit was not found: this test cannot fail")


def unit_is_hardened():
    need("systemd-analyze")
    judged = run("systemd-analyze", "security", "--offline=true", f"--threshold={MAX_EXPOSURE}", UNIT)
    if judged.returncode:
        fail(judged.stdout)
    if not run("systemd-analyze", "security", "--offline=true", "--threshold=1", UNIT).returncode:
        fail("any unit is hardened enough: this test cannot fail")
    # Only robots with a CAN bus may use AF_CAN, through their own drop-in file.
    allowed = [" ".join(settings_of(unit)["RestrictAddressFamilies"]) for unit in (UNIT, SYSTEMD / "examples/can.conf")]
    if "AF_CAN" in allowed[0] or allowed[1] != "AF_CAN":
        fail(f"address families: {allowed}")


def unit_gives_up_on_refusals():
    unit = settings_of(UNIT)
    refused = run(AZIMUTHD, "--config", "/nonexistent/azimuthd.toml")
    if [str(refused.returncode)] != unit["RestartPreventExitStatus"]:
        fail(f"a refused configuration exits with {refused.returncode}")


def drop_ins():
    need("systemd-analyze")
    files = sorted((SYSTEMD / "examples").glob("*.conf"))
    if not files:
        fail("there are none")
    for file in files:
        with tempfile.TemporaryDirectory() as folder:
            unit = Path(folder) / UNIT.name
            unit.write_text(UNIT.read_text().replace("/usr/bin/azimuthd", str(AZIMUTHD)))
            place = Path(folder) / (UNIT.name + ".d")
            place.mkdir()
            shutil.copy(file, place)
            verified = run("systemd-analyze", "verify", "--man=no", unit)
            if verified.returncode or verified.stdout:
                fail(f"{file.name}: {verified.stdout}")
            (place / file.name).write_text("[Service]\nWatchdogSecs=1\n")
            if not run("systemd-analyze", "verify", "--man=no", unit).stdout:
                fail("drop-ins are not read: this test cannot fail")


def view_unit():
    """The unit is valid and hardened more than the others, does not start at boot, and does not restart after errors
    that persist."""
    need("systemd-analyze")
    unit = SYSTEMD / "azimuth-view.service"
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / unit.name
        copy.write_text(unit.read_text().replace("/usr/bin/azimuth ", f"{AZIMUTH} "))
        verified = run("systemd-analyze", "verify", "--man=no", copy)
        if verified.returncode or verified.stdout:
            fail(verified.stdout)
    judged = run("systemd-analyze", "security", "--offline=true", f"--threshold={MAX_VIEW_EXPOSURE}", unit)
    if judged.returncode:
        fail(judged.stdout)
    if not run("systemd-analyze", "security", "--offline=true", "--threshold=1", unit).returncode:
        fail("any unit is hardened enough: this test cannot fail")
    lines = (TREE / "packaging/debian/postinst").read_text().splitlines()
    if any("enable" in line and unit.name in line for line in lines):
        fail("the package enables it")
    refused = run(AZIMUTH, "view", "--listen", "nowhere")
    if [str(refused.returncode)] != settings_of(unit)["RestartPreventExitStatus"]:
        fail(f"a refused command line exits with {refused.returncode}")


def ros2_unit():
    """The unit is valid and hardened, and does not restart after errors that persist."""
    need("systemd-analyze")
    unit = SYSTEMD / "azimuth-ros2.service"
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / unit.name
        copy.write_text(unit.read_text().replace("/usr/bin/azimuth-ros2", str(AZIMUTH_ROS2)))
        verified = run("systemd-analyze", "verify", "--man=no", copy)
        if verified.returncode or verified.stdout:
            fail(verified.stdout)
    judged = run("systemd-analyze", "security", "--offline=true", f"--threshold={MAX_EXPOSURE}", unit)
    if judged.returncode:
        fail(judged.stdout)
    refused = run(AZIMUTH_ROS2, "--interface", "nowhere0")
    if [str(refused.returncode)] != settings_of(unit)["RestartPreventExitStatus"]:
        fail(f"a refused command line exits with {refused.returncode}")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
