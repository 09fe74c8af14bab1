//! Gap, virtual slip and their linearisation at one nonmortar point, for both projections.
//!
//! # Local variables
//!
//! Everything at a point depends on eight numbers, the local vector
//!
//! ```text
//! z = (d, a, b, e),   d = x - y,  a = y',  b = y'',  e = x'      (primes: parameter derivatives)
//! ```
//!
//! and each control point moves `z` linearly at a fixed projection parameter: a nonmortar control point with shape
//! function `N` gives `(N, 0, 0, N')`, a mortar one with `M` gives `(-M, M', M'', 0)`. A row over degrees of freedom is
//! therefore a row of eight 'slots' times this map.
//!
//! # Closest point, `(x - y).a = 0`
//!
//! With `m = a.a`, `t = a/|a|`, `n` the outward mortar normal, `g = d.n`, `k = n.b`, `D = m - g k` (design section 4):
//!
//! ```text
//! dg  = dd.n                    dxi = (dd.a + g n.da) / D
//! virtual gap = dg              virtual slip = dd.t + g n.da/|a| = (D/m) |a| dxi
//! ```
//!
//! The factor `D/m = 1 - g k/m` makes the friction resultant exactly `q t`; with `|a| dxi` alone it would be `q t m/D`, and
//! `Fx/Fy = tan(atan mu + contact angle)` would hold only up to the penetration times the curvature. Both vanish under
//! rigid rotation (`dd = w x d`, `da = w x a`), so linear and angular momentum balance exactly.
//!
//! # Ray along the nonmortar normal, `x + g nu = y`
//!
//! Varying gives `dd + dg nu + g dnu = a dxi`, and with `tau = e/|e|`: `dnu = -tau (nu.de)/|e|`. With `c = -nu.n`:
//!
//! ```text
//! dg           = (dd.n + g dnu.n) / c           dxi = (dd.t + dg nu.t + g dnu.t) / |a|
//! virtual gap  = -dd.nu                         virtual slip = +-(dd.tau + g dnu.tau), positive along t
//! ```
//!
//! The virtual gap is not `dg` here: forces follow the nonmortar normal, which does not jump where the point passes a
//! corner of the mortar curve (`n` and `dg` do, and then no equilibrium may exist). The price is a tangent that is not
//! symmetric without friction. Pressure acts along `nu` and friction along `tau`, so `|q| = mu p` is a resultant at exactly
//! the friction angle. Both vanish under rigid rotation (`dd = -g dnu`), so that linear and angular momentum balance
//! exactly for any gap.

use num_dual::{DualNum, DualSVec64};

use super::interface::Projection;

/// Number of local slots: four plane vectors.
pub const SLOTS: usize = 8;

/// One number per slot.
pub type Slots<T = f64> = [T; SLOTS];

/// A square array over slots.
pub type SlotMatrix = [[f64; SLOTS]; SLOTS];

type Dual = DualSVec64<SLOTS>;

/// Plain or dual numbers over `f64`.
pub trait Scalar: DualNum<Primitive = f64> + Copy {}
impl<T: DualNum<Primitive = f64> + Copy> Scalar for T {}

/// Kinematics of a point as functions of its local vector.
#[derive(Clone, Copy, Debug)]
pub struct Frame<T = f64> {
    /// Gap, positive when open.
    pub gap: T,
    /// Coefficients of `dg`.
    pub gap_row: Slots<T>,
    /// Coefficients of the virtual gap, along which the pressure works; `dg` for the closest point.
    pub normal: Slots<T>,
    /// Coefficients of the virtual slip.
    pub tangential: Slots<T>,
    /// Coefficients of `dxi`.
    pub parameter: Slots<T>,
}

/// What does not change with the motion: the projection and the orientation of the two curves (outward normal =
/// `side * rot90(tangent)`).
#[derive(Clone, Copy, Debug)]
pub struct Orientation {
    /// Closest point or ray.
    pub projection: Projection,
    /// Side of the nonmortar curve.
    pub nonmortar: f64,
    /// Side of the mortar curve.
    pub mortar: f64,
}

impl Orientation {
    /// Evaluates the formulas of the module for any scalar, so that derivatives come from dual numbers.
    pub fn frame<T: Scalar>(&self, z: &Slots<T>) -> Frame<T> {
        match self.projection {
            Projection::Closest => self.closest(z),
            Projection::Ray => self.ray(z),
        }
    }

    fn closest<T: Scalar>(&self, z: &Slots<T>) -> Frame<T> {
        let [d, a, b, _] = vectors(z);
        let m = dot(a, a);
        let length = m.sqrt();
        let n = scale(rot(a), length.recip() * self.mortar);
        let gap = dot(d, n);
        let denominator = (m - gap * dot(n, b)).recip();
        let zero = [T::zero(); 2];
        let xi = [scale(a, denominator), scale(n, gap * denominator)];
        Frame {
            gap,
            gap_row: join([n, zero, zero, zero]),
            normal: join([n, zero, zero, zero]),
            tangential: join([scale(a, length.recip()), scale(n, gap * length.recip()), zero, zero]),
            parameter: join([xi[0], xi[1], zero, zero]),
        }
    }

