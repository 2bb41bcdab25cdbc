#!/usr/bin/env python3
"""Prints one table from the JSON of the benchmark programs: a row per map size, and the ratios that the design promises.

usage: table.py FILE...
"""

import json
import re
import sys
from collections import defaultdict

COLUMNS = [  # name of the benchmark, heading
    ("mrpt_naive", "MRPT default"),
    ("mrpt_davison", "MRPT Davison"),
    ("invariant_step/rows:20", "Azimuth 20 rows"),
    ("additive_step/rows:20", "additive 20 rows"),
    ("gain_and_rank_update/rows:20", "yardstick 20 rows"),
    ("invariant_step/rows:10", "Azimuth 10 rows"),
    ("gain_and_rank_update/rows:10", "yardstick 10 rows"),
    ("estimator_step", "whole estimator"),
]


def medians(paths):
    """Returns {column: {landmarks: microseconds}}: the median over the repetitions of the median step."""
    table = defaultdict(dict)
    for path in paths:
        with open(path, encoding="utf-8") as file:
            for run in json.load(file)["benchmarks"]:
                if run.get("aggregate_name") != "median" or run.get("error_occurred"):
                    continue
                landmarks = int(re.search(r"landmarks:(\d+)", run["name"]).group(1))
                rows = re.search(r"/rows:\d+", run["name"])
                table[run["name"].split("/")[0] + (rows.group() if rows else "")][landmarks] = run["median_us"]
    return table


def ratio(table, above, below, landmarks_above, landmarks_below=None):
    try:
        return f"{table[above][landmarks_above] / table[below][landmarks_below or landmarks_above]:.2f}"
    except KeyError:
        return "not measured"


def main():
    table = medians(sys.argv[1:])
    columns = [(key, heading) for key, heading in COLUMNS if table[key]]
    print("| landmarks | " + " | ".join(heading for _, heading in columns) + " |")
    print("|---" * (len(columns) + 1) + "|")
    for landmarks in sorted({size for key, _ in columns for size in table[key]}):
        cells = [f"{table[key][landmarks]:,.1f}" if landmarks in table[key] else "" for key, _ in columns]
        print(f"| {landmarks} | " + " | ".join(cells) + " |")
    ours = "invariant_step/rows:20"
    print()
    print("at 500 landmarks, MRPT Davison / Azimuth:", ratio(table, "mrpt_davison", ours, 500))
    print("at 500 landmarks, Azimuth / yardstick:   ", ratio(table, ours, "gain_and_rank_update/rows:20", 500))
    print("Azimuth, t(1000) / t(500):               ", ratio(table, ours, ours, 1000, 500))


if __name__ == "__main__":
    main()
