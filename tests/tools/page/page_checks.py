"""Checks of the single parts of the live page, with events from the stand-in for the server."""

import os

PATIENCE = float(os.environ.get("AZIMUTH_TEST_PATIENCE", "3"))  # longer on a busy machine


def expect(condition, words):
    if not condition:
        raise AssertionError(words)


def pictures_are_unrolled(view, browser):
    """In the image of a mirror camera, 100 pixels wide plus a margin, ahead is up and left is left."""
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
    """A lost robot has no pose and no expected bearings, so the panorama shows only the identities from the camera."""
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


# Records the texts that are drawn on a canvas: [words, left, top, right, bottom] of each number.
WRITTEN = """
  const written = (context, draw) => {
    const boxes = [];
    context.fillText = (words, x, y) => {
      const { width } = context.measureText(words), left = x - { left: 0, center: width / 2, right: width }[context.textAlign];
      if (/^\\d+$/.test(words)) boxes.push([words, left, y - 8, left + width, y]);
      CanvasRenderingContext2D.prototype.fillText.call(context, words, x, y);
    };
    draw();
    delete context.fillText;
    return boxes;
  };
  const touching = (boxes) => boxes.flatMap((a, i) => boxes.slice(0, i).filter((b) => a[1] < b[3] && b[1] < a[3] && a[2] < b[4] && b[2] < a[4])
    .map((b) => `${a[0]} and ${b[0]}`));"""


def names_stand_apart(browser):
    """Labels do not overlap, on the map with landmarks close together and above overlapping bands of the panorama."""
    names, crowded, touching = browser.run(WRITTEN + """
      const { map, store } = window.azimuthView, held = store.map, context = Object.assign(document.createElement('canvas'), { width: 700, height: 600 }).getContext('2d');
      context.font = map.surface.context.font;
      const all = written(context, () => map.paint(context, 700, 600));
      const close = held.landmarks.map((one, i) => ({ ...one, at: [0.25 * (i % 6), 0.25 * Math.floor(i / 6)] }));
      store.map = { ...held, landmarks: close };
      const some = written(context, () => map.paint(context, 700, 600));
      store.map = held;
      return [all.length, some.length, [...touching(all), ...touching(some)]];""")
    expect(names == 24, f"{names} of 24 landmarks have their names on the map")
    expect(crowded >= 6, f"{crowded} of 24 that stand within 2 m have their names")
    expect(not touching, f"names on the map that touch: {touching}")
    names, touching = browser.run(WRITTEN + """
      const { store, camera: { panorama } } = window.azimuthView, held = store.bearings, { context } = panorama.surface;
      panorama.canvas.scrollIntoView();
      store.bearings = { t: 1, own: true, bearings: [], expected: store.map.landmarks.map(({ id }, i) => [id, 0.09 * i - 1, 0.02, null, 0.06]) };
      const boxes = written(context, () => panorama.surface.drawNow());
      store.bearings = held, panorama.surface.redraw();
      return [boxes.length, touching(boxes)];""")
    expect(names >= 12 and not touching, f"{names} names in the panorama, touching: {touching}")


def numbers_are_short(browser):
    """Landmarks are numbered in the order of the map; the tooltip shows the id that files use."""
    ids, labels, named = browser.run("""
      const { numbersOf } = await import('/modules/live_store.js'), { landmarks } = window.azimuthView.store.map;
      return [landmarks.map(({ id }) => id), landmarks.map(({ label }) => label), [...numbersOf([7, 5], true).values()]];""")
    expect(min(ids) >= 100 and labels == [str(1 + i) for i in range(24)], f"ids {ids} are called {labels}")
    expect(named == ["7", "5"], f"beside names of the sensor: {named}")
    words = browser.run("const { landmarkWords } = await import('/modules/map_layers.js'); return [landmarkWords('landmark', '5', 113), landmarkWords('lamp', '5', 5)]")
    expect(words == ["landmark 5 (id 113)", "lamp 5"], f"{words}")


def head_tells_of_the_robot(browser):
    words = browser.run("return document.querySelector('.live-head').textContent")
    for part in ("p3dx-sh GJC_3156", " m/s", " V", "s old"):
        expect(part in words, f"{part!r} is not in the line on top: {words}")
    speed = browser.run("return window.azimuthView.store.speed_m_per_s")
    expect(0.2 < speed < 2.0, f"a speed of {speed} m/s")


def tools_hide_no_map(browser):
    covered = browser.run("""
      const [tools, canvas] = ['.tools', '.map canvas'].map((name) => document.querySelector(name).getBoundingClientRect());
      return Math.min(tools.right, canvas.right) > Math.max(tools.left, canvas.left) && Math.min(tools.bottom, canvas.bottom) > Math.max(tools.top, canvas.top);""")
    expect(not covered, "the toolbar lies over the map")


def rays_are_told_from_the_way(browser):
    """Rays and path have different hues in both colour schemes."""
    for scheme in ("light", "dark"):
        browser.scheme(scheme)
        way, ray = browser.run("""
          const hue = (name) => {
            const value = getComputedStyle(document.documentElement).getPropertyValue(name).trim(), parts = [1, 3, 5].map((i) => parseInt(value.slice(i, i + 2), 16));
            const [r, g, b] = parts, most = Math.max(...parts), range = most - Math.min(...parts);
            return 60 * (most === r ? ((g - b) / range + 6) % 6 : most === g ? (b - r) / range + 2 : (r - g) / range + 4);
          };
          return [hue('--estimate'), hue('--used')];""")
        expect(abs(way - ray) > 20, f"{scheme}: hues {way:.0f} and {ray:.0f}")
    browser.scheme("light")


def an_empty_page_says_what_to_do(view, browser):
    view.silent = True
    browser.run("const { store } = window.azimuthView, { hello } = store; store.clear(), store.hello = hello;")
    browser.until("!document.querySelector('.empty').hidden", PATIENCE, "no robot is there, and that is said")
    commands = browser.run("return [...document.querySelectorAll('.empty code')].map((node) => node.textContent)")
    expect("azimuthd --play RUN" in commands and "azimuth doctor" in commands, f"{commands}")
    view.silent = False
    browser.until("document.querySelector('.empty').hidden", PATIENCE, "a robot is there")