    fn ray<T: Scalar>(&self, z: &Slots<T>) -> Frame<T> {
        let [d, a, _, e] = vectors(z);
        let (length, stretch) = (dot(a, a).sqrt(), dot(e, e).sqrt());
        let (t, tau) = (scale(a, length.recip()), scale(e, stretch.recip()));
        let (n, nu) = (scale(rot(t), T::from(self.mortar)), scale(rot(tau), T::from(self.nonmortar)));
        let gap = -dot(d, nu);
        let inverse = -dot(nu, n).recip();
        // g dnu = turn * (nu.de), turn = -tau g / |e|
        let turn = scale(tau, -gap / stretch);
        let (along_n, along_t) = (dot(turn, n), dot(turn, t));
        let zero = [T::zero(); 2];
        let gap_row = [scale(n, inverse), scale(nu, along_n * inverse)];
        let lean = dot(nu, t);
        let xi = [
            scale(add(t, scale(gap_row[0], lean)), length.recip()),
            scale(add(scale(nu, along_t), scale(gap_row[1], lean)), length.recip()),
        ];
        let sense = T::from(dot(t, tau).re().signum());
        Frame {
            gap,
            gap_row: join([gap_row[0], zero, zero, gap_row[1]]),
            normal: join([scale(nu, T::from(-1.0)), zero, zero, zero]),
            tangential: join([scale(tau, sense), zero, zero, scale(nu, sense * dot(turn, tau))]),
            parameter: join([xi[0], zero, zero, xi[1]]),
        }
    }

    /// Linearisation of `c_n (virtual gap) + c_t (virtual slip)` with respect to the motion: a form in (variation, increment),
    /// including the move of the projection. `third` is `y'''`.
    ///
    /// The increment changes the local vector by `Dz + z_xi Dxi`, `z_xi = (-a, b, y''', 0)`, and the variation of the
    /// local vector by `(-da, db, ., 0) Dxi`.
    pub fn linearise(&self, z: &Slots, third: [f64; 2], c_n: f64, c_t: f64) -> SlotMatrix {
        let mut seeded = [Dual::from_re(0.0); SLOTS];
        for (i, slot) in seeded.iter_mut().enumerate() {
            *slot = Dual::from_re(z[i]).derivative(i);
        }
        let frame = self.frame(&seeded);
        let parameter = frame.parameter.map(|v| v.re);
        let along = [-z[2], -z[3], z[4], z[5], third[0], third[1], 0.0, 0.0];
        let mut form = [[0.0; SLOTS]; SLOTS];
        let mut combined = [0.0; SLOTS];
        for i in 0..SLOTS {
            let value = frame.normal[i] * c_n + frame.tangential[i] * c_t;
            combined[i] = value.re;
            let gradient = value.eps.unwrap_generic(nalgebra::Const::<SLOTS>, nalgebra::Const::<1>);
            let moved: f64 = (0..SLOTS).map(|j| gradient[j] * along[j]).sum();
            for j in 0..SLOTS {
                form[i][j] = gradient[j] + moved * parameter[j];
            }
        }
        for c in 0..2 {
            for j in 0..SLOTS {
                form[2 + c][j] -= combined[c] * parameter[j];
                form[4 + c][j] += combined[2 + c] * parameter[j];
            }
        }
        form
    }
}

fn vectors<T: Copy>(z: &Slots<T>) -> [[T; 2]; 4] {
    [[z[0], z[1]], [z[2], z[3]], [z[4], z[5]], [z[6], z[7]]]
}

fn join<T: Copy>(v: [[T; 2]; 4]) -> Slots<T> {
    [v[0][0], v[0][1], v[1][0], v[1][1], v[2][0], v[2][1], v[3][0], v[3][1]]
}

fn dot<T: Scalar>(a: [T; 2], b: [T; 2]) -> T {
    a[0] * b[0] + a[1] * b[1]
}

fn rot<T: Scalar>(a: [T; 2]) -> [T; 2] {
    [-a[1], a[0]]
}

fn scale<T: Scalar>(a: [T; 2], factor: T) -> [T; 2] {
    [a[0] * factor, a[1] * factor]
}

fn add<T: Scalar>(a: [T; 2], b: [T; 2]) -> [T; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `g` and the closest-point `dg` against the closed second variation of design section 4.
    #[test]
    fn closest_point_tangent_equals_the_closed_second_variation() {
        let orientation = Orientation { projection: Projection::Closest, nonmortar: -1.0, mortar: 1.0 };
        let (a, b, third) = ([1.3, 0.4], [-0.2, -0.9], [0.3, 0.1]);
        let m = a[0] * a[0] + a[1] * a[1];
        let n = [-a[1] / m.sqrt(), a[0] / m.sqrt()];
        let g = 0.07;
        let z = [g * n[0], g * n[1], a[0], a[1], b[0], b[1], 0.0, 0.0];
        let form = orientation.linearise(&z, third, 1.0, 0.0);
        let k = n[0] * b[0] + n[1] * b[1];
        let denominator = m - g * k;
        let mut xi = [0.0; SLOTS];
        for c in 0..2 {
            xi[c] = a[c] / denominator;
            xi[2 + c] = g * n[c] / denominator;
        }
        let mut turn = [0.0; SLOTS];
        turn[2] = n[0];
        turn[3] = n[1];
        for i in 0..SLOTS {
            for j in 0..SLOTS {
                let expected = -(denominator / m) * (turn[i] * xi[j] + xi[i] * turn[j] + k * xi[i] * xi[j])
                    + (g / m) * turn[i] * turn[j];
                assert!((form[i][j] - expected).abs() < 1e-13, "{i} {j}: {} {expected}", form[i][j]);
            }
        }
    }
}
