#!/usr/bin/env python3
"""Is the recommendation of `asperity trade` right?  python3 papers/trade/check.py ASPERITY SCENE TRADE_FOLDER OUT.csv GRID.csv

Computes an exhaustive grid of settings of SCENE, each in a process of its own, against a reference of its own (NURBS 3, four times
the elements and steps). For every target the settings that TRADE_FOLDER/trade.csv recommends (the cheapest whose bound is at most
the target) are computed in the same way, and compared with the cheapest of the grid that meets the target. The error norm is
written here a second time, from the words of trade.md. GRID.csv is written once, with GRID.csv.json (the reference) beside it.
TRADE_FOLDER may be `-`: the grid only. Standard library only.
"""
import csv, itertools, json, math, os, subprocess, sys, tempfile

TARGETS = [0.1, 0.05, 0.03, 0.01, 0.005]
BASES = [("nurbs", 1), ("nurbs", 2), ("nurbs", 3), ("nurbs", 4), ("lagrange", 1), ("lagrange", 2)]
SIZES = [0.5, 2 ** -0.5, 1.0, 2 ** 0.5]
STEPS = [0.5, 1.0]
CONTACTS = [("quadrature", "element"), ("quadrature", "segment"), ("nodal", "element")]
QUANTITIES = ["fx", "fy", "mu_global"]
REFERENCE = 4.0, 4.0  # elements, steps
CHEAP, TRIES = 0.5, 3  # runs below so many seconds are timed so often


