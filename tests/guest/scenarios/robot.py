"""Runs azimuth-sim as the robot with a camera, at the far end of the serial adapter's line or on a CAN bus."""

import csv
import socket
import subprocess
from pathlib import Path

from bench import wait_until
from devices import PROGRAMS, PROMPT

LINE_PORT = 7001


class SimulatedRobot:
    """Drives through a world and renders the camera images. `folder` gets rig.toml at the start and the truth during
    the drive."""

    def __init__(self, folder, scenario="lab", image_rate_hz=4, can=None, seed=1):
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.camera_socket = self.folder / "camera.sock"
        self.truth_file = self.folder / "true.csv"
        self._control = self.folder / "control.sock"
        command = [PROGRAMS / "azimuth-sim", "--tcp", LINE_PORT, "--camera-socket", self.camera_socket, "--scenario",
                   scenario, "--seed", seed, "--images", "mirror", "--image-rate", image_rate_hz, "--image-scale", 0.3125,
                   "--run-folder", self.folder, "--truth", self.truth_file, "--control", self._control,
                   "--laps", 200]
        if can:
            command += ["--can", can]
        self._log = open(self.folder / "sim.log", "w")
        self._processes = [self._start(command)]
        rig = self.folder / "rig.toml"
        wait_until(rig.exists, 60, "azimuth-sim writes rig.toml")
        self.rig = rig
        self._processes.append(self._start(
            ["socat", "OPEN:/dev/virtio-ports/robot", f"TCP:127.0.0.1:{LINE_PORT},retry=50,interval=0.1"]))

    def _start(self, command):
        return subprocess.Popen(PROMPT + [str(word) for word in command], stdin=subprocess.DEVNULL, stdout=self._log,
                                stderr=self._log)

    def command(self, line):
        """Sends a command to azimuth-sim and returns its answer."""
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as control:
            control.settimeout(10)
            control.connect(str(self._control))
            control.sendall(line.encode() + b"\n")
            return control.recv(4096).decode()

    def truth(self):
        """The true poses (t_s, x_m, y_m, heading_rad) so far."""
        with open(self.truth_file) as file:
            rows = list(csv.reader(file))[1:]
        return [tuple(map(float, row)) for row in rows if len(row) == 4]

    def close(self):
        for process in reversed(self._processes):
            if process.poll() is None:
                process.terminate()
                process.wait(20)
        self._log.close()
