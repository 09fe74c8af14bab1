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

/// Volume change at one point, as its energy sees it.
#[derive(Clone, Copy, Debug)]
pub struct Dilatation {
    /// `theta`.
    pub value: f64,
    /// `d theta / d F_iJ`.
    pub gradient: Matrix2<f64>,
}

/// A hyperelastic body in plane strain whose energy is quadratic in a dilatation `theta(F)`,
///
/// ```text
/// psi(F) = psi_rest(F) + lambda/2 theta(F)^2
/// ```
///
/// so that `tau = lambda theta`, the stress that resists the change of volume, can be taken from the point itself (the
/// provided methods) or from its surroundings (near incompressibility, see [`VolumeSpace`](super::VolumeSpace)).
pub trait Material: Debug + Send + Sync {
    /// Dilatation for the in-plane deformation gradient `f`; `None` where the material does not exist (`det F <= 0`).
    fn dilatation(&self, f: &Matrix2<f64>) -> Option<Dilatation>;
    /// `psi_rest` and the stress `P = d psi_rest / dF + tau d theta / dF`.
    fn elastic(&self, f: &Matrix2<f64>, dilatation: &Dilatation, tau: f64) -> (f64, Matrix2<f64>);
    /// `d P / dF` at constant `tau`, as [`StressResponse::tangent`].
    fn moduli(&self, dilatation: &Dilatation, tau: f64) -> [[f64; 4]; 4];
    /// True when the tangent is the same for every `f`.
    fn linear(&self) -> bool {
        false
    }
    /// Young's modulus at small strain: the stress scale of every numerical parameter.
    fn youngs_modulus(&self) -> f64;
    /// Poisson's ratio at small strain.
    fn poissons_ratio(&self) -> f64;
    /// True when the small-strain theory is used: the Cauchy stress is then the stress itself.
    fn small_strain(&self) -> bool {
        false
    }
    /// The same material under the other strain measure, small for finite and finite for small; `None` where there is none.
    fn other_strain_measure(&self) -> Option<Box<dyn Material>> {
        None
    }
    /// Name in the scene.
    fn name(&self) -> &'static str;

    /// Lame's constants `(lambda, mu)`.
    fn lame(&self) -> (f64, f64) {
        lame(self.youngs_modulus(), self.poissons_ratio())
    }

    /// Stress, tangent and energy for the in-plane deformation gradient `f`; `None` where the material does not exist.
    fn response(&self, f: &Matrix2<f64>) -> Option<StressResponse> {
        let dilatation = self.dilatation(f)?;
        let (lambda, Dilatation { value, gradient: g }) = (self.lame().0, dilatation);
        let (rest, stress) = self.elastic(f, &dilatation, lambda * value);
        let mut tangent = self.moduli(&dilatation, lambda * value);
        add_dyad(&mut tangent, lambda, &g);
        Some(StressResponse { energy: rest + 0.5 * lambda * value * value, stress, tangent })
    }

    /// Energy and stress of [`Self::response`] without the tangent.
    fn stress(&self, f: &Matrix2<f64>) -> Option<(f64, Matrix2<f64>)> {
        let dilatation = self.dilatation(f)?;
        let (lambda, theta) = (self.lame().0, dilatation.value);
        let (rest, stress) = self.elastic(f, &dilatation, lambda * theta);
        Some((rest + 0.5 * lambda * theta * theta, stress))
    }

    /// Cauchy stress `xx, yy, zz, xy`, where `tau` follows from the dilatation; at finite strain `P F^T / det F`.
    ///
    /// In plane strain nothing but the dilatation acts out of the plane: `sigma_zz = tau / det F`, `tau` at small strain.
    fn cauchy(&self, f: &Matrix2<f64>, tau: &dyn Fn(f64) -> f64) -> Option<[f64; 4]> {
        let dilatation = self.dilatation(f)?;
        let tau = tau(dilatation.value);
        let (_, stress) = self.elastic(f, &dilatation, tau);
        let (s, j) = if self.small_strain() { (stress, 1.0) } else { (stress * f.transpose(), f.determinant()) };
        Some([s[(0, 0)], s[(1, 1)], tau, s[(0, 1)]].map(|v| v / j))
    }
}

