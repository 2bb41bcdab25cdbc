#!/usr/bin/env python3
"""Runs one check of the other shipped files: accounts, rules, configuration, maintainer scripts, documents.

usage: packaging_test.py CASE AZIMUTHD AZIMUTH AZIMUTH_SIM [AZIMUTH_ROS2]      exit code 0: good, 1: not, 77: a tool is missing
"""

import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

from package_case import AZIMUTHD, SYSTEMD, TREE, UNIT, fail, need, run, settings_of


def users():
    need("systemd-sysusers")
    with tempfile.TemporaryDirectory() as root:
        (Path(root) / "etc").mkdir()
        made = run("systemd-sysusers", f"--root={root}", SYSTEMD / "azimuth.sysusers")
        passwd, group = (Path(root) / "etc" / name for name in ("passwd", "group"))
        if made.returncode or not passwd.exists():
            fail(made.stdout)
        unit = settings_of(UNIT)
        if f"\n{unit['User'][0]}:" not in "\n" + passwd.read_text():
            fail(passwd.read_text())
        if f"\n{unit['Group'][0]}:" not in "\n" + group.read_text():
            fail(group.read_text())


def folders():
    need("systemd-tmpfiles")
    text = (SYSTEMD / "azimuth.tmpfiles").read_text()
    unit = settings_of(UNIT)
    expected = f"d /run/{unit['RuntimeDirectory'][0]} {unit['RuntimeDirectoryMode'][0]} {unit['User'][0]} {unit['Group'][0]} -"
    if expected not in text.splitlines():
        fail(f"not there, as the unit has it: {expected}")
    if os.geteuid() != 0:  # only root may change the owner of a folder
        return
    with tempfile.TemporaryDirectory() as root:
        (Path(root) / "etc").mkdir()
        run("systemd-sysusers", f"--root={root}", SYSTEMD / "azimuth.sysusers")
        made = run("systemd-tmpfiles", f"--root={root}", "--create", SYSTEMD / "azimuth.tmpfiles")
        if made.returncode or not (Path(root) / "run/azimuth").is_dir():
            fail(made.stdout)


# A term of a rule, see udev(7): a key with an optional attribute, an operator, and a value in double quotes.
TERM = re.compile(r'([A-Z_]+)(?:\{([^}]*)\})?\s*(==|!=|\+=|:=|-=|=)\s*"((?:[^"\\]|\\.)*)"')
MATCHES = {"ACTION", "SUBSYSTEM", "SUBSYSTEMS", "DRIVER", "DRIVERS", "ATTRS", "KERNEL", "KERNELS"}
ASSIGNS = {"SYMLINK", "GROUP", "MODE", "OWNER", "TAG", "GOTO", "LABEL"}
EITHER = {"ATTR", "ENV"}


def rule_mistakes(text):
    mistakes, gotos, labels, user = [], set(), set(), settings_of(UNIT)["Group"][0]
    for number, line in enumerate(text.splitlines(), 1):
        line = line.strip()
        if not line or line.startswith("#"):
            continue
        terms = [TERM.fullmatch(term.strip()) for term in re.split(r",(?=(?:[^\"]*\"[^\"]*\")*[^\"]*$)", line)]
        if not all(terms):
            mistakes.append(f"{number}: not KEY OPERATOR \"value\", ...")
            continue
        for key, attribute, operator, value in (term.groups() for term in terms):
            compares = operator in ("==", "!=")
            known = key in EITHER or key in (MATCHES if compares else ASSIGNS)
            if not known or (key in {"ATTR", "ATTRS", "ENV"}) != bool(attribute):
                mistakes.append(f"{number}: {key}{operator}")
            if key == "GROUP" and value not in (user, "video", "dialout"):
                mistakes.append(f"{number}: the daemon is not in group {value}")
            gotos |= {value} if key == "GOTO" else set()
            labels |= {value} if key == "LABEL" else set()
    return mistakes + [f"no label {label}" for label in gotos - labels]


def device_rules():
    rules = SYSTEMD / "60-azimuth.rules"
    names = SYSTEMD / "examples/61-azimuth-names.rules"
    # Removing the # enables the example rules.
    enabled = re.sub(r"^#(?=[A-Z]+==)", "", names.read_text(), flags=re.M)
    for file, text in ((rules, rules.read_text()), (names, enabled)):
        if mistakes := rule_mistakes(text):
            fail(f"{file.name}: {mistakes}")
        if len([line for line in text.splitlines() if TERM.match(line)]) < 3:
            fail(f"{file.name}: hardly a rule in it")
    for wrong in ('SUBSYSTEM="usb" GROUP="azimuth"', 'GOTO="nowhere"', 'ATTR=="1"', 'GROUP="wheel"', "MODE=0660"):
        if not rule_mistakes(wrong):
            fail(f"taken for good: {wrong}")


