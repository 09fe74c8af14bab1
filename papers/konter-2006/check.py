"""Prints what the benchmark asks for, from run folders of roller.toml: python3 papers/konter-2006/check.py out/roller [...]

Vertical displacement of the middle of the block's surface and pressure there (fits, even in x, to the points within a third of
the contact), half the length of contact, end of the zone that sticks, largest tangential traction.
"""

import csv
import sys


def solve(a, b):
    """Gauss elimination for a few normal equations."""
    n = len(b)
    for i in range(n):
        for j in range(i + 1, n):
            factor = a[j][i] / a[i][i]
            a[j] = [y - factor * x for x, y in zip(a[i], a[j])]
            b[j] -= factor * b[i]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (b[i] - sum(a[i][k] * x[k] for k in range(i + 1, n))) / a[i][i]
    return x


def at_centre(points, terms=3):
    """Value at x = 0 of the least-squares polynomial 1, x^2, x^4."""
    width = max(abs(x) for x, _ in points)
    rows = [([(x / width) ** (2 * k) for k in range(terms)], y) for x, y in points]
    normal = [[sum(r[i] * r[j] for r, _ in rows) for j in range(terms)] for i in range(terms)]
    return solve(normal, [sum(r[i] * y for r, y in rows) for i in range(terms)])[0]


def summary(folder):
    with open(f"{folder}/interface.csv") as file:
        rows = list(csv.DictReader(file))
    last = max(int(row["step"]) for row in rows)
    rows = [row for row in rows if int(row["step"]) == last and float(row["pressure"]) > 0]
    value = lambda row, key: float(row[key])
    half = max(abs(value(row, "x")) for row in rows)
    middle = [row for row in rows if abs(value(row, "x")) < half / 3]
    stick = [abs(value(row, "x")) for row in rows if row["status"] == "stick"]
    return {
        "u_y of B [mm]": at_centre([(value(r, "x"), value(r, "y")) for r in middle]),
        "pressure at B [N/mm^2]": at_centre([(value(r, "x"), value(r, "pressure")) for r in middle]),
        "half contact [mm]": half,
        "sticks to [mm]": max(stick, default=0.0),
        "largest traction [N/mm^2]": max(abs(value(r, "traction")) for r in rows),
    }


if __name__ == "__main__":
    for folder in sys.argv[1:]:
        print(folder + ":", ", ".join(f"{key} {found:.6g}" for key, found in summary(folder).items()))
