"""A synthetic robot that gives the events of `azimuth view`, for tests and films of the page."""

import math
import random

# Id of the first landmark; the landmarks with smaller ids have left the map.
FIRST_ID = 100
HEALTHS = {"starting": 0, "tracking": 1, "degraded": 2, "lost": 3}


class SyntheticRobot:
    """Drives a clover-shaped path in a hall of landmarks. All its data are functions of the time in seconds."""

    def __init__(self, landmarks=24, size_m=9.0, seed=1, lamps=False):
        self.random = random.Random(seed)
        self.size_m, self.lamps = size_m, lamps
        self.lap_s = 60.0 * size_m / 9.0
        reach = 1.45 * size_m
        self.landmarks = [(self.random.uniform(-reach, reach), self.random.uniform(-reach, reach)) for _ in range(landmarks)]
        self.seq = 0
        self.odometer, self.camera = "running (p3dx-sh GJC_3156)", "running (640x480, 12.5 images/s)"

    def true_pose(self, t):
        turn = 2.0 * math.pi * t / self.lap_s
        radius = self.size_m * (0.72 + 0.22 * math.cos(3.0 * turn))
        ahead = turn + 1e-4
        next_radius = self.size_m * (0.72 + 0.22 * math.cos(3.0 * ahead))
        x, y = radius * math.cos(turn), radius * math.sin(turn)
        return x, y, math.atan2(next_radius * math.sin(ahead) - y, next_radius * math.cos(ahead) - x)

    def health(self, t):
        return "starting" if t < 1.5 else "degraded" if 36.0 < t % 61.0 < 42.0 else "lost" if 42.0 <= t % 61.0 < 44.0 else "tracking"

    def sigma_m(self, t):
        extra = max(0.0, t % 61.0 - 36.0) if 36.0 < t % 61.0 < 44.0 else 0.0
        return 0.025 + 0.012 * math.sin(0.21 * t) + 0.05 * extra

    def estimate(self, t):
        x, y, heading = self.true_pose(t)
        sigma = self.sigma_m(t)
        return x + 0.7 * sigma * math.sin(0.9 * t), y + 0.6 * sigma * math.cos(0.7 * t), heading + 0.01 * math.sin(0.5 * t)

    def odometry(self, t):
        """The dead reckoning of the wheels from the first pose on, whose heading drifts."""
        x, y, heading = self.true_pose(t)
        drift = 0.0016 * t
        return x * math.cos(drift) - y * math.sin(drift), x * math.sin(drift) + y * math.cos(drift), heading + drift

    def pose(self, t, now_us):
        x, y, heading = self.estimate(t)
        sigma = self.sigma_m(t)
        self.seq += 1
        xx, yy, xy = sigma**2, (0.55 * sigma) ** 2, 0.3 * sigma**2 * math.sin(0.1 * t)
        return {"t": t, "sent_us": now_us, "seq": self.seq, "step": self.seq // 2, "predicted": self.seq % 2 == 1, "x": x, "y": y,
                "heading": math.remainder(heading, 2 * math.pi), "covariance": [xx, xy, 0.0, yy, 0.0, (0.3 * sigma) ** 2],
                "odom": list(self.odometry(t)), "health": HEALTHS[self.health(t)]}

    def trail(self, times):
        """The path at the given times as columns, in events of 5,000 rows."""
        for begin in range(0, len(times), 5000):
            part = times[begin:begin + 5000]
            poses, odometry = [self.estimate(t) for t in part], [self.odometry(t) for t in part]
            yield {"t": part, "x": [p[0] for p in poses], "y": [p[1] for p in poses], "heading": [p[2] for p in poses],
                   "health": [HEALTHS[self.health(t)] for t in part], "sigma_m": [self.sigma_m(t) for t in part],
                   "sigma_heading_rad": [0.3 * self.sigma_m(t) for t in part], "odom_x": [p[0] for p in odometry],
                   "odom_y": [p[1] for p in odometry], "odom_heading": [p[2] for p in odometry]}

    def truth(self, t):
        x, y, heading = self.true_pose(t)
        return {"t": t, "x": x, "y": y, "heading": heading}

    def known(self, t):
        """Indices of the landmarks that are in the map at time `t`; they are added one after the other."""
        return range(min(len(self.landmarks), max(1, int(len(self.landmarks) * (t + 4.0) / 30.0))))

    def map(self, t):
        rows = []
        for i in self.known(t):
            x, y = self.landmarks[i]
            sigma = 0.05 + 0.6 / (1.0 + max(0.0, t - i * 0.8))
            state = "new" if t < 60 and i >= len(self.known(t - 5.0)) else "unseen" if i % 9 == 4 else "doubted" if i == 12 else "confirmed"
            turn = i * 0.7
            long, across = sigma**2, (0.4 * sigma) ** 2
            xx = long * math.cos(turn) ** 2 + across * math.sin(turn) ** 2
            yy = long * math.sin(turn) ** 2 + across * math.cos(turn) ** 2
            height = (2.4 + 0.1 * math.sin(i), 0.02) if self.lamps else (None, None)
            rows.append([FIRST_ID + i, -1, x + 0.3 * sigma * math.sin(i), y + 0.3 * sigma * math.cos(i), xx, (long - across) * math.sin(turn) * math.cos(turn), yy,
                         *height, t - (40.0 if state == "unseen" else 1.0), state])
        return {"t": t, "seq": int(t), "landmarks": rows, "more": 0}

    def bearings(self, t, most=14):
        x, y, heading = self.estimate(t)
        known = sorted(self.known(t), key=lambda i: math.hypot(self.landmarks[i][0] - x, self.landmarks[i][1] - y))[:most]
        seen, expected = [], []
        for k, i in enumerate(known):
            lx, ly = self.landmarks[i]
            azimuth = math.remainder(math.atan2(ly - y, lx - x) - heading, 2 * math.pi)
            elevation = math.atan2(2.4, math.hypot(lx - x, ly - y)) if self.lamps else None
            sigma = 0.015 + 0.03 * (k % 3)
            expected.append([FIRST_ID + i, azimuth, sigma, elevation, 3.0 * sigma])
            fate = ("used", "used", "used", "used", "refused", "used", "ambiguous", "thinned")[k % 8]
            seen.append([azimuth + self.random.gauss(0.0, 0.012) + (0.2 if fate == "refused" else 0.0), elevation, -1, 0, fate,
                         None if fate in ("refused", "ambiguous") else FIRST_ID + i])
        seen.append([math.remainder(0.4 * t, 2 * math.pi), 0.3 if self.lamps else None, -1, 0, "new", None])
        return {"t": t, "bearings": seen, "expected": expected}

    def status(self, t):
        health = self.health(t)
        reasons = {"starting": "no landmark yet: the pose is odometry", "degraded": "few bearings are used: 0.4 of 3.0 a second",
                   "lost": "nothing fits the map", "tracking": ""}
        return {"t": t, "utime": int(1e6 * t), "seq": int(t), "health": HEALTHS[health], "reason": reasons[health], "estimates": self.seq, "steps": int(12 * t),
                "landmarks": len(self.known(t)), "accepted": int(90 * t), "rejected": int(7 * t), "thinned": int(11 * t),
                "created": len(self.known(t)), "deleted": 2, "recovered": 1, "odometry_gaps": 0, "frames": int(12 * t), "frames_unusable": 0,
                "detect_mean_us": 6200 + 900 * math.sin(t), "detect_max_us": 9000.0, "input_trouble": "", "map_trouble": "", "picture_trouble": "",
                "image_trouble": "", "odometer": self.odometer,
                "camera": self.camera,
                "recorder": "log/2026-03-14T10-21-07.azlog", "camera_reconnects": int(t // 61), "realtime": "SCHED_FIFO, memory locked",
                "configuration": "", "kept": {"log_bytes": 1.2e9 + 2e5 * t, "log_quota_bytes": 8e9, "disk_free_bytes": 31e9, "map_age_s": t % 30},
                "battery_v": 12.9 - 0.002 * t, "robot_flags": 1,
                "rates": {"pose_hz": 30.0 + math.sin(t), "odometry_hz": 10.0 + 0.1 * math.sin(3 * t), "image_hz": 12.5 + 0.4 * math.sin(2 * t)},
                "latency_s": 0.018 + 0.004 * math.sin(2.3 * t), "nis": {"value": 11.0 + 6.0 * math.sin(1.7 * t), "degrees": 12}}
