#!/usr/bin/env python3
"""Runs asperity and GetFEM in turn on the two-asperity problem and prints what the same answer costs.

  cargo build --release
  python3 papers/peers/compare.py                 the table, written to results.md (7 minutes)
  python3 papers/peers/compare.py --quick         the two cheap comparisons, once each, printed only
  python3 papers/peers/compare.py --study         error against cost of many settings, once each, written to study.md
  python3 papers/peers/compare.py --reference     the converged solution, written to reference.csv

Cost is the CPU time of the whole process (user and system, start and output included), one thread, the median over the
repetitions; the programs take turns in each repetition. The force error is the largest difference of Fx over the steps
from the converged solution at the same places, divided by the largest Fx. Python's standard library is enough here;
GetFEM needs the interpreter it is installed for. Without it asperity runs alone.
"""
import argparse
import csv
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGE = HERE.parents[1]
ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "RAYON_NUM_THREADS")}
COUNTS = {"lower": (18, 4), "upper": (16, 4)}  # elements of nurbs.toml
REFERENCE = 10  # refinement of the converged solution
REFERENCE_STEPS = 152


class Asperity:
    """One scene with some of its values replaced."""

    program = "asperity"

    def __init__(self, setting, scene, steps, sets):
        self.setting, self.scene, self.steps = setting, scene, steps
        self.sets = ["time.steps=%d" % steps, *sets]

    def command(self, options, out):
        sets = [word for value in self.sets for word in ("--set", value)]
        return [options.asperity, "run", HERE / self.scene, "--quiet", "--out", out, *sets]

    def result(self, out, _printed):
        rows = read(out / "history.csv")
        unknowns = json.loads((out / "run.json").read_text())["model"]["unknowns"]
        return unknowns, sum(int(row["newton_iterations"]) for row in rows), [float(row["fx"]) for row in rows]


class GetFEM:
    """One run of `getfem_two_asperities.py`."""

    program = "GetFEM"

    def __init__(self, setting, steps, **values):
        self.setting, self.steps = setting, steps
        self.values = [word for key, value in values.items() for word in ("--" + key, str(value))]

    def command(self, options, out):
        script = HERE / "getfem_two_asperities.py"
        return [options.getfem, script, "--steps", str(self.steps), "--out", out / "force.csv", *self.values]

    def result(self, out, printed):
        rows = read(out / "force.csv")
        unknowns = next(int(line.split()[1]) for line in printed.splitlines() if line.startswith("unknowns"))
        return unknowns, sum(int(row["iterations"]) for row in rows), [float(row["Fx"]) for row in rows]


def lagrange(level, steps=76):
    factor = 2 ** (level - 1)
    upper = (43, 22) if level == 1 else (86, 43)
    sets = ["body.lower.elements=[%d, %d]" % (80 * factor, 20 * factor), "body.upper.elements=[%d, %d]" % upper]
    return Asperity("Lagrange p = 1, size %g" % (0.05 / factor), "lagrange.toml", steps, sets)


def nurbs(degree, refinement, steps=76, across=None):
    counts = {name: (round(n * refinement), across or round(m * refinement)) for name, (n, m) in COUNTS.items()}
    sets = ["body.%s.basis={ type = 'nurbs', degree = %d }" % (name, degree) for name in counts]
    sets += ["body.%s.elements=[%d, %d]" % (name, *count) for name, count in counts.items()]
    setting = "NURBS p = %d, %d x %d and %d x %d" % (degree, *counts["lower"], *counts["upper"])
    return Asperity(setting, "nurbs.toml", steps, sets)


def q1(size, steps=76):
    return GetFEM("Q1, size %g" % size, steps, degree=1, size=size)


def q2(size, growth, half, steps=76):
    return GetFEM("Q2, size %g, growth %g" % (size, growth), steps, degree=2, size=size, growth=growth, half=half)


