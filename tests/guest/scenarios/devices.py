"""Emulated devices. Each has plug() and unplug() and a wait for its node."""

import json
import os
import subprocess
import time
from pathlib import Path

from bench import Failed, Skipped, exit_code, expect, run, wait_until

IN = Path("/mnt/in")
PROGRAMS = IN / "programs"
FIRST_NODE_TIMEOUT_S = 30
# Programs that replace hardware have real-time priority, because a real robot does not wait for udev. Their priority is
# below that of the daemon's threads, which are under test.
PROMPT = ["chrt", "--fifo", "10"]


class Host:
    """The control port to the program that booted the guest, see boot.py."""

    def __init__(self):
        self._port = os.open("/dev/virtio-ports/host", os.O_RDWR)

    def ask(self, request):
        os.write(self._port, request.encode() + b"\n")
        answer = b""
        while not answer.endswith(b"\n"):
            answer += os.read(self._port, 4096)
        answer = json.loads(answer)
        expect(answer == "done", f"the host, asked to {request}: {answer}")


_host = None


def host():
    global _host
    _host = _host or Host()
    return _host


class SerialAdapter:
    """The FTDI adapter that QEMU emulates, driven by the kernel's ftdi_sio."""

    node = Path("/dev/ttyUSB0")

    def plug(self):
        host().ask("plug")
        wait_until(self.node.exists, FIRST_NODE_TIMEOUT_S, f"{self.node} after the adapter was plugged in", 0.01)

    def unplug(self):
        host().ask("unplug")
        wait_until(lambda: not self.node.exists(), FIRST_NODE_TIMEOUT_S, f"{self.node} gone", 0.01)

    def mute(self, muted):
        host().ask("mute" if muted else "speak")


class UsbCamera:
    """The user-space camera tests/equipment/usb_camera, attached to the kernel's vhci_hcd."""

    def __init__(self, kind, width_px=320, height_px=240, rate_hz=15, serial="BENCH1", camera_link=None, port=0):
        run("modprobe", "-a", "vhci-hcd", "uvcvideo")
        command = [str(PROGRAMS / "usb_camera"), kind, str(port), str(width_px), str(height_px), str(rate_hz),
                   "--serial", serial]
        if camera_link:
            command += ["--camera-link", str(camera_link)]
        self.kind, self.serial = kind, serial
        self.log = open(f"/tmp/usb_camera_{kind}.log", "a")
        self._process = subprocess.Popen(PROMPT + command, stdin=subprocess.PIPE, stdout=self.log, stderr=self.log,
                                         text=True)
        self.wait_for_node()

    def tell(self, command):
        if self._process.poll() is not None:
            raise Failed(f"usb_camera ended with exit code {self._process.returncode}: {Path(self.log.name).read_text()}")
        self._process.stdin.write(command + "\n")
        self._process.stdin.flush()

    def device(self):
        """The USB device in sysfs if it is plugged in, else None."""
        for serial in Path("/sys/bus/usb/devices").glob("*/serial"):
            try:
                if serial.read_text().strip() == self.serial:
                    return serial.parent
            except OSError:
                pass  # the device disappears during the search
        return None

    def node(self):
        """The node /dev/videoN of the UVC camera if it exists."""
        device = self.device()
        nodes = sorted(device.glob("*/video4linux/video*")) if device else []
        return Path("/dev") / nodes[0].name if nodes else None

    def is_there(self):
        return bool(self.node() if self.kind == "uvc" else self.device())

    def wait_for_node(self):
        wait_until(self.is_there, FIRST_NODE_TIMEOUT_S, f"the {self.kind} camera after it was plugged in", 0.01)

    def plug(self):
        self.tell("plug")
        self.wait_for_node()

    def unplug(self):
        self.tell("unplug")
        wait_until(lambda: not self.is_there(), FIRST_NODE_TIMEOUT_S, f"the {self.kind} camera gone", 0.01)

    def close(self):
        if self._process.poll() is None:
            self.tell("quit")
            try:
                self._process.wait(10)
            except subprocess.TimeoutExpired:
                self._process.kill()
        self.log.close()


class LoopbackCamera:
    """The camera tests/equipment/usb_camera, which writes to a node of v4l2loopback."""

    node = Path("/dev/video20")

    def __init__(self, layout, width_px=320, height_px=240, rate_hz=15):
        if exit_code("modprobe", "--dry-run", "v4l2loopback") != 0:
            raise Skipped("this guest has no v4l2loopback")
        run("modprobe", "v4l2loopback", f"video_nr={self.node.name[5:]}", "exclusive_caps=1", "card_label=Loopback",
            "max_buffers=8")  # with the default of two, it overwrites images that are still being read
        wait_until(self.node.exists, FIRST_NODE_TIMEOUT_S, f"{self.node}")
        command = [PROGRAMS / "usb_camera", "loopback", self.node, width_px, height_px, rate_hz, "--format", layout]
        self._log = open("/tmp/usb_camera_loopback.log", "a")
        self._process = subprocess.Popen(PROMPT + [str(word) for word in command], stdin=subprocess.PIPE,
                                         stdout=self._log, stderr=self._log)
        time.sleep(1)  # until the log names its format
        expect(self._process.poll() is None, f"usb_camera writes: {Path(self._log.name).read_text()}")

    def close(self):
        self._process.terminate()
        self._process.wait(10)
        self._log.close()
        wait_until(lambda: not run("modprobe", "-r", "v4l2loopback", check=False), 10, "v4l2loopback is removed", 0.5)


class VirtualCan:
    """A vcan interface that can disappear and return under its name like a USB adapter, while its bus stays. The bus is
    a separate interface, so that the senders are not affected: closing and opening a socket blocks while the kernel
    removes an interface."""

    name, bus = "vcan0", "bus0"

    def __init__(self):
        run("modprobe", "can-gw")
        self._add(self.bus)

    @staticmethod
    def _add(name):
        run("ip", "link", "add", "dev", name, "type", "vcan")
        run("ip", "link", "set", name, "up")

    def plug(self):
        self._add(self.name)
        run("cangw", "-A", "-s", self.bus, "-d", self.name, "-e")

    def unplug(self):
        run("ip", "link", "del", self.name)

    def close(self):
        for name in (self.name, self.bus):
            run("ip", "link", "del", name, check=False)


class KvaserCard:
    """can0, an emulated Kvaser card with an SJA1000; can1 is on the same bus."""

    name, peer = "can0", "can1"
    driver = Path("/sys/bus/pci/drivers/kvaser_pci")

    def __init__(self):
        run("modprobe", "kvaser_pci")
        self._address = os.path.basename(os.path.realpath(f"/sys/class/net/{self.name}/device"))
        self.up(self.peer)

    @staticmethod
    def up(name):
        run("ip", "link", "set", name, "down")
        run("ip", "link", "set", name, "type", "can", "bitrate", "500000", "restart-ms", "100")
        run("ip", "link", "set", name, "up")

    def plug(self):
        if not Path(f"/sys/class/net/{self.name}").exists():
            (self.driver / "bind").write_text(self._address)
        self.up(self.name)

    def unplug(self):
        (self.driver / "unbind").write_text(self._address)
