"""Scenarios of the whole system: a robot on a serial adapter, a camera, the service and subscribers."""

import re
import shutil
import time
from pathlib import Path

import service
from bench import expect, expect_equal, run, scenario, tell, wait_until
from devices import PROGRAMS, UsbCamera
from replugs import replugged_unharmed, tell_around
from robot import SimulatedRobot
from set_up import at_end, closing, error_m, listener, plugged_adapter, start_robot_and_service

RESTART_S = 3.0


@scenario
def robot_is_tracked():
    """Poses of the service agree with a replay of its log bit for bit, and with where the robot was."""
    robot, _, _, heard = start_robot_and_service(service.RECORDED)
    time.sleep(45)
    expect_equal(service.property_of("User"), "azimuth", "the service's user")
    status = heard.status
    service.stop()
    rms_m, points = error_m(heard, robot)
    tell(f"{len(heard.poses)} poses, of them {points} steps compared with the truth: {rms_m:.3f} m rms; "
         f"{status['landmarks']} landmarks, {status['frames']} images, {status['frames_replaced']} replaced, "
         f"{status['bearing_gaps']} missing")
    expect(rms_m < 0.5, f"the poses are {rms_m:.3f} m off")
    sessions = sorted(service.LOGS.iterdir())
    expect_equal(len(sessions), 1, "recorded sessions")
    told = run("azimuth", "replay", sessions[0], "--verify", "--tum", "/tmp/replayed.tum", timeout=300)
    tell(told.strip().splitlines()[-1])
    replayed = {}
    for line in open("/tmp/replayed.tum"):
        if not line.startswith("#"):
            t, x, y = map(float, line.split()[:3])
            replayed[round(t * 1e6)] = (x, y)
    compared = [(p, replayed[p.utime]) for p in heard.poses if not p.predicted and p.utime in replayed]
    expect(len(compared) > 0.9 * points, f"only {len(compared)} of {points} poses are in the replay")
    worst_m = max(max(abs(p.x_m - x), abs(p.y_m - y)) for p, (x, y) in compared)
    tell(f"{len(compared)} poses that a subscriber received differ by at most {worst_m:.1e} m from the replay's")
    expect(worst_m < 1e-5, "received and replayed poses agree")
    digests = set(re.findall(r"digest ([0-9a-f]{16})", service.journal() + told))
    expect_equal(len(digests), 1, f"digests of service and replay {digests}")


@scenario
def devices_come_late():
    """The service is active without any device, and tracks once they are there."""
    service.forget_everything()
    robot = closing(SimulatedRobot("/run/robot"))
    service.configure(service.FROM_SERIAL, robot.rig)
    service.start()
    heard = listener()
    time.sleep(3)
    tell(service.property_of("StatusText"))
    camera = closing(UsbCamera("uvc", camera_link=robot.camera_socket))
    del camera
    plugged_adapter()
    there = time.monotonic()
    took = wait_until(lambda: heard.tracks_since(there), 30, "the robot is tracked")
    tell(f"tracking {took:.1f} s after the last device was there")


@scenario
def camera_and_adapter_replugged():
    """Camera and serial adapter go and come back, each several times in random order."""
    robot, adapter, camera, heard = start_robot_and_service(service.RECORDED)
    replugged_unharmed({"camera": camera, "adapter": adapter}, robot, heard)


@scenario
def silent_camera_is_reset():
    """A camera that is there and silent is noticed within a second, and its port is reset."""
    _, _, camera, heard = start_robot_and_service()
    time.sleep(3)
    since = time.monotonic()
    camera.tell("hang")
    line = re.compile(r"\[\s*([0-9.]+)\].*camera.*(silent|no image|nothing)", re.IGNORECASE)

    def noticed():
        text = run("journalctl", "-u", "azimuthd", "--no-pager", "-o", "short-monotonic")
        times = [float(match[1]) for match in map(line.search, text.splitlines()) if match]
        return [t for t in times if t >= since]

    wait_until(noticed, 10, "the silence is noticed")
    after_s = noticed()[0] - since
    tell(f"noticed {after_s:.2f} s after the camera's end")
    recovered = wait_until(lambda: heard.tracks_since(since + after_s), 30, "the robot is tracked again")
    tell(f"tracking again {after_s + recovered:.2f} s after the camera's end; "
         f"{heard.status['camera_resets']} resets of its port")
    wait_until(lambda: heard.status["camera_resets"] == 1, 3, "one reset of the port in the status")
    expect(after_s <= 1.0, f"noticed after {after_s:.2f} s")


