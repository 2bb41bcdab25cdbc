#!/usr/bin/env python3
"""Makes HTML of the tree's documents: README becomes index.html, every other one lies where its Markdown lies.

usage: html_pages.py TREE OUT      needs cmark-gfm (scripts/setup --docs)
"""

import html
import re
import shutil
import subprocess
import sys
from pathlib import Path

PAGES = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "runs/README.md")
STYLE = """body { max-width: 60rem; margin: 2rem auto; padding: 0 1rem; font: 1rem/1.5 sans-serif; }
pre, code { font-family: monospace; background: #f4f4f4; } pre { padding: .6rem; overflow-x: auto; }
table { border-collapse: collapse; display: block; overflow-x: auto; } th, td { border: 1px solid #ccc; padding: .2rem .5rem; }
img { max-width: 100%; } nav { font-size: .9rem; }"""


def documents(tree):
    """The documents, as paths in the tree."""
    return [*PAGES, *sorted(path.relative_to(tree).as_posix() for path in (tree / "docs").glob("*.md"))]


def slugs():
    """A function that gives headings the names that links to them have, as GitHub does; each name once."""
    seen = {}

    def slug(heading):
        name = re.sub(r"[^\w\- ]", "", re.sub(r"<[^>]*>", "", heading).strip().lower()).replace(" ", "-")
        seen[name] = seen.get(name, -1) + 1
        return name if seen[name] == 0 else f"{name}-{seen[name]}"

    return slug


def is_local(target):
    return not re.match(r"[a-z]+:", target)


def page_of(document):
    """Where the page of a document lies in the site."""
    return "index.html" if document == "README.md" else re.sub(r"\.md$", ".html", document)


def with_anchors(body):
    slug = slugs()
    return re.sub(r"<h([1-6])>(.*?)</h\1>",
                  lambda found: f'<h{found[1]} id="{slug(html.unescape(found[2]))}">{found[2]}</h{found[1]}>', body, flags=re.S)


def with_links_to_pages(body, document, known):
    """Links to documents lead to their pages, and what else is linked is told: (body, paths in the tree)."""
    folder, others = Path(document).parent, set()

    def link(found):
        target, _, anchor = html.unescape(found[2]).partition("#")
        if not target or not is_local(target):
            return found[0]
        path = Path(*folder.parts, target).as_posix()
        while re.search(r"[^/]+/\.\./", path):
            path = re.sub(r"[^/]+/\.\./", "", path, count=1)
        if path in known:
            depth = len(folder.parts)
            target = "../" * depth + page_of(path)
        else:
            others.add(path)
        return f'{found[1]}="{html.escape(target + ("#" + anchor if anchor else ""))}"'

    return re.sub(r'\b(href|src)="([^"]*)"', link, body), others


def title_of(body, document):
    heading = re.search(r"<h1[^>]*>(.*?)</h1>", body, flags=re.S)
    return re.sub(r"<[^>]*>", "", heading[1]) if heading else document


def page(tree, document, known):
    made = subprocess.run(["cmark-gfm", "--extension", "table", tree / document], stdout=subprocess.PIPE, text=True, check=True)
    body, others = with_links_to_pages(with_anchors(made.stdout), document, known)
    home = "../" * len(Path(document).parent.parts) + "index.html"
    text = (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title_of(body, document)}</title>\n'
            f"<style>{STYLE}</style></head><body>\n<nav><a href=\"{home}\">Azimuth</a></nav>\n{body}</body></html>\n")
    return text, others


def copy(tree, path, out):
    (out / path).parent.mkdir(parents=True, exist_ok=True)
    if (tree / path).is_dir():
        shutil.copytree(tree / path, out / path, dirs_exist_ok=True)
    else:
        shutil.copyfile(tree / path, out / path)


def make(tree, out):
    """The pages, by their paths in the site."""
    known, others, pages = documents(tree), set(), []
    for document in known:
        text, linked = page(tree, document, known)
        target = out / page_of(document)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")
        others |= linked
        pages.append(page_of(document))
    for path in sorted(others):
        copy(tree, path, out)
    return pages


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__.strip())
    print(f"docs: {len(make(Path(sys.argv[1]), Path(sys.argv[2])))} pages, from {Path(sys.argv[2]) / 'index.html'} on")
