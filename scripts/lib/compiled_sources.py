"""Prints the files that a build tree compiles from the wanted sources, one per line, largest first.

usage: compiled_sources.py BUILD WANTED
WANTED is a file with a list of sources, relative to the working directory. A generated unit (cmake/AzimuthTarget.cmake)
is printed if it includes a wanted source.
"""
import json
import os
import re
import sys


def parts_of(file, build):
    """The sources that are compiled with this file, relative to the working directory."""
    name = os.path.relpath(file)
    if not name.startswith(os.path.relpath(build) + os.sep):
        return [name]
    with open(file) as text:
        return re.findall(r'^#include "(.*)"$', text.read(), re.MULTILINE)


def main(build, wanted_file):
    with open(wanted_file) as lines:
        wanted = set(lines.read().split())
    with open(os.path.join(build, "compile_commands.json")) as commands:
        compiled = {os.path.join(entry["directory"], entry["file"]) for entry in json.load(commands)}
    sizes = {}
    for file in compiled:
        mine = wanted.intersection(parts_of(file, build)) if os.path.exists(file) else ()
        if mine:
            sizes[os.path.relpath(file)] = sum(os.path.getsize(part) for part in mine)
    for file in sorted(sizes, key=lambda name: (-sizes[name], name)):
        print(file)


if __name__ == "__main__":
    main(*sys.argv[1:])