def toml(value):
    """A value of JSON in one line of TOML."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(k)} = {toml(v)}" for k, v in value.items() if v is not None) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(toml(v) for v in value) + "]"
    return json.dumps(value)


def run(program, scene, folder):
    """History of a scene (a dict as in run.json) and the CPU time of the process; None if it failed."""
    scene = dict(scene, output={"fields": 0, "interface": 0, "figures": False})
    path = os.path.join(folder, "scene.toml")
    with open(path, "w") as file:
        file.writelines(f"{k} = {toml(v)}\n" for k, v in scene.items())
    best = math.inf
    for _ in range(TRIES):
        process = subprocess.Popen([program, "run", path, "--out", os.path.join(folder, "out"), "--quiet"],
                                   stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode not in (0, 4):
            return None, math.nan
        best = min(best, usage.ru_utime + usage.ru_stime)
        if best > CHEAP:
            break
    with open(os.path.join(folder, "out", "history.csv")) as file:
        rows = list(csv.DictReader(file))
    names = ["time", "contact_length"] + QUANTITIES
    return {name: [float(row[name]) for row in rows] for name in names}, best


def at(curve, name, time):
    """Straight line between the nominal times."""
    times, values = curve["time"], curve[name]
    above = next((k for k, t in enumerate(times) if t >= time - 1e-12), len(times) - 1)
    if above == 0 or abs(times[above] - time) < 1e-12:
        return values[above]
    share = (time - times[above - 1]) / (times[above] - times[above - 1])
    return (1 - share) * values[above - 1] + share * values[above]


def error(history, reference, name):
    """Root mean square over the time in contact, relative to the peak; see trade.md."""
    peak_fy = max(map(abs, reference["fy"]))
    loaded = [abs(f) if abs(f) > 0.02 * peak_fy else 0.0 for f in reference["fy"]]
    touching = [1.0 if length > 0 else 0.0 for length in reference["contact_length"]]
    weighted = dict(reference, weight=loaded if name == "mu_global" else touching)
    peak = max(abs(v) for v, w in zip(reference[name], weighted["weight"]) if w > 0 and math.isfinite(v))
    times = min(history["time"], reference["time"], key=len)
    total = weights = 0.0
    for k, time in enumerate(times):
        wanted, weight = at(weighted, name, time), at(weighted, "weight", time)
        if not (weight > 0 and math.isfinite(wanted)):
            continue
        weight *= 0.5 * (times[min(k + 1, len(times) - 1)] - times[max(k - 1, 0)])
        found = at(history, name, time)
        total += weight * ((found if math.isfinite(found) else 0.0) - wanted) ** 2
        weights += weight
    return math.sqrt(total / weights) / peak


def under(scene, basis, size, steps, contact):
    scene = json.loads(json.dumps(scene))
    for body in scene["body"].values():
        body["elements"] = [max(1, int(n * size + 0.5)) for n in body["elements"]]
        if not body["rigid"]:
            body["basis"] = {"type": basis[0], "degree": basis[1]}
    scene["time"]["steps"] = int(scene["time"]["steps"] * steps + 0.5)
    for pair in scene["contact"]:
        pair["numerics"].update(sites=contact[0], integration=contact[1])
    return scene


def given_scene(program, scene_file, folder):
    """The scene with all defaults."""
    given = os.path.join(folder, "given")
    subprocess.run([program, "run", scene_file, "--out", given, "--quiet"], check=True)
    with open(os.path.join(given, "run.json")) as file:
        return json.load(file)["scene"]


def compute_grid(program, scene, folder, path):
    """Every setting of the grid, and the reference, into files."""
    reference, _ = run(program, under(scene, ("nurbs", 3), *REFERENCE, ("quadrature", "element")), folder)
    quantities = counting(scene)
    with open(path, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["basis", "elements", "steps", "sites", "integration", "error", "cpu_s"])
        for basis, size, steps, contact in itertools.product(BASES, SIZES, STEPS, CONTACTS):
            history, cpu = run(program, under(scene, basis, size, steps, contact), folder)
            found = max(error(history, reference, q) for q in quantities) if history else math.nan
            table.writerow(["%s %d" % basis, f"{size:.3g}", steps, *contact, f"{found:.3e}", f"{cpu:.3f}"])
            file.flush()
    with open(path + ".json", "w") as file:
        json.dump(reference, file)


def counting(scene):
    """Quantities that are not prescribed."""
    vertical = scene["drive"][0].get("y") or {}
    return [q for q in QUANTITIES if q != "fy" or "force" not in vertical]


def main():
    program, scene_file, trade, out, grid_file = sys.argv[1:6]
    program = os.path.abspath(program)
    with tempfile.TemporaryDirectory() as folder:
        scene = given_scene(program, scene_file, folder)
        if not os.path.exists(grid_file + ".json"):
            compute_grid(program, scene, folder, grid_file)
        if trade == "-":
            return
        with open(grid_file + ".json") as file:
            reference = json.load(file)
        with open(grid_file) as file:
            grid = [g for g in csv.DictReader(file) if g["error"] != "nan"]
        with open(os.path.join(trade, "trade.csv")) as file:
            points = [p for p in csv.DictReader(file) if p["role"] == "candidate" and p["bound"] != "nan"]
        with open(out, "w", newline="") as file:
            table = csv.writer(file)
            table.writerow(["target", "recommended", "error", "cpu_s", "met", "best_of_grid", "best_error", "best_cpu_s", "ratio"])
            for target in TARGETS:
                cost = lambda row: float(row["cpu_s"])
                best = min((g for g in grid if float(g["error"]) <= target), key=cost, default=None)
                fit = min((p for p in points if float(p["bound"]) <= target), key=cost, default=None)
                row = [target] + ["not reached"] + [""] * 3
                if fit:
                    with open(os.path.join(trade, fit["folder"], "run.json")) as run_json:
                        history, cpu = run(program, json.load(run_json)["scene"], folder)
                    found = max(error(history, reference, q) for q in counting(scene))
                    words = f"{fit['basis']}, elements x {float(fit['elements']):.2f}, grading x {fit['grading']}, {fit['steps']} steps"
                    words += "; " + fit["choices"] if fit["choices"] else ""
                    row = [target, words, f"{found:.2e}", f"{cpu:.3f}", found <= target]
                if best:
                    name = f"{best['basis']}, elements x {best['elements']}, steps x {best['steps']}, {best['sites']}, {best['integration']}"
                    row += [name, best["error"], best["cpu_s"], f"{cpu / cost(best):.2f}" if fit else ""]
                table.writerow(row)


main()
