#!/usr/bin/env python3
"""Measures the cost of `azimuth view`, and its effect on the daemon's latency. A looker is a client of the viewer.

usage: lookers.py BUILD [--lookers N] [--stopped N] [--seconds S]
           a large map (large_map_sender): the server's processor time and memory with no looker, with one and with --lookers of them, of
           which --stopped are stopped (SIGSTOP), and the poses per second that each of the others receives
       lookers.py BUILD --page [--seconds S]
           the same map in a headless browser: frames per second, and the time from sending a pose (its stamp) to drawing it
       lookers.py BUILD --latency PAIRS [--lookers N] [--stopped N] [--scheduling unit|normal]
           latency_bench alone and with server and lookers, in turns

BUILD is a build folder such as build/release. Run it in a network namespace: tests/daemon/in_namespace.sh tests/bench/lookers.py ...
The server uses the scheduling of azimuth-view.service (`normal`: the default scheduling). Lookers normally run on other computers, so here
they only get idle processor time (SCHED_IDLE).
"""

import argparse
import json
import os
import re
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

TREE = Path(__file__).resolve().parents[2]
TICK_S = 1.0 / os.sysconf("SC_CLK_TCK")
BESIDE = ["bearings_to_pose_sent/landmarks:100/echo:0/fifo:0", "bearings_to_pose_sent/landmarks:100/echo:1/fifo:0",
          "bearings_to_pose_sent/landmarks:100/echo:1/fifo:1"]


def look(port):
    """One looker: counts poses from SIGUSR1 on. At SIGTERM it prints the poses per second and the longest pause between two poses."""
    counted = {"begun": False, "poses": 0, "since": time.monotonic(), "last": None, "pause": 0.0}

    def begin(*_):
        counted.update(poses=0, since=time.monotonic(), last=None, pause=0.0)

    def end(*_):
        print(json.dumps({"hz": counted["poses"] / (time.monotonic() - counted["since"]), "pause_s": counted["pause"]}), flush=True)
        os._exit(0)

    signal.signal(signal.SIGUSR1, begin)
    signal.signal(signal.SIGTERM, end)
    connection = socket.create_connection(("127.0.0.1", port))
    connection.sendall(b"GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n")
    print("looking", flush=True)
    kept = b""
    while block := connection.recv(262144):
        text = kept + block
        poses = text.count(b"event: pose\n")
        kept = text[-11:]  # shorter than the counted text, so that nothing counts twice
        if poses:
            now_s = time.monotonic()
            if counted["last"] is None and not counted["begun"]:
                counted["begun"] = True
                print("it drives", flush=True)
            counted["pause"] = max(counted["pause"], now_s - (counted["last"] or now_s))
            counted["last"] = now_s
            counted["poses"] += poses
    print("hung up on", flush=True)


def scheduled_as(unit):
    """Returns a function for the child process that applies the niceness and the policy that a systemd unit states."""
    text = (TREE / "packaging/systemd" / unit).read_text(encoding="utf-8")
    nice = re.search(r"^Nice=(-?\d+)$", text, re.M)
    policy = re.search(r"^CPUSchedulingPolicy=(\w+)$", text, re.M)
    known = {"idle": os.SCHED_IDLE, "batch": os.SCHED_BATCH, "other": os.SCHED_OTHER}

    def take():
        if nice:
            os.setpriority(os.PRIO_PROCESS, 0, int(nice[1]))
        if policy:
            os.sched_setscheduler(0, known[policy[1]], os.sched_param(0))

    return take


