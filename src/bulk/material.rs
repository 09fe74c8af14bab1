//! Constitutive models in plane strain: stress, tangent and energy from the deformation gradient.

use std::fmt::Debug;

use nalgebra::Matrix2;

/// Answer of a material at one point.
#[derive(Clone, Copy, Debug)]
pub struct StressResponse {
    /// Strain energy per reference area.
    pub energy: f64,
    /// First Piola-Kirchhoff stress `P_iJ = d psi / d F_iJ`.
    pub stress: Matrix2<f64>,
    /// `A[2 i + J][2 k + L] = d P_iJ / d F_kL`, symmetric.
    pub tangent: [[f64; 4]; 4],
}

/// A hyperelastic body in plane strain.
pub trait Material: Debug + Send + Sync {
    /// Stress, tangent and energy for the in-plane deformation gradient `f`; `None` where the material does not exist
    /// (`det F <= 0`).
    fn response(&self, f: &Matrix2<f64>) -> Option<StressResponse>;
    /// Energy and stress of [`Self::response`] without the tangent.
    fn stress(&self, f: &Matrix2<f64>) -> Option<(f64, Matrix2<f64>)>;
    /// True when the tangent is the same for every `f`.
    fn linear(&self) -> bool {
        false
    }
    /// Young's modulus at small strain: the stress scale of every numerical parameter.
    fn youngs_modulus(&self) -> f64;
    /// Poisson's ratio at small strain.
    fn poissons_ratio(&self) -> f64;
    /// Out-of-plane Cauchy stress in plane strain, for the von Mises stress.
    fn out_of_plane(&self, f: &Matrix2<f64>) -> f64;
    /// True when the small-strain theory is used: the Cauchy stress is then the stress itself.
    fn small_strain(&self) -> bool {
        false
    }
    /// Name in the scene.
    fn name(&self) -> &'static str;

    /// In-plane Cauchy stress, `P F^T / det F` at finite strain.
    fn cauchy(&self, f: &Matrix2<f64>) -> Option<Matrix2<f64>> {
        let (_, stress) = self.stress(f)?;
        Some(if self.small_strain() { stress } else { stress * f.transpose() / f.determinant() })
    }
}

/// Lame constants `(lambda, mu)` in plane strain.
pub fn lame(youngs_modulus: f64, poissons_ratio: f64) -> (f64, f64) {
    let (e, nu) = (youngs_modulus, poissons_ratio);
    (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)))
}

/// Compressible neo-Hookean solid (design section 6),
///
/// ```text
/// psi = mu/2 (I1 - 3 - 2 ln J) + lambda/2 (ln J)^2,      I1 = F:F + 1 in plane strain
/// P   = mu (F - F^-T) + lambda ln J F^-T
/// A   = mu I + lambda F^-T x F^-T + (mu - lambda ln J) (F^-T)_iL (F^-T)_kJ
/// ```
///
/// from `d F^-T_iJ / d F_kL = -F^-T_iL F^-T_kJ`. Without a state at `det F <= 0`.
#[derive(Clone, Copy, Debug)]
pub struct NeoHookean {
    /// Young's modulus (stress).
    pub youngs_modulus: f64,
    /// Poisson's ratio, in `(-1, 1/2)`.
    pub poissons_ratio: f64,
}

impl NeoHookean {
    /// `ln J` and `F^-T`.
    fn volume(f: &Matrix2<f64>) -> Option<(f64, Matrix2<f64>)> {
        let j = f.determinant();
        (j > 0.0).then(|| (j.ln(), Matrix2::new(f[(1, 1)], -f[(1, 0)], -f[(0, 1)], f[(0, 0)]) / j))
    }

    /// Energy and stress.
    fn elastic(&self, f: &Matrix2<f64>, (log_j, t): &(f64, Matrix2<f64>)) -> (f64, Matrix2<f64>) {
        let (lambda, mu) = lame(self.youngs_modulus, self.poissons_ratio);
        let energy = 0.5 * mu * (f.norm_squared() - 2.0 - 2.0 * log_j) + 0.5 * lambda * log_j * log_j;
        (energy, (f - t) * mu + t * (lambda * log_j))
    }
}

