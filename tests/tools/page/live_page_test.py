#!/usr/bin/env python3
"""Opens the live page in a headless browser with a stand-in for the server. The page must show the robot's pose, answer
keys and pointer, name faults within two seconds, recover by itself and write nothing to the browser's console.

usage: live_page_test.py PAGE_FOLDER SCREENSHOTS [JPEG]      exit code 0: good, 1: not, 77: the browser is missing
If $AXE_CORE names the file axe.min.js of the npm package axe-core, its findings count too.
"""

import json
import os
import sys
import tempfile
import time
import xml.etree.ElementTree
from pathlib import Path

import web_driver
from fake_view import FakeView
from page_checks import (PATIENCE, a_lost_robot_has_names_alone, an_empty_page_says_what_to_do, doubted_landmarks_are_told_apart, expect, head_tells_of_the_robot,
                         honesty_is_charted, names_stand_apart, numbers_are_short, pictures_are_unrolled, rays_are_told_from_the_way, tools_hide_no_map,
                         what_is_kept_is_told)
from synthetic_robot import SyntheticRobot

SAYS_WITHIN_S = 2.0
RECOVERS_WITHIN_S = 4.0

KEY = "const key = (node, name) => node.dispatchEvent(new KeyboardEvent('keydown', { key: name, bubbles: true, cancelable: true }));"
MAP = "window.azimuthView.map"


def marker_is_where_the_robot_is(view, browser):
    shown = browser.run(f"const {{ x, y, heading, t }} = {MAP}.shownPose(); return {{ x, y, heading, t }}")
    x, y, heading = view.robot.estimate(shown["t"])
    expect(abs(shown["x"] - x) < 1e-6 and abs(shown["y"] - y) < 1e-6, f"marker at {shown}, robot at {x}, {y}")
    behind_s = view.now() - shown["t"]
    expect(behind_s < 0.5 * PATIENCE, f"the pose shown is {behind_s:.2f} s old")
    words = browser.run("return document.querySelector('.pose').textContent")
    expect("m" in words and "°" in words, f"the pose in words: {words}")


def everything_is_drawn(browser):
    empty = browser.run("""
      const blank = (canvas) => Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height }).toDataURL();
      return [...document.querySelectorAll('canvas')].filter((canvas) => {
        const box = canvas.getBoundingClientRect();
        return box.top < innerHeight && box.bottom > 0 && canvas.toDataURL() === blank(canvas);
      }).map((canvas) => canvas.getAttribute('aria-label'));""")
    expect(not empty, f"empty: {empty}")
    counted = browser.run("return window.azimuthView.store.map.landmarks.length")
    expect(counted == 24, f"{counted} landmarks")


def keys_and_pointer(browser):
    run = browser.run
    for name in ("+", "-", "r", "R", "ArrowLeft"):
        before = run(f"return JSON.stringify([{MAP}.view.scale, {MAP}.view.turn, {MAP}.view.centre])")
        run(f"{KEY} key({MAP}.canvas, arguments[0])", name)
        expect(run(f"return JSON.stringify([{MAP}.view.scale, {MAP}.view.turn, {MAP}.view.centre])") != before, f"key {name}")
    expect(run(f"return {MAP}.mode") == "free", "a map that was moved is left where it is")
    run(f"{KEY} key(document.body, 'f')")
    browser.until(f"{MAP}.mode === 'follow' && Math.hypot({MAP}.view.centre[0] - {MAP}.shownPose().x, {MAP}.view.centre[1] - {MAP}.shownPose().y) < 0.3", PATIENCE,
                  "the robot in the middle")
    run(f"{MAP}.view.face(0); {KEY} key({MAP}.canvas, '0')")
    browser.until(f"{MAP}.mode === 'all' && !{MAP}.aim", PATIENCE, "everything in sight")


def distance_is_measured(browser):
    words = browser.run(f"""{KEY}
      key(document.body, 'm');
      const {{ canvas, view, ruler }} = {MAP}, box = canvas.getBoundingClientRect();
      const at = (type, x, y, buttons) => canvas.dispatchEvent(new PointerEvent(type, {{ clientX: box.left + view.px(x, y), clientY: box.top + view.py(x, y),
        pointerId: 1, buttons, bubbles: true }}));
      canvas.setPointerCapture = () => {{}};
      at('pointerdown', 0, 0, 1), at('pointermove', 1, 1, 1), at('pointermove', 3, 4, 1), at('pointerup', 3, 4, 0);
      const words = ruler.words();
      key(document.body, 'm');
      delete canvas.setPointerCapture;
      return [words, ruler.words()];""")
    expect(words == ["5.00 m, 53°", ""], f"from 0, 0 to 3, 4 it is {words}")


