"""Scenarios of the installation, which run first."""

import service
from bench import exit_code, expect, expect_equal, run, scenario, tell
from devices import IN

PACKAGE = IN / "azimuth.deb"
EXPOSURE = 17  # in tenths of the exposure of systemd-analyze security


def version():
    return run("dpkg-query", "-W", "-f", "${Version} ${db:Status-Status}", "azimuth").strip()


def user_exists():
    return exit_code("getent", "passwd", "azimuth") == 0


@scenario
def package_installs():
    """The package installs, and a robot that is not described yet fails nothing."""
    tell(run("dpkg", "-i", PACKAGE).strip().splitlines()[-1])
    expect(version().endswith(" installed"), version())
    expect(user_exists(), "there is a user azimuth")
    expect_equal(run("systemctl", "--failed", "--no-legend").strip(), "", "failed units")
    for folder in (service.STATE, service.LOGS):
        tell(f"{folder}: {folder.owner() if folder.exists() else 'not yet'}")
    run("azimuthd", "--version")
    run("azimuth", "--version")


@scenario
def unit_is_closed():
    """systemd finds nothing wrong with the unit, and little that it could reach."""
    expect_equal(run("systemd-analyze", "verify", "--man=no", "azimuthd.service").strip(), "", "systemd-analyze verify")
    verdict = run("systemd-analyze", "security", "--no-pager", f"--threshold={EXPOSURE}", "azimuthd.service")
    tell(verdict.strip().splitlines()[-1])
