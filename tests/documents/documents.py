#!/usr/bin/env python3
"""Checks that citations exist: sections of docs/mathematics.md (`mathematics I.7`), documents, their headings and
links.

usage: documents.py SOURCE_TREE      exit code 0: clean, 1: not, one `file:line: message` each
"""

import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import tree_check  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts/lib"))
from html_pages import documents, is_local, slugs  # noqa: E402

TOPS = ("base", "slam", "drivers", "settings", "daemon", "sim", "tools", "tests", "config", "cmake", "scripts", "packaging", "docs")
SUFFIXES = {".hpp", ".cpp", ".py", ".sh", ".txt", ".cmake", ".lcm", ".toml", ".service", ".rules", ".md", ".mdoc", ".yml", ""}

GAP = r"(?:[\s/#*!<]+)"  # also matches the beginning of a continued comment line
NUMBER = r"[IVX]+\.\d+"
CITATION = re.compile(rf"\bmathematics{GAP}(?:part{GAP}(?P<roman>[IVX]+)\b|(?P<first>{NUMBER})"
                      rf"(?P<more>(?:(?:,|;| and| to){GAP}(?:part{GAP}[IVX]+\b|{NUMBER}))*))")
DOCUMENT = re.compile(rf"\b(?P<name>docs/(?:notes/)?[\w-]+\.md|README|CONTRIBUTING|CHANGELOG)\b(?P<heading>,{GAP}\"(?P<title>[^\"]+)\")?")
# The site names README.md index.md.
NOT_OURS = re.compile(r"\bDESIGN\b|(?<![\w/.-])(?!index\.md)[a-z][\w-]*\.md\b(?!\.gz)")
PATH = re.compile(r"`((?:base|slam|drivers|settings|daemon|sim|tools|tests|config|cmake|scripts|packaging|docs|runs)"
                  r"/[\w./{},*-]*)[^`]*`")
LINK = re.compile(r"\]\(([^)\s]+)\)")


def without_code(text):
    """The Markdown text with its code replaced by blanks."""
    blank = lambda found: re.sub(r"[^\n]", " ", found[0])
    return re.sub(r"`[^`\n]*`", blank, re.sub(r"^```.*?^```", blank, text, flags=re.S | re.M))


def alternatives(path):
    """Expands a.{hpp,cpp} to a.hpp and a.cpp."""
    braces = re.search(r"\{([^}]*)\}", path)
    return [path[:braces.start()] + each + path[braces.end():] for each in braces[1].split(",")] if braces else [path]


class Documents:
    def __init__(self, tree):
        self.tree = tree
        self.anchors, self.titles = {}, {}
        for name in documents(tree):
            if not (tree / name).exists():
                continue
            slug, titles = slugs(), []
            for heading in re.findall(r"^#{1,6} +(.*?) *$", re.sub(r"^```.*?^```", "", (tree / name).read_text(), flags=re.S | re.M),
                                      flags=re.M):
                titles.append(heading)
            self.titles[name] = titles
            self.anchors[name] = {slug(title) for title in titles}
        mathematics = "\n".join(self.titles.get("docs/mathematics.md", ()))
        self.sections = set(re.findall(rf"^({NUMBER})\b", mathematics, flags=re.M))
        self.parts = set(re.findall(r"^Part ([IVX]+)\b", mathematics, flags=re.M))

    def section_problems(self, found):
        numbers = re.findall(NUMBER, (found["first"] or "") + (found["more"] or ""))
        parts = [found["roman"]] if found["roman"] else re.findall(r"part\s+([IVX]+)", found["more"] or "")
        for number in numbers:
            if number not in self.sections:
                yield f"docs/mathematics.md has no section {number}"
        for part in parts:
            if part not in self.parts:
                yield f"docs/mathematics.md has no part {part}"

    def document_problem(self, found):
        name = found["name"] if found["name"].startswith("docs/") else found["name"] + ".md"
        if name not in self.titles:
            return f"there is no {name}"
        title = re.sub(GAP, " ", found["title"]) if found["heading"] else None
        return f'{name} has no heading "{title}"' if title and title not in self.titles[name] else None

    def link_problem(self, document, target):
        path, _, anchor = target.partition("#")
        file = (self.tree / document).parent / path if path else self.tree / document
        if not file.exists():
            return f"{target} is not there"
        name = file.resolve().relative_to(self.tree.resolve()).as_posix()
        if anchor and anchor not in self.anchors.get(name, set()):
            return f"{target}: {name} has no such heading"
        return None

    def problems(self, path, text):
        """Yields (offset, message) of each violation."""
        is_markdown = path.endswith(".md")
        for found in CITATION.finditer(text):
            for message in self.section_problems(found):
                yield found.start(), message
        for found in DOCUMENT.finditer(text):
            if message := self.document_problem(found):
                yield found.start(), message
        if not is_markdown:
            for found in NOT_OURS.finditer(text):
                yield found.start(), f"{found[0]} is no document of this tree"
            return
        for found in PATH.finditer(text) if path != "CHANGELOG.md" else ():  # the changelog cites files of earlier versions
            for each in alternatives(found[1]):
                if "NAME" not in found[0] and not any(self.tree.glob(each.rstrip("/"))):
                    yield found.start(), f"{each} is not there"
        for found in LINK.finditer(without_code(text)):
            if is_local(found[1]) and (message := self.link_problem(path, found[1])):
                yield found.start(), message


def files(tree):
    yield from (name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "runs/README.md") if (tree / name).exists())
    for top in TOPS:
        for file in sorted((tree / top).rglob("*")):
            path = file.relative_to(tree).as_posix()
            if file.is_file() and file.suffix in SUFFIXES and "corpus" not in path and not path.startswith("tests/documents/"):
                yield path


def violations(tree):
    """All violations under `tree`, as `file:line: message`."""
    known = Documents(tree)
    for path in files(tree):
        try:
            text = (tree / path).read_text(encoding="utf-8")
        except UnicodeDecodeError:  # a binary file
            continue
        for offset, message in known.problems(path, text):
            yield f"{path}:{text.count(chr(10), 0, offset) + 1}: {message}"


if __name__ == "__main__":
    tree_check.run(violations, needs="docs/mathematics.md", clean="documents: everything cited is there")
