#!/usr/bin/env python3
"""Runs one check of the shipped completions. Bash is asked for completions; zsh and fish only read theirs.

usage: completion_test.py CASE AZIMUTHD AZIMUTH AZIMUTH_SIM      exit code 0: good, 1: not, 77: a shell is missing
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

AZIMUTHD, AZIMUTH, AZIMUTH_SIM = (Path(path).resolve() for path in sys.argv[2:5])
SHARE = AZIMUTHD.parents[1] / "packaging/share"

# The typed words, and the completions of the last one. Bash passes '=' as a separate word.
OFFERED = [
    (["azimuth", "re"], {"replay", "report"}),
    (["azimuth", "map", ""], {"save", "info", "export", "merge", "refine"}),
    (["azimuth", "map", "save", "run", "--quie"], {"--quiet"}),
    (["azimuth", "replay", "--front-e"], {"--front-end"}),
    (["azimuth", "replay", "--front-end", ""], {"bearings", "colour", "sift", "lamps"}),
    (["azimuth", "replay", "run", "--front-end", "=", "s"], {"sift"}),
    (["azimuth", "replay", "run", "--front-end", "="], {"bearings", "colour", "sift", "lamps"}),
    (["azimuth", "replay", "run", "--seed", ""], set()),
    (["azimuth", "replay", "run", "--set", "ekf.init"], {"ekf.initialisation="}),
    (["azimuth", "replay", "run", "--set", "preset", "=", ""], {"default", "paper", "paper-7deg"}),
    (["azimuth", "replay", "run", "--set", "ekf.initialisation", "=", "de"], {"delayed"}),
    (["azimuth", "simulate", "out", "--world", "co"], {"coloured-lab", "corridor"}),
    (["azimuth", "replay", "--report", "file-"], {"file-1", "file-2"}),
    (["azimuth", "replay", "file-"], {"file-1", "file-2"}),
    (["azimuthd", "--set", "daemon.live.odometer", "=", "p"], {"pioneer"}),
    (["azimuthd", "--check"], {"--check-config"}),
    (["azimuth-sim", "--images", ""], {"mirror", "fisheye"}),
    (["azimuth-sim", "--scenario", "ha"], {"hall"}),
]


def fail(message):
    sys.exit(f"{sys.argv[1]}: {message}")


def need(shell):
    if not shutil.which(shell):
        print(f"skipped: no {shell} here")
        sys.exit(77)


def script_of(program):
    return SHARE / "bash-completion/completions" / program


def offered(words, folder="."):
    """The completions that a non-interactive bash offers for the last word."""
    program = words[0]
    function = "_" + program.replace("-", "_")
    asked = f'source "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); {function}; printf "%s\\n" "${{COMPREPLY[@]}}"'
    said = subprocess.run(["bash", "--norc", "-c", asked, script_of(program), *words], cwd=folder, capture_output=True, text=True, check=False)
    if said.returncode or said.stderr:
        fail(f"{words}: {said.stderr}")
    return set(said.stdout.split())


def mistakes(expected):
    with tempfile.TemporaryDirectory() as folder:
        for name in ("file-1", "file-2", "other"):
            (Path(folder) / name).touch()
        for words, offers in expected:
            if (found := offered(words, folder)) != offers:
                yield f"{words}: {sorted(found)} in place of {sorted(offers)}"


def bash_offers_what_there_is():
    need("bash")
    if found := list(mistakes(OFFERED)):
        fail("\n".join(found))


def said(program, *words):
    return subprocess.run([program, *words, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout


def lacking(program, words=()):
    """Yields the options and commands of the help that the completions lack."""
    text = said(program, *words)
    typed = [program.name, *words]
    options = set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", text, flags=re.M))
    commands = re.findall(r"^  (\w+)  ", text.split("Subcommands:")[1], flags=re.M) if "Subcommands:" in text else []
    yield from (f"{' '.join(typed)} {word}" for word in sorted(options - offered([*typed, "--"])))
    if commands:
        yield from (f"{' '.join(typed)} {word}" for word in sorted(set(commands) - offered([*typed, ""])))
    for command in commands:
        yield from lacking(program, (*words, command))


def bash_offers_every_option():
    need("bash")
    for program in (AZIMUTH, AZIMUTHD, AZIMUTH_SIM):
        if found := list(lacking(program)):
            fail(f"not offered: {found}")


def reads(shell, files):
    for file in files:
        read = subprocess.run([shell, "-n", file], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if read.returncode or read.stdout:
            fail(f"{file.name}: {read.stdout}")
    if len(files) != 3:
        fail(f"{files}")


def zsh_reads_it():
    need("zsh")
    reads("zsh", sorted((SHARE / "zsh/vendor-completions").glob("_*")))


def fish_reads_it():
    need("fish")
    reads("fish", sorted((SHARE / "fish/vendor_completions.d").glob("*.fish")))


# Fish treats '=' as part of the word.
OFFERED_BY_FISH = [
    ("azimuth re", {"replay", "report"}),
    ("azimuth map ", {"save", "info", "export", "merge", "refine"}),
    ("azimuth replay run --front-end ", {"bearings", "colour", "sift", "lamps"}),
    ("azimuth replay run --set ekf.init", {"ekf.initialisation="}),
    ("azimuth replay run --set preset=", {"preset=default", "preset=paper", "preset=paper-7deg"}),
    ("azimuth map save run --quie", {"--quiet"}),
    ("azimuthd --set daemon.live.odometer=p", {"daemon.live.odometer=pioneer"}),
    ("azimuth-sim --scenario ha", {"hall"}),
]


def offered_by_fish(line, home):
    script = SHARE / "fish/vendor_completions.d" / f"{line.split()[0]}.fish"
    said = subprocess.run(["fish", "--no-config", "-c", f"source {script}; complete -C{line!r}"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, check=False, env={"HOME": home, "PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8"})
    return {each.split("\t")[0] for each in said.stdout.splitlines()}


def fish_offers_what_there_is():
    need("fish")
    with tempfile.TemporaryDirectory() as home:
        for line, offers in OFFERED_BY_FISH:
            if (found := offered_by_fish(line, home)) != offers:
                fail(f"{line}: {sorted(found)} in place of {sorted(offers)}")


def bites():
    need("bash")
    if not list(mistakes([(["azimuth", "re"], {"replay"})])) or list(mistakes([(["azimuth", "replay", "file-1"], {"file-1"})])):
        fail("a wrong offer is not noticed: this test cannot fail")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
