"""What one step away from the program's own choices does: python3 papers/trade/defaults.py papers/trade/results/{single,hertz,wedge,roller}.csv

Pairs of settings of a trade that differ in one choice only. A line of the table: median factor of the error and of the CPU time over the
pairs of each scene.
"""

import csv
import statistics
import sys
from collections import defaultdict
from pathlib import Path


def pairs(path):
    """(choice, factor of the error, factor of the CPU time)"""
    with open(path) as file:
        rows = [row for row in csv.DictReader(file) if row["status"] == "done" and row["role"] == "candidate"]
    known = {}
    for row in rows:
        choices = frozenset(filter(None, row["choices"].split("; ")))
        key = (row["basis"], row["elements"], row["grading"], row["steps"])
        known[key, choices] = (float(row["error"]), float(row["cpu_s"]))
    for (key, choices), (error, cpu) in known.items():
        for choice in choices:
            if (key, choices - {choice}) in known:
                before = known[key, choices - {choice}]
                yield choice, error / before[0], cpu / before[1]


if __name__ == "__main__":
    found = defaultdict(lambda: defaultdict(list))
    for path in sys.argv[1:]:
        for choice, error, cpu in pairs(path):
            found[choice][Path(path).stem].append((error, cpu))
    scenes = [Path(path).stem for path in sys.argv[1:]]
    print("| choice | " + " | ".join(scenes) + " |\n|---|" + "---|" * len(scenes))
    for choice, of in sorted(found.items()):
        if sum(len(values) for values in of.values()) < 12:
            continue
        median = lambda values, k: statistics.median(value[k] for value in values)
        cell = lambda v: f"{median(v, 0):.2f}, {median(v, 1):.2f} ({len(v)})" if v else "-"
        print(f"| {choice} | " + " | ".join(cell(of[scene]) for scene in scenes) + " |")