/// Adds `factor g x g` to moduli.
pub(super) fn add_dyad(moduli: &mut [[f64; 4]; 4], factor: f64, g: &Matrix2<f64>) {
    let g = [g[(0, 0)], g[(0, 1)], g[(1, 0)], g[(1, 1)]];
    for (line, row) in moduli.iter_mut().zip(g) {
        for (entry, column) in line.iter_mut().zip(g) {
            *entry += factor * row * column;
        }
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

impl Material for NeoHookean {
    fn dilatation(&self, f: &Matrix2<f64>) -> Option<Dilatation> {
        let j = f.determinant();
        let gradient = Matrix2::new(f[(1, 1)], -f[(1, 0)], -f[(0, 1)], f[(0, 0)]) / j;
        (j > 0.0).then(|| Dilatation { value: j.ln(), gradient })
    }

    fn elastic(
        &self,
        f: &Matrix2<f64>,
        &Dilatation { value, gradient: t }: &Dilatation,
        tau: f64,
    ) -> (f64, Matrix2<f64>) {
        let (_, mu) = self.lame();
        (0.5 * mu * (f.norm_squared() - 2.0 - 2.0 * value), (f - t) * mu + t * tau)
    }

    fn moduli(&self, Dilatation { gradient: t, .. }: &Dilatation, tau: f64) -> [[f64; 4]; 4] {
        let (_, mu) = self.lame();
        let geometric = mu - tau;
        let mut moduli = [[0.0; 4]; 4];
        for (row, line) in moduli.iter_mut().enumerate() {
            let (i, jj) = (row / 2, row % 2);
            for (column, value) in line.iter_mut().enumerate() {
                let (k, l) = (column / 2, column % 2);
                *value = geometric * t[(i, l)] * t[(k, jj)];
            }
            line[row] += mu;
        }
        moduli
    }

    fn youngs_modulus(&self) -> f64 {
        self.youngs_modulus
    }

    fn poissons_ratio(&self) -> f64 {
        self.poissons_ratio
    }

    fn other_strain_measure(&self) -> Option<Box<dyn Material>> {
        let Self { youngs_modulus, poissons_ratio } = *self;
        Some(Box::new(LinearElastic { youngs_modulus, poissons_ratio }))
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
    fn dilatation(&self, f: &Matrix2<f64>) -> Option<Dilatation> {
        let finite = f.iter().all(|v| v.is_finite());
        finite.then(|| Dilatation { value: f.trace() - 2.0, gradient: Matrix2::identity() })
    }

    fn elastic(&self, f: &Matrix2<f64>, _: &Dilatation, tau: f64) -> (f64, Matrix2<f64>) {
        let (_, mu) = self.lame();
        let strain = (f + f.transpose()) * 0.5 - Matrix2::identity();
        (mu * strain.norm_squared(), Matrix2::identity() * tau + strain * (2.0 * mu))
    }

    fn moduli(&self, _: &Dilatation, _: f64) -> [[f64; 4]; 4] {
        let (_, mu) = self.lame();
        [[2.0 * mu, 0.0, 0.0, 0.0], [0.0, mu, mu, 0.0], [0.0, mu, mu, 0.0], [0.0, 0.0, 0.0, 2.0 * mu]]
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

    fn small_strain(&self) -> bool {
        true
    }

    fn other_strain_measure(&self) -> Option<Box<dyn Material>> {
        let Self { youngs_modulus, poissons_ratio } = *self;
        Some(Box::new(NeoHookean { youngs_modulus, poissons_ratio }))
    }

    fn name(&self) -> &'static str {
        "linear-elastic"
    }
}
