#!/usr/bin/env python3
"""Runs one check of the scripts in a copy of a fresh tree. Stand-ins replace the programs that would change the machine
or take long; they only record their calls.

usage: scripts_test.py CASE      exit code 0: good, 1: not, 77: the system does not allow the check
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TREE = Path(__file__).resolve().parents[2]
TOOLS = ("awk basename bash cat chmod cut date dirname env find git grep head ls mkdir mktemp nproc python3 realpath rm sed "
         "seq sh sleep sort tail tee timeout tr xargs").split()
STAND_INS = "apt-get cmake clang-format clang-tidy cpack ctest dpkg-query lintian mmdebstrap ninja unshare ip".split()
NOT_ROOT = 'echo 1000'


def fail(message):
    sys.exit(f"{sys.argv[1]}: {message}")


class Place:
    """A folder with the scripts and the only programs that they can find."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.calls_file = self.folder / "calls"
        for part in ("scripts", ".ci", "tests/guest/scenarios"):
            shutil.copytree(TREE / part, self.folder / part)
        shutil.copy(TREE / "tests/seconds.txt", self.folder / "tests")
        self.programs = self.folder / "bin"
        self.programs.mkdir()
        for tool in TOOLS:
            if found := shutil.which(tool):
                (self.programs / tool).symlink_to(found)
        for name in STAND_INS:
            self.stand_in(name, "exit 1")
        self.stand_in("id", "echo 0", noted=False)

    def stand_in(self, name, does, noted=True):
        program = self.programs / name
        program.unlink(missing_ok=True)
        note = f'echo "{name} $*" >>"{self.calls_file}"\n' if noted else ""
        program.write_text(f"#!/bin/sh\n{note}{does}\n")
        program.chmod(0o755)

    def scripts(self):
        found = [path for path in (self.folder / "scripts").iterdir() if path.is_file()]
        return sorted(found) + [self.folder / ".ci/run", self.folder / ".ci/nightly"]

    def run(self, script, *arguments):
        self.calls_file.write_text("")
        environment = {"PATH": str(self.programs), "HOME": str(self.folder), "LC_ALL": "C.UTF-8"}
        return subprocess.run([script, *arguments], cwd=self.folder, env=environment, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=30, check=False)

    def calls(self):
        return self.calls_file.read_text()


def help_comes_first(place):
    for script in place.scripts():
        for arguments in (["--help"], ["-h"], ["--nonsense", "--help"]):
            said = place.run(script, *arguments)
            usage = f"\nusage: {script.relative_to(place.folder)}"
            if said.returncode or usage not in said.stdout or said.stderr or place.calls():
                fail(f"{script.name} {arguments}: {said.returncode}, {said.stdout}{said.stderr}{place.calls()}")


def unknown_arguments_are_refused(place):
    # The part of the help that scripts/test reads.
    place.stand_in("ctest", "echo '  -R <regex>, --tests-regex <regex> = Run tests'; echo '  -j <jobs>  = Jobs'", noted=False)
    wrong = [(script, "--nonsense") for script in place.scripts()]
    wrong += [(place.folder / "scripts" / name, "nonsense") for name in ("docs", "fuzz", "setup", "package", "refresh-golden", "results", "test", "test-builds", "test-sanitizers")]
    for script, argument in wrong:
        said = place.run(script, argument)
        expected = f"{script.name}: unknown argument: {argument} (see --help)\n"
        if said.returncode != 1 or said.stderr != expected or place.calls():
            fail(f"{script.name}: {said.returncode}, {said.stderr}{place.calls()}")
    place.run(place.folder / "scripts/test", "-R", "Ekf", "-j2", "--tests-regex=Lamp")
    if "dpkg-query" not in place.calls():
        fail("what ctest knows is refused, or this test cannot fail")


def what_is_missing_is_told_once(place):
    place.stand_in("id", NOT_ROOT, noted=False)
    for name in ("setup", "test", "demo", "package", "bench", "refresh-golden", "results", "test-builds", "test-sanitizers"):
        said = place.run(place.folder / "scripts" / name)
        lines = said.stderr.splitlines()
        if said.returncode != 1 or len(lines) != 1 or not lines[0].startswith("setup: needs root to install g++ "):
            fail(f"{name}: {said.returncode}, {said.stderr}")
        if "cmake --" in place.calls():
            fail(f"{name} goes on without its packages")