def two_fingers(browser):
    """Two fingers that move apart enlarge the map; fingers that move round each other turn it."""
    left, top = browser.run(f"const box = {MAP}.canvas.getBoundingClientRect(); return [box.left + box.width / 2, box.top + box.height / 2]")
    before = browser.run(f"return [{MAP}.view.scale, {MAP}.view.turn]")
    browser.devtools("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
    for kind, reach, rise in (("touchStart", 40, 0), ("touchMove", 60, 10), ("touchMove", 80, 40)):
        points = [{"x": left + reach, "y": top - rise, "id": 1}, {"x": left - reach, "y": top + rise, "id": 2}]
        browser.devtools("Input.dispatchTouchEvent", type=kind, touchPoints=points)
    browser.devtools("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    browser.devtools("Emulation.setTouchEmulationEnabled", enabled=False)
    scale, turn = browser.run(f"return [{MAP}.view.scale / {before[0]}, {MAP}.view.turn - {before[1]}]")
    expect(1.8 < scale < 2.8 and 0.3 < turn < 0.6, f"two fingers: {scale:.2f} times as large, turned by {turn:.2f}")
    browser.run(f"{MAP}.view.face(0); {KEY} key({MAP}.canvas, '0')")
    browser.until(f"{MAP}.mode === 'all' && !{MAP}.aim", PATIENCE, "everything in sight")


def long_ways_are_thinned(browser):
    """The page thins the older half of a long path; it must keep the order and both ends."""
    found = browser.run("""
      const { Columns } = await import('/modules/columns.js'), columns = new Columns(['t', 'x'], 1000), before = columns.generation;
      for (let i = 0; i < 1750; ++i) columns.push(i, i % 7 ? i : null);
      const t = columns.get('t');
      return [columns.length, t[0], t.at(-1), t.every((value, i) => i === 0 || value > t[i - 1]), columns.generation - before, Number.isNaN(columns.get('x')[0])];""")
    expect(found == [1000, 0, 1749, True, 3, True], f"{found}")


def layers_are_switched(browser):
    for i in range(browser.run("return document.querySelectorAll('.chip:not([hidden])').length")):
        chip = f"document.querySelectorAll('.chip:not([hidden])')[{i}]"
        browser.run(f"{chip}.click()")
        expect(browser.run(f"return {chip}.getAttribute('aria-pressed')") == "false", "a layer that is off says so")
        browser.run(f"{chip}.click()")


def looking_back(browser):
    browser.run("""
      const chart = document.querySelector('.times canvas'), box = chart.getBoundingClientRect();
      for (const [type, buttons] of [['pointermove', 0], ['pointerdown', 1], ['pointerup', 0]])
        chart.dispatchEvent(new PointerEvent(type, { clientX: box.left + 0.4 * box.width, clientY: box.top + 30, buttons, bubbles: true }));""")
    then = browser.run("return [window.azimuthView.link.following, window.azimuthView.link.cursor]")
    expect(then[0] is False, "pressing a chart leaves now")
    time.sleep(0.5)
    later = browser.run("return [window.azimuthView.link.cursor, window.azimuthView.map.shownPose().t]")
    expect(later[0] == then[1] and abs(later[1] - then[1]) < 0.2, f"the cursor stays: {then[1]}, {later}")
    browser.run(f"{KEY} key(document.body, 'l')")
    expect(browser.run("return window.azimuthView.link.following") is True, "back to now")
    browser.run("location.hash = '#t=12.5'")
    browser.until("Math.abs(window.azimuthView.link.cursor - 12.5) < 0.01 && !window.azimuthView.link.following", PATIENCE, "the moment in the address")
    browser.run("document.querySelector('.now-button').click(); history.replaceState(null, '', location.pathname)")


def exports(browser):
    svg, png, places, link = browser.run("""
      const { mapAsSvg, mapAsPng, momentAddress } = await import('/modules/map_export.js'), { liveGeoJson } = await import('/modules/map_tools.js');
      const { map, store } = window.azimuthView;
      return [mapAsSvg(map), (await mapAsPng(map)).size, liveGeoJson(store), momentAddress(3.25)];""")
    root = xml.etree.ElementTree.fromstring(svg)
    paths = [node for node in root if node.tag.endswith("path")]
    expect(len(paths) > 40 and "NaN" not in svg, f"{len(paths)} paths in the SVG")
    expect(png > 10000, f"a PNG of {png} bytes")
    features = json.loads(places)["features"]
    kinds = [feature["geometry"]["type"] for feature in features]
    expect(kinds.count("Point") == 24 and kinds.count("LineString") == 3, f"{kinds}")
    expect(link.endswith("/#t=3.250"), link)


def banner(words):
    return f"!document.querySelector('.banner').hidden && document.querySelector('.banner').textContent.includes({json.dumps(words)})"


NO_BANNER = "document.querySelector('.banner').hidden && document.querySelector('.connection').classList.contains('open')"


def silence_is_said(view, browser):
    view.silent = True
    took_s = browser.until(banner("from the daemon"), SAYS_WITHIN_S * PATIENCE, "silence of the daemon")
    print(f"silence of the daemon: said after {took_s:.1f} s")
    view.silent = False
    browser.until(NO_BANNER, PATIENCE, "it is over")
    view.stalled = True
    took_s = browser.until(banner("from azimuth view"), SAYS_WITHIN_S * PATIENCE, "silence of the server")
    print(f"silence of the server: said after {took_s:.1f} s")
    view.stalled = False
    browser.until(NO_BANNER, PATIENCE, "it is over")


def devices_in_trouble_are_named(view, browser):
    view.robot.camera = "/dev/video0: No such device"
    took_s = browser.until(banner("Camera: /dev/video0: No such device."), SAYS_WITHIN_S * PATIENCE, "the camera is gone")
    print(f"a camera gone: said after {took_s:.1f} s")
    expect(browser.run("return document.querySelector('.connection').classList.contains('troubled')"), "the stream is well, but not live")
    view.robot.camera = "running (640x480, 12.5 images/s)"
    browser.until(NO_BANNER, PATIENCE, "it is over")


def server_goes_and_comes(view, browser):
    view.stop()
    took_s = browser.until(banner("does not answer"), SAYS_WITHIN_S * PATIENCE, "the server is gone")
    view.refusal = "There are 32 lookers already."
    view.start()
    browser.until(banner("32 lookers already"), RECOVERS_WITHIN_S * PATIENCE, "why the server refuses")
    view.refusal = ""
    back_s = browser.until(NO_BANNER, RECOVERS_WITHIN_S * PATIENCE, "the server is back")
    print(f"server gone: said after {took_s:.1f} s; back: {back_s:.1f} s later")
    browser.until("window.azimuthView.store.poses.length > 10", PATIENCE, "the way is there again")


def daemon_restarts(view, browser):
    browser.run("window.azimuthView.map.become('all')")
    view.restart_daemon()
    took_s = browser.until("window.azimuthView.store.now < 30", SAYS_WITHIN_S * PATIENCE, "the new way begins")
    print(f"daemon restarted: shown after {took_s:.1f} s")
    browser.until("document.querySelector('.said').textContent.includes('started again')", PATIENCE, "it is said")
    browser.until("document.querySelector('.journal').textContent.split('the daemon started anew').length === 2", PATIENCE, "the journal says so, once")
    browser.until("window.azimuthView.store.poses.length > 20 && window.azimuthView.map.shownPose().t < 30", PATIENCE, "the way goes on")


def garbage_is_left_out(view, browser):
    view.extra += [("pose", "{"), ("pose", "null"), ("pose", '{"t": 1}'), ("pose", '{"t": "a", "x": [], "covariance": 3, "odom": {}}'),
                   ("map", '{"t": 1, "landmarks": [[1, 2, "x"], 5]}'), ("map", '{"landmarks": 7}'), ("bearings", '{"bearings": {}, "expected": null}'),
                   ("trail", '{"t": 5}'), ("status", "[]"), ("status", '"x"'), ("picture", '{"seq": "../../etc/passwd"}'), ("journal", "7"),
                   ("journal", json.dumps({"t": 1, "text": "<img src=x onerror=alert(1)>", "level": "<b>"})), ("nonsense", "{}"), ("silence", '{"since_s": "?"}')]
    browser.until("window.azimuthView.store.unreadable + window.azimuthView.feed.unreadable >= 9", PATIENCE, "counted")
    browser.until(NO_BANNER, PATIENCE, "it goes on")
    browser.until("document.querySelector('.journal').textContent.includes('<img src=x') && !document.querySelector('.journal img')", PATIENCE, "text stands as text")
    marker_is_where_the_robot_is(view, browser)


def burst(view, browser):
    """Sends many late events at once, as after a suspended laptop wakes up."""
    poses = [view.robot.pose(view.now() + 1e-4 * i, int(time.time() * 1e6)) for i in range(3000)]
    view.extra += [("pose", json.dumps(pose)) for pose in poses] + [("missed", '{"n": 12}')]
    browser.until("window.azimuthView.store.missed === 12", 5 * PATIENCE, "all of a burst is read")
    browser.until(NO_BANNER, PATIENCE, "it goes on")


def looks(browser, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name, scheme, width, height, phone in (("light", "light", 1400, 900, False), ("dark", "dark", 1400, 900, False), ("phone", "light", 390, 844, True)):
        browser.scheme(scheme)
        browser.size(width, height, phone)
        time.sleep(1.5)
        browser.screenshot(folder / f"live-{name}.png")
        wide = browser.run("return document.documentElement.scrollWidth - innerWidth")
        expect(wide <= 0, f"{name}: {wide} pixels wider than the window")
        accessible(browser, f"live, {name}")
    browser.scheme("light")
    browser.size(1400, 900)


def accessible(browser, name):
    axe = os.environ.get("AXE_CORE")
    if not axe:
        return print(f"{name}: no axe-core here ($AXE_CORE), so not checked by it")
    if not browser.run("return Boolean(window.axe)"):
        browser.run(Path(axe).read_text(encoding="utf-8"))
    found = browser.run("return (await axe.run()).violations.map(({ id, impact, nodes }) => [impact, id, nodes.map(({ target, failureSummary }) => [target, failureSummary])])")
    for impact, rule, nodes in found:
        print(f"{name}: axe: {impact}: {rule}: {nodes}")
    expect(not found, f"{name}: axe finds {[rule for _, rule, _ in found]}")


def problems(page, screenshots, picture):
    view = FakeView(page, SyntheticRobot(), past_s=80, points=2400, picture=picture)
    address = view.start()
    with tempfile.TemporaryDirectory() as folder, web_driver.Browser(folder) as browser:
        browser.open(address)
        browser.until("window.azimuthView && window.azimuthView.store.bearings", 10 * PATIENCE, "it begins")
        browser.until("window.azimuthView.map.view.scale && !window.azimuthView.map.aim", PATIENCE)
        checks = [lambda: marker_is_where_the_robot_is(view, browser), lambda: everything_is_drawn(browser), lambda: keys_and_pointer(browser),
                  lambda: distance_is_measured(browser), lambda: two_fingers(browser), lambda: long_ways_are_thinned(browser), lambda: layers_are_switched(browser), lambda: looking_back(browser), lambda: exports(browser),
                  lambda: head_tells_of_the_robot(browser), lambda: numbers_are_short(browser), lambda: names_stand_apart(browser), lambda: tools_hide_no_map(browser),
                  lambda: rays_are_told_from_the_way(browser),
                  lambda: looks(browser, screenshots), lambda: silence_is_said(view, browser), lambda: devices_in_trouble_are_named(view, browser), lambda: what_is_kept_is_told(browser), lambda: honesty_is_charted(browser),
                  lambda: doubted_landmarks_are_told_apart(browser), lambda: a_lost_robot_has_names_alone(browser), lambda: pictures_are_unrolled(view, browser), lambda: garbage_is_left_out(view, browser),
                  lambda: burst(view, browser), lambda: an_empty_page_says_what_to_do(view, browser), lambda: daemon_restarts(view, browser)]
        for check in checks:
            try:
                check()
            except AssertionError as error:
                yield str(error)
        print(f"a pose is drawn {browser.run('return window.azimuthView.delay_ms'):.0f} ms after it was sent (median)")
        yield from (f"console: {words}" for words in browser.complaints())
        try:
            server_goes_and_comes(view, browser)
        except AssertionError as error:
            yield str(error)
        # The browser itself reports requests without an answer; any other message is a fault.
        yield from (f"console: {words}" for words in browser.complaints() if "Failed to load resource" not in words)


def main():
    page, screenshots = Path(sys.argv[1]), Path(sys.argv[2])
    if not web_driver.is_here():
        print("no chromium with a chromedriver here to open the page with")
        return 77
    picture = Path(sys.argv[3]).read_bytes() if len(sys.argv) > 3 else None
    found = list(problems(page, screenshots, picture))
    print("\n".join(found) or "as it should be")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
