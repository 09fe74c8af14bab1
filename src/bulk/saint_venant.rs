//! The material of codes that take Hooke's law to large rotations.

use nalgebra::Matrix2;

use super::material::{Dilatation, Material};

/// Saint Venant-Kirchhoff solid: Hooke's law between Green's strain and the second Piola-Kirchhoff stress,
///
/// ```text
/// E   = (F^T F - I)/2,   theta = tr E,   d theta / dF = F
/// psi = mu E:E + lambda/2 theta^2
/// P   = 2 mu F E + lambda theta F
/// A   = lambda F x F + (lambda theta) I + 2 mu [ delta_ik E_LJ + (F_iL F_kJ + (F F^T)_ik delta_JL)/2 ]
/// ```
///
/// It turns with the body but is meant for small strains: under compression it softens, and in plane strain without
/// lateral motion it loses its stiffness at the stretch `1/sqrt(3)` (`P = (lambda + 2 mu) (s^3 - s)/2`), while nothing
/// keeps it from being turned inside out. For rubber take [`NeoHookean`](super::NeoHookean).
#[derive(Clone, Copy, Debug)]
pub struct SaintVenantKirchhoff {
    /// Young's modulus (stress).
    pub youngs_modulus: f64,
    /// Poisson's ratio, in `(-1, 1/2)`.
    pub poissons_ratio: f64,
}

/// Green's strain in the plane.
fn green(f: &Matrix2<f64>) -> Matrix2<f64> {
    (f.transpose() * f - Matrix2::identity()) * 0.5
}

impl Material for SaintVenantKirchhoff {
    fn dilatation(&self, f: &Matrix2<f64>) -> Option<Dilatation> {
        (f.determinant() > 0.0).then(|| Dilatation { value: green(f).trace(), gradient: *f })
    }

    fn elastic(&self, f: &Matrix2<f64>, _: &Dilatation, tau: f64) -> (f64, Matrix2<f64>) {
        let (_, mu) = self.lame();
        let strain = green(f);
        (mu * strain.norm_squared(), f * strain * (2.0 * mu) + f * tau)
    }

    fn moduli(&self, Dilatation { gradient: f, .. }: &Dilatation, tau: f64) -> [[f64; 4]; 4] {
        let (_, mu) = self.lame();
        let (strain, left) = (green(f), f * f.transpose());
        let mut moduli = [[0.0; 4]; 4];
        for (row, line) in moduli.iter_mut().enumerate() {
            let (i, j) = (row / 2, row % 2);
            for (column, value) in line.iter_mut().enumerate() {
                let (k, l) = (column / 2, column % 2);
                let same = |a, b| if a == b { 1.0 } else { 0.0 };
                let shear = f[(i, l)] * f[(k, j)] + left[(i, k)] * same(j, l);
                *value = mu * (2.0 * same(i, k) * strain[(l, j)] + shear) + tau * same(row, column);
            }
        }
        moduli
    }

    fn youngs_modulus(&self) -> f64 {
        self.youngs_modulus
    }

    fn poissons_ratio(&self) -> f64 {
        self.poissons_ratio
    }

    fn name(&self) -> &'static str {
        "saint-venant-kirchhoff"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: SaintVenantKirchhoff = SaintVenantKirchhoff { youngs_modulus: 2.1, poissons_ratio: 0.3 };

    fn response(f: &Matrix2<f64>) -> Matrix2<f64> {
        STEEL.response(f).expect("not inverted").stress
    }

    #[test]
    fn uniaxial_strain_follows_the_cubic() {
        let (lambda, mu) = STEEL.lame();
        for s in [0.3, 0.8, 1.0, 1.4] {
            let p = response(&Matrix2::new(s, 0.0, 0.0, 1.0));
            assert!((p[(0, 0)] - (lambda + 2.0 * mu) * 0.5 * (s * s * s - s)).abs() < 1e-14);
            assert!((p[(1, 1)] - lambda * 0.5 * (s * s - 1.0)).abs() < 1e-14);
        }
    }

    #[test]
    fn stress_turns_with_the_body() {
        let f = Matrix2::new(1.1, 0.2, -0.1, 0.9);
        let (sin, cos) = 1.3_f64.sin_cos();
        let turn = Matrix2::new(cos, -sin, sin, cos);
        assert!((response(&(turn * f)) - turn * response(&f)).norm() < 1e-14);
        assert!(STEEL.response(&Matrix2::new(-1.0, 0.0, 0.0, 1.0)).is_none());
    }
}