def another_architecture_wants_a_compiler_and_no_libraries(place):
    place.stand_in("id", NOT_ROOT, noted=False)
    place.stand_in("dpkg", "echo amd64", noted=False)
    for name in ("setup", "package", "test"):
        script = place.folder / "scripts" / name
        missing = place.run(script, "--arch", "arm64").stderr
        if " g++-aarch64-linux-gnu " not in missing or " libpng-dev " in missing:
            fail(f"{name} --arch arm64: {missing}")
        missing = place.run(script, "--arch", "amd64").stderr  # the architecture of this machine
        if "aarch64" in missing or " libpng-dev " not in missing:
            fail(f"{name} --arch amd64: {missing}")
        for wrong in (["mips"], []):
            said = place.run(script, "--arch", *wrong)
            if said.returncode != 1 or not said.stderr.startswith(f"{name}: no programs for the architecture '{''.join(wrong)}'"):
                fail(f"{name} --arch {wrong}: {said.returncode}, {said.stderr}")


def a_guest_wants_the_machine_it_is(place):
    place.stand_in("id", NOT_ROOT, noted=False)
    place.stand_in("dpkg", "echo amd64", noted=False)
    script = place.folder / "scripts/test-guest"
    for arguments, wanted, unwanted in (([], " qemu-system-x86 ", "qemu-system-arm"),
                                        (["--arch", "arm64"], " qemu-system-arm", "qemu-system-x86"),
                                        (["robot", "--arch", "arm64"], " qemu-system-arm", "qemu-system-x86")):
        missing = place.run(script, *arguments).stderr
        if wanted not in missing or unwanted in missing or " mmdebstrap " not in missing:
            fail(f"test-guest {arguments}: {missing}")
    said = place.run(script, "--arch", "mips")
    if said.returncode != 1 or not said.stderr.startswith("test-guest: no programs for the architecture 'mips'"):
        fail(f"test-guest --arch mips: {said.returncode}, {said.stderr}")


def way_of(place, *, unshare, comes_back):
    """The output of scripts/demo about LCM before it builds."""
    place.stand_in("dpkg-query", "echo installed")
    place.stand_in("unshare", f"exit {0 if unshare else 1}")
    place.stand_in("python3", f"exit {0 if comes_back else 1}")
    said = place.run(place.folder / "scripts/demo")
    if "cmake --preset" not in place.calls():
        fail(f"the demo did not come to building: {said.stdout}{said.stderr}")
    return said.stdout.split("== configure")[0]


def demo_finds_a_way_for_lcm(place):
    for unshare, comes_back, expected in ((True, True, "network namespace of its own"),
                                          (False, True, "goes over this machine's network"),
                                          (False, False, "azimuthd writes its messages to a file")):
        said = way_of(place, unshare=unshare, comes_back=comes_back)
        if expected not in said:
            fail(f"namespaces {unshare}, multicast {comes_back}: {said}")


def multicast_is_tried(place):
    probe = f"{place.folder}/scripts/lib/multicast_comes_back.py 239.255.76.67 7667"
    namespace = ["unshare", "-n"] if os.geteuid() == 0 else ["unshare", "-rn"]
    if subprocess.run([*namespace, "true"], check=False, capture_output=True).returncode:
        print("skipped: no network namespaces here")
        sys.exit(77)
    for prepare, expected in (("true", 1), ("ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo", 0)):
        code = subprocess.run([*namespace, "sh", "-c", f"{prepare} && python3 -B {probe}"], check=False).returncode
        if code != expected:
            fail(f"after {prepare}: {code}")


FAST = ["Ekf.Begins", "Lamps.Shine"]
LONG = [f"Runs.Number{number}" for number in range(40)]
SECONDS = "# head\n" + "".join(f"{3.5 + number * number % 37} {name}\n" for number, name in enumerate(LONG[5:]))  # five tests have no time

CTEST = """case "$*" in
  *--help*) echo '  -R <regex>, --tests-regex <regex> = Run tests' ;;
  *--show-only*) cat "{listing}" ;;
  *)
    while [ $# -gt 0 ]; do [ "$1" != --output-junit ] || out=$2; shift; done
    mkdir -p "$(dirname "$out")"
    echo '<testsuite><testcase name="one" status="run" time="2.5"/></testsuite>' >"$out" ;;
esac"""


