"""Scenarios with odometry from another process over LCM, and with arbitrary datagrams on the network."""

import subprocess
import time

import service
from bench import expect, expect_equal, run, scenario, tell, wait_until
from can_scenarios import cpu_per_second
from devices import PROGRAMS, UsbCamera
from robot import SimulatedRobot
from set_up import at_end, closing, error_m, listener, plugged_adapter

NETWORK = "udpm://239.255.76.68:7668"
MOST_CPU = 0.9

FROM_LCM = service.FROM_SERIAL.replace('odometer = "pioneer"', 'odometer = "lcm"').replace(
    '[daemon.pioneer]\ndevice = "/dev/ttyUSB0"\n', f"""[daemon.lcm_source]
url = "{NETWORK}"
odometry_channel = "AZIMUTH_ODOM"
""")

# A second daemon that reads the robot and publishes its odometry.
READER = f"""
[daemon]
rig = "/etc/azimuthd/rig.toml"
[daemon.live]
odometer = "pioneer"
[daemon.pioneer]
device = "/dev/ttyUSB0"
[daemon.lcm]
url = "{NETWORK}?ttl=0"
"""


def start_reader():
    file = service.CONFIGURATION.parent / "reader.toml"
    file.write_text(READER)
    at_end(file.unlink)
    reader = subprocess.Popen(["azimuthd", "--config", str(file)], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL)

    def stop():
        reader.terminate()
        reader.wait(20)
    at_end(stop)


@scenario
def lcm_odometry_is_flooded():
    """Odometry comes over LCM; a flood of damaged messages and datagrams beside it ends nothing."""
    service.forget_everything()
    robot = closing(SimulatedRobot("/run/robot"))
    plugged_adapter()
    closing(UsbCamera("uvc", camera_link=robot.camera_socket))
    heard = listener()
    service.configure(FROM_LCM, robot.rig)
    start_reader()
    start = time.monotonic()
    service.start()
    took = wait_until(lambda: heard.tracks_since(start), 40, "the robot is tracked by odometry from LCM")
    time.sleep(10)
    rms_m, points = error_m(heard, robot, start)
    tell(f"tracking after {took:.1f} s; {rms_m:.3f} m rms of {points} steps; odometer {heard.status['odometer']!r}")
    expect(rms_m < 0.5, f"the poses are {rms_m:.3f} m off")
    pid, memory_kb = service.pid(), service.memory_kb()
    told = []
    flood_s = cpu_per_second(lambda: told.append(run(
        PROGRAMS / "lcm_flood", NETWORK, "--channel", "AZIMUTH_ODOM,CAMERA", "--rate", 2000, "--seconds", 10)))
    tell(f"{told[0].strip()}: {flood_s:.2f} s of processor a second; memory {memory_kb} kB before, "
         f"{service.memory_kb()} after; odometer {heard.status['odometer']!r}")
    expect_equal(service.pid(), pid, "the process")
    expect_equal(service.restarts(), 0, "restarts")
    expect(flood_s < MOST_CPU, f"{flood_s:.2f} s of processor a second")
    expect(service.memory_kb() < memory_kb + 50_000, "memory is bounded")
    since = time.monotonic()
    wait_until(lambda: any(pose.time_s > since for pose in reversed(heard.poses)), 10, "poses go on")