impl Material for NeoHookean {
    fn stress(&self, f: &Matrix2<f64>) -> Option<(f64, Matrix2<f64>)> {
        Some(self.elastic(f, &Self::volume(f)?))
    }

    fn response(&self, f: &Matrix2<f64>) -> Option<StressResponse> {
        let (lambda, mu) = lame(self.youngs_modulus, self.poissons_ratio);
        let volume = Self::volume(f)?;
        let (energy, stress) = self.elastic(f, &volume);
        let (log_j, t) = volume;
        let geometric = mu - lambda * log_j;
        let mut tangent = [[0.0; 4]; 4];
        for (row, line) in tangent.iter_mut().enumerate() {
            let (i, jj) = (row / 2, row % 2);
            for (column, value) in line.iter_mut().enumerate() {
                let (k, l) = (column / 2, column % 2);
                *value = lambda * t[(i, jj)] * t[(k, l)] + geometric * t[(i, l)] * t[(k, jj)];
            }
            line[row] += mu;
        }
        Some(StressResponse { energy, stress, tangent })
    }

    fn youngs_modulus(&self) -> f64 {
        self.youngs_modulus
    }

    fn poissons_ratio(&self) -> f64 {
        self.poissons_ratio
    }

    fn out_of_plane(&self, f: &Matrix2<f64>) -> f64 {
        // F_33 = 1: sigma_33 = (mu (1 - 1) + lambda ln J) / J.
        let (lambda, _) = lame(self.youngs_modulus, self.poissons_ratio);
        lambda * f.determinant().ln() / f.determinant()
    }

    fn name(&self) -> &'static str {
        "neo-hookean"
    }
}

/// Linear elasticity at small strain: `sigma = lambda tr(eps) I + 2 mu eps`, `eps = sym(F) - I`.
#[derive(Clone, Copy, Debug)]
pub struct LinearElastic {
    /// Young's modulus (stress).
    pub youngs_modulus: f64,
    /// Poisson's ratio, in `(-1, 1/2)`.
    pub poissons_ratio: f64,
}

impl Material for LinearElastic {
    fn stress(&self, f: &Matrix2<f64>) -> Option<(f64, Matrix2<f64>)> {
        let (lambda, mu) = lame(self.youngs_modulus, self.poissons_ratio);
        let strain = (f + f.transpose()) * 0.5 - Matrix2::identity();
        let stress = Matrix2::identity() * (lambda * strain.trace()) + strain * (2.0 * mu);
        stress.iter().all(|v| v.is_finite()).then(|| (0.5 * stress.dot(&strain), stress))
    }

    fn response(&self, f: &Matrix2<f64>) -> Option<StressResponse> {
        let (lambda, mu) = lame(self.youngs_modulus, self.poissons_ratio);
        let (energy, stress) = self.stress(f)?;
        let tangent = [
            [lambda + 2.0 * mu, 0.0, 0.0, lambda],
            [0.0, mu, mu, 0.0],
            [0.0, mu, mu, 0.0],
            [lambda, 0.0, 0.0, lambda + 2.0 * mu],
        ];
        Some(StressResponse { energy, stress, tangent })
    }

    fn linear(&self) -> bool {
        true
    }

    fn youngs_modulus(&self) -> f64 {
        self.youngs_modulus
    }

    fn poissons_ratio(&self) -> f64 {
        self.poissons_ratio
    }

    fn out_of_plane(&self, f: &Matrix2<f64>) -> f64 {
        let (lambda, _) = lame(self.youngs_modulus, self.poissons_ratio);
        lambda * (f.trace() - 2.0)
    }

    fn small_strain(&self) -> bool {
        true
    }

    fn name(&self) -> &'static str {
        "linear-elastic"
    }
}
