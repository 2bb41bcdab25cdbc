#!/usr/bin/env python3
"""Checks which folders may include which, and that the pure part uses nothing impure (CONTRIBUTING, "Layout and its
rules").

usage: include_rules.py SOURCE_TREE      exit code 0: clean, 1: violations, one `file:line: message` each
"""

import re
import sys
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import tree_check  # noqa: E402

STANDARD = re.compile(r"[a-z][a-z0-9_]*")  # <vector>; C headers of the kernel end in .h
EIGEN = re.compile(r"(unsupported/)?Eigen/.+")
OPENCV = re.compile(r"opencv2/.+")
VECTOR_INSTRUCTIONS = re.compile(r"immintrin\.h|arm_neon\.h")
TOML = re.compile(r"toml\+\+/.+")
CLI11 = re.compile(r"CLI/.+")
JSON = re.compile(r"nlohmann/json\.hpp")
FMT = re.compile(r"fmt/.+")  # stands in for std::format
EXPECTED = re.compile(r"tl/expected\.hpp")  # stands in for std::expected
MESSAGES = re.compile(r"(azimuth|bot_core)/\w+\.hpp|lcm/.+")  # made by lcm-gen, and LCM itself
KERNEL = re.compile(r"(sys|linux(/can)?|asm|net|netinet|arpa)/[\w-]+\.h|(unistd|fcntl|poll|termios|pty|endian|byteswap|dirent)\.h")
DEVICES = re.compile(r"dc1394/.+|libusb.*|libv4l.*|(jpeglib|jerror)\.h|png\.h|zlib\.h")
ANYTHING = re.compile(r".+")

THREADS = {"thread", "mutex", "shared_mutex", "condition_variable", "future", "stop_token", "semaphore", "latch",
           "barrier"}
OUTSIDE_WORLD = {"fstream", "iostream", "istream", "ostream", "sstream", "syncstream", "filesystem", "cstdio",
                 "csignal", "ctime", "csetjmp", "atomic"} | THREADS

THREAD_WORDS = re.compile(r"\bstd::(jthread|thread|async|(\w+_)?mutex|condition_variable\w*)\b|\bpthread_create\b")
IMPURE_WORDS = re.compile(
    r"_clock::now\b|\bclock_gettime\b|\bgettimeofday\b|\btime\s*\(\s*(NULL|nullptr|0)\s*\)|\brandom_device\b"
    r"|\bstd::(exit|quick_exit|_Exit|abort|terminate|system)\b|\b(exit|abort|_exit)\s*\("
    r"|\bstd::(cout|cerr|clog|print)\b|\b(f|s|sn)?printf\s*\(|\bspdlog::|\bsocket\s*\(|\bfopen\s*\("
    r"|\bthread_local\b|\bgetenv\b")
# Functions whose last bits differ in the C library of arm64; slam/geometry/same_everywhere.hpp replaces them.
ROUNDED_OTHERWISE = re.compile(r"\bstd::(hypot|cbrt|erfc?|[lt]gamma)\b")


@dataclass(frozen=True)
class Rule:
    """The includes that files below a folder may use. The rule of the longest matching folder counts."""
    sees: tuple                   # folders of this project
    externals: tuple              # patterns of headers in <>
    forbidden: frozenset = frozenset(THREADS)
    words: tuple = (THREAD_WORDS,)


def driver(*sees):
    return Rule((*sees, "base", "slam/sample", "slam/geometry"),
                (STANDARD, EIGEN, EXPECTED, MESSAGES, FMT, KERNEL, DEVICES))


def pure(*sees, externals=()):
    return Rule(sees, (STANDARD, EIGEN, VECTOR_INSTRUCTIONS, *externals), frozenset(OUTSIDE_WORLD),
                (THREAD_WORDS, IMPURE_WORDS, ROUNDED_OTHERWISE))


