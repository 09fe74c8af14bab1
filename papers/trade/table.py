#!/usr/bin/env python3
"""Tables of README.md from trade.csv files:  python3 papers/trade/table.py papers/trade/results/single.csv ...   Standard library only."""
import csv, sys

TARGETS = [0.1, 0.03, 0.01, 0.003, 0.001]
BASES = ["nurbs 1", "nurbs 2", "nurbs 3", "nurbs 4", "lagrange 1", "lagrange 2"]


def cheapest(points, target):
    fitting = [p for p in points if float(p["bound"]) <= target]
    return min((float(p["cpu_s"]) for p in fitting), default=None)


def row(name, points):
    costs = [cheapest(points, target) for target in TARGETS]
    print(f"| {name} | " + " | ".join("-" if c is None else f"{c:.3g}" for c in costs) + " |")


for path in sys.argv[1:]:
    with open(path) as file:
        points = [p for p in csv.DictReader(file) if p["role"] == "candidate" and p["bound"] != "nan"]
    segment = lambda p: "integration segment" in p["choices"]
    print(f"\n{path}: CPU s of the cheapest settings\n\n| | " + " | ".join(f"{100 * t:g} %" for t in TARGETS) + " |")
    print("|---|" + "---|" * len(TARGETS))
    row("all", points)
    for basis in BASES:
        row(f"{basis}, element", [p for p in points if p["basis"] == basis and not segment(p)])
        row(f"{basis}, segment", [p for p in points if p["basis"] == basis and segment(p)])
    row("nodal", [p for p in points if "nodal" in p["choices"]])
