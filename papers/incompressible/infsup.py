"""Discrete inf-sup constants of splines with discontinuous dilatations on blocks of elements (needs numpy and scipy).

Unit square, uniform mesh, displacement zero on the boundary: singular values of M^(-1/2) B A^(-1/2), with A the vector
Laplacian, B the divergence against an orthonormal basis of the dilatations; the smallest belongs to the constant.
"""

import numpy as np
import scipy.linalg as sl
from numpy.polynomial.legendre import Legendre, leggauss
from scipy.interpolate import BSpline


def splines(p, n):
    """Gauss points, weights, values and slopes of the interior functions on n unit elements."""
    x, w = leggauss(p + 1)
    knots = np.r_[[0] * p, np.arange(n + 1), [n] * p].astype(float)
    points = (np.arange(n)[:, None] + (x + 1) / 2).ravel()
    functions = [BSpline(knots, np.eye(n + p)[i], p) for i in range(1, n + p - 1)]
    values = np.array([f(points) for f in functions]).T
    slopes = np.array([f.derivative()(points) for f in functions]).T
    return points, np.tile(w / 2, n), values, slopes


def parts(n, size):
    """Ends of the blocks, as in src/bulk/volume.rs."""
    full = max(n // size, 1)
    count = full + (full % 2 == 0 and n % 2 == 1)
    length, larger, half = n // count, n % count, count // 2
    ends = [0]
    for k in range(count):
        pair = min(k, count - 1 - k)
        ends.append(ends[-1] + length + (larger % 2 == 1 if pair == half else pair + larger // 2 >= half))
    return ends


def moments(ends, degree, points, w, f):
    """Integrals against orthonormal Legendre polynomials: block, degree, function."""
    def one(a, b, d):
        inside = (points > a) & (points < b)
        phi = Legendre.basis(d)((2 * points[inside] - a - b) / (b - a)) * np.sqrt((2 * d + 1) / (b - a))
        return (w[inside] * phi) @ f[inside]
    return np.array([[one(a, b, d) for d in range(degree + 1)] for a, b in zip(ends, ends[1:])])


def infsup(p, block, degree, n):
    points, w, values, slopes = splines(p, n)
    mass, stiffness = values.T @ (w[:, None] * values), slopes.T @ (w[:, None] * slopes)
    ends = parts(n, block)
    m, d = moments(ends, degree, points, w, values), moments(ends, degree, points, w, slopes)
    blocks = range(len(ends) - 1)
    pairs = [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]
    rows = [np.r_[np.kron(d[a, i], m[b, j]), np.kron(m[a, i], d[b, j])] for a in blocks for b in blocks for i, j in pairs]
    lower = np.linalg.cholesky(np.kron(stiffness, mass) + np.kron(mass, stiffness))
    half = [sl.solve_triangular(lower, part.T, lower=True).T for part in np.hsplit(np.array(rows), 2)]
    values = np.linalg.svd(np.hstack(half), compute_uv=False)
    missing = max(len(rows) - len(values), 0)
    return np.sort(np.r_[values, np.zeros(missing)])[1]


for p, spaces in {
    1: [(1, 0), (2, 0)],
    2: [(1, 0), (2, 1), (3, 1), (4, 2)],
    3: [(1, 0), (2, 1), (4, 2)],
    4: [(1, 0), (2, 1), (4, 3), (4, 2)],
    5: [(1, 0), (4, 2)],
}.items():
    for block, degree in spaces:
        found = ", ".join(f"{infsup(p, block, degree, n):.2f}" for n in (8, 9, 12, 16, 17, 20, 24))
        print(f"degree {p}, polynomials of degree {degree} on {block} x {block}: {found}", flush=True)
