//! By how much displacements and contact forces miss the conditions of a step: exact kinematics, no projection.
//!
//! With the gap `c_a = g_a + (p^_a - p_a)/r_N` and the slip `v_a = s_a + e_a - (q^_a - q_a)/r_T` of a site, the conditions are
//! `p^ >= 0`, `c >= 0`, `p^ c = 0`, `|q^| <= b`, and `q^ = b v/|v|` where `v` is not zero. Gaps and slips are turned into stresses by `r`; stresses are measured by
//! the peak pressure. Of two numbers one of which has to vanish the smaller one counts: their product would be small where both
//! are far from zero.

use crate::contact::{ContactDiscretization, SiteKinematics, Sites};
use crate::model::{Loaded, Model, Pair};

use super::answer::{Answer, PairAnswer};
use super::bound::{Carries, carries};

/// Round-off of the internal forces of a translated body, of `E` times the size of the model.
const ROUND_OFF: f64 = 1e-15;

/// Largest violations of all sites, dimensionless.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Violation {
    /// Residual of the displacement equations over the largest nodal force.
    pub equilibrium: f64,
    /// `-c` and `-p^`.
    pub sign: f64,
    /// The smaller of `p^` and `c`, of `b - |q^|` and `|v|`, and of `|v|` and `|q^|` where it does not act against the slip.
    pub complementarity: f64,
    /// `|q^| - b`; for a direct law `|q^ - Q|`.
    pub cone: f64,
    /// What the multipliers miss of the projection of the site forces.
    pub projection: f64,
}

impl Violation {
    /// The largest of them; `NaN` if there is one.
    pub fn worst(&self) -> f64 {
        let parts = [self.equilibrium, self.sign, self.complementarity, self.cone, self.projection];
        parts.into_iter().fold(0.0, |m: f64, v| if m.is_nan() || v.is_nan() { f64::NAN } else { m.max(v) })
    }
}

/// Measures an answer whose forces `loaded` was made with; `least` is the smallest stress that pressures are measured by,
/// and forces by it per element.
pub fn violation(model: &Model, loaded: &Loaded, answer: &Answer, dt: f64, least: f64) -> Violation {
    let residual = loaded.bulk.iter().zip(&loaded.contact).map(|(a, b)| (a + b).abs());
    let scale = peak(loaded).max(least);
    let round_off = ROUND_OFF * model.modulus * model.size();
    let force = loaded.force_scale.max(least * model.element_size);
    let mut out = Violation { equilibrium: (largest(residual) - round_off).max(0.0) / force, ..Default::default() };
    for ((pair, sites), answer) in model.pairs.iter().zip(&loaded.sites).zip(&answer.pairs) {
        let measure = PairMeasure { pair, sites, answer, scale, dt };
        out.projection = out.projection.max(measure.projection());
        for site in sites.iter().filter(|site| site.has_partner()) {
            measure.normal(site, &mut out);
            measure.tangential(site, &mut out);
        }
    }
    out
}

/// Largest pressure or traction of the sites.
pub fn peak(loaded: &Loaded) -> f64 {
    largest(loaded.sites.iter().flatten().flat_map(|site| site.load).map(f64::abs))
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |m, v| if v.is_nan() || m.is_nan() { f64::NAN } else { m.max(v) })
}

/// True where the sites of a pair carry stabilisation.
pub fn relaxed(pair: &Pair) -> bool {
    pair.contact.numerics().sites == Sites::Quadrature
}

struct PairMeasure<'a> {
    pair: &'a Pair,
    sites: &'a [SiteKinematics],
    answer: &'a PairAnswer,
    scale: f64,
    dt: f64,
}

impl PairMeasure<'_> {
    /// `(1 - P) load / r` of a site: component 0 for pressures, 1 for tractions.
    fn relaxation(&self, site: &SiteKinematics, kind: usize) -> f64 {
        if !relaxed(self.pair) {
            return 0.0;
        }
        let multipliers = [&self.answer.pressure, &self.answer.traction][kind];
        (site.load[kind] - site.reads.iter().map(|&(k, m)| m * multipliers[k]).sum::<f64>()) / site.r[kind]
    }

    fn projection(&self) -> f64 {
        let kinds = if self.pair.contact.rubs() { 2 } else { 1 };
        let mut worst = 0.0_f64;
        for kind in 0..kinds {
            let mut sums = vec![[0.0; 2]; self.pair.contact.multipliers()];
            for site in self.sites {
                for &(k, m) in &site.reads {
                    sums[k][0] += m * site.weight * self.relaxation(site, kind);
                    sums[k][1] += m * site.weight / site.r[kind];
                }
            }
            worst = worst.max(largest(sums.iter().map(|[sum, weight]| (sum / weight).abs() / self.scale)));
        }
        worst
    }

    fn normal(&self, site: &SiteKinematics, out: &mut Violation) {
        let p = site.load[0] / self.scale;
        let gap = site.r[0] * (site.gap + self.relaxation(site, 0)) / self.scale;
        out.sign = out.sign.max(-gap).max(-p);
        out.complementarity = out.complementarity.max(p.min(gap));
    }

    fn tangential(&self, site: &SiteKinematics, out: &mut Violation) {
        let Some(law) = self.pair.contact.law() else { return };
        let [p, q] = site.load;
        if p <= 0.0 {
            out.cone = out.cone.max(q.abs() / self.scale);
            return;
        }
        match carries(&**law, site, p, self.dt) {
            Carries::Bound([bound, ..]) => {
                let slip = site.r[1] * sliding(site, self.relaxation(site, 1));
                let against = q.abs() - q * slip.signum();
                let [below, slip, against] = [bound - q.abs(), slip.abs(), against].map(|v| v / self.scale);
                out.cone = out.cone.max(-below);
                out.complementarity = out.complementarity.max(slip.min(below)).max(slip.min(against));
            }
            Carries::Traction([traction, ..]) => out.cone = out.cone.max((q - traction).abs() / self.scale),
        }
    }
}

/// Slip that does friction work: `s + e - (1 - P) q^/r_T`.
pub fn sliding(site: &SiteKinematics, relaxation: f64) -> f64 {
    site.slip + site.deflection - relaxation
}
