#!/usr/bin/env python3
"""Runs one replay. If it fails, the job writes a report with the reason; azimuth report compare counts and names such
runs.

usage: replay_job.py REPORT NAME TIME_S MEMORY_MB COMMAND...      exit code 0: there is a report
"""

import json
import os
import resource
import signal
import subprocess
import sys
from pathlib import Path

DONE, ENDS_LOST = 0, 3     # exit codes of azimuth replay with which there is a report


def name_of_signal(number):
    try:
        return signal.Signals(number).name
    except ValueError:     # of the real-time signals, only the first and the last have names
        return f"signal {number}"


def failure(command, time_s, memory_mb):
    """Runs the command; returns why it failed, or None."""
    limit = memory_mb * 1_000_000
    try:
        done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace", timeout=time_s,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)), check=False)
    except subprocess.TimeoutExpired:
        return f"took more than {time_s:g} s"
    except OSError as error:
        return f"{command[0]}: {error.strerror}"
    if done.returncode in (DONE, ENDS_LOST):
        return None
    if "bad_alloc" in done.stderr:     # printed before the program ends or aborts
        return f"out of memory: more than {memory_mb} MB"
    if done.returncode < 0:
        return f"killed by {name_of_signal(-done.returncode)}"
    said = done.stderr.strip().splitlines()
    return f"exit code {done.returncode}: {said[0][:200] if said else 'it said nothing'}"


def main():
    report, name, time_s, memory_mb, *command = sys.argv[1:]
    partial = Path(report + ".partial")
    partial.parent.mkdir(parents=True, exist_ok=True)     # on a cluster node, no other program makes the folder
    partial.unlink(missing_ok=True)     # left by an attempt that was killed
    why = failure([*command, "--quiet", "--name", name, "--report", str(partial)], float(time_s), int(memory_mb))
    if why is None and not partial.exists():
        why = "it wrote no report"
    if why is not None:
        tags = [tag for option, tag in zip(command, command[1:]) if option == "--tag"]
        partial.write_text(json.dumps({"name": name, "tags": tags, "failure": why}))
    os.replace(partial, report)     # a report is complete or does not exist


if __name__ == "__main__":
    main()
