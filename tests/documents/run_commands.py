#!/usr/bin/env python3
"""Runs the shell commands of a document unchanged, in a scratch folder with the beginning of the shipped run and the
configurations. Each fence is one session; NOT_RUN lists the commands that are not run, with reasons.

usage: run_commands.py SOURCE_TREE DOCUMENT AZIMUTH AZIMUTHD AZIMUTH_SIM      exit code 0: all ran, 1: not, 77: nothing can be run here
       run_commands.py SOURCE_TREE                                            checks NOT_RUN: each entry is of some document
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve()
sys.path.insert(0, str(HERE.parents[2] / "scripts/lib"))
from html_pages import documents  # noqa: E402

KEPT_S = 10.0       # length of the shipped run that is kept, which is enough for a map
PATIENCE_S = 50.0

NOT_RUN = [  # pattern of a command, and the reason why it is not run
    (r"^scripts/|^\.ci/|^cmake |^export PATH=|^AZIMUTH_RESTARTS", "installs or builds"),
    (r"^sudo|^journalctl|^systemctl|^ip link", "of the machine's administrator"),
    (r"^azimuth doctor", "answers differently on each machine"),
    (r"/etc/azimuthd|/var/log/azimuth", "an installed robot"),
    (r"^azimuthd --config|azimuthd\.toml|^azimuth-sim", "devices; drives until it is stopped (tests/live does it)"),
    (r"/tmp/log|/tmp/drive", "of the drive before it"),
    (r"^azimuth calibrate|--front-end sift|log/\* --pictures", "wants images, which the shipped run has not, or a drive of minutes"),
    (r"^azimuth check", "wants a drive of minutes, and the shipped one is cut short here"),
    (r"^types=|^lcm-gen|^g\+\+|^\./listen|listen\.py", "done by the test lcm_examples"),
    (r"^azimuth view", "shows until it is stopped (tests/live does it)"),
    (r"^azimuth-ros2|^ros2 ", "there is no ROS 2 here (tests/ros2 does it with another DDS)"),
    (r"drive\.bag|--images left|drive\.lcm ", "recordings of others (tests/tools does it)"),
]

# Shell commands that make further files which a document's commands expect beside runs/ and config/.
FOUND = {
    "docs/import.md": r"""cp runs/lab/rig.toml .
awk -F, 'NR == 1 { print "timestamp px py yaw"; next } { print $1, $2, $3, $4 * 57.29577951 }' runs/lab/odometry.csv > odometry.txt
awk -F, 'NR == 1 { print "time,bearing,tag"; next } { print $1 "," (-$2 * 57.29577951) "," $NF }' runs/lab/bearings.csv > seen.csv""",
    "docs/export.md": "azimuthd --play runs/lab --speed max --record log --lcm-url memq:// 2>/dev/null",
    "docs/fleet.md": "azimuthd --play runs/lab --speed max --record log --lcm-url memq:// 2>/dev/null",
    "docs/first-map.md": "cp runs/lab/rig.toml . && azimuthd --play runs/lab --speed max --record log --lcm-url memq:// 2>/dev/null",
}


def fences(text):
    return re.findall(r"^```sh\n(.*?)^```", text, flags=re.M | re.S)


def commands(fence):
    """Yields (command, comment) of each command of a fence, with continued lines joined."""
    for line in fence.replace("\\\n", " ").splitlines():
        found = re.fullmatch(r"(.*?)(?:\s+#\s*(.*))?", line)
        if found[1].strip() and not found[1].startswith("#"):
            yield found[1].strip(), found[2] or ""


def reason_not_to_run(command):
    return next((why for pattern, why in NOT_RUN if re.search(pattern, command)), None)


def cut_short(table):
    lines = table.read_text().splitlines(keepends=True)
    table.write_text("".join([lines[0], *(line for line in lines[1:] if float(line.split(",")[0]) <= KEPT_S)]))


def prepare(tree, document, folder, run):
    shutil.copytree(tree / "runs", folder / "runs")
    shutil.copytree(tree / "config", folder / "config")
    for name in ("odometry", "bearings", "truth"):
        cut_short(folder / "runs/lab" / f"{name}.csv")
    if document in FOUND and run(FOUND[document]).returncode:
        sys.exit(f"{document}: what its commands need could not be made")


class Session:
    """Runs the commands of one fence in a folder. Commands for another terminal run in parallel until the others are
    done. A player starts after all listeners, independently of their order in the document, because nothing is played
    twice here."""

    def __init__(self, folder, environment):
        self.folder, self.environment, self.beside, self.players = folder, environment, [], []

    def run(self, command):
        return subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=PATIENCE_S, check=False)

    def start(self, command):
        if "--play" in command:
            self.players.append(command)
        else:
            self.beside.append(self.begin(command))

    def begin(self, command):
        process = subprocess.Popen(["bash", "-c", f"exec {command}"], cwd=self.folder, env=self.environment,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_until_heard(command)
        return process

    def finish_beside(self):
        """Runs the players until they end, and then ends the listeners with Ctrl-C."""
        for process in [self.begin(command) for command in self.players]:
            process.wait(PATIENCE_S)
        self.players = []
        for process in self.beside:
            process.send_signal(signal.SIGINT)
            process.wait(PATIENCE_S)
        self.beside = []


def wait_until_heard(command):
    """Waits until lcm-logger has subscribed, which binds a socket to LCM's port (0x1DF3 = 7667)."""
    for _ in range(100):
        if not command.startswith("lcm-logger") or re.search(r"^\s*\d+: \w+:1DF3 ", Path("/proc/net/udp").read_text(), flags=re.M):
            return
        subprocess.run(["sleep", "0.05"], check=False)


def run_fence(document, fence, session, ran):
    for command, comment in commands(fence):
        if reason_not_to_run(command):
            continue
        ran.append(command)
        if re.search(r"\bin (one|another)\b", comment):
            session.start(command)
            continue
        if command.startswith("azimuth "):  # reads the files of the other programs
            session.finish_beside()
        done = session.run(command)
        if done.returncode:
            sys.exit(f"{document}: {command}: exit code {done.returncode}\n{done.stdout}")
    session.finish_beside()


def run_document(tree, document, programs):
    environment = os.environ | {"PATH": ":".join([*(str(program.parent) for program in programs), os.environ["PATH"]])}
    with tempfile.TemporaryDirectory() as folder:
        session, ran = Session(Path(folder), environment), []
        prepare(tree, document, Path(folder), session.run)
        for fence in fences((tree / document).read_text(encoding="utf-8")):
            run_fence(document, fence, session, ran)
    print(f"{document}: {len(ran)} commands ran\n" + "\n".join(ran))


def check_exceptions(tree):
    every = [command for document in documents(tree) for fence in fences((tree / document).read_text(encoding="utf-8")) for command, _ in commands(fence)]
    unused = [pattern for pattern, _ in NOT_RUN if not any(re.search(pattern, command) for command in every)]
    if unused:
        sys.exit(f"of no document: {unused}")
    if len([command for command in every if not reason_not_to_run(command)]) < 15:
        sys.exit("hardly a command is run")


def main():
    if len(sys.argv) == 2:
        return check_exceptions(Path(sys.argv[1]))
    if len(sys.argv) != 6:
        sys.exit(__doc__.strip())
    return run_document(Path(sys.argv[1]), sys.argv[2], [Path(each).resolve() for each in sys.argv[3:]])


if __name__ == "__main__":
    main()
