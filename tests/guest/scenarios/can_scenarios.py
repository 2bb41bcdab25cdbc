"""Scenarios with a robot base on a CAN bus: its messages, an interface that comes and goes, a full bus, an emulated
card."""

import math
import re
import shutil
import socket
import struct
import time

import service
from bench import expect, expect_equal, run, scenario, tell, wait_until
from devices import IN, PROGRAMS, KvaserCard, UsbCamera, VirtualCan
from lcm import LOST, TRACKING
from replugs import expect_quick, replug, replugged_unharmed
from robot import SimulatedRobot
from set_up import at_end, closing, error_m, listener

WHEELS, POWER = 0x181, 0x182  # identifiers of the frames of the base
DBC = service.CONFIGURATION.parent / "simulated-can.dbc"
EMERGENCY_STOP, BUMPER = 2, 16  # bits of status_t.robot_flags
MOST_CPU = 0.9

FROM_CAN = service.FROM_SERIAL.replace('odometer = "pioneer"', 'odometer = "can"').replace(
    '[daemon.pioneer]\ndevice = "/dev/ttyUSB0"\n', f"""[daemon.can]
interface = "INTERFACE"
dbc = "{DBC}"
odometry = "ticks"
left = "Wheels.LeftTicks"
right = "Wheels.RightTicks"
ticks_per_m = 20000
track_m = 0.357142857
battery = "Power.Voltage"
emergency_stop = "Wheels.EmergencyStop"
bumper = "Wheels.Bumper"
charging = "Wheels.Charging"
""")


def virtual_bus():
    bus = closing(VirtualCan())
    bus.plug()
    return bus


def start_can_robot(listens, sends):
    """Starts the base on the interface `sends` and the service on the interface `listens`, and waits until it
    tracks."""
    service.forget_everything()
    robot = closing(SimulatedRobot("/run/robot", can=sends))
    camera = closing(UsbCamera("uvc", camera_link=robot.camera_socket))
    heard = listener()
    shutil.copy(IN / "simulated-can.dbc", DBC)
    DBC.chmod(0o644)
    at_end(lambda: DBC.unlink(missing_ok=True))
    service.configure(FROM_CAN.replace("INTERFACE", listens), robot.rig)
    service.drop_in("can", "[Service]\nRestrictAddressFamilies=AF_CAN\n")  # the content of the package's example
    start = time.monotonic()
    service.start()
    wait_until(lambda: heard.tracks_since(start), 40, "the robot is tracked")
    tell(f"tracking {time.monotonic() - start:.1f} s after the service was started")
    wait_until(lambda: heard.status, 5, "a status")
    return robot, camera, heard


def healths_of_steps(heard, since_s):
    return [pose.health for pose in heard.poses if not pose.predicted and pose.time_s >= since_s]


@scenario
def can_base_is_tracked():
    """A base on a CAN bus is tracked; battery, emergency stop and bumper are in the status, errors of the bus in the
    log."""
    bus = virtual_bus()
    robot, _, heard = start_can_robot(bus.name, bus.bus)
    since = time.monotonic()
    time.sleep(15)
    rms_m, points = error_m(heard, robot, since)
    tell(f"{rms_m:.3f} m rms of {points} steps; odometer {heard.status['odometer']!r}")
    expect(rms_m < 0.5, f"the poses are {rms_m:.3f} m off")
    tell(f"battery {heard.status['battery_v']:.2f} V, flags {heard.status['robot_flags']}")
    expect(5 < heard.status["battery_v"] < 20 and not math.isnan(heard.status["battery_v"]), "the battery's volts")
    expect_equal(heard.status["robot_flags"] & (EMERGENCY_STOP | BUMPER), 0, "emergency stop and bumper, before")
    robot.command("estop=on")
    took = wait_until(lambda: heard.status["robot_flags"] & EMERGENCY_STOP, 5, "the emergency stop in the status")
    robot.command("estop=off")
    wait_until(lambda: not heard.status["robot_flags"] & EMERGENCY_STOP, 5, "its release")
    robot.command("bumpers=front")
    wait_until(lambda: heard.status["robot_flags"] & BUMPER, 5, "the bumper in the status")
    robot.command("bumpers=none")
    tell(f"emergency stop in the status after {took:.2f} s")
    bus_fails(bus, heard)


