"""Scenarios of the upgrade, the removal and the purge of the package, which run last."""

import shutil
from pathlib import Path

import service
from bench import exit_code, expect, expect_equal, run, scenario, tell
from devices import IN
from package_scenarios import version

NEXT_PACKAGE = IN / "azimuth_next.deb"


@scenario
def package_upgrades():
    """An upgrade restarts the service and keeps configuration and map."""
    service.CONFIGURATION.parent.mkdir(exist_ok=True)
    note = "# the owner's own line\n"
    service.CONFIGURATION.write_text(service.CONFIGURATION.read_text() + note)
    kept = service.STATE / "kept"
    service.STATE.mkdir(exist_ok=True)
    kept.write_text("map")
    run("dpkg", "-i", "--force-confold", NEXT_PACKAGE)
    tell(version())
    expect(service.CONFIGURATION.read_text().endswith(note), "the owner's configuration is kept")
    expect(kept.exists(), "what the daemon has saved is kept")
    expect_equal(run("systemctl", "--failed", "--no-legend").strip(), "", "failed units")


@scenario
def package_removes_and_purges():
    """Removing stops the service and keeps what is the owner's; purging leaves nothing."""
    run("dpkg", "-r", "azimuth")
    expect(not Path("/usr/bin/azimuthd").exists(), "the program is gone")
    expect(not Path("/lib/systemd/system/azimuthd.service").exists()
           and not Path("/usr/lib/systemd/system/azimuthd.service").exists(), "the unit is gone")
    expect(exit_code("pgrep", "-x", "azimuthd") != 0, "no process is left")
    expect(service.CONFIGURATION.exists(), "the configuration is still there")
    service.RIG.unlink(missing_ok=True)  # a file of the owner, which the purge keeps
    run("dpkg", "-P", "azimuth")
    expect(not service.CONFIGURATION.exists(), "the configuration is gone")
    expect(not service.STATE.exists() and not service.LOGS.exists(), "maps and logs are gone")
    expect(exit_code("dpkg-query", "-W", "azimuth") != 0, "dpkg has forgotten it")
    expect_equal(run("systemctl", "--failed", "--no-legend").strip(), "", "failed units")
    shutil.rmtree(service.CONFIGURATION.parent, ignore_errors=True)
