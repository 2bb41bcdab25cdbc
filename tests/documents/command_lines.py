#!/usr/bin/env python3
"""Checks the documents' statements about the programs: commands, options and keys of settings must exist, and docs/reference.md
must have every command.

usage: command_lines.py SOURCE_TREE AZIMUTH AZIMUTHD AZIMUTH_SIM      exit code 0: right, 1: not, one `file: message` each
"""

import re
import shlex
import sys
from pathlib import Path

HERE = Path(__file__).resolve()
sys.path[:0] = [str(HERE.parents[2] / "scripts/lib"), str(HERE.parents[2] / "packaging/command_line")]
import programs  # noqa: E402
from html_pages import documents  # noqa: E402

NOT_OF_NOW = {"CHANGELOG.md", "docs/wrong-uses.md"}  # describe earlier versions and wrong commands
REFERENCE = "docs/reference.md"
FENCE = re.compile(r"^```sh\n(.*?)^```", flags=re.M | re.S)
TOML = re.compile(r"^```toml\n(.*?)^```", flags=re.M | re.S)
SPAN = re.compile(r"`([^`\n]+)`")
KEY = re.compile(r"((?:[a-z]\w*\.)+[a-z]\w*)(?: ?= ?.*)?")
FILES = (".toml", ".csv", ".png", ".azmap", ".json", ".md", ".txt", ".sock", ".jpg", ".py", ".cpp", ".hpp", ".dbc", ".svg", ".previous",
         ".odometry", ".located", ".refused", ".conf", ".service", ".rules", ".lcm", ".lcmlog")


def shell_lines(text):
    """The commands of a fence, without comments and with continued lines joined."""
    return [line.strip() for line in re.sub(r"(?:^|\s)#.*$", "", text.replace("\\\n", " "), flags=re.M).splitlines() if line.strip()]


def commands_in(line, names):
    """Yields the words of each call of our programs in a line of shell."""
    for call in re.split(r"&&|\|\||[;|]", line):
        try:
            words = shlex.split(call)
        except ValueError:
            continue
        if words and words[0] in names:
            yield words


def word_problem(words, roots):
    """The first command or option of a call that does not exist, as a message; None if all exist."""
    command = roots[words[0]]
    for word in words[1:]:
        below = {each.name: each for each in command.commands}
        if word.startswith("-") and not re.fullmatch(r"-?[\d.]+", word):
            option = word.split("=")[0]
            if option not in [name for each in command.options for name in each.names]:
                return f"{' '.join(command.path)} has no option {option}"
        elif below:
            if word not in below and not command.positionals() and word not in ("...", "X", "…"):
                return f"{' '.join(command.path)} has no command {word}"
            command = below.get(word, command)
    return None


def key_problem(span, known):
    found = KEY.fullmatch(span)
    if not found or found[1].endswith(FILES) or found[1].split(".")[0] not in {name.split(".")[0] for name in known if "." in name}:
        return None
    is_table = any(name.startswith(found[1] + ".") for name in known)
    return None if is_table or found[1] in known else f"there is no key {found[1]}"


def toml_problems(text, known):
    """Yields the unknown keys in a piece of a configuration or of a rig."""
    table = ""
    for line in text.splitlines():
        if found := re.match(r"\[+([\w.]+)\]", line):
            table = found[1] + "."
        elif (found := re.match(r"(\w+) =", line)) and table + found[1] not in known:
            yield f"there is no key {table}{found[1]}"


def violations(tree, roots, known):
    for name in documents(tree):
        if name in NOT_OF_NOW:
            continue
        text = (tree / name).read_text(encoding="utf-8")
        lines = [line for fence in FENCE.findall(text) for line in shell_lines(fence)]
        spans = SPAN.findall(re.sub(r"^```.*?^```", "", text, flags=re.M | re.S))
        for line in [*lines, *(span for span in spans if "|" not in span)]:
            for words in commands_in(line, roots):
                if problem := word_problem(words, roots):
                    yield f"{name}: {line}: {problem}"
        for span in spans:
            if problem := key_problem(span, known):
                yield f"{name}: `{span}`: {problem}"
        for piece in TOML.findall(text):
            yield from (f"{name}: {problem}" for problem in toml_problems(piece, known))
    reference = (tree / REFERENCE).read_text(encoding="utf-8")
    rows = "\n".join(re.findall(r"^\| (`azimuth.*)$", reference, flags=re.M))
    for command in roots["azimuth"].commands:
        if not re.search(rf"`azimuth {command.name}\b", rows):
            yield f"{REFERENCE}: lacks azimuth {command.name}"


def keys(azimuth, azimuthd):
    tables = programs.tables(programs.said(azimuthd, "--print-settings")) + programs.tables(programs.said(azimuthd, "--print-rig-settings"))
    # The programs list this table only if it has entries.
    return {table.full_name(key) for table in tables for key in table.keys} | {"daemon.can.signal"}


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__.strip())
    tree, azimuth, azimuthd, azimuth_sim = (Path(each) for each in sys.argv[1:])
    roots = {program.name: programs.described(program) for program in (azimuth, azimuthd, azimuth_sim)}
    known = keys(azimuth, azimuthd)
    if not word_problem(["azimuth", "map", "sav"], roots) or not word_problem(["azimuth", "replay", "--verfy"], roots):
        sys.exit("wrong commands are not found: this test cannot fail")
    if not key_problem("ekf.thining_s", known) or key_problem("ekf.thinning_s = 9", known):
        sys.exit("wrong keys are not found: this test cannot fail")
    if list(toml_problems('[ekf]\nthinning_s = "x"\n', known)) or not list(toml_problems("[ekf]\npre = 1\n", known)):
        sys.exit("wrong keys of TOML are not found: this test cannot fail")
    found = list(violations(tree, roots, known))
    print("\n".join(found) if found else "documents: every command, option and key is there")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
