"""Starts the simulated robot, its devices, the service and subscribers for a scenario. All of them end with the
scenario."""

import time
from pathlib import Path

import service
from bench import run, tell, wait_until
from compare import rms_after_best_fit
from devices import IN, SerialAdapter, UsbCamera
from lcm import Listener
from messages import status_decoder
from robot import SimulatedRobot

OUT = Path("/mnt/out")

_at_end = []  # objects that a scenario started; they are closed at its end in any case


def clean_up(name, outcome):
    if outcome == "failed":
        print(run("systemctl", "status", "azimuthd", "--no-pager", "-l", check=False))
        print(service.journal()[-6000:])
        for log in [*Path("/tmp").glob("usb_camera*.log"), Path("/run/robot/sim.log")]:
            if log.exists():
                print(f"{log}:\n{log.read_text()[-2000:]}")
        for folder in (service.LOGS, Path("/run/robot")):
            if folder.exists():
                run("tar", "-C", folder.parent, "-czf", OUT / f"{name}-{folder.name}.tar.gz", folder.name, check=False)
    run("systemctl", "stop", "azimuthd", check=False, timeout=60)
    run("systemctl", "reset-failed", check=False)
    service.remove_drop_ins()
    while _at_end:
        _at_end.pop()()


def at_end(action):
    _at_end.append(action)


def closing(thing):
    at_end(thing.close)
    return thing


def listener():
    return closing(Listener(status_decoder((IN / "status_t.lcm").read_text())))


def plugged_adapter():
    adapter = SerialAdapter()
    adapter.plug()
    at_end(adapter.unplug)
    return adapter


def start_robot_and_service(configuration=service.FROM_SERIAL, **robot_options):
    """Plugs everything in, restarts the service and waits until it tracks."""
    service.forget_everything()
    robot = closing(SimulatedRobot("/run/robot", **robot_options))
    adapter = plugged_adapter()
    camera = closing(UsbCamera("uvc", camera_link=robot.camera_socket))
    heard = listener()
    service.configure(configuration, robot.rig)
    start = time.monotonic()
    service.start()
    tell(f"active after {time.monotonic() - start:.1f} s")
    took = wait_until(lambda: heard.tracks_since(start), 40, "the robot is tracked")
    tell(f"tracking after {took:.1f} s")
    wait_until(lambda: heard.status, 5, "a status")
    return robot, adapter, camera, heard


def error_m(heard, robot, since_s=0.0):
    truth = [row[:3] for row in robot.truth()]
    track = [(p.utime / 1e6, p.x_m, p.y_m) for p in heard.poses if not p.predicted and p.time_s >= since_s]
    return rms_after_best_fit(track, truth)
