"""Certifies the benchmark scenes with both kinds of sites and writes table.md: what agrees, how closely, at what cost.

    cargo build --release && python3 papers/certify/certify.py [target/release/asperity]
"""

import json
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).parent
ROOT = HERE.parent.parent
PROGRAM = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "target/release/asperity")
SITES = ["quadrature", "nodal"]
CASES = [("hertz", []), ("cattaneo_mindlin", [])]
CASES += [("single_asperity", [f"contact.0.law.friction={mu}"]) for mu in ["0.0", "0.1", "0.3", "1.0"]]
CASES += [("single_asperity", ["contact.0.law.friction=0.3", "time.steps=19"])]
CASES += [("multi_asperity", [])]
HEAD = [
    "scene", "sites", "steps", "agree", "inconclusive", "disagree", "dp", "dq", "dFx", "dFy",
    "Newton iterations", "programmes", "Newton, s", "conic, s", "rescued", "cuts",
]


def certify(scene, sets, sites, out):
    sets = sets + [f'contact.0.numerics.sites="{sites}"', "output.fields=0", "output.interface=0"]
    arguments = [word for value in sets for word in ("--set", value)]
    command = [PROGRAM, "certify", str(ROOT / "examples" / f"{scene}.toml"), "--out", str(out), "--quiet", *arguments]
    subprocess.run(command, check=False)
    return json.loads((out / "run.json").read_text())["result"]


def row(scene, sets, sites):
    label = lambda value: value.split("=")[0].split(".")[-1] + " = " + value.split("=")[1]
    name = ", ".join([scene] + [label(value) for value in sets])
    out = ROOT / "out" / "certify" / f"{name} {sites}".replace(" ", "_").replace(",", "")
    result = certify(scene, sets, sites, out)
    found, counters = result["certified"], result["counters"]
    largest = found["largest"]
    cells = [name, sites, found["steps"], found["agrees"], found["inconclusive"], found["disagrees"]]
    cells += [f"{largest[key]:.1e}" for key in ("dp", "dq", "dfx", "dfy")]
    cells += [found["newton_iterations"], found["programmes"], f"{found['newton_s']:.1f}", f"{found['conic_s']:.1f}"]
    cells += [counters["rescued_steps"], counters["cuts"]]
    if result["status"] != "done":
        cells[0] += f" ({result['status']} at {result['time_reached']:.3f})"
    return cells


def main():
    lines = ["| " + " | ".join(HEAD) + " |", "|" + "---|" * len(HEAD)]
    for scene, sets in CASES:
        for sites in SITES:
            lines.append("| " + " | ".join(str(cell) for cell in row(scene, sets, sites)) + " |")
            print(lines[-1], flush=True)
            (HERE / "table.md").write_text("\n".join(lines) + "\n")


main()