def expect_tracking_after_a_hang(image_rate_hz):
    """The process of a stage that hangs is killed, and the next one goes on with map and odometry."""
    # Runs the program from the guest's disk, which is cached in memory, so that it starts as fast as the real one.
    program = Path(shutil.copy(PROGRAMS / "hanging_azimuthd", "/usr/local/sbin"))
    at_end(program.unlink)
    service.drop_in("hang", f"[Service]\nExecStart=\nExecStart={program} --config /etc/azimuthd/azimuthd.toml\n")
    _, _, _, heard = start_robot_and_service(image_rate_hz=image_rate_hz)
    service.wait_for_map()
    time.sleep(75)  # one lap of the room
    landmarks = heard.status["landmarks"]
    (Path("/run/azimuth") / "hang").write_text("")
    hung = time.monotonic()
    wait_until(lambda: not (Path("/run/azimuth") / "hang").exists(), 5, "the stage hangs")
    wait_until(lambda: service.restarts() == 1, 15, "the service is restarted")
    restarted = time.monotonic()
    wait_until(lambda: heard.tracks_since(restarted), 30, "the robot is tracked again")
    took = heard.tracking_again_s(restarted) - hung
    time.sleep(2)
    tell(f"restarted after {restarted - hung:.1f} s, tracking after {took:.1f} s; landmarks {landmarks} before, "
         f"{heard.status['landmarks']} after")
    if took > RESTART_S:
        tell_around(restarted, heard)
    expect("watchdog" in run("journalctl", "-b", "--no-pager", "_PID=1", "-o", "cat").lower(), "the watchdog did it")
    expect(heard.status["landmarks"] >= landmarks * 0.7, "the map is the saved one")
    journal = service.journal()
    expect("odometry goes on from before the start" in journal, "the robot is not searched for")
    expect(took <= RESTART_S, f"tracking after {took:.1f} s")


@scenario
def hung_stage_is_killed():
    """A stage that hangs is killed by the watchdog, and the service tracks again within 3 s, knowing where it is."""
    expect_tracking_after_a_hang(image_rate_hz=8)


@scenario
def hung_stage_is_killed_with_few_images():
    """Likewise with a camera of 4 images a second."""
    expect_tracking_after_a_hang(image_rate_hz=4)


@scenario
def real_time_is_had():
    """SCHED_FIFO and locked memory are active under the unit."""
    *_, heard = start_robot_and_service()
    wait_until(lambda: heard.status["realtime"], 5, "the status says what was had of it")
    fifo = {name: priority for name, (policy, priority) in service.threads().items() if policy == 1}
    tell(f"SCHED_FIFO: {fifo}; locked {service.locked_kb()} kB; status: {heard.status['realtime']!r}")
    expect(fifo.get("estimator") == 30 and fifo.get("camera") == 40 and fifo.get("odometer") == 40, "SCHED_FIFO threads")
    expect(service.locked_kb() > 10000, "memory is locked")


@scenario
def real_time_refused_is_told():
    """Where SCHED_FIFO and locked memory are refused the status says so, and the robot is tracked all the same."""
    service.drop_in("refused", "[Service]\nLimitRTPRIO=0\nLimitMEMLOCK=65536\n")
    *_, heard = start_robot_and_service()
    wait_until(lambda: heard.status["realtime"], 5, "the status says what was had of it")
    told = heard.status["realtime"]
    tell(told)
    expect("SCHED_FIFO" in told and "refused" in told and "memory" in told, "the status tells what was refused")


@scenario
def configuration_is_reloaded():
    """SIGHUP takes a new configuration over and keeps the map; a wrong one is refused."""
    _, _, _, heard = start_robot_and_service()
    time.sleep(10)
    pid, landmarks = service.pid(), heard.status["landmarks"]
    text = service.CONFIGURATION.read_text()
    service.CONFIGURATION.write_text(text + "\n[ekf]\nno_such_key = 1\n")
    run("systemctl", "reload", "azimuthd", check=False)
    time.sleep(2)
    expect("no_such_key" in service.journal(), "what is wrong is logged")
    expect_equal(service.pid(), pid, "the process")
    before = time.monotonic()
    wait_until(lambda: heard.tracks_since(before), 10, "the old configuration stays in force")
    service.CONFIGURATION.write_text(text + "\n[daemon.lcm]\nmap_rate_hz = 2.0\n")
    run("systemctl", "reload", "azimuthd", timeout=30)
    reloaded = time.monotonic()
    took = wait_until(lambda: heard.tracks_since(reloaded), 20, "tracking with the new configuration")
    time.sleep(2)
    tell(f"tracking {took:.1f} s after the reload; landmarks {landmarks} before, {heard.status['landmarks']} after")
    expect_equal(service.pid(), pid, "the process")
    expect(heard.status["landmarks"] >= landmarks * 0.9, "the map is kept")