def tests_that_take_long(place):
    """Makes a ctest with long tests, most of which have times, and returns the names of all tests."""
    listing = [{"name": name, "properties": [{"name": "LABELS", "value": [label]}]}
               for names, label in ((FAST, "scripts"), (LONG[::2], "statistics"), (LONG[1::2], "nightly")) for name in names]
    listing.insert(1, {"name": "NoLabels.AreFine"})
    (place.folder / "listing.json").write_text(json.dumps({"tests": listing}))
    (place.folder / "tests/seconds.txt").write_text(SECONDS)
    place.stand_in("ctest", CTEST.format(listing=place.folder / "listing.json"))
    place.stand_in("dpkg-query", "echo installed", noted=False)
    place.stand_in("cmake", "exit 0", noted=False)
    return [each["name"] for each in listing]


def share_of(place, *turn):
    """Returns the number of the share and the numbers of its tests."""
    said = place.run(place.folder / "scripts/lib/test_shares.py", "share", "build", *turn)
    if said.returncode:
        fail(said.stderr)
    lines = said.stdout.splitlines()
    return int(lines[0]), [int(number) for number in lines[1].split(",")]


def what_takes_long_is_dealt_into_twenty_shares(place):
    names = tests_that_take_long(place)
    shares = [[names[number - 1] for number in share_of(place, str(turn))[1]] for turn in range(20)]
    if sorted(name for share in shares for name in share) != sorted(LONG):
        fail(f"not each in one share: {shares}")
    seconds = {name: float(time_s) for time_s, name in (line.split() for line in SECONDS.splitlines()[1:])}
    sums = [sum(seconds.get(name, 0.0) for name in share) for share in shares]
    if max(sums) - min(sums) > max(seconds.values()) / 2:
        fail(f"not alike: {sums}")
    # A new test does not move another one.
    listing = json.loads((place.folder / "listing.json").read_text())
    listing["tests"].append({"name": "Runs.AreMore", "properties": [{"name": "LABELS", "value": ["statistics"]}]})
    (place.folder / "listing.json").write_text(json.dumps(listing))
    names.append("Runs.AreMore")
    later = [[names[number - 1] for number in share_of(place, str(turn))[1]] for turn in range(20)]
    if [[name for name in share if name != "Runs.AreMore"] for share in later] != shares or sum(map(len, later)) != 41:
        fail(f"{shares}, then {later}")


def twenty_commits_in_a_row_have_all_turns(place):
    tests_that_take_long(place)

    def git(*arguments):
        author = ["-c", "user.name=a", "-c", "user.email=a@b"]
        subprocess.run(["git", *author, *arguments], cwd=place.folder, check=True, capture_output=True)

    if not 0 <= share_of(place)[0] <= 19:
        fail("there is no turn without commits")
    git("init", "--quiet")
    turns = []
    for number in range(21):
        git("commit", "--quiet", "--allow-empty", "--message", str(number))
        turns.append(share_of(place)[0])
    if sorted(turns[:20]) != list(range(20)) or turns[20] != turns[0] or share_of(place)[0] != turns[20]:
        fail(f"turns: {turns}")


def what_is_left_out_is_told(place):
    tests_that_take_long(place)

    def chosen(*arguments):
        """The arguments of ctest after the usual ones, and the last two lines of the output."""
        said = place.run(place.folder / "scripts/test", *arguments)
        if said.returncode:
            fail(f"{arguments}: {said.stdout}{said.stderr}")
        call = next(line for line in place.calls().splitlines() if "--output-junit" in line)
        return call.split("test-results.xml", 1)[1].strip(), said.stdout.splitlines()[-2:]

    passed = "1 passed, 0 failed, 0 skipped"
    which, (told, last) = chosen()
    if which != "--label-exclude ^(statistics|nightly)$" or last != passed:
        fail(f"{which}, {last}")
    if not told.startswith("left out: 40 tests ") or "scripts/test --all" not in told:
        fail(told)
    for arguments in (["--all"], ["-R", "Ekf"], ["--all", "-R", "Ekf"]):
        which, (told, last) = chosen(*arguments)
        if "exclude" in which or "left out" in told or last != passed:
            fail(f"{arguments}: {which}, {told}, {last}")
    for turn in ("3", "19"):
        which, (told, last) = chosen("--share", turn)
        numbers = ",".join(str(number) for number in share_of(place, turn)[1])
        if which != f"--tests-information 0,0,0,{numbers}" or not told.startswith(f"share {turn} of 0 to 19: ") or last != passed:
            fail(f"{which}, {told}, {last}")


