#!/usr/bin/env python3
"""Builds the site of the documents and follows every link in it.

usage: pages_test.py SOURCE_TREE      exit code 0: good, 1: not, 77: mkdocs-material is missing
"""

import re
import shutil
import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts/lib"))
from html_pages import documents, is_local, make  # noqa: E402


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.anchors, self.tables, self.title = [], [], 0, ""
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tables += tag == "table"
        for name, value in attrs:
            if name in ("href", "src"):
                self.links.append(value)
            if name == "id":
                self.anchors.append(value)


def elsewhere(text):
    """The scripts, styles and pictures that a page loads from other sites."""
    return re.search(r"<(?:script|img)[^>]* src=.?https?:|<link[^>]* rel=.?(?:stylesheet|preconnect)[^>]*https?:", text)


def problems(out, pages):
    read = {name: Page((out / name).read_text(encoding="utf-8")) for name in pages}
    for name, page in read.items():
        if len(page.anchors) != len(set(page.anchors)):
            yield f"{name}: two headings have one name"
        for link in page.links:
            target, _, anchor = link.partition("#")
            if not is_local(target):
                continue
            file = ((out / name).parent / target).resolve() if target else (out / name).resolve()
            if not file.exists():
                yield f"{name}: {link} leads nowhere"
                continue
            other = file.relative_to(out.resolve()).as_posix()
            if target.endswith(".md"):
                yield f"{name}: {link} is no page"
            if anchor and anchor not in read[other].anchors:
                yield f"{name}: {link}: no such heading"


def main():
    if not shutil.which("mkdocs"):
        print("skipped: no mkdocs here")
        sys.exit(77)
    tree = Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "site"
        pages = make(tree, out)
        if fetched := [page for page in pages if elsewhere((out / page).read_text(encoding="utf-8"))]:
            sys.exit(f"fetches something from elsewhere: {fetched}")
        if len(pages) != len(documents(tree)) or "index.html" not in pages:
            sys.exit(f"pages: {pages}")
        if found := list(problems(out, pages)):
            sys.exit("\n".join(found))
        index = Page((out / "index.html").read_text(encoding="utf-8"))
        if not index.tables or not any(link.endswith(".html") for link in index.links):
            sys.exit("tables or links are not understood: this test cannot fail")
        victim = out / next(page for page in pages if page.startswith("docs/"))
        victim.unlink()
        rest = [page for page in pages if (out / page) != victim]
        if not list(problems(out, rest)):
            sys.exit("a missing page is not noticed: this test cannot fail")


if __name__ == "__main__":
    main()
