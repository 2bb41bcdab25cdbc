"""Shared parts of the tests of the package: the programs, the tree, and functions that fail or skip a case."""

import shutil
import subprocess
import sys
from pathlib import Path

TREE = Path(__file__).resolve().parents[2]
SYSTEMD = TREE / "packaging/systemd"
UNIT = SYSTEMD / "azimuthd.service"
AZIMUTHD, AZIMUTH, AZIMUTH_SIM = (Path(path).resolve() for path in sys.argv[2:5])
AZIMUTH_ROS2 = Path(sys.argv[5]).resolve() if len(sys.argv) > 5 else None


def fail(message):
    sys.exit(f"{sys.argv[1]}: {message}")


def need(tool):
    if not shutil.which(tool):
        print(f"skipped: no {tool} here")
        sys.exit(77)


def run(*command, **options):
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False, **options)


def settings_of(unit):
    """All settings `Key=value` of a unit in order, as {key: [values]}."""
    found = {}
    for line in unit.read_text().splitlines():
        if "=" in line and not line.startswith("#"):
            key, value = line.split("=", 1)
            found.setdefault(key, []).append(value)
    return found