def times_are_taken_over(place):
    names = tests_that_take_long(place)
    results = place.folder / "build/test-results.xml"
    results.parent.mkdir()
    results.write_text("<testsuite>" + "".join(
        f'<testcase name="{name}" status="{status}" time="{time_s}"/>'
        for name, status, time_s in ((LONG[0], "run", 77.77), (LONG[6], "run", 1), (LONG[7], "notrun", 0), (names[0], "run", 5)))
        + "</testsuite>")
    said = place.run(place.folder / "scripts/lib/test_shares.py", "measured", "build")
    lines = (place.folder / "tests/seconds.txt").read_text().splitlines()
    if said.returncode or lines[:2] != ["# head", f"77.8 {LONG[0]}"] or lines[-1] != f"1.0 {LONG[6]}" or len(lines) != 37:
        fail(f"{said.stderr}{lines}")


JUNIT = """<testsuite>
<testcase name="good" status="run"><system-out>SKIPPED: not this one</system-out></testcase>
<testcase name="script" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/><system-out>SKIPPED: no room
</system-out></testcase>
<testcase name="gtest" status="notrun"><skipped message="x"/><system-out>a_test.cpp:7: Skipped
no data

</system-out></testcase>
<testcase name="silent" status="notrun"><skipped message="x"/></testcase>
<testcase name="bad" status="fail"><failure message=""/><system-out>{long}it is bad
</system-out></testcase>
</testsuite>""".format(long="it goes on\n" * 100)
COUNTED = """skipped: script: no room
skipped: gtest: no data
skipped: silent
failed: bad
{long}    it is bad
1 passed, 1 failed, 3 skipped
""".format(long="    it goes on\n" * 19)


def skips_are_told_with_their_reasons(place):
    results = place.folder / "results.xml"
    results.write_text(JUNIT)
    counted = subprocess.run([sys.executable, "-B", place.folder / "scripts/lib/count_tests.py", results],
                             capture_output=True, text=True, check=False)
    if counted.returncode != 1 or counted.stdout != COUNTED:
        fail(f"{counted.returncode}, {counted.stdout}{counted.stderr}")


def what_the_time_does_not_suffice_for_has_failed(place):
    try_steps = place.folder / ".ci/try"

    def said(*steps):
        lines = "\n".join(steps)
        try_steps.write_text(f'#!/usr/bin/env bash\nsource "$(dirname "$0")/steps.sh"\nbegin try 1\n{lines}\nend\n')
        try_steps.chmod(0o755)
        return place.run(try_steps)

    def summary(*steps):
        ended = said(*steps)
        return ended.stdout.splitlines()[-1], ended.returncode

    failed = "failed: this\n    for a reason\n"
    ended = said(f"step bad bash -c \"echo '{failed}0 passed, 1 failed, 0 skipped'\"", "step good sh -c :").stdout
    if f"== summary\n{failed}bad " not in ended:
        fail(ended)

    for expected, *steps in (
            (("1 passed, 0 failed, 0 skipped", 0), "step good sh -c :"),
            (("1 passed, 1 failed, 0 skipped", 1), "step good sh -c :", "step bad sh -c 'exit 3'"),
            (("0 passed, 0 failed, 1 skipped", 1), "step skipped sh -c 'exit 77'"),
            (("5 passed, 0 failed, 2 skipped", 0), "step counted sh -c 'echo 5 passed, 0 failed, 2 skipped'"),
            (("1 passed, 1 failed, 0 skipped", 1), "step good sh -c :", "timeout() { return 124; }", "step long sh -c :"),
            (("1 passed, 1 failed, 0 skipped", 1), "step good sh -c :", "deadline=0", "step late sh -c :")):
        if summary(*steps) != expected:
            fail(f"{steps}: {summary(*steps)}, not {expected}")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        globals()[sys.argv[1]](Place(scratch))
