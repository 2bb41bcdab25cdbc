"""Scenarios that check every image of each camera driver: order, stamps, content and the count of lost images."""

import time
from pathlib import Path

from bench import expect, expect_equal, run, scenario, tell, wait_until
from devices import LoopbackCamera, UsbCamera
from grab import Grab, ascends, check_order, check_pattern, tell_of
from set_up import closing

LOST = 7  # number of images that a test drops on purpose


def uvc(*settings, **options):
    return Grab("v4l2", "device=serial:BENCH1", "width_px=320", "height_px=240", *settings, **options)


def loopback(camera, code, **options):
    return Grab("v4l2", f"device={camera.node}", f"formats={code}", "width_px=320", "height_px=240", **options)


def iidc(**options):
    return Grab("iidc", "mode=640x480_mono8", "rate_hz=15", **options)


def expect_counted(grab, lost):
    """Expects that `lost` images are missing in the images, in their sequence numbers and in the driver's counters."""
    counters = grab.counters
    expect_equal(grab.gaps("number"), lost, "gaps among the images that were sent")
    expect_equal(counters["missing"] + counters["corrupt"] + counters["dropped"], lost, f"lost, says {counters}")
    expect_equal(grab.gaps("sequence"), lost, "gaps in the sequence numbers")


@scenario
def uvc_frames():
    """uvcvideo: 100 images of each format, in order, stamped, undamaged; sequence numbers tell of every lost one."""
    closing(UsbCamera("uvc"))
    for code in ("YUYV", "NV12", "GREY"):
        grab = uvc(f"formats={code}").finish()
        tell_of(code, grab)
        check_order(grab)
        check_pattern(grab)
        expect_equal(grab.gaps("number"), grab.gaps("sequence"), "gaps among the images and in their sequence numbers")


@scenario
def uvc_errors_are_counted():
    """uvcvideo: images that the camera marks as bad, or that are cut short, are counted exactly."""
    camera = closing(UsbCamera("uvc"))
    for flaw in ("error", "short"):
        grab = uvc()
        time.sleep(3)
        camera.tell(f"{flaw} {LOST}")
        grab.finish()
        tell_of(flaw, grab)
        check_order(grab)
        check_pattern(grab)
        expect_counted(grab, LOST)


def check_losses(grab):
    """Pauses the reader; the driver must count exactly the images for which there was no free buffer."""
    time.sleep(2)
    grab.pause(1.5)
    grab.finish()
    tell_of("paused for 1.5 s", grab)
    check_order(grab)
    check_pattern(grab)
    expect(grab.gaps("number") > 5, "images were lost")
    expect_counted(grab, grab.gaps("number"))


@scenario
def uvc_losses_are_counted():
    """uvcvideo: images for which the reader left no buffer are counted exactly."""
    closing(UsbCamera("uvc"))
    check_losses(uvc(frames=60))


@scenario
def loopback_losses_are_counted():
    """v4l2loopback: images for which the reader left no buffer are counted exactly."""
    check_losses(loopback(closing(LoopbackCamera("yuyv")), "YUYV", frames=60))


@scenario
def uvc_controls_are_set():
    """uvcvideo: exposure, gain, white balance and focus are what v4l2-ctl reads back."""
    camera = closing(UsbCamera("uvc"))
    uvc("exposure=123", "gain=77", "white_balance=3300", "focus=45", frames=5).finish()
    wanted = {"auto_exposure": 1, "exposure_time_absolute": 123, "gain": 77, "white_balance_automatic": 0,
              "white_balance_temperature": 3300, "focus_automatic_continuous": 0, "focus_absolute": 45}
    expect_equal(controls(camera.node(), wanted), wanted, "controls, fixed")
    uvc("exposure=auto", "gain=keep", "white_balance=auto", "focus=auto", frames=5).finish()
    wanted = {"auto_exposure": 3, "gain": 77, "white_balance_automatic": 1, "focus_automatic_continuous": 1}
    expect_equal(controls(camera.node(), wanted), wanted, "controls, automatic")
    grab = uvc("exposure=999999", frames=5).finish()
    tell(grab.events.strip())
    expect(0 < controls(camera.node(), ["exposure_time_absolute"])["exposure_time_absolute"] <= 5000,
           "an exposure beyond the camera's is bounded")


def controls(node, names):
    told = run("v4l2-ctl", "-d", node, "-C", ",".join(names))
    words = (line.replace(":", "").split() for line in told.strip().splitlines())
    found = {name: int(value) for name, value, *_ in words}
    tell(str(found))
    return found


