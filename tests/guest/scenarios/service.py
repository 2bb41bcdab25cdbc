"""Controls azimuthd as a systemd service."""

import os
import shutil
from pathlib import Path

from bench import expect, run, wait_until

CONFIGURATION = Path("/etc/azimuthd/azimuthd.toml")
RIG = Path("/etc/azimuthd/rig.toml")
STATE = Path("/var/lib/azimuth")
LOGS = Path("/var/log/azimuth")
MAP = STATE / "map.azmap"
DROP_INS = Path("/run/systemd/system/azimuthd.service.d")

FROM_SERIAL = """
[daemon]
rig = "/etc/azimuthd/rig.toml"
[daemon.live]
odometer = "pioneer"
camera = "v4l2"
[daemon.pioneer]
device = "/dev/ttyUSB0"
[daemon.v4l2]
device = "serial:BENCH1"
width_px = 320
height_px = 240
[daemon.camera]
latency_s = 0.06     # of the emulated one: 45 to 80 ms
[daemon.map]
file = "/var/lib/azimuth/map.azmap"
save_interval_s = 3.0
[daemon.realtime]
lock_memory = true
deadline_ms = 800
source_fifo_priority = 40
estimator_fifo_priority = 30
"""
RECORDED = FROM_SERIAL + f'[daemon.record]\nfolder = "{LOGS}"\n'


def configure(text, rig):
    shutil.copy(rig, RIG)
    CONFIGURATION.write_text(text)
    for file in (RIG, CONFIGURATION):
        file.chmod(0o644)


def drop_in(name, text):
    DROP_INS.mkdir(parents=True, exist_ok=True)
    (DROP_INS / f"{name}.conf").write_text(text)
    run("systemctl", "daemon-reload")


def remove_drop_ins():
    if DROP_INS.exists():
        shutil.rmtree(DROP_INS)
        run("systemctl", "daemon-reload")


def property_of(name):
    return run("systemctl", "show", "-P", name, "azimuthd").strip()


def start():
    run("systemctl", "start", "azimuthd", timeout=60)
    expect(property_of("ActiveState") == "active", f"azimuthd is {property_of('ActiveState')} after its start")


def stop():
    run("systemctl", "stop", "azimuthd", timeout=60)


def pid():
    return int(property_of("MainPID"))


def descriptors():
    return len(os.listdir(f"/proc/{pid()}/fd"))


def restarts():
    return int(property_of("NRestarts"))


def cpu_s():
    """The CPU time that the process has used [s]."""
    fields = Path(f"/proc/{pid()}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def threads():
    """Scheduling policy and priority of the threads, keyed by thread name."""
    found = {}
    for task in Path(f"/proc/{pid()}/task").iterdir():
        name = (task / "comm").read_text().strip()
        try:
            found[name] = (os.sched_getscheduler(int(task.name)), os.sched_getparam(int(task.name)).sched_priority)
        except ProcessLookupError:
            pass
    return found


def locked_kb():
    for line in Path(f"/proc/{pid()}/status").read_text().splitlines():
        if line.startswith("VmLck:"):
            return int(line.split()[1])
    return 0


def memory_kb():
    """The resident memory of the process [kB]."""
    fields = (line.split() for line in Path(f"/proc/{pid()}/status").read_text().splitlines())
    return next(int(words[1]) for words in fields if words[0] == "VmRSS:")


def journal(since=None):
    return run("journalctl", "-u", "azimuthd", "--no-pager", "-o", "cat", *(["--since", since] if since else []))


def forget_everything():
    """Deletes maps and field logs."""
    for folder in (STATE, LOGS):
        if folder.exists():
            for entry in folder.iterdir():
                shutil.rmtree(entry) if entry.is_dir() else entry.unlink()


def wait_for_map(timeout_s=30):
    wait_until(MAP.exists, timeout_s, f"{MAP} is saved")
