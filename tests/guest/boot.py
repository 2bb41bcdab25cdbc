#!/usr/bin/env python3
"""Boots the QEMU guest of build_image, runs IN/run in it and copies the results back.

usage: boot.py IN OUT [--limit SECONDS] [--images FOLDER] [--arch ARCH] [--keep]
  IN      folder that the guest mounts read-only at /mnt/in; it runs IN/run as root
    OUT     folder of the guest's /mnt/out: log, exit_code, dmesg, journal and the files of IN/run; console is that of the kernel
    --arch  architecture of the guest: amd64 or arm64
    --keep  keeps the changes of the guest's disk

Exit code: that of IN/run; 125 if the guest did not run it.

The guest is emulated (no KVM), with two CPUs, and has
  a serial adapter  an FTDI on a USB bus, /dev/ttyUSB0; this program connects its line to /dev/virtio-ports/robot. Bytes
                      that are sent while the adapter is unplugged are lost, as on a real line
  two CAN cards     Kvaser (SJA1000) on one bus, can0 and can1
  a control port    /dev/virtio-ports/host takes commands, one per line, and answers each with a line: `unplug` and `plug`
                      the serial adapter, `mute` and `speak` on its line
"""

import argparse
import asyncio
import json
import os
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

NOT_FINISHED = 125


@dataclass(frozen=True)
class Machine:
    """The emulated machine of one architecture."""
    command: list
    threads: str  # threading of QEMU: one thread for each processor of the guest, or one for all
    clock: list
    console: str
    kernel_options: str = ""


# The clock of the arm64 guest counts executed instructions, 10^9 per second, independently of the time on the host.
# With the host's clock, the guest would be too slow for cameras and watchdogs whenever the host is busy.
MACHINES = {
    "amd64": Machine(["qemu-system-x86_64", "-cpu", "Nehalem", "-machine", "q35"], "multi", [], "ttyS0", "tsc=reliable"),
    "arm64": Machine(["qemu-system-aarch64", "-cpu", "cortex-a72", "-machine", "virt"], "single", ["-icount", "shift=0"],
                     "ttyAMA0"),
}


def arguments():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n")[0])
    parser.add_argument("folder_in", type=Path)
    parser.add_argument("folder_out", type=Path)
    parser.add_argument("--limit", type=float, default=1500)
    parser.add_argument("--images", type=Path, default=Path(__file__).resolve().parents[2] / "build/guest")
    parser.add_argument("--arch", choices=MACHINES, default="amd64")
    parser.add_argument("--keep", action="store_true")
    return parser.parse_args()


def qemu_command(options, sockets):
    def shared(tag, folder, mode):
        return ["-fsdev", f"local,id={tag},path={folder.resolve()},security_model=none{mode}",
                "-device", f"virtio-9p-pci,fsdev={tag},mount_tag={tag}"]

    def line(name):
        return ["-chardev", f"socket,id={name},path={sockets}/{name},server=on,wait=off"]

    def port(name):
        return [*line(name), "-device", f"virtserialport,chardev={name},name={name}"]

    machine = MACHINES[options.arch]
    # norandmaps: QEMU caches translated code by virtual address. With address randomisation it would translate a
    # program again at every start, which takes a second.
    return [
        *machine.command, "-accel", f"tcg,thread={machine.threads},tb-size=512", *machine.clock,
        "-smp", "2", "-m", "2048", "-nodefaults", "-no-user-config", "-display", "none", "-nic", "none", "-no-reboot",
        "-kernel", str(options.images / "vmlinux"), "-initrd", str(options.images / "initrd.img"),
        "-append", f"console={machine.console} quiet panic=-1 net.ifnames=0 mitigations=off nokaslr norandmaps "
                   f"{machine.kernel_options}",
        "-serial", f"file:{options.folder_out / 'console'}",
        "-drive", f"file={options.images / 'disk.ext4'},format=raw,if=virtio,cache=unsafe,"
                  f"snapshot={'off' if options.keep else 'on'}",
        *shared("in", options.folder_in, ",readonly=on"), *shared("out", options.folder_out, ""),
        "-device", "virtio-rng-pci", "-device", "qemu-xhci,id=xhci", "-device", "virtio-serial-pci",
        *port("host"), *port("robot"), *line("adapter"),
        "-object", "can-bus,id=wires", "-device", "kvaser_pci,canbus=wires", "-device", "kvaser_pci,canbus=wires",
        "-qmp", f"unix:{sockets}/qmp,server=on,wait=off"]


