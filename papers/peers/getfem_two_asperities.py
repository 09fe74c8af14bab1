#!/usr/bin/python3
"""Two soft asperities slide over each other at constant height, computed with GetFEM.

The scene is that of `lagrange.toml` and `nurbs.toml` beside this file. Profile `h(x) = H/2 (1 + cos(2 pi x/L))` for
`|x| <= L/2`; lower body 4 wide, upper body 2 wide and upside down, both 1 thick, tips overlapping by 0.2; neo-Hookean,
plane strain, E = 1, nu = 0.3. The top edge of the upper body is driven by 3.8 to the right in equal steps.

Contact: GetFEM's integral large-sliding brick (raytracing, both sides deformed; Poulios and Renard, Computers and
Structures 153, 2015), multiplier of degree 1 on the upper body, Coulomb friction with backward Euler steps. The bodies
are Q1 (`--degree 1`) or Q2 (`--degree 2`), on uniform elements or on graded ones (`--growth 0.12`).

Needs Debian's python3-getfem, hence the system python; one thread for a fair time:

  OMP_NUM_THREADS=1 /usr/bin/python3 getfem_two_asperities.py --degree 1 --size 0.05 --steps 76 --out q1.csv

Writes one row per step: step,drive,Fx,Fy,iterations,cpu_s. As in asperity's history.csv, `drive` is the displacement of
the driven edge, Fx the resistance to sliding and Fy > 0 the support it feels. Prints the number of unknowns.
"""
import argparse
import csv
import time

import getfem as gf
import numpy as np

HEIGHT, WAVELENGTH, OVERLAP = 0.4, 1.6, 0.2
YOUNG, POISSON = 1.0, 0.3
START, TRAVEL = -1.9, 3.8

# Settings of the brick (augmentation in E per length; rays longer than the release distance find no partner) and of
# Newton's method. At level 1 augmentations of 1, 10, 100 take 91, 102, 430 iterations, a release distance of 0.3 takes
# 103, and without the predictor there are 177.
AUGMENTATION, RELEASE = 10.0, 0.1
RESIDUAL, MAX_ITERATIONS, MAX_CUTS = 1e-8, 40, 4
ORDERS = {1: (3, 5), 2: (5, 7)}  # of integration in the bulk and on the contact edge, by degree
CONTACT, FAR = 1, 2  # numbers of the mesh regions


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--degree", type=int, choices=(1, 2), default=1, help="of displacements and geometry")
    parser.add_argument("--size", type=float, default=0.05, help="of the lower body's elements at the contact")
    parser.add_argument("--growth", type=float, default=0.0, help="of the size per length away from the contact")
    parser.add_argument("--half", type=float, default=0.6, help="half width of the zone of smallest elements")
    parser.add_argument("--steps", type=int, default=76)
    parser.add_argument("--friction", type=float, default=0.3)
    parser.add_argument("--out", required=True, help="csv file")
    return parser.parse_args()


def profile(x):
    return np.where(np.abs(x) <= WAVELENGTH / 2, HEIGHT / 2 * (1 + np.cos(2 * np.pi * x / WAVELENGTH)), 0.0)


def breaks(start, end, size, half, growth):
    """Ends of elements that have `size` within `half` of 0 and grow linearly with the distance outside."""
    x = np.linspace(start, end, 20001)
    density = 1.0 / (size + growth * np.maximum(np.abs(x) - half, 0.0))
    count = np.concatenate([[0.0], np.cumsum((density[1:] + density[:-1]) / 2 * np.diff(x))])
    return np.interp(np.linspace(0.0, count[-1], int(round(count[-1])) + 1), count, x)


def body(width, size, options, place):
    """Mesh of a body; `place(x, t)` maps the position along and the depth 0..1 from the contact edge into the plane."""
    along = breaks(-width / 2, width / 2, size, options.half, options.growth)
    depth = breaks(0.0, 1.0, size, 0.0, options.growth)
    n = [len(along) - 1, len(depth) - 1]
    shape = "GT='GT_QK(2,%d)';ORG=[0,0];SIZES=[%d,%d];NSUBDIV=[%d,%d]" % (options.degree, *n, *n)
    mesh = gf.Mesh("import", "structured", shape)
    mesh.set_region(CONTACT, mesh.outer_faces_with_direction([0.0, -1.0], 0.01))
    mesh.set_region(FAR, mesh.outer_faces_with_direction([0.0, 1.0], 0.01))
    i, j = mesh.pts()
    mesh.set_pts(np.vstack(place(np.interp(i, np.arange(n[0] + 1), along), np.interp(j, np.arange(n[1] + 1), depth))))
    return mesh


def stress_power(u):
    """First Piola-Kirchhoff stress of `psi = mu/2 (I1 - 3 - 2 ln J) + lambda/2 (ln J)^2`, times the test gradient."""
    f = "(Id(2)+Grad_%s)" % u
    return "(mu*%s + (lame*log(Det(%s))-mu)*(Inv(%s))'):Grad_Test_%s" % (f, f, f, u)


