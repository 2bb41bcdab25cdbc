#!/usr/bin/env python3
"""Makes manual pages and completions from the help of the programs.

usage: make.py OUT TREE AZIMUTH AZIMUTHD AZIMUTH_SIM [EMULATOR [ARGUMENT...]]
  OUT is emptied; in it: man/, bash-completion/, zsh/, fish/. EMULATOR runs programs that were built for another processor.
"""

import gzip
import re
import shutil
import sys
from email.utils import parsedate_to_datetime
from pathlib import Path

import bash
import fish
import manual
import programs
import zsh

HAND_WRITTEN = [("azimuthd", 8), ("azimuth-sim", 1), ("azimuth-run", 5)]
SETTINGS = [("azimuth.toml", 5), ("rig.toml", 5)]


def date_of(tree):
    """The date of the package, so that a tree gives the same pages on any day."""
    signed = re.findall(r"^ -- .*>  (.*)$", (tree / "packaging/debian/changelog").read_text(), flags=re.M)[0]
    day = parsedate_to_datetime(signed)
    return f"{day:%B} {day.day}, {day.year}"


def supplement(tree, name):
    """The handwritten sections of a page, mainly examples."""
    file = tree / "packaging/man" / f"{name}.mdoc"
    return file.read_text(encoding="utf-8") if file.exists() else ""


def relatives(command, root):
    """The pages of the parent command, of the subcommands and of the command's files."""
    pages = [(manual.page_name(command.path[:depth]), 1) for depth in range(1, len(command.path))]
    pages += [(manual.page_name(each.path), 1) for each in command.commands]
    return pages + (HAND_WRITTEN + SETTINGS if command is root else SETTINGS)


def manual_pages(tree, azimuth, configuration, rig):
    """The texts of the pages, keyed by name and section."""
    date, pages = date_of(tree), {}
    for command in azimuth.everything():
        name = manual.page_name(command.path)
        pages[name, 1] = manual.command_page(command, date, supplement(tree, name), relatives(command, azimuth))
    for name, tables, summary in (("azimuth.toml", configuration, "configuration of azimuthd and azimuth"),
                                  ("rig.toml", rig, "what is fixed on a robot that Azimuth runs on")):
        others = [("azimuth", 1), ("azimuth-run", 5), *(page for page in SETTINGS if page[0] != name), ("azimuthd", 8)]
        pages[name, 5] = manual.settings_page(name, date, summary, supplement(tree, name), tables, others)
    return pages


def write(file, text, compressed=False):
    file.parent.mkdir(parents=True, exist_ok=True)
    data = text.encode()
    file.write_bytes(gzip.compress(data, 9, mtime=0) if compressed else data)


def keys_of(tables):
    return [(table.full_name(key), key.choices) for table in tables if not table.is_list for key in table.keys]


def completions(program, keys, out):
    write(out / "bash-completion/completions" / program.name, bash.script(program, keys))
    write(out / "zsh/vendor-completions" / f"_{program.name}", zsh.script(program, keys))
    write(out / "fish/vendor_completions.d" / f"{program.name}.fish", fish.script(program, keys))


def make(out, tree, azimuth, azimuthd, azimuth_sim):
    shutil.rmtree(out, ignore_errors=True)
    configuration = programs.tables(programs.said(azimuthd, "--print-settings"))
    rig = programs.tables(programs.said(azimuthd, "--print-rig-settings"))
    tool = programs.described(azimuth)
    for (name, section), text in manual_pages(tree, tool, configuration, rig).items():
        write(out / f"man/man{section}/{name}.{section}.gz", text, compressed=True)
    shared = [table for table in configuration if table.name.split(".")[0] != "daemon"]
    completions(tool, keys_of(shared), out)
    completions(programs.described(azimuthd), keys_of(configuration), out)
    completions(programs.described(azimuth_sim), [], out)


if __name__ == "__main__":
    if len(sys.argv) < 6:
        sys.exit(__doc__.strip())
    programs.emulator = sys.argv[6:]
    make(Path(sys.argv[1]), Path(sys.argv[2]), *(Path(each).resolve() for each in sys.argv[3:6]))
