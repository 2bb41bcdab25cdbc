"""An independent subscriber to LCM over multicast, so that another reader than the LCM library checks the messages."""

import socket
import struct
import threading
import time
from dataclasses import dataclass

GROUP, PORT = "239.255.76.67", 7667
WHOLE, FRAGMENT = b"LC02", b"LC03"

TRACKING = 1
LOST = 3
HEALTH = {0: "starting", 1: "tracking", 2: "degraded", 3: "lost"}


@dataclass(frozen=True)
class Pose:
    """The fields of pose_cov_t that the tests use. Times are CLOCK_MONOTONIC [s]."""
    time_s: float
    arrived_s: float
    utime: int
    sequence: int
    x_m: float
    y_m: float
    heading_rad: float
    health: int
    predicted: bool
    step: int


def decode_pose(data, arrived_s):
    utime, utime_mono, sequence, x_m, y_m, heading_rad = struct.unpack_from(">qqqddd", data, 8)
    health, predicted, step = struct.unpack_from(">bbq", data, 8 + 3 * 8 + (3 + 9 + 3) * 8)
    return Pose(utime_mono / 1e6, arrived_s, utime, sequence, x_m, y_m, heading_rad, health, bool(predicted), step)


class Reader:
    """Reads the fields of a message one after the other."""

    def __init__(self, data):
        self.data, self.at = data, 8

    def take(self, letters):
        values = struct.unpack_from(">" + letters, self.data, self.at)
        self.at += struct.calcsize(">" + letters)
        return values if len(values) > 1 else values[0]

    def text(self):
        length = self.take("i")
        start, self.at = self.at, self.at + length
        return self.data[start:start + length - 1].decode(errors="replace")


class Listener:
    """Keeps every pose and the newest status. It ignores fragmented messages."""

    def __init__(self, decode_status):
        self._decode_status = decode_status
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 21)
        self._socket.bind((GROUP, PORT))
        membership = struct.pack("4s4s", socket.inet_aton(GROUP), socket.inet_aton("127.0.0.1"))
        self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
        self._socket.settimeout(0.2)
        self.poses, self.status, self.counts = [], None, {}
        self._over = False
        self._thread = threading.Thread(target=self._listen, daemon=True)
        self._thread.start()

    def close(self):
        self._over = True
        self._thread.join()
        self._socket.close()

    def _listen(self):
        while not self._over:
            try:
                datagram = self._socket.recv(65536)
            except socket.timeout:
                continue
            now = time.monotonic()
            if datagram[:4] != WHOLE:
                continue
            channel, _, data = datagram[8:].partition(b"\0")
            self.counts[channel] = self.counts.get(channel, 0) + 1
            if channel == b"AZIMUTH_POSE":
                self.poses.append(decode_pose(data, now))
            elif channel == b"AZIMUTH_STATUS":
                self.status = self._decode_status(Reader(data))

    def tracks_since(self, time_s):
        """True if a step after `time_s` had health "tracking", so that odometry, camera and estimator work again."""
        return self.tracking_again_s(time_s) is not None

    def tracking_again_s(self, time_s):
        """The arrival time of the first such step; None if there is none yet."""
        again_s = None
        for pose in reversed(self.poses):
            if pose.time_s < time_s:
                break
            if not pose.predicted and pose.health == TRACKING:
                again_s = pose.arrived_s
        return again_s
