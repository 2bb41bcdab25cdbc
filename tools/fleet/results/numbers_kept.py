"""The numbers of reports for the tables, with six digits, as in tools/fleet/results/numbers.json: {variant: {run:
numbers}}."""

import json
from pathlib import Path

FILE = Path(__file__).resolve().parent / "numbers.json"
DIGITS = 6     # more than any table shows, which avoids double rounding

PARTS = {  # paths in a report
    "rmse_m": ("pose", "rmse_m"),
    "mean_m": ("pose", "mean_m"),
    "anees": ("pose", "anees"),
    "anees_tracking": ("pose", "anees_tracking"),
    "odometry_m": ("odometry_only", "rmse_m"),
    "odometry_mean_m": ("odometry_only", "mean_m"),
    "odometry_raw_m": ("odometry_raw", "rmse_m"),
    "hindsight_m": ("hindsight", "rmse_m"),
    "hindsight_anees": ("hindsight", "anees"),
    "tracking": ("health_over_time", "tracking", "share"),
    "landmarks": ("map", "landmarks"),
    "found": ("map", "matched"),
    "of": ("map", "true_landmarks"),
    "twice": ("map", "duplicates"),
    "phantoms": ("map", "phantoms"),
    "landmarks_mean_m": ("map", "mean_m"),
    "wrong": ("association", "wrong"),
    "judged": ("association", "judged"),
}


def name_of(run, seed):
    return run if seed is None else f"{run}, seed {seed}"


def rounded(number):
    return float(f"{number:.{DIGITS - 1}e}") if isinstance(number, float) else number


def at(report, path):
    for key in path:
        report = None if report is None else report.get(key)
    return report


def numbers_of(report):
    """The numbers of a report, without the missing ones."""
    found = {name: rounded(at(report, path)) for name, path in PARTS.items()}
    return {"estimator": report["estimator"], **{name: number for name, number in found.items() if number is not None}}


def text_of(numbers):
    """One line for each run, so that a diff shows the changed runs."""
    variants = (f' "{variant}": {{\n' + ",\n".join(f"  {json.dumps(run)}: {json.dumps(found)}" for run, found in sorted(runs.items())) + "\n }"
                for variant, runs in sorted(numbers.items()))
    return "{\n" + ",\n".join(variants) + "\n}\n"


def kept():
    return json.loads(FILE.read_text(encoding="utf-8"))
