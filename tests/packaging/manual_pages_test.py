#!/usr/bin/env python3
"""Runs one check of the shipped manual pages.

usage: manual_pages_test.py CASE AZIMUTHD AZIMUTH AZIMUTH_SIM [AZIMUTH_ROS2]      exit code 0: good, 1: not, 77: a tool is missing
"""

import gzip
import re
import sys
from pathlib import Path

from package_case import AZIMUTH, AZIMUTH_ROS2, AZIMUTH_SIM, AZIMUTHD, TREE, fail, need, run

WRITTEN = {"azimuthd.8": AZIMUTHD, "azimuth-sim.1": AZIMUTH_SIM}  # written by hand; the others are generated from the help of the programs
if AZIMUTH_ROS2:
    WRITTEN["azimuth-ros2.1"] = AZIMUTH_ROS2
SHARE = AZIMUTHD.parents[1] / "packaging/share"


def manual_pages():
    """The texts of all pages, keyed by name and section."""
    made = {file.name.removesuffix(".gz"): gzip.decompress(file.read_bytes()).decode() for file in sorted(SHARE.glob("man/man*/*.gz"))}
    return made | {file.name: file.read_text() for file in sorted((TREE / "packaging/man").glob("*.[0-9]"))}


def manual_pages_are_clean():
    need("groff")
    if not Path("/usr/share/groff").is_dir() or run("groff", "-mandoc", "-z", "/dev/null").returncode:
        need("a groff that has the manual macros")
    for name, text in manual_pages().items():
        read = run("groff", "-mandoc", "-ww", "-Tutf8", "-z", "-", input=text)
        if read.returncode or read.stdout:
            fail(f"{name}: {read.stdout}")


def options_of(said):
    return set(re.findall(r"^  (?:-\w,)?--([\w-]+)", said, flags=re.M))


def commands_of(said):
    return re.findall(r"^  ([a-z]\w*)  ", said, flags=re.M)  # in any group; positionals are in capitals


def written_options(text):
    return {name.removeprefix("\\&").lstrip("-") for name in re.findall(r"Fl ((?:\\&)?-[\w-]+)", text)}


def check_options(page, text, said):
    options, written = options_of(said), written_options(text)
    if "help" not in options:
        fail(f"not understood: {said}")
    if missing := options - written:
        fail(f"{page} lacks --{', --'.join(sorted(missing))}")
    return written - options


def check_command_pages(pages, words):
    """Checks the page of a command and those of its subcommands."""
    name = "-".join(words) + ".1"
    said = run(AZIMUTH, *words[1:], "--help").stdout
    if name not in pages:
        fail(f"there is no {name}")
    check_options(name, pages[name], said)
    commands = commands_of(said)
    if commands != re.findall(r"^\.It Cm (\w+)$", pages[name], flags=re.M):
        fail(f"{name}: commands are {commands}")
    return 1 + sum(check_command_pages(pages, [*words, command]) for command in commands)


def manual_pages_name_every_option():
    pages = manual_pages()
    for page, program in WRITTEN.items():
        if extra := check_options(page, pages[page], run(program, "--help").stdout):
            fail(f"{page} has what there is not: --{', --'.join(sorted(extra))}")
    if check_command_pages(pages, ["azimuth"]) < 15:
        fail("hardly a command: help is not understood")
    for page, said in (("azimuth.toml.5", run(AZIMUTHD, "--print-settings").stdout), ("rig.toml.5", run(AZIMUTHD, "--print-rig-settings").stdout)):
        keys = re.findall(r"^#(\w+) = |^# (\w+): no default$", said, flags=re.M)
        if missing := [a or b for a, b in keys if f".It Va \\&{a or b}" not in pages[page]]:
            fail(f"{page} lacks {', '.join(missing)}")
        if len(keys) < 20:
            fail(f"hardly a key: {said}")


def manual_pages_refer_to_what_is_there():
    pages = manual_pages()
    for name, text in pages.items():
        for page, section in re.findall(r"^\.Xr (\S+) (\d)", text, flags=re.M):
            if page.startswith(("azimuth", "rig")) and f"{page}.{section}" not in pages:
                fail(f"{name} refers to {page}({section})")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
