"""Replaces `azimuth view` in tests of the page: it sends the same events, and faults on request.

As a program: fake_view.py PAGE_FOLDER [PORT [PICTURE.jpg]]    serves a synthetic drive until the program is ended
"""

import json
import math
import socket
import sys
import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

from synthetic_robot import SyntheticRobot

POLICY = ("default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; base-uri 'none'; "
          "form-action 'none'; frame-ancestors 'none'")
TYPES = {".html": "text/html", ".js": "text/javascript", ".css": "text/css"}
PERIOD_S = 1.0 / 30.0
# The camera of runs/mirror, because its pictures may be shown.
IMAGE = {"width": 512, "height": 384, "centre": [255.5, 191.5], "beta": 1.0, "direction": -1, "offset": -math.pi / 2, "inner": 30.0, "outer": 188.0}


class FakeView:
    """`robot` is a robot that started `past_s` ago, with a trail of `points` poses. `run` is the object of a recorded
    run."""

    def __init__(self, page, robot=None, run=None, past_s=0.0, points=0, picture=None, port=0, speed=1.0):
        self.page, self.robot, self.run, self.picture = Path(page), robot, run, picture
        self.past_s, self.points, self.speed = past_s, points, speed
        self.began_s = time.monotonic() - past_s / speed
        self.silent = False          # the daemon sends nothing
        self.stalled = False         # the server sends nothing
        self.refusal = ""            # a sentence that replaces the stream
        self.extra = []              # [(event, text)] to be sent unchanged
        self.streams = set()
        self.port = port
        self.server = None

    def start(self):
        view = self

        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def do_GET(self):
                view.answer(self)

            def log_message(self, *_):
                pass

        ThreadingHTTPServer.daemon_threads = True
        ThreadingHTTPServer.allow_reuse_address = True
        self.server = ThreadingHTTPServer(("127.0.0.1", self.port), Handler)
        self.port = self.server.server_address[1]
        threading.Thread(target=self.server.serve_forever, args=(0.05,), daemon=True).start()
        return f"http://127.0.0.1:{self.port}/"

    def stop(self):
        """Stops like a killed program; start() serves again at the same port."""
        self.server.shutdown()
        self.server.server_close()
        for connection in list(self.streams):
            try:
                connection.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def now(self):
        return (time.monotonic() - self.began_s) * self.speed

    def restart_daemon(self):
        """Simulates a new daemon, whose time and counters start again; the page is told."""
        self.began_s, self.past_s, self.points = time.monotonic(), 0.0, 0
        self.robot.seq = 0
        told = {"t": None, "text": "the daemon started anew, or its recording did", "level": "info", "sent_us": int(time.time() * 1e6)}
        self.extra += [("restarted", "{}"), *self.greeting(), ("journal", json.dumps(told)), ("journal", json.dumps(told))]

    def greeting(self):
        hello = {"version": "0.0", "source": "udpm://239.255.76.67:7667", "epoch_us": 0, "limits": {"trail": 100000, "landmarks": 5000},
                 "rig": {"front_end": "features", "camera_model": "mirror", "looks_up": self.robot.lamps, "image": IMAGE}}
        t = self.now()
        times = [t * i / self.points for i in range(self.points)]
        truth = [self.robot.truth(t) for t in times[::10]]
        truth_trail = {name: [one[name] for one in truth] for name in ("t", "x", "y", "heading")}
        return [("hello", json.dumps(hello)), *(("trail", json.dumps(part)) for part in self.robot.trail(times)),
                ("truth_trail", json.dumps(truth_trail)),
                ("map", json.dumps(self.robot.map(t))), ("status", json.dumps(self.robot.status(t)))]

    def answer(self, request):
        path = request.path.split("?")[0]
        name = path.removeprefix("/modules/")
        if path == "/":
            self.send_file(request, "page.html")
        elif path == "/health":
            self.send(request, 200, "application/json", json.dumps({"shows": "recorded" if self.run else "live"}).encode())
        elif path == "/events" and self.robot and not self.refusal:
            self.stream(request)
        elif path == "/events":
            self.send(request, 503, "text/plain", self.refusal.encode())
        elif path == "/run.json" and self.run:
            self.send(request, 200, "application/json", json.dumps(self.run).encode())
        elif path == "/picture" and self.picture:
            self.send(request, 200, "image/jpeg", self.picture)
        elif path.startswith("/modules/") and "/" not in name and (self.page / name).suffix in (".js", ".css"):
            self.send_file(request, name)
        else:
            self.send(request, 404, "text/plain", b"There is nothing here.")

    def send_file(self, request, name):
        self.send(request, 200, TYPES[Path(name).suffix] + "; charset=utf-8", (self.page / name).read_bytes())

    def send(self, request, code, kind, body):
        request.send_response(code)
        self.send_headers(request, kind)
        request.send_header("Content-Length", str(len(body)))
        request.end_headers()
        request.wfile.write(body)

    @staticmethod
    def send_headers(request, kind):
        for name, value in (("Content-Type", kind), ("Content-Security-Policy", POLICY), ("X-Content-Type-Options", "nosniff"),
                            ("Referrer-Policy", "no-referrer"), ("Cache-Control", "no-store")):
            request.send_header(name, value)

    def stream(self, request):
        request.close_connection = True
        request.send_response(200)
        self.send_headers(request, "text/event-stream")
        request.end_headers()
        self.streams.add(request.connection)
        try:
            for event, text in self.greeting():
                self.put(request, event, text)
            self.drive(request)
        except OSError:
            pass
        finally:
            self.streams.discard(request.connection)

    def put(self, request, event, text):
        request.wfile.write(f"event: {event}\nid: 1\ndata: {text}\n\n".encode())

    def drive(self, request):
        """Sends 30 poses per second, the bearings of 15 images per second, and the map and the status once per
        second."""
        beat, quiet_since, next_s = 0, None, time.monotonic()
        while True:
            next_s = max(next_s + PERIOD_S, time.monotonic() - 1.0)
            time.sleep(max(0.0, next_s - time.monotonic()))
            while self.extra and not self.stalled:
                self.put(request, *self.extra.pop(0))
            beat += 1
            if self.stalled:
                continue
            if self.silent:
                if quiet_since is None:
                    quiet_since, said_s = time.monotonic(), 0.5
                quiet_s = time.monotonic() - quiet_since
                if quiet_s > said_s + 1.0:
                    said_s = quiet_s
                    self.put(request, "silence", json.dumps({"since_s": quiet_s}))
                if beat % 15 == 0:
                    self.put(request, "beat", "{}")
                continue
            quiet_since = None
            self.beat(request, beat)

    def beat(self, request, beat):
        t = self.now()
        events = [("pose", self.robot.pose(t, int(time.time() * 1e6))), ("truth", self.robot.truth(t))]
        if beat % 2 == 0:
            events.append(("bearings", self.robot.bearings(t)))
        if beat % 30 == 0:
            events += [("map", self.robot.map(t)), ("status", self.robot.status(t))]
            if self.picture:
                events.append(("picture", {"t": t, "seq": beat, "width": IMAGE["width"], "height": IMAGE["height"]}))
        if self.robot.health(t) != self.robot.health(t - PERIOD_S * self.speed):
            told = self.robot.status(t)
            bad = self.robot.health(t) in ("degraded", "lost")
            events.append(("journal", {"t": t, "text": f"health: {self.robot.health(t)}{': ' if told['reason'] else ''}{told['reason']}",
                                       "level": "warning" if bad else "info", "sent_us": int(time.time() * 1e6)}))
        for event, data in events:
            self.put(request, event, json.dumps(data))


def main():
    picture = Path(sys.argv[3]).read_bytes() if len(sys.argv) > 3 else None
    view = FakeView(sys.argv[1], SyntheticRobot(), port=int(sys.argv[2]) if len(sys.argv) > 2 else 0, picture=picture)
    print(view.start(), flush=True)
    while True:
        time.sleep(60)


if __name__ == "__main__":
    main()
