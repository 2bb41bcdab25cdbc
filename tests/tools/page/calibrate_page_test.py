#!/usr/bin/env python3
"""Opens pages of `azimuth calibrate --html`. Every element must be closed, every picture must be drawn, and the page's
security policy must refuse nothing.

usage: calibrate_page_test.py AZIMUTH RUNS      exit code 0: good, 1: not, 77: chromium is missing
"""

import re
import shutil
import subprocess
import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path

from browser_test import opened, short_run

ROGUE = "<script>'\"&"  # a name that tests the escaping
VOID = {"meta", "img"}
# Counts the pictures that the browser could draw. The page's policy is removed, because it would refuse this script.
COUNTING = """
addEventListener('load', () => { document.body.dataset.drawn = [...document.images].filter((image) => image.naturalWidth > 100).length; });
"""


class Elements(HTMLParser):
    """Notes elements that are not closed in order, and sources outside the page."""

    def __init__(self, text):
        super().__init__()
        self.open, self.wrong = [], []
        self.feed(text)
        self.wrong += [f"not closed: {tag}" for tag in self.open]

    def handle_starttag(self, tag, attrs):
        if tag not in VOID:
            self.open.append(tag)
        self.wrong += [f"loads {value[:40]}" for name, value in attrs if name in ("src", "href") and not value.startswith("data:")]

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append(f"closed out of order: {tag}")


def mirror_run(runs, folder):
    run = folder / "mirror"
    shutil.copytree(runs / "mirror", run)
    (run / "rig.toml").unlink()
    return run


def problems(azimuth, chromium, runs, folder):
    if not Elements("<p><b></p>").wrong or not Elements("<i>").wrong:
        yield "elements that are not closed are not noticed: this test cannot fail"
    for run, pictures in ((short_run(runs, "lab", folder, ROGUE), 2), (mirror_run(runs, folder), 1)):
        page = folder / "page.html"
        subprocess.run([azimuth, "calibrate", run, "--quiet", "--html", page, "--force"], check=True)
        text = page.read_text(encoding="utf-8")
        yield from Elements(text).wrong
        dom, complaints = opened(chromium, page, folder)
        yield from complaints
        if run.name == ROGUE and f"<h1>{ROGUE.replace('&', '&amp;').replace('<', '&lt;').replace('>', '&gt;')}: what" not in dom:
            yield "the run's name does not stand as it is"
        counted = folder / "counted.html"
        text = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", text)
        counted.write_text(text.replace("</head>", f"<script>{COUNTING}</script></head>"), encoding="utf-8")
        dom, _ = opened(chromium, counted, folder)
        drawn = re.search(r'data-drawn="(\d+)"', dom)
        if not drawn or int(drawn[1]) != pictures:
            yield f"{run.name}: {drawn[1] if drawn else 'no'} of {pictures} pictures are drawn"


def main():
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not chromium:
        print("no chromium here to open the page with")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        found = list(problems(sys.argv[1], chromium, Path(sys.argv[2]), Path(folder)))
    print("\n".join(found) or "drawn")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
