"""Reads the commands and options of the programs (--describe-command-line) and their settings."""

import json
import re
import subprocess
from dataclasses import dataclass, field


@dataclass
class Option:
    names: list         # with their dashes, the short one first; empty for a positional
    positional: str
    value: str          # type of the value as CLI11 names it; empty: a flag
    choices: list
    limits: str
    default: str
    required: bool
    repeats: bool
    about: str

    @property
    def long(self):
        return self.names[-1] if self.names else self.positional

    def takes_files(self):
        return self.value in ("PATH", "TEXT") and not self.choices


@dataclass
class Command:
    path: tuple         # e.g. ("azimuth", "map", "save")
    about: str
    footer: str
    options: list
    commands: list

    @property
    def name(self):
        return self.path[-1]

    def flags(self):
        return [option for option in self.options if option.names]

    def positionals(self):
        return [option for option in self.options if not option.names]

    def everything(self):
        """This command and all its subcommands, recursively."""
        return [self, *(each for command in self.commands for each in command.everything())]


def command(described, above=()):
    path = (*above, described["name"])
    return Command(path, described["about"].strip(), described["footer"].strip(), [Option(**each) for each in described["options"]],
                   [command(each, path) for each in described["commands"]])


@dataclass
class Key:
    name: str
    about: str
    value: str = ""         # default in TOML notation; empty: no default
    choices: list = field(default_factory=list)
    limits: str = ""


@dataclass
class Table:
    name: str               # as in the file, e.g. ekf, daemon.lcm; empty: the top level
    about: str
    is_list: bool = False   # True for [[name]]
    keys: list = field(default_factory=list)

    def full_name(self, key):
        return f"{self.name}.{key.name}" if self.name else key.name


CHOICES = re.compile(r" \(([\w.-]+(?: \| [\w.-]+)+)\)$")
LIMITS = re.compile(r" ([\[(]-?[\d.e+]+, -?[\d.e+]+\]|(?:>=|>|<=|<) -?[\d.e+]+)$")


def key_of(name, comment, value=""):
    key = Key(name, comment, value)
    if found := CHOICES.search(key.about):
        key.about, key.choices = key.about[:found.start()], found[1].split(" | ")
    elif found := LIMITS.search(key.about):
        key.about, key.limits = key.about[:found.start()], found[1]
    return key


def tables(reference):
    """Parses the printed settings, in which the comment of each key stands above it."""
    found, comment, about_is_next = [], "", False
    for line in reference.splitlines():
        if header := re.fullmatch(r"\[([\w.]+)\]", line):
            found.append(Table(header[1], ""))
            about_is_next = True
        elif header := re.fullmatch(r"#\[\[([\w.]+)\]\]", line):
            if not found or found[-1].name != header[1]:
                found.append(Table(header[1], comment, is_list=True))
        elif entry := re.fullmatch(r"#(\w+) = (.*)", line):
            add(found, key_of(entry[1], comment, entry[2]))
        elif entry := re.fullmatch(r"# (\w+): no default", line):
            add(found, key_of(entry[1], comment))
        elif line.startswith("# "):
            comment = line[2:]
            if about_is_next:
                found[-1].about, about_is_next = comment, False
    return found


def add(found, key):
    if not found:
        found.append(Table("", ""))
    table = found[-1]
    if all(other.name != key.name for other in table.keys):  # the first element of a list has all keys
        table.keys.append(key)


emulator = []  # command that runs the programs; empty: they run directly


def said(program, *arguments):
    return subprocess.run([*emulator, program, *arguments], stdout=subprocess.PIPE, text=True, check=True).stdout


def described(program):
    return command(json.loads(said(program, "--describe-command-line")))
