"""Makes the jobs of tools/fleet/Snakefile: one per run and variant, with digests of everything that its report depends
on."""

import functools
import glob
import hashlib
import os
import re
import shlex
from dataclasses import dataclass
from pathlib import Path

JOB = Path(__file__).resolve().with_name("replay_job.py")


@dataclass(frozen=True)
class Job:
    key: str           # file name of the report, without suffix
    name: str          # name of the run in its report, by which reports of variants are paired
    path: str
    tags: tuple
    seed: object       # None: the seed of the configuration


def unusable_name(variant):
    """True if a name cannot be used for folders or for Snakemake, which passes wildcards as
    RULE:NAME=VALUE,NAME=VALUE."""
    return re.fullmatch(r"[\w.=+-]+", variant) is None


def digest(text):
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def digest_of_file(file):
    state = os.stat(file)
    return digest_of_bytes(file, state.st_size, state.st_mtime_ns)


@functools.lru_cache(maxsize=None)     # a thousand jobs ask for the digest of a program of 60 MB
def digest_of_bytes(file, _size, _changed_ns):
    return hashlib.sha256(Path(file).read_bytes()).hexdigest()[:16]


def digest_of_data(path):
    """A digest of names, sizes and times of change. It does not read the logs, because they are large and closed
    segments never change."""
    path = Path(path)
    files = sorted(each for each in path.rglob("*") if each.is_file()) if path.is_dir() else [path]
    states = [(str(each), each.stat()) for each in files]
    return digest(repr([(name, state.st_size, state.st_mtime_ns) for name, state in states]))


def runs_of(corpus):
    """Returns {path: tags} and the patterns that match nothing. A run in several entries gets the tags of all of
    them."""
    runs, empty = {}, []
    for entry in corpus:
        paths = sorted(glob.glob(entry["path"]))
        empty += [] if paths else [entry["path"]]
        for path in paths:
            runs.setdefault(path.rstrip("/"), set()).update(entry.get("tags", []))
    return {path: tuple(sorted(tags)) for path, tags in sorted(runs.items())}, empty


def jobs_of(runs, variant):
    """Yields the jobs of a variant. Paths serve as unique names. A variant with tags only gets runs with one of these
    tags."""
    wanted = set(variant.get("tags", []))
    for path, tags in runs.items():
        if wanted and wanted.isdisjoint(tags):
            continue
        for seed in variant.get("seeds", [None]):
            readable = "".join(letter if letter.isalnum() else "_" for letter in path)[-60:]
            yield Job(f"{readable}-{digest(path)[:6]}" + ("" if seed is None else f".seed{seed}"), path, path, tags, seed)


def options_of(variant, job):
    options = [*variant.get("options", []), *(f"--set={assignment}" for assignment in variant.get("set", []))]
    options += [f"--config={variant['config']}"] if "config" in variant else []
    options += [f"--seed={job.seed}"] if job.seed is not None else []
    return options


def command_of(variant, job, report, time_s, memory_mb):
    """The shell command of a job."""
    tags = [word for tag in job.tags for word in ("--tag", tag)]
    words = [JOB, report, job.name, time_s, memory_mb, variant["azimuth"], "replay", job.path, *tags, *options_of(variant, job)]
    return "python3 -IS " + shlex.join(str(word) for word in words)     # without site packages, python starts in half the time


def state_of(variant, job):
    """A value that changes whenever the report may change."""
    config = digest_of_file(variant["config"]) if "config" in variant else ""
    return digest(repr((digest_of_file(variant["azimuth"]), config, options_of(variant, job), job.tags, digest_of_data(job.path))))