async def connect(path):
    for _ in range(100):
        try:
            return await asyncio.open_unix_connection(path)
        except OSError:
            await asyncio.sleep(0.1)
    raise SystemExit(f"boot.py: QEMU does not listen at {path}")


class Monitor:
    """The control channel of QEMU (QMP)."""

    def __init__(self, reader, writer):
        self.reader, self.writer = reader, writer

    async def run(self, command, **details):
        self.writer.write(json.dumps({"execute": command, "arguments": details}).encode() + b"\n")
        while True:
            answer = json.loads(await self.reader.readline())
            if "return" in answer or "error" in answer:
                return answer


class Adapter:
    """The FTDI adapter, and the line behind it."""

    def __init__(self, monitor):
        self.monitor, self.carries, self.plugged = monitor, True, False

    async def plug(self):
        """Plugs the adapter in; retries, because QEMU releases an unplugged adapter later than the guest."""
        self.plugged = True
        for _ in range(50):
            answer = await self.monitor.run("device_add", driver="usb-serial", id="adapter0", chardev="adapter",
                                            bus="xhci.0")
            if "in use" not in str(answer.get("error")) and "Duplicate" not in str(answer.get("error")):
                break
            await asyncio.sleep(0.1)
        return answer

    async def unplug(self):
        self.plugged = False
        return await self.monitor.run("device_del", id="adapter0")

    async def carry(self, source, target):
        while data := await source.read(4096):
            if self.carries and self.plugged:
                target.write(data)
                await target.drain()


async def serve(reader, writer, adapter):
    """Answers the commands of the guest."""
    while line := await reader.readline():
        request = line.decode(errors="replace").strip()
        answer = {}
        if request == "plug":
            answer = await adapter.plug()
        elif request == "unplug":
            answer = await adapter.unplug()
        elif request in ("mute", "speak"):
            adapter.carries = request == "speak"
        else:
            answer = {"error": f"unknown request {request!r}"}
        writer.write((json.dumps(answer.get("error", "done")) + "\n").encode())


async def run(options):
    options.folder_out.mkdir(parents=True, exist_ok=True)
    for name in ("exit_code", "log", "dmesg", "journal", "console", "boot_s", "state"):
        (options.folder_out / name).unlink(missing_ok=True)
    with tempfile.TemporaryDirectory() as sockets:
        qemu = await asyncio.create_subprocess_exec(*qemu_command(options, sockets), stdin=asyncio.subprocess.DEVNULL)
        tasks = []
        try:
            monitor = Monitor(*await connect(f"{sockets}/qmp"))
            await monitor.reader.readline()  # the greeting
            await monitor.run("qmp_capabilities")
            adapter = Adapter(monitor)
            adapter_reader, adapter_writer = await connect(f"{sockets}/adapter")
            robot_reader, robot_writer = await connect(f"{sockets}/robot")
            host_reader, host_writer = await connect(f"{sockets}/host")
            tasks = [asyncio.create_task(work) for work in (
                adapter.carry(adapter_reader, robot_writer), adapter.carry(robot_reader, adapter_writer),
                serve(host_reader, host_writer, adapter))]
            await asyncio.wait_for(qemu.wait(), options.limit)
        except asyncio.TimeoutError:
            print(f"boot.py: the guest was still running after {options.limit:.0f} s", file=sys.stderr)
        finally:
            for task in tasks:
                task.cancel()
            if qemu.returncode is None:
                qemu.kill()
                await qemu.wait()
    try:
        return int((options.folder_out / "exit_code").read_text())
    except (OSError, ValueError):
        return NOT_FINISHED


if __name__ == "__main__":
    os.umask(0o022)
    sys.exit(asyncio.run(run(arguments())))
