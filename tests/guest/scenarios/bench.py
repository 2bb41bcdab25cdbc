"""Runs scenarios; functions for their expectations and measurements."""

import subprocess
import sys
import time
import traceback

_scenarios = []


class Failed(Exception):
    """An expectation did not hold."""


class Skipped(Exception):
    """The scenario cannot run on this machine; the message is the reason."""


def scenario(function):
    """A decorator that registers a function as a scenario under its name."""
    _scenarios.append(function)
    return function


def expect(condition, what):
    """Fails the scenario unless `condition` holds."""
    if not condition:
        raise Failed(what)


def expect_equal(found, wanted, what):
    expect(found == wanted, f"{what}: {found!r}, not {wanted!r}")


def tell(text):
    """Prints a measurement to the log."""
    print(f"    {text}", flush=True)


def run(*command, check=True, timeout=120, **options):
    """Runs a program and returns its standard output and error; fails the scenario if the program fails."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          timeout=timeout, **options)
    if check and done.returncode != 0:
        raise Failed(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout}")
    return done.stdout


def exit_code(*command, timeout=120):
    return subprocess.run([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                          timeout=timeout).returncode


def wait_until(condition, timeout_s, what, pause_s=0.05):
    """Waits until `condition()` is true and returns the seconds; fails the scenario after `timeout_s`."""
    start = time.monotonic()
    while not condition():
        if time.monotonic() - start > timeout_s:
            raise Failed(f"not within {timeout_s:g} s: {what}")
        time.sleep(pause_s)
    return time.monotonic() - start


def run_scenarios(wanted, clean_up):
    """Runs the scenarios whose names contain a part in `wanted` (all if it is empty) and calls `clean_up()` after each.
    Returns the exit code."""
    counts = {"passed": 0, "failed": 0, "skipped": 0}
    for function in _scenarios:
        name = function.__name__
        if wanted and not any(word in name for word in wanted):
            continue
        print(f"[ RUN     ] {name}: {(function.__doc__ or '').strip().splitlines()[0]}", flush=True)
        start = time.monotonic()
        outcome = "passed"
        try:
            function()
        except Skipped as reason:
            outcome = "skipped"
            tell(str(reason))
        except Exception as problem:  # the other scenarios still run
            outcome = "failed"
            if not isinstance(problem, Failed):
                traceback.print_exc(file=sys.stdout)
            tell(str(problem))
        try:
            clean_up(name, outcome)
        except Exception:
            outcome = "failed"
            traceback.print_exc(file=sys.stdout)
        counts[outcome] += 1
        print(f"[ {outcome.upper():7} ] {name} ({time.monotonic() - start:.1f} s)", flush=True)
    print(", ".join(f"{count} {outcome}" for outcome, count in counts.items()), flush=True)
    return 1 if counts["failed"] or not counts["passed"] else 0