TABLE = {
    "Level 1, same size, 76 steps": [lagrange(1), q1(0.05)],
    "Force error 1.2e-2, 76 steps": [nurbs(2, 1), q1(0.05), q2(0.1, 0.5, 0.35)],
    "Level 2, same size, 76 steps": [lagrange(2), q1(0.025)],
    "Force error 2e-3, 152 steps": [nurbs(3, 1.6, 152, across=5), q2(0.025, 0.12, 0.6, 152), q2(0.025, 0.5, 0.35, 152)],
}
QUICK = dict(list(TABLE.items())[:2])
STUDY = {
    "Splines, 76 steps": [nurbs(degree, k) for degree in (2, 3) for k in (0.9, 1, 1.25, 1.5, 1.75, 2, 2.5)],
    "Linear elements, 76 steps": [lagrange(1), q1(0.1), q1(0.05)],
    "GetFEM, mild grading, 76 steps": [q2(size, 0.12, 0.6) for size in (0.1, 0.05, 0.025)],
    "GetFEM, strong grading, 76 steps": [q2(size, 0.5, 0.35) for size in (0.1, 0.07, 0.05, 0.035, 0.025)],
    "Splines, 152 steps": [nurbs(3, 1.5, 152), nurbs(3, 1.6, 152, across=5), nurbs(3, 1.75, 152)],
    "GetFEM, strong grading, 152 steps": [q2(size, 0.5, 0.35, 152) for size in (0.05, 0.035, 0.025)],
}


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run(case, options):
    """Runs one case: process CPU time, unknowns, iterations, and Fx of every step."""
    with tempfile.TemporaryDirectory() as folder:
        before = children()
        done = subprocess.run(case.command(options, Path(folder)), env=os.environ | ONE_THREAD, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        cpu = children() - before
        if done.returncode != 0:
            raise SystemExit("%s, %s: exit code %d\n%s" % (case.program, case.setting, done.returncode, done.stderr))
        return cpu, *case.result(Path(folder), done.stdout)


def force_error(force, steps):
    if len(force) != steps:
        raise SystemExit("%d steps written instead of %d" % (len(force), steps))
    every = REFERENCE_STEPS // steps
    exact = [float(row["fx"]) for row in read(HERE / "reference.csv")[every - 1::every]]
    return max(abs(a - b) for a, b in zip(force, exact)) / max(map(abs, exact))


def table(title, cases, options, repetitions):
    """Markdown lines of one comparison; the ratio is CPU time over that of the first row."""
    cases = [case for case in cases if options.getfem or case.program == "asperity"]
    runs = [[] for _ in cases]
    for _ in range(repetitions):
        for case, done in zip(cases, runs):
            done.append(run(case, options))
            print("  %s, %s: %.2f s" % (case.program, case.setting, done[-1][0]), file=sys.stderr, flush=True)
    lines = ["", "## " + title, "", "| program | setting | unknowns | iterations | force error | CPU s | ratio |",
             "|---|---|---|---|---|---|---|"]
    first = None
    for case, done in zip(cases, runs):
        cpu = statistics.median(one[0] for one in done)
        first = first or cpu
        _, unknowns, iterations, force = done[0]
        lines.append("| %s | %s | %d | %d | %.1e | %.2f | %.1f |" % (
            case.program, case.setting, unknowns, iterations, force_error(force, case.steps), cpu, cpu / first))
    return lines


def said(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def machine(options, repetitions):
    """Where and with what the figures were made."""
    cpu = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), "?")
    getfem = said("dpkg-query", "-W", "-f", "${Version}", "python3-getfem") if options.getfem else "not installed"
    commit = said("git", "-C", str(PACKAGE), "rev-parse", "--short", "HEAD")
    return ["Machine: %s, %d cores, load %.1f at the start; one thread; median of %d." % (
                cpu, os.cpu_count(), os.getloadavg()[0], repetitions),
            "Versions: %s (commit %s), GetFEM %s." % (said(options.asperity, "--version"), commit, getfem)]


def reference(options):
    case = nurbs(2, REFERENCE, REFERENCE_STEPS)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(case.command(options, Path(folder)), env=os.environ | ONE_THREAD, check=True)
        rows = read(Path(folder) / "history.csv")
    with open(HERE / "reference.csv", "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["drive", "fx", "fy"])
        out.writerows(["%.9g" % float(row[key]) for key in ("drive_x", "fx", "fy")] for row in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    target = Path(os.environ.get("CARGO_TARGET_DIR", PACKAGE / "target"))
    parser.add_argument("--asperity", default=str(target / "release/asperity"), help="program to run")
    parser.add_argument("--getfem", default="/usr/bin/python3", help="interpreter that has GetFEM")
    parser.add_argument("--repetitions", type=int, default=3)
    for what in ("quick", "study", "reference"):
        parser.add_argument("--" + what, action="store_true")
    options = parser.parse_args()
    if not said(options.asperity, "--version"):
        raise SystemExit("%s does not run; build it with `cargo build --release`" % options.asperity)
    if options.reference:
        return reference(options)
    if not said(options.getfem, "-c", "import getfem; print(1)"):
        print("%s has no GetFEM: asperity alone" % options.getfem, file=sys.stderr)
        options.getfem = None
    repetitions = 1 if options.quick or options.study else options.repetitions
    lines = ["# Process CPU time of the two-asperity problem", "", *machine(options, repetitions)]
    for title, cases in (QUICK if options.quick else STUDY if options.study else TABLE).items():
        lines += table(title, cases, options, repetitions)
    print("\n".join(lines))
    if options.getfem and not options.quick:
        (HERE / ("study.md" if options.study else "results.md")).write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
