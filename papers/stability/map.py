"""The stability map out of the tables of its studies: a classified table (markdown), one csv and one figure (svg).

    python3 papers/stability/map.py out/stability [papers/stability]

reads coulomb, flat and laws below the first folder, writes map.csv, map.md and map.svg into the second (default: the first).
A cell is
  converged  done, no step was cut
  cut        done, steps were cut on the way
  snapped    done, across at least one snap (energy set free)
  physical   ended at a limit that the program names at the last equilibrium: interlock or crease
  failed     ended for another reason
"""

import csv
import sys
from pathlib import Path

CLASSES = {
    "converged": ("#2a788e", "o"),
    "cut": ("#7ad151", "c"),
    "snapped": ("#fde725", "s"),
    "physical": ("#b0b0b0", "p"),
    "failed": ("#d62728", "x"),
}
MEANING = {
    "converged": "converged, no cut",
    "cut": "converged, steps cut",
    "snapped": "converged across a snap",
    "physical": "ended: interlock or crease",
    "failed": "failed",
}
LIMITS = {"interlock": "interlock", "creases": "crease"}


def classified(row):
    """Class of a row of study.csv, and the limit or reason where it ended early."""
    if row["status"] == "done":
        kind = "snapped" if float(row["snaps"]) > 0 else "cut" if float(row["cuts"]) > 0 else "converged"
        return kind, ""
    limits = [name for word, name in LIMITS.items() if word in row["reason"]]
    if row["status"] == "not converged" and limits:
        return "physical", " + ".join(limits)
    return "failed", f"{row['status']}: {row['reason']}"


def basis_of(text):
    """`NURBS 2` as it is; a table of the scene in the same form."""
    if "{" not in text:
        return text
    entries = dict(part.split("=") for part in text.strip("{ }").split(","))
    entries = {key.strip(): value.strip().strip('"') for key, value in entries.items()}
    return {"nurbs": "NURBS", "lagrange": "Lagrange"}[entries["type"]] + " " + entries["degree"]


def cells(folder):
    for study in ("flat", "coulomb", "laws"):
        table = folder / study / "study.csv"
        if not table.exists():
            continue
        with table.open(newline="") as file:
            for row in csv.DictReader(file):
                if row["status"] in ("pending", "running", "interrupted"):
                    continue
                kind, why = classified(row)
                law = row["law"] if study == "laws" else f"mu = {float(row['mu']):g}"
                yield {
                    "angle": float(row.get("angle", 0)), "law": law, "basis": basis_of(row["basis"]), "class": kind,
                    "reached": row["reached"], "cuts": row["cuts"], "snaps": row["snaps"],
                    "iterations": row["iterations"], "wall_s": row["wall_s"], "why": why,
                }  # fmt: skip


def distinct(rows, key):
    return list(dict.fromkeys(row[key] for row in rows))


def markdown(rows):
    angles, laws, bases = sorted(distinct(rows, "angle")), distinct(rows, "law"), distinct(rows, "basis")
    at = {(row["angle"], row["law"], row["basis"]): row["class"] for row in rows}
    lines = []
    for law in laws:
        lines += [f"| {law} | " + " | ".join(f"{a:g}°" for a in angles) + " |", "|---" * (len(angles) + 1) + "|"]
        for basis in bases:
            line = [at.get((angle, law, basis), "") for angle in angles]
            if any(line):
                lines.append(f"| {basis} | " + " | ".join(line) + " |")
        lines.append("")
    counts = {kind: sum(row["class"] == kind for row in rows) for kind in CLASSES}
    lines.append(f"{len(rows)} cells: " + ", ".join(f"{count} {kind}" for kind, count in counts.items()) + ".")
    return "\n".join(lines) + "\n"


def svg(rows):
    """One panel a basis: angles to the right, laws upwards."""
    angles, laws, bases = sorted(distinct(rows, "angle")), distinct(rows, "law"), distinct(rows, "basis")
    at = {(row["angle"], row["law"], row["basis"]): row["class"] for row in rows}
    side, left, top, across = 26, 100, 60, 3
    width, height = left + side * len(angles) + 20, side * len(laws) + 62
    down = -(-len(bases) // across)
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{max(width * across, 14 + 205 * len(CLASSES))}" height="{top + height * down}" '
        'font-family="sans-serif" font-size="12"><rect width="100%" height="100%" fill="white"/>'
    ]
    for k, kind in enumerate(CLASSES):
        colour, sign = CLASSES[kind]
        x = 14 + 205 * k
        out.append(f'<rect x="{x}" y="12" width="20" height="20" fill="{colour}" stroke="white"/>')
        out.append(f'<text x="{x + 10}" y="26" text-anchor="middle">{sign}</text><text x="{x + 26}" y="26">{MEANING[kind]}</text>')
    for k, basis in enumerate(bases):
        x0, y0 = left + width * (k % across), top + height * (k // across)
        out.append(f'<text x="{x0 + side * len(angles) / 2}" y="{y0}" text-anchor="middle" font-weight="bold">{basis}</text>')
        for j, law in enumerate(laws):
            y = y0 + 8 + side * (len(laws) - 1 - j)
            out.append(f'<text x="{x0 - 6}" y="{y + side / 2 + 4}" text-anchor="end">{law}</text>')
            for i, angle in enumerate(angles):
                x = x0 + side * i
                colour, sign = CLASSES.get(at.get((angle, law, basis)), ("#f4f4f4", ""))
                out.append(f'<rect x="{x}" y="{y}" width="{side}" height="{side}" fill="{colour}" stroke="white"/>')
                out.append(f'<text x="{x + side / 2}" y="{y + side / 2 + 4}" text-anchor="middle">{sign}</text>')
        foot = y0 + 8 + side * len(laws) + 14
        out += [f'<text x="{x0 + side * (i + 0.5)}" y="{foot}" text-anchor="middle">{a:g}°</text>' for i, a in enumerate(angles)]
        if k // across == down - 1 or k + across >= len(bases):
            out.append(f'<text x="{x0 + side * len(angles) / 2}" y="{foot + 17}" text-anchor="middle">steepest flank</text>')
    return "\n".join(out + ["</svg>"]) + "\n"


def main():
    source = Path(sys.argv[1])
    target = Path(sys.argv[2]) if len(sys.argv) > 2 else source
    rows = list(cells(source))
    if not rows:
        sys.exit(f"{source}: no table of flat, coulomb or laws with a point that is over")
    with (target / "map.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    (target / "map.md").write_text(markdown(rows))
    (target / "map.svg").write_text(svg(rows))
    print(markdown(rows).splitlines()[-1])


if __name__ == "__main__":
    main()