class Processes:
    """Context manager of all started processes, which end with it."""

    def __init__(self, options):
        self.is_idle = options.lookers_as == "idle"
        self.all = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in self.all:
            if process.poll() is None:
                process.send_signal(signal.SIGCONT)
                process.kill()
            process.wait()

    def start(self, arguments, **how):
        self.all.append(subprocess.Popen([str(each) for each in arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, **how))
        return self.all[-1]

    def view(self, options):
        process = self.start([options.build / "tools/azimuth/azimuth", "view", "--port", "0"],
                             preexec_fn=scheduled_as("azimuth-view.service") if options.scheduling == "unit" else None)
        return process, int(re.search(r"http://localhost:(\d+)", process.stdout.readline())[1])

    def sender(self, options, seconds):
        process = self.start([options.build / "tests/bench/large_map_sender", seconds])
        if process.stdout.readline().strip() != "driving":
            raise RuntimeError("large_map_sender does not begin")
        return process

    def lookers(self, count, port):
        policy = os.SCHED_IDLE if self.is_idle else os.SCHED_OTHER
        take = lambda: os.sched_setscheduler(0, policy, os.sched_param(0))
        lookers = [self.start([sys.executable, "-B", __file__, "--look", port], preexec_fn=take) for _ in range(count)]
        for each in lookers:
            if each.stdout.readline().strip() != "looking":
                raise RuntimeError("a looker is hung up on")
        return lookers


def cpu_s(process):
    fields = Path(f"/proc/{process.pid}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) * TICK_S


def most_memory_mb(process):
    return int(re.search(r"VmHWM:\s+(\d+)", Path(f"/proc/{process.pid}/status").read_text(encoding="utf-8"))[1]) / 1024


def measured(view, seconds):
    before_s, begin_s = cpu_s(view), time.monotonic()
    time.sleep(seconds)
    return 100.0 * (cpu_s(view) - before_s) / (time.monotonic() - begin_s)


def load(options):
    with Processes(options) as processes:
        view, port = processes.view(options)
        processes.sender(options, int(3 * options.seconds + 60))
        lookers, driven = [], 0
        for count in (0, 1, options.lookers):
            lookers += processes.lookers(count - len(lookers), port)
            for each in lookers[driven:]:
                each.stdout.readline()  # the looker has received the past and the first pose
            driven = count
            if count == options.lookers:
                for each in lookers[:options.stopped]:
                    each.send_signal(signal.SIGSTOP)
                for each in lookers[options.stopped:]:
                    each.send_signal(signal.SIGUSR1)
            percent = measured(view, options.seconds)
            print(f"{count} lookers: server {percent:.1f} % of a core, {most_memory_mb(view):.0f} MB at most", flush=True)
        figures = []
        for each in lookers[options.stopped:]:
            each.send_signal(signal.SIGTERM)
            figures.append(json.loads(each.stdout.readline()))
        rates = [each["hz"] for each in figures]
        print(f"{len(rates)} that run beside {options.stopped} that are stopped: {min(rates):.1f} to {max(rates):.1f} poses/s, "
              f"longest pause {max(each['pause_s'] for each in figures):.3f} s")


DELAYS = """
  const { store, map } = window.azimuthView, told = map.drawn;
  window.delays = [];
  let last = null;
  map.drawn = () => {
    told();
    if (!store.pose || store.pose === last) return;
    last = store.pose;
    window.delays.push(Date.now() - (store.hello.epoch_us / 1e3 + last.t * 1e3));
  };
  window.azimuthView.frames.clear();"""


def page(options):
    sys.path.insert(0, str(TREE / "tests/tools/page"))
    import web_driver
    with Processes(options) as processes, tempfile.TemporaryDirectory() as folder, web_driver.Browser(folder) as browser:
        view, port = processes.view(options)
        processes.sender(options, int(options.seconds + 120))
        browser.open(f"http://localhost:{port}/")
        browser.until("window.azimuthView?.store.map.landmarks.length === 5000 && window.azimuthView.store.poses.length > 90000", 90, "the map is there")
        time.sleep(3)
        browser.run(DELAYS)
        percent = measured(view, options.seconds)
        delays, frames = browser.run("return [window.delays, window.azimuthView.frames.figures()]")
        delays.sort()
        print(f"a browser: server {percent:.1f} % of a core; {frames['fps']:.0f} frames/s, 95 % within {frames['p95']:.0f} ms; from LCM to drawn "
              f"{statistics.median(delays):.0f} ms (median), {delays[int(0.99 * (len(delays) - 1))]:.0f} ms (99 %) of {len(delays)} poses")


def latencies_us(options):
    """Returns {benchmark: (median, 99 % quantile)} in microseconds."""
    run = subprocess.run([options.build / "tests/bench/latency_bench", "--benchmark_format=json", "--benchmark_filter=^(" + "|".join(BESIDE) + ")/"],
                         capture_output=True, text=True, check=True)
    return {each["name"]: (each["median_us"], each["p99_us"]) for each in json.loads(run.stdout)["benchmarks"]}


def beside_lookers(options):
    with Processes(options) as processes:
        _, port = processes.view(options)
        lookers = processes.lookers(options.lookers, port)
        time.sleep(3)
        for each in lookers[:options.stopped]:
            each.send_signal(signal.SIGSTOP)
        return latencies_us(options)


def latency(options):
    outcomes = []
    for i in range(options.latency):
        pair = [("alone", latencies_us), ("looked at", beside_lookers)]
        outcomes.append({name: measure(options) for name, measure in (pair if i % 2 == 0 else pair[::-1])})
        print(f"pair {i + 1} of {options.latency}", file=sys.stderr, flush=True)
    for name in outcomes[0]["alone"]:
        for how in ("alone", "looked at"):
            medians, tails = zip(*(each[how][name] for each in outcomes))
            words = [", ".join(f"{value:.0f}" for value in values) for values in (medians, tails)]
            print(f"{name.split('/iterations')[0]} {how}: median {words[0]} us; 99 % {words[1]} us")


def main():
    if sys.argv[1:2] == ["--look"]:
        return look(int(sys.argv[2]))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("--lookers", type=int, default=20)
    parser.add_argument("--stopped", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--page", action="store_true")
    parser.add_argument("--latency", type=int, default=0, metavar="PAIRS")
    parser.add_argument("--scheduling", choices=["unit", "normal"], default="unit")
    parser.add_argument("--lookers-as", choices=["idle", "normal"], default="idle", help="how lookers are scheduled; idle ones starve on a busy machine")
    options = parser.parse_args()
    latency(options) if options.latency else page(options) if options.page else load(options)


if __name__ == "__main__":
    main()