class TwoAsperities:
    """The GetFEM model, its state, and the way to advance it."""

    def __init__(self, options):
        gap = 2 * HEIGHT - OVERLAP
        lower = body(4.0, options.size, options, lambda x, t: (x, profile(x) * (1 - t) - t))
        upper = body(2.0, 0.93 * options.size, options, lambda x, t: (x + START, gap - profile(x) * (1 - t) + t))
        self.model = model = gf.Model("real")
        model.add_initialized_data("mu", YOUNG / (2 * (1 + POISSON)))
        model.add_initialized_data("lame", YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)))
        self.bulk, self.surface = {}, {}  # GetFEM does not keep what the interpreter forgets
        for name, mesh in (("lower", lower), ("upper", upper)):
            fem = gf.MeshFem(mesh, 2)
            fem.set_classical_fem(options.degree)
            self.bulk[name], self.surface[name] = (gf.MeshIm(mesh, order) for order in ORDERS[options.degree])
            model.add_fem_variable(name, fem)
            model.add_fem_data(name + "_before", fem)
            model.add_initialized_data(name + "_edge", [0.0, 0.0])
            model.add_nonlinear_term(self.bulk[name], stress_power(name))
            model.add_Dirichlet_condition_with_simplification(name, FAR, name + "_edge")
        self.edge = fem.basic_dof_on_region(FAR)
        self.add_contact(upper, options.friction)

    def add_contact(self, upper, friction):
        model = self.model
        trace = gf.MeshFem(upper, 2)
        trace.set_classical_fem(1)
        model.add_filtered_fem_variable("traction", trace, CONTACT)
        for name, value in (("augmentation", AUGMENTATION), ("friction", friction), ("rate", 1.0)):
            model.add_initialized_data(name, value)
        brick = model.add_integral_large_sliding_contact_brick_raytracing("augmentation", RELEASE, "friction", "rate")
        model.add_slave_contact_boundary_to_large_sliding_contact_brick(
            brick, self.surface["upper"], CONTACT, "upper", "traction", "upper_before")
        model.add_master_contact_boundary_to_large_sliding_contact_brick(
            brick, self.surface["lower"], CONTACT, "lower", "lower_before")

    def force(self):
        """What holds the driven edge: internal forces of the upper body there, in the signs of history.csv."""
        start, _ = self.model.interval_of_variable("upper")
        internal = gf.asm_generic(self.bulk["upper"], 1, stress_power("upper"), -1, self.model)
        at = start + self.edge
        return internal[at[self.edge % 2 == 0]].sum(), -internal[at[self.edge % 2 == 1]].sum()

    def attempt(self, start, end):
        """One increment of the driven edge, predicted by moving the upper body as one piece: (iterations, success)."""
        model = self.model
        for name in ("lower", "upper"):
            model.set_variable(name + "_before", model.variable(name))
        moved = model.variable("upper").copy()
        moved[0::2] += end - start
        model.set_variable("upper", moved)
        model.set_variable("upper_edge", [end, 0.0])
        try:
            iterations, converged = model.solve("max_iter", MAX_ITERATIONS, "max_res", RESIDUAL, "lsolver", "mumps")
        except RuntimeError:  # e.g. a ray that finds no end, an inverted element
            return 0, False
        return iterations, bool(converged) and bool(np.isfinite(model.variable("upper")).all())

    def advance(self, start, end):
        """From `start` to `end`, halving the increment where it fails; returns the iterations, lost ones included."""
        shortest = (end - start) / 2**MAX_CUTS
        iterations, targets = 0, [end]
        while targets:
            kept = {name: self.model.variable(name).copy() for name in ("lower", "upper", "traction")}
            used, success = self.attempt(start, targets[-1])
            iterations += used
            if success:
                start = targets.pop()
                continue
            if (targets[-1] - start) / 2 < 0.999 * shortest:
                raise SystemExit("no equilibrium found at drive %g after %d cuts" % (targets[-1], MAX_CUTS))
            for name, value in kept.items():
                self.model.set_variable(name, value)
            targets.append((start + targets[-1]) / 2)
        return iterations


def main():
    options = arguments()
    gf.util_trace_level(1)
    gf.util_warning_level(1)
    problem = TwoAsperities(options)
    print("unknowns", problem.model.nbdof(), flush=True)
    drive = np.linspace(0.0, TRAVEL, options.steps + 1)
    with open(options.out, "w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["step", "drive", "Fx", "Fy", "iterations", "cpu_s"])
        for step in range(1, options.steps + 1):
            before = time.process_time()
            iterations = problem.advance(drive[step - 1], drive[step])
            cpu = time.process_time() - before
            fx, fy = problem.force()
            rows.writerow([step, "%.9g" % drive[step], "%.10g" % fx, "%.10g" % fy, iterations, "%.4f" % cpu])
            file.flush()


if __name__ == "__main__":
    main()
