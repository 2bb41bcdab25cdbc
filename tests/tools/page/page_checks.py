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


def doubted_landmarks_are_told_apart(browser):
    kinds = browser.run("return window.azimuthView.store.map.landmarks.map(({ state, kind }) => [state, kind])")
    expect(["doubted", 2] in kinds and ["confirmed", 0] in kinds, f"{kinds}")
