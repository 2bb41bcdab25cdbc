#!/usr/bin/env python3
"""Checks that no two files define a type of the same name in the same namespace. A program that links both would use
the destructor of one type for objects of the other layout, without a message of the compiler or the linker.

usage: one_definition.py SOURCE_TREE      exit code 0: clean, 1: violations, one `file:line: message` each
"""

import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import tree_check  # noqa: E402
from include_rules import COMMENT_OR_LITERAL, RULES, blank  # noqa: E402

FOLDERS = sorted({folder.split("/")[0] for folder in RULES} | {"tests", "docs"})

# The text between a brace and the previous brace or semicolon tells what the brace opens.
TOKEN = re.compile(r"[{};]")
PREPROCESSOR = re.compile(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.MULTILINE)
NAMESPACE = re.compile(r"\bnamespace\b\s*([\w:]*)\s*$")
TYPE = re.compile(r"(?:^|\s)(?:struct|class|union|enum(?:\s+(?:class|struct))?)\s+(?:\[\[[^\]]*\]\]\s*|alignas\([^)]*\)\s*)*"
                  r"(\w+)\s*(?:final\s*)?(?:$|:(?!:))")
ALIAS = re.compile(r"\busing\s+(\w+)\s*=")
TEMPLATE = re.compile(r"\btemplate\s*<(?:[^<>]|<[^<>]*>)*>")


def type_defined(head):
    """The name of the type whose body follows `head`; None if `head` does not define a type."""
    found = TYPE.search(TEMPLATE.sub("", head))
    return found[1] if found else None


def definitions(text):
    """Yields (line, qualified name) of the types that a file defines in named namespaces, without nested types."""
    code = PREPROCESSOR.sub(blank, COMMENT_OR_LITERAL.sub(blank, text))
    scopes = []  # for each open brace its namespace; "" for an unnamed one, None if it opens no namespace
    start = 0
    for token in TOKEN.finditer(code):
        head = code[start:token.start()]
        start = token.end()
        in_namespace = all(scopes)  # names in an unnamed namespace are local to the file
        line = code.count("\n", 0, token.start()) + 1
        if token.group() == "}":
            if scopes:
                scopes.pop()
        elif token.group() == ";":
            if in_namespace and (alias := ALIAS.search(head)):
                yield line, "::".join([*scopes, alias[1]])
        elif namespace := NAMESPACE.search(head):
            scopes.append(namespace[1])
        else:
            if in_namespace and (name := type_defined(head)):
                yield line, "::".join([*scopes, name])
            scopes.append(None)


def violations(tree):
    """All violations under `tree`, as `file:line: message`, in the order of the files."""
    places = {}
    for top in FOLDERS:
        for source in sorted((tree / top).rglob("*.[ch]pp")):
            path = source.relative_to(tree).as_posix()
            for line, name in definitions(source.read_text(encoding="utf-8")):
                places.setdefault(name, []).append((path, line))
    for name, defined in places.items():
        for path, line in defined[1:]:
            yield f"{path}:{line}: {name} is defined in {defined[0][0]} already: one name, one type"


if __name__ == "__main__":
    tree_check.run(violations, needs="slam", clean="one definition: clean")