def bus_fails(bus, heard):
    """Sends the error frames of a CAN controller from another process."""
    sender = socket.socket(socket.PF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
    sender.bind((bus.name,))
    for kind, data in ((socket.CAN_ERR_FLAG | 0x4, bytes([0, 0x20, 0, 0, 0, 0, 0, 0])),  # error-passive
                       (socket.CAN_ERR_FLAG | 0x40, bytes(8))):  # bus-off
        sender.send(struct.pack("=IB3x8s", kind, 8, data))
        time.sleep(1.5)
    sender.close()
    told = sorted(set(re.findall(rf"{bus.name}: .*", service.journal())))
    tell("; ".join(told))
    expect(any("off" in line for line in told), "the log tells that the controller left the bus")
    since = time.monotonic()
    wait_until(lambda: heard.tracks_since(since), 5, "tracking goes on")


@scenario
def camera_and_can_link_replugged():
    """Camera and CAN interface go and come back, each several times in random order."""
    bus = virtual_bus()
    robot, camera, heard = start_can_robot(bus.name, bus.bus)
    replugged_unharmed({"camera": camera, "CAN link": bus}, robot, heard)


@scenario
def can_bus_is_flooded():
    """A bus full of other frames: odometry intact, and the processor's load bounded."""
    bus = virtual_bus()
    robot, _, heard = start_can_robot(bus.name, bus.bus)
    time.sleep(8)
    for rate_hz in (8000, 0):  # the maximum of a bus of 1 Mbit/s; then as many as the kernel takes
        flooded(bus, robot, heard, rate_hz)


def flooded(bus, robot, heard, rate_hz):
    quiet_s = cpu_per_second(lambda: time.sleep(4))
    gaps, since = heard.status["odometry_gaps"], time.monotonic()
    told = []
    flood_s = cpu_per_second(lambda: told.append(run(
        PROGRAMS / "can_flood", bus.name, "--rate", rate_hz, "--seconds", 10, "--spare", f"{WHEELS},{POWER}")))
    time.sleep(1.5)
    rms_m, points = error_m(heard, robot, since)
    healths = healths_of_steps(heard, since)
    tell(f"{told[0].strip()}: {quiet_s:.2f} s of processor a second before, {flood_s:.2f} meanwhile; "
         f"{healths.count(TRACKING)} of {len(healths)} steps tracking, {rms_m:.3f} m rms of {points}; "
         f"{heard.status['odometry_gaps'] - gaps} gaps")
    expect(len(healths) > 10, f"only {len(healths)} steps")
    # Some poses may be uncertain: on the first lap, the small images show few known landmarks.
    expect_equal(healths.count(LOST), 0, "steps that are lost")
    expect(rms_m < 0.5, f"the poses are {rms_m:.3f} m off")
    expect_equal(heard.status["odometry_gaps"] - gaps, 0, "gaps in the odometry")
    expect(flood_s < MOST_CPU, f"{flood_s:.2f} s of processor a second")


def cpu_per_second(work):
    used, start = service.cpu_s(), time.monotonic()
    work()
    return (service.cpu_s() - used) / (time.monotonic() - start)


@scenario
def can_card_carries_odometry():
    """The base on the wires of a Kvaser card, read through the kernel's driver of it, which also lets go of it."""
    card = KvaserCard()
    card.plug()
    robot, _, heard = start_can_robot(card.name, card.peer)
    since = time.monotonic()
    time.sleep(12)
    rms_m, points = error_m(heard, robot, since)
    tell(f"{rms_m:.3f} m rms of {points} steps; odometer {heard.status['odometer']!r}, "
         f"battery {heard.status['battery_v']:.2f} V")
    expect(rms_m < 0.5, f"the poses are {rms_m:.3f} m off")
    expect_quick(replug({"CAN card": card}, heard, times=5))
