#!/usr/bin/env python3
"""Builds a site of the documents of a tree: a README becomes index.html, and every other page has the path of its Markdown file.

usage: html_pages.py TREE OUT      needs mkdocs-material (scripts/setup --docs)
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PAGES = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "runs/README.md")
LINK = re.compile(r"(\]\()([^)\s]+)(\))")
CODE = re.compile(r"^```.*?^```|`[^`\n]*`", flags=re.S | re.M)
PLACES = """docs_dir: {sources}
site_dir: {out}
markdown_extensions:
  - tables
  - fenced_code
  - toc:
      permalink: true
      slugify: !!python/name:html_pages.slug
"""
LIST_ITEM = re.compile(r"(?:[-*]|\d+\.) ")


def documents(tree):
    """The paths of all documents in the tree."""
    return [*PAGES, *sorted(path.relative_to(tree).as_posix() for path in (tree / "docs").rglob("*.md"))]


def slug(heading, separator="-"):
    """The anchor of a heading, as GitHub makes it."""
    return re.sub(r"[^\w\- ]", "", re.sub(r"<[^>]*>", "", heading).strip().lower()).replace(" ", separator)


def slugs():
    """Returns a function that gives each heading a unique anchor."""
    seen = {}

    def once(heading):
        name = slug(heading)
        seen[name] = seen.get(name, -1) + 1
        return name if seen[name] == 0 else f"{name}-{seen[name]}"

    return once


def is_local(target):
    return not re.match(r"[a-z]+:", target)


def source_of(document):
    """The path of a document in the sources of the site."""
    return re.sub(r"README\.md$", "index.md", document)


def page_of(document):
    return re.sub(r"\.md$", ".html", source_of(document))


def normalised(path):
    while re.search(r"[^/]+/\.\./", path):
        path = re.sub(r"[^/]+/\.\./", "", path, count=1)
    return path.rstrip("/")


def outside_code(text, change):
    """Applies `change` to all parts of the text that are not code."""
    made, end = "", 0
    for found in CODE.finditer(text):
        made += change(text[end:found.start()]) + found[0]
        end = found.end()
    return made + change(text[end:])


def with_links(text, document, known):
    """Rewrites links to the paths of the site's sources. Also returns the linked paths of other files in the tree."""
    folder, others = Path(document).parent, set()

    def link(found):
        target, _, anchor = found[2].partition("#")
        if not target or not is_local(target):
            return found[0]
        path = normalised(Path(*folder.parts, target).as_posix())
        if path not in known:
            others.add(path)
        return found[1] + source_of(target) + ("#" + anchor if anchor else "") + found[3]

    return outside_code(text, lambda prose: LINK.sub(link, prose)), others


def as_python_markdown_reads_it(text):
    """Adapts Markdown: unlike GitHub, Python-Markdown needs an empty line before a list and keeps \\| in code in a
    table."""
    lines, in_code = [], False
    for line in text.split("\n"):
        in_code ^= line.startswith("```")
        before = lines[-1] if lines else ""
        begins = LIST_ITEM.match(line) and before and not in_code and not LIST_ITEM.match(before) and not before.startswith((" ", "|", "#"))
        if begins and not any(LIST_ITEM.match(above) for above in paragraph(lines)):
            lines.append("")
        if line.startswith("|"):
            line = re.sub(r"`[^`]*`", lambda code: code[0].replace("\\|", "|"), line)
        lines.append(line)
    return "\n".join(lines)


def paragraph(lines):
    """The lines after the last empty line."""
    for line in reversed(lines):
        if not line:
            return
        yield line


def copy(tree, path, out):
    (out / path).parent.mkdir(parents=True, exist_ok=True)
    if (tree / path).is_dir():
        shutil.copytree(tree / path, out / path, dirs_exist_ok=True)
    else:
        shutil.copyfile(tree / path, out / path)


def gather(tree, sources):
    """Collects all sources of the site in one folder."""
    known, others = documents(tree), set()
    for document in known:
        text, linked = with_links((tree / document).read_text(encoding="utf-8"), document, known)
        target = sources / source_of(document)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(as_python_markdown_reads_it(text), encoding="utf-8")
        others |= linked
    for path in sorted(others):
        copy(tree, path, sources)


def whole_navigation(settings, tree):
    """Appends the documents that the navigation lacks to the settings, in which `nav` comes last."""
    named = set(re.findall(r"^ +- (?:[^:]*: )?(\S+\.md)$", settings, flags=re.M))
    rest = [source_of(document) for document in documents(tree) if source_of(document) not in named]
    return settings + ("".join(["  - More:\n", *(f"      - {each}\n" for each in rest)]) if rest else "")


def make(tree, out):
    """Builds the site and returns the paths of its pages. A warning of mkdocs is an error."""
    with tempfile.TemporaryDirectory() as folder:
        sources, settings = Path(folder) / "sources", Path(folder) / "mkdocs.yml"
        gather(tree, sources)
        settings.write_text(whole_navigation((tree / "docs/mkdocs.yml").read_text(encoding="utf-8"), tree)
                            + PLACES.format(sources=sources, out=out.resolve()), encoding="utf-8")
        made = subprocess.run(["mkdocs", "build", "--strict", "--config-file", settings], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, env=os.environ | {"PYTHONPATH": str(Path(__file__).resolve().parent)}, check=False)
    if made.returncode:
        sys.exit(made.stdout)
    return [page_of(document) for document in documents(tree)]


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__.strip())
    print(f"docs: {len(make(Path(sys.argv[1]), Path(sys.argv[2])))} pages, from {Path(sys.argv[2]) / 'index.html'} on")
