"""A Slurm cluster of one node on this machine: munged, slurmctld and slurmd. It needs its own namespaces
(in_namespaces.sh)."""

import os
import subprocess
import time
from pathlib import Path

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "scancel")
WAIT_S = 60

CONFIGURATION = """
ClusterName=test
SlurmctldHost=localhost
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
CredType=cred/munge
StateSaveLocation=/run/slurm/state
SlurmdSpoolDir=/run/slurm/node
SlurmctldPidFile=/run/slurm/slurmctld.pid
SlurmdPidFile=/run/slurm/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SlurmdParameters=config_overrides
MpiDefault=none
ReturnToService=2
NodeName=localhost CPUs={cpus} RealMemory={memory_mb} State=UNKNOWN
PartitionName=all Nodes=localhost Default=YES MaxTime=INFINITE State=UP
"""


def path():
    return os.environ["PATH"] + ":/usr/sbin:/sbin"


class Cluster:
    """A context manager: within it, the commands of Slurm find the cluster."""

    def __init__(self, folder, cpus, memory_mb):
        self.folder, self.daemons = folder, []
        folder.mkdir()
        for each in ("state", "node"):
            Path("/run/slurm", each).mkdir(parents=True)
        self.configuration = folder / "slurm.conf"
        user = subprocess.run(["id", "--user", "--name"], capture_output=True, text=True, check=True).stdout.strip()
        self.configuration.write_text(CONFIGURATION.format(user=user, cpus=cpus, memory_mb=memory_mb))
        self.key = folder / "munge.key"
        self.key.write_bytes(os.urandom(1024))
        self.key.chmod(0o600)

    def __enter__(self):
        os.environ.update(SLURM_CONF=str(self.configuration), PATH=path())
        try:
            self.start("munged", "--foreground", "--force", f"--key-file={self.key}", "--seed-file=/run/munge/seed",
                       "--log-file=/run/munge/log", "--pid-file=/run/munge/pid")
            self.wait("munge", "--no-input")
            self.start("slurmctld", "-D")
            self.start("slurmd", "-D")
            self.wait("sh", "-c", "sinfo --noheader --format=%T | grep -x idle")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            daemon.terminate()
            daemon.wait(timeout=WAIT_S)
        self.daemons = []

    def start(self, program, *arguments):
        with open(self.folder / f"{program}.log", "wb") as log:
            self.daemons.append(subprocess.Popen([program, *arguments], stdout=log, stderr=subprocess.STDOUT))

    def wait(self, *command):
        """Waits until a command succeeds."""
        end = time.monotonic() + WAIT_S
        while subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode != 0:
            if time.monotonic() > end or any(daemon.poll() is not None for daemon in self.daemons):
                raise RuntimeError(f"{' '.join(command)}: not content\n" + self.logs())
            time.sleep(0.1)

    def logs(self):
        return "\n".join(f"{log.name}:\n{log.read_text(errors='replace')[-3000:]}" for log in sorted(self.folder.glob("*.log")))
