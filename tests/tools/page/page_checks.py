"""What the live page has to show of events that the stand-in for the server sends, part by part."""

import os

PATIENCE = float(os.environ.get("AZIMUTH_TEST_PATIENCE", "3"))  # a machine with other things to do is given longer


def expect(condition, words):
    if not condition:
        raise AssertionError(words)


def pictures_are_unrolled(view, browser):
    """Ahead is up in the image of a mirror's camera that is 100 pixels wide, left is left; a margin is round it."""
    ahead, left, behind = browser.run("""
      const { pixelIndices, columns } = await import('/modules/unrolled.js');
      const found = pixelIndices({ centre: [50, 50], beta: 1, direction: -1, offset: -Math.PI / 2, inner: 10, outer: 40, margin: 5, width: 110, height: 110, looksUp: false });
      return [columns / 2, columns / 4, 0].map((column) => [found[column] % 110, Math.floor(found[column] / 110)]);""")
    for name, found, wanted in (("ahead", ahead, (55, 15)), ("left", left, (15, 55)), ("behind", behind, (55, 95))):
        expect(max(abs(found[0] - wanted[0]), abs(found[1] - wanted[1])) <= 1, f"the highest pixel {name} is at {found}")
    if not view.picture:
        return
    browser.until("window.azimuthView.camera.panorama.pictured", 5 * PATIENCE, "the picture is unrolled")
    shades = browser.run("return new Set(window.azimuthView.camera.panorama.unrolled.pixels).size")
    expect(shades > 100, f"{shades} colours in it")


def what_is_kept_is_told(browser):
    words = browser.run("return document.querySelector('.devices').textContent")
    expect("of 8.0 GB; 31 GB free" in words, f"the field log's quota: {words}")
    expect("written" in words and "ago" in words, f"the map file's age: {words}")


def honesty_is_charted(browser):
    shown = browser.run("const c = window.azimuthView.charts.find(({ spec }) => spec.key === 'nis'); return !c.node.hidden && c.node.textContent")
    expect(shown and "95 %" in shown, f"the chart of NIS: {shown}")
    about = browser.run("return document.querySelector('.panorama').textContent")
    expect("where the estimator expected landmarks" in about and "gates" in about, about)


def a_lost_robot_has_names_alone(browser):
    """Where it is nobody knows, nor where landmarks should be seen: what the camera calls them is shown."""
    words = "document.querySelector('.panorama').textContent"
    shown = browser.run(f"""
      const {{ store }} = window.azimuthView, {{ LiveStore }} = await import('/modules/live_store.js'), lost = new LiveStore();
      lost.take('map', {{ t: 1, landmarks: [[7, 31, 1, 1, 0.01, 0, 0.01, null, null, 1, 'confirmed']], more: 0 }});
      lost.take('pose', {{ ...store.pose, health: 3 }});
      lost.take('bearings', {{ t: 1, bearings: [[0.5, null, 42, 0, 'unknown', null], [0.7, null, -1, 0, 'used', 7], [0.9, null, -1, 0, 'unknown', null]], expected: [] }});
      const {{ panorama }} = window.azimuthView.camera, held = panorama.store;
      panorama.store = lost;
      const frame = () => new Promise((done) => requestAnimationFrame(done));
      panorama.surface.redraw();
      for (let i = 0; i < 200 && !{words}.includes('Lost'); ++i) await frame();
      const said = {words}, names = lost.bearings.bearings.map((bearing) => panorama.seenName(bearing));
      panorama.store = held, panorama.surface.redraw();
      return [lost.bearings.expected.length, names, said];""")
    expect(shown[0] == 0, f"{shown[0]} landmarks are expected by a lost robot")
    expect(shown[1] == ["42", "31", ""], f"names of what it sees: {shown[1]}")
    expect("Lost: the map cannot tell" in shown[2] and "what the camera calls" in shown[2], shown[2])


def doubted_landmarks_are_told_apart(browser):
    kinds = browser.run("return window.azimuthView.store.map.landmarks.map(({ state, kind }) => [state, kind])")
    expect(["doubted", 2] in kinds and ["confirmed", 0] in kinds, f"{kinds}")
