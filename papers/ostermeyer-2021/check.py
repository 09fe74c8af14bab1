"""The identities that the passes of a study must obey, and the rigid flank, from the tables that `asperity sweep` writes.

    python3 check.py out/single      # identity, energy, net work
    python3 check.py out/load        # the same, and the mean of mu_global over the one of rigid flanks

Nothing but the standard library is needed.
"""
import csv
import math
import pathlib
import sys

L = 1.6  # wavelength of the scenes


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def number(row, name):
    return float(row[name])


def absolute_work(history):
    """Work of the resistance, driving and driven parts added."""
    pairs = zip(history, history[1:])
    return sum(abs(number(b, "fx") + number(a, "fx")) / 2 * (number(b, "drive_x") - number(a, "drive_x")) for a, b in pairs)


def checks(study, points):
    """Worst deviations over all steps of all passes, and where."""
    identity, balance, net, judged = (0, ""), (0, ""), (0, ""), 0
    for point in points:
        place = {name: point[name] for name in ("modulus", "angle", "mu", "overlap", "n", "spread") if name in point}
        history = rows(study / point["folder"] / "history.csv")
        peak = max(abs(number(row, "fy")) for row in history)
        mu = number(point, "mu")
        for row in history:
            # while one body is pressed down between two asperities, the contacts slip in opposite directions
            dragged = number(row, "drive_x") > 0
            if row["fully_slipping"] != "true" or not dragged or mu == 0 or abs(number(row, "fy")) < 1e-3 * peak:
                continue
            expected = math.tan(math.atan(mu) + number(row, "contact_angle"))
            off = abs(number(row, "mu_global") - expected) / max(1, abs(expected))
            identity = max(identity, (off, place), key=lambda pair: pair[0])
            judged += 1
        last = history[-1]
        # pressing, and pushing out an overlap to start with, is set aside
        pressed = [row for row in history if number(row, "drive_x") == 0][-1:]

        def spent(name):
            return number(last, name) - sum(number(row, name) for row in pressed)

        open_ = spent("external_work") - sum(map(spent, ["strain_energy", "dissipated", "snap_loss"]))
        turnover = max(max(number(row, "strain_energy") for row in history), absolute_work(history))
        balance = max(balance, (abs(open_) / turnover, place), key=lambda pair: pair[0])
        if mu == 0 and spent("snap_loss") == 0:
            cost = spent("external_work") - spent("strain_energy")
            net = max(net, (abs(cost) / turnover, place), key=lambda pair: pair[0])
    print(f"{len(points)} passes, {judged} fully slipping steps")
    print("mu_global - tan(atan mu + contact_angle), worst:          %.1e at %s" % identity)
    print("W - U - D - snap loss of the sliding, over absolute work: %.1e at %s" % balance)
    print("mu = 0 without snap: net over absolute work:              %.1e at %s" % net)


def rigid(angle, mu, low, high, count=2000):
    """Mean of tan(atan mu + theta) over the path of rigid cosine asperities, -tan theta = h'(x/2)."""
    slope = math.tan(math.radians(angle))
    places = [low + (high - low) * (k + 0.5) / count for k in range(count)]
    return sum(math.tan(math.atan(mu) + math.atan(-slope * math.sin(math.pi * x / L))) for x in places) / count


def flanks(points):
    """mu_global, mean over |x| <= 0.6, for each modulus against the mean of rigid flanks."""
    moduli = sorted({number(point, "modulus") for point in points})
    print("\nangle  mu    rigid   E = " + "  ".join(f"{modulus:7.3g}" for modulus in moduli))
    table = {tuple(number(p, name) for name in ("angle", "mu", "modulus")): p["mu_mean"] for p in points}
    for angle, mu in sorted({(number(p, "angle"), number(p, "mu")) for p in points}):
        means = "  ".join(f"{float(table[angle, mu, modulus]):7.4f}" for modulus in moduli)
        print(f"{angle:5.0f}  {mu:4.2f} {rigid(angle, mu, -0.6, 0.6):7.4f}       {means}")


def main():
    study = pathlib.Path(sys.argv[1])
    points = [row for row in rows(study / "study.csv") if row["status"] == "done"]
    checks(study, points)
    if "modulus" in points[0]:
        flanks(points)


main()