@scenario
def loopback_frames():
    """v4l2loopback: 100 images of each format, in order, stamped, undamaged."""
    for layout, code in (("yuyv", "YUYV"), ("grey", "GREY"), ("nv12", "NV12"), ("mjpeg", "MJPG")):
        camera = LoopbackCamera(layout)
        try:
            grab = loopback(camera, code).finish()
        finally:
            camera.close()
        tell_of(layout, grab)
        check_order(grab)
        if layout != "mjpeg":  # JPEG images have no number in their first bytes
            check_pattern(grab)
            expect_equal(grab.gaps("number"), grab.gaps("sequence"), "gaps among images and in sequence numbers")
        expect_equal(len({image.digest for image in grab.images}), len(grab.images), "different images")


class Vivid:
    """The virtual webcam of the kernel."""

    def __init__(self):
        run("modprobe", "vivid", "n_devs=1", "node_types=0x1", "input_types=0x0", "num_inputs=1")
        wait_until(lambda: self.node(), 20, "vivid's node")

    @staticmethod
    def node():
        names = [entry for entry in Path("/sys/class/video4linux").iterdir() if "vivid" in (entry / "name").read_text()]
        return Path("/dev") / names[0].name if names else None

    def control(self, name, value):
        run("v4l2-ctl", "-d", self.node(), "-c", f"{name}={value}")

    def grab(self, **options):
        return Grab("v4l2", f"device={self.node()}", "width_px=320", "height_px=180", "formats=YUYV", "rate_hz=15",
                    **options)

    def close(self):
        wait_until(lambda: not run("modprobe", "-r", "vivid", check=False), 10, "vivid is removed", 0.5)


@scenario
def vivid_frames():
    """vivid: 100 images, in order, stamped; what it drops at random is counted, and agrees with the stamps."""
    camera = closing(Vivid())
    grab = camera.grab().finish()
    tell_of("vivid", grab)
    check_order(grab)
    expect(any(image.number for image in grab.images), "images are not black")
    expect(len({image.digest for image in grab.images}) > 1, "images show the time")
    camera.control("percentage_of_dropped_buffers", 30)
    grab = camera.grab().finish()
    tell_of("vivid, of which it drops 30 %", grab)
    check_order(grab)
    expect_equal(grab.counters["missing"], grab.gaps("sequence"), "missing, and gaps in the sequence numbers")
    expect(10 < grab.gaps("sequence") < 120, f"{grab.gaps('sequence')} of {grab.gaps('sequence') + 100} are lost")
    steps = [(b.sequence - a.sequence, b.stamp_us - a.stamp_us) for a, b in zip(grab.images, grab.images[1:])]
    by_stamps = [round(us * 15 / 1e6) for _, us in steps]
    tell(f"sequence numbers say {sum(n for n, _ in steps)} intervals, stamps {sum(by_stamps)}")
    expect_equal(by_stamps, [n for n, _ in steps], "intervals by stamps and by sequence numbers")


@scenario
def vivid_fails():
    """vivid: a stream that ends with an error is opened anew, and order and stamps go on ascending."""
    camera = closing(Vivid())
    grab = camera.grab()
    time.sleep(3)
    camera.control("inject_fatal_streaming_error", 1)
    grab.finish()
    tell_of("vivid, with a fatal error", grab)
    tell("; ".join(grab.events.strip().splitlines()))
    expect_equal(grab.counters["reopenings"], 1, "reopenings")
    expect(ascends([image.sequence for image in grab.images]), "sequence numbers ascend")
    expect(ascends([image.stamp_us for image in grab.images]), "stamps ascend")


@scenario
def iidc_frames():
    """libdc1394: 100 images, in order, stamped, undamaged."""
    closing(UsbCamera("iidc", 640, 480))
    grab = iidc().finish()
    tell_of("iidc", grab)
    check_order(grab)
    check_pattern(grab)
    expect_equal(grab.gaps("number"), 0, "gaps among the images: the camera waits for its host")


@scenario
def iidc_losses_are_counted():
    """libdc1394: images that the camera leaves out are counted, by their stamps: there are no sequence numbers."""
    camera = closing(UsbCamera("iidc", 640, 480))
    grab = iidc()
    time.sleep(3)
    camera.tell(f"drop {LOST}")
    grab.finish()
    tell_of("dropped", grab)
    check_order(grab)
    check_pattern(grab)
    expect_counted(grab, LOST)


@scenario
def iidc_errors_are_counted():
    """libdc1394: images that are cut short are counted exactly."""
    camera = closing(UsbCamera("iidc", 640, 480))
    grab = iidc(for_s=50)
    time.sleep(3)
    camera.tell(f"short {LOST}")
    grab.finish()
    tell_of("short", grab)
    check_order(grab)
    check_pattern(grab)
    expect_equal(grab.counters["corrupt"], LOST, "corrupt ones")
    # A program makes the stamps, so they may be unusable on a machine that stalls.
    expect_equal(grab.gaps("number"), LOST + grab.counters["dropped"], "gaps among the images that were sent")