def configuration():
    rigs = sorted((TREE / "config/rigs").glob("*.toml"))
    if not rigs:
        fail("no rig to check with")
    for rig in rigs:
        checked = run(AZIMUTHD, "--check-config", "--config", SYSTEMD / "azimuthd.toml", "--rig", rig)
        if checked.returncode or checked.stderr or not checked.stdout.startswith(f"right: {SYSTEMD / 'azimuthd.toml'} and {rig}; "):
            fail(f"with {rig.name}: {checked.stdout}{checked.stderr}")
    condition = settings_of(UNIT)["ConditionPathExists"][0]
    if f'rig = "{condition}"' not in (SYSTEMD / "azimuthd.toml").read_text():
        fail(f"the unit waits for {condition}, which is not what the configuration names")
    shipped = (TREE / "packaging/debian/conffiles").read_text().strip()
    if f"--config {shipped}\n" not in UNIT.read_text():
        fail("the unit reads another file than the package ships")
    if f'"{shipped}"' not in (TREE / "tools/doctor/plan.hpp").read_text():
        fail("azimuth doctor looks for another file than the package ships")


def catalogue():
    text = (SYSTEMD / "azimuth.catalog").read_text()
    described = re.findall(r"^-- ([0-9a-f]{32})$", text, flags=re.M)
    source = (TREE / "daemon/journal/journal.cpp").read_text()
    sent = re.findall(r'"([0-9a-f]{32})"', source)
    if not sent or sorted(described) != sorted(sent):
        fail(f"only described: {set(described) - set(sent)}; only sent: {set(sent) - set(described)}")
    need("journalctl")
    with tempfile.TemporaryDirectory() as root:
        place = Path(root) / "usr/lib/systemd/catalog"
        place.mkdir(parents=True)
        shutil.copy(SYSTEMD / "azimuth.catalog", place)
        (Path(root) / "var/lib/systemd/catalog").mkdir(parents=True)
        made = run("journalctl", f"--root={root}", "--update-catalog")
        listed = run("journalctl", f"--root={root}", "--list-catalog")
        if made.returncode or listed.stdout.count("azimuthd:") != len(sent):
            fail(made.stdout + listed.stdout)


def maintainer_scripts():
    for name in ("postinst", "prerm", "postrm", "ros2/prerm"):
        script = TREE / "packaging/debian" / name
        if not script.read_text().startswith("#!/bin/sh\n") or "\nset -e\n" not in script.read_text():
            fail(f"{name}: must be of /bin/sh and end at a mistake")
        if (checked := run("sh", "-n", script)).returncode:
            fail(f"{name}: {checked.stdout}")
    for name in ("StateDirectory", "LogsDirectory"):
        folder = ("/var/lib/" if name == "StateDirectory" else "/var/log/") + settings_of(UNIT)[name][0]
        if folder not in (TREE / "packaging/debian/postrm").read_text().split():
            fail(f"a purge leaves {folder}")


# Files whose path in the tree differs from that in the package.
SHIPPED_AS = {"CHANGELOG.md": "changelog.gz", "LICENSE": "copyright", "README.md": "README.md.gz",
              "drivers/lcmtypes": "../../azimuth/lcmtypes", "config/azimuth.toml": "examples/config/azimuth.toml"}


def linked_from_readme():
    """All link targets of README.md and of the documents that it links to, as paths in the tree."""
    found, waiting = set(), ["README.md"]
    while waiting:
        document = waiting.pop()
        for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", re.sub(r"`[^`\n]*`", "", (TREE / document).read_text())):
            path = os.path.normpath(Path(document).parent / target)
            if "://" in target or path in found:
                continue
            found.add(path)
            if path.endswith(".md"):
                waiting.append(path)
    return found


def documents():
    """The package contains every document that its files name and every document that README.md leads to."""
    debian = TREE / "packaging/debian"
    writers = [debian / "changelog", debian / "README.Debian", *sorted((TREE / "packaging/man").iterdir()),
               *(file for file in sorted(SYSTEMD.rglob("*")) if file.is_file())]
    with tempfile.TemporaryDirectory() as root:
        made = run("cmake", "--install", AZIMUTHD.parents[1], "--prefix", "/usr", env=os.environ | {"DESTDIR": root})
        folder = Path(root) / "usr/share/doc/azimuth"
        if made.returncode:
            fail(made.stdout)
        named = {"README.Debian", "README.md.gz", "copyright", "changelog.gz", "changelog.Debian.gz"}
        for writer in writers:
            named.update(re.findall(r"/usr/share/doc/azimuth/([\w./-]*\w)", writer.read_text()))
        named.update(re.findall(r"\b(examples/[\w./-]*\w)", (debian / "README.Debian").read_text()))
        linked = linked_from_readme()
        if not {"docs/map.png", "docs/architecture.md", "docs/mathematics.md"} <= linked:
            fail(f"the links of README.md are not understood: {sorted(linked)}")
        named.update(SHIPPED_AS.get(path, path) for path in linked)
        if missing := [name for name in sorted(named) if not (folder / name).exists()]:
            fail(f"not in the package: {', '.join(missing)}")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