RULES = {
    "slam": pure(),  # a folder without a rule may include nothing
    "slam/geometry": pure("slam/geometry"),
    "slam/sample": pure("slam/sample", "slam/geometry"),
    "slam/camera": pure("slam/camera", "slam/sample", "slam/geometry", externals=(OPENCV,)),
    "slam/perception": pure("slam/perception", "slam/camera", "slam/sample", "slam/geometry", externals=(OPENCV,)),
    # Association takes predictions and covariances as values, so it and the filters are independent of each other.
    "slam/association": pure("slam/association", "slam/sample", "slam/geometry"),
    "slam/ekf": pure("slam/ekf", "slam/camera", "slam/sample", "slam/geometry"),
    "slam/fastslam": pure("slam/fastslam", "slam/camera", "slam/sample", "slam/geometry"),
    # The smoother minimises a sum of squares over poses and landmarks; it gets the data association from its caller.
    "slam/smoother": pure("slam/smoother", "slam/sample", "slam/geometry"),
    "slam/hypotheses": pure("slam/hypotheses", "slam/localisation", "slam/smoother", "slam/sample", "slam/geometry"),
    "slam/localisation": pure("slam/localisation", "slam/association", "slam/sample", "slam/geometry"),
    "slam/map_merge": pure("slam/map_merge", "slam/sample", "slam/geometry"),
    # The interface of all estimators. The estimators are independent of each other.
    "slam/estimator": pure("slam/estimator", "slam/ekf", "slam/localisation", "slam/camera", "slam/sample",
                           "slam/geometry"),
    "slam/lost": pure("slam/lost", "slam/estimator", "slam/localisation", "slam/ekf", "slam/sample", "slam/geometry"),
    "slam/planar": pure("slam/planar", "slam/lost", "slam/estimator", "slam/ekf", "slam/association",
                        "slam/localisation", "slam/camera", "slam/sample", "slam/geometry"),
    "slam/hindsight": pure("slam/hindsight", "slam/lost", "slam/estimator", "slam/ekf", "slam/hypotheses", "slam/smoother",
                           "slam/localisation", "slam/camera", "slam/sample", "slam/geometry"),
    # Both filters for ceiling lamps share the decision whether a light is a lamp or a reflection.
    "slam/ceiling": pure("slam/ceiling", "slam/lost", "slam/estimator", "slam/ekf", "slam/fastslam",
                         "slam/association", "slam/localisation", "slam/camera", "slam/sample", "slam/geometry"),
    "slam/particles": pure("slam/particles", "slam/lost", "slam/estimator", "slam/fastslam", "slam/ekf",
                           "slam/association", "slam/localisation", "slam/camera", "slam/sample", "slam/geometry"),
    "base": Rule(("base",), (STANDARD, EXPECTED, KERNEL)),
    "drivers": driver("drivers"),
    # Common parts of the drivers; each may use the ones above it.
    "drivers/wire": driver("drivers/wire"),
    "drivers/device": driver("drivers/device"),
    # The only driver folder that knows estimates: it converts them to messages and back.
    "drivers/estimates": driver("drivers/estimates", "slam/estimator"),
    "drivers/storage": driver("drivers/storage", "drivers/wire", "drivers/device"),
    "drivers/camera": driver("drivers/camera", "drivers/storage", "drivers/wire", "drivers/device"),
    "settings": Rule(("settings", "base", "slam"), (STANDARD, EIGEN, EXPECTED, TOML, FMT)),
    # Pictures of the detections, for people.
    "drivers/picture": pure("drivers/picture", "slam/camera", "slam/sample", "slam/geometry", externals=(OPENCV,)),
    # Estimates as ROS messages, for recordings and for the bridge to ROS 2: values and bytes, without the ROS
    # libraries.
    "drivers/ros": Rule(("drivers/ros", "base", "slam/estimator", "slam/sample", "slam/geometry"), (STANDARD, EIGEN)),
    # azimuth-ros2 is a separate process. Only the part outside the bridge uses DDS.
    "tools/ros2": Rule(("tools/ros2", "base", "drivers", "settings/command_line", "slam/estimator", "slam/sample", "slam/geometry"),
                       (ANYTHING,)),
    "tools/ros2/bridge": Rule(("tools/ros2/bridge", "drivers/ros", "base", "drivers/estimates", "drivers/wire", "drivers/lcm",
                               "settings/command_line", "slam/estimator", "slam/sample", "slam/geometry"),
                              (STANDARD, EIGEN, MESSAGES, FMT, CLI11, re.compile(r"net/if\.h"))),
    # Common parts of the programs' command lines.
    "settings/command_line": Rule(("settings", "base"), (STANDARD, CLI11, FMT, JSON)),
    "sim": Rule(("sim", "base", "slam", "settings", "drivers"), (ANYTHING,)),
    "tools": Rule(("tools", "sim", "base", "slam", "settings", "drivers"), (ANYTHING,)),
    # The view of a running daemon turns messages into events, without sockets.
    "tools/view": Rule(("tools/view", "base", "drivers/lcm", "drivers/wire", "drivers/estimates", "settings", "slam"),
                       (STANDARD, EIGEN, EXPECTED, MESSAGES, FMT, JSON), frozenset(THREADS | {"fstream", "iostream", "cstdio"})),
    # The only folder with threads, and the only one that combines drivers and estimators in real time.
    "daemon": Rule(("daemon", "base", "slam", "settings", "drivers"), (ANYTHING,), frozenset(), ()),
}

INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)[>"]')
COMMENT_OR_LITERAL = re.compile(
    r"""//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\w)'(?:\\.|[^'\\\n])'""", re.DOTALL)


def rule_of(path):
    """The rule for a file, given by its path relative to the tree."""
    folders = [folder for folder in RULES if path.startswith(folder + "/")]
    return RULES[max(folders, key=len)] if folders else None


def include_problem(rule, path, bracket, header):
    """Returns why an include is wrong, or None."""
    if bracket == '"':
        if header.startswith("."):
            return f'"{header}": write the path from the top of the tree'
        folder = header.rsplit("/", 1)[0] + "/"
        if any(folder.startswith(seen + "/") for seen in rule.sees):
            return None
        return f'"{header}" may not be included from {Path(path).parent}'
    if header in rule.forbidden:
        return f"<{header}> may not be included from {Path(path).parent}"
    if any(pattern.fullmatch(header) for pattern in rule.externals):
        return None
    return f"<{header}> may not be included from {Path(path).parent}"


INTERNAL = re.compile(r"\bInternal to ([\w/]+)")  # a phrase in the comments of headers


def internal_problem(tree, path, header):
    """Returns why a file may not include a header of this project because it is internal to another folder, or None."""
    file = tree / header
    said = INTERNAL.search(file.read_text(encoding="utf-8")) if file.is_file() else None
    if said is None or path.startswith(said[1].rstrip("/") + "/"):
        return None
    return f'"{header}" is internal to {said[1]}'


def blank(match):
    return re.sub(r"[^\n]", " ", match.group())


def check_source(tree, path):
    """Yields (line, message) of the violations in a source file."""
    rule = rule_of(path)
    if rule is None:
        return
    text = (tree / path).read_text(encoding="utf-8")
    for number, line in enumerate(text.splitlines(), 1):
        if include := INCLUDE.match(line):
            problem = include_problem(rule, path, *include.groups())
            if problem := problem or internal_problem(tree, path, include[2]):
                yield number, problem
    code = COMMENT_OR_LITERAL.sub(blank, text)
    for number, line in enumerate(code.splitlines(), 1):
        for pattern in rule.words:
            if word := pattern.search(line):
                yield number, f"{word.group().strip()} has no place in {path.split('/')[0]}/"


def check_targets(tree, folder):
    """Checks that sources are listed by hand in the CMakeLists.txt of their folder; yields (line, message)."""
    sources = sorted(source.name for source in folder.glob("*.cpp"))
    if not sources:
        return
    lists = folder / "CMakeLists.txt"
    text = lists.read_text(encoding="utf-8") if lists.exists() else ""
    for number, line in enumerate(text.splitlines(), 1):
        if re.search(r"\bfile\s*\(\s*GLOB", line):
            yield number, "sources are listed by hand, not by GLOB"
    listed = set(re.findall(r"[\w.-]+\.cpp", text))
    for source in sources:
        if source not in listed:
            yield 1, f"{source} is in no target of its folder"


def violations(tree):
    """All violations under `tree`, as `file:line: message`, in the order of the files."""
    for top in sorted({folder.split("/")[0] for folder in RULES}):
        for source in sorted((tree / top).rglob("*")):
            path = source.relative_to(tree).as_posix()
            if source.is_dir() or path == top:
                continue
            if source.suffix in (".hpp", ".cpp", ".h", ".c"):
                for number, message in check_source(tree, path):
                    yield f"{path}:{number}: {message}"
        for folder in [tree / top, *sorted(p for p in (tree / top).rglob("*") if p.is_dir())]:
            for number, message in check_targets(tree, folder):
                yield f"{(folder / 'CMakeLists.txt').relative_to(tree).as_posix()}:{number}: {message}"


if __name__ == "__main__":
    tree_check.run(violations, needs="slam", clean="include rules: clean")
