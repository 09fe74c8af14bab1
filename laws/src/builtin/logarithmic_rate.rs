//! Friction that changes with the logarithm of the speed.

use crate::{
    Dual, DualNum, FrictionLaw, InterfacePoint, Kind, LawInfo, Parameter, Range, Response, Unit,
    dual::{constant, max},
};
use serde::{Deserialize, Serialize};

/// `|q| <= mu(v) p`, `mu(v) = max(0, mu_0 + a ln(1 + |v|/v_0))`.
///
/// Thermally activated sliding: the coefficient changes by `a ln 10` per decade of speed above `v_0`, and rests at `mu_0`
/// below. `a > 0` strengthens, `a < 0` weakens until nothing is left at `|v| = v_0 (exp(mu_0/|a|) - 1)`. It is the steady state
/// of a rate-and-state law with `a` in place of its `a - b`, but without memory and therefore, for `a < 0`, ill-posed in
/// quasi-static models at small time steps (see [`crate::builtin::Stribeck`]). Usual `|a|`: 0.005 to 0.05 for dry friction of
/// rock, polymer, paper.
///
/// Derivatives `db/dp = mu`, `db/ds = sign(s) p a / [(v_0 + |v|) dt]`, 0 at rest and where nothing is left.
/// Limits: `v -> 0` gives `mu_0`; `a = 0` is Coulomb's law.
///
/// Reference: T. Baumberger and C. Caroli, Adv. Phys. 55 (2006) 279 (review); the `1 +` as in J. H. Dieterich, J. Geophys. Res.
/// 84 (1979) 2161. The printed equation was not checked against the source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogarithmicRate {
    /// Coefficient at rest, `mu_0 >= 0`.
    pub friction: f64,
    /// Change `a` of the coefficient per e-fold of speed, of either sign.
    pub rate: f64,
    /// Speed `v_0 > 0` above which the coefficient changes.
    pub speed: f64,
}

#[typetag::serde(name = "logarithmic-rate")]
impl FrictionLaw for LogarithmicRate {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        let friction = (at.speed() / self.speed).ln_1p() * self.rate + self.friction;
        Response::Threshold(at.pressure * max(friction, constant(0.0)))
    }

    fn frictionless(&self) -> bool {
        self.friction == 0.0 && self.rate <= 0.0
    }
}

inventory::submit! {
    LawInfo {
        name: "logarithmic-rate",
        kind: Kind::SetValued,
        equation: "|q| <= max(0, friction + rate ln(1 + |v|/speed)) p",
        parameters: &[
            Parameter::new("friction", Unit::ONE, Range::AtLeast(0.0), "coefficient at rest"),
            Parameter::new("rate", Unit::ONE, Range::Number, "change of the coefficient per e-fold of speed"),
            Parameter::new("speed", Unit::VELOCITY, Range::Above(0.0), "speed above which the coefficient changes"),
        ],
        reference: "T. Baumberger and C. Caroli, Adv. Phys. 55 (2006) 279",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dual::derivatives;

    fn bound(rate: f64, speed: f64) -> (f64, [f64; 2]) {
        let law = LogarithmicRate { friction: 0.25, rate, speed: 1e-3 };
        derivatives(&law.response(&InterfacePoint::new(2.0, speed * 0.5, 0.5), &[], &mut []).value())
    }

    #[test]
    fn at_rest_and_one_e_fold() {
        let e = std::f64::consts::E;
        for rate in [0.05, -0.05] {
            assert_eq!(bound(rate, 0.0), (0.5, [0.25, 0.0]));
            let (value, slope) = bound(rate, -1e-3 * (e - 1.0));
            assert!((value - 2.0 * (0.25 + rate)).abs() < 1e-15);
            assert!((slope[1] + 2.0 * rate / (1e-3 * e * 0.5)).abs() < 1e-10);
        }
    }

    #[test]
    fn weakening_ends_at_nothing() {
        let end = 1e-3 * 5f64.exp_m1();
        assert!(bound(-0.05, 0.999 * end).0 > 0.0);
        assert_eq!(bound(-0.05, 1.001 * end), (0.0, [0.0, 0.0]));
    }

    #[test]
    fn conforms() {
        for (friction, rate) in [(0.3, 0.01), (0.3, -0.01), (0.3, 0.0), (0.0, 1.0), (0.0, -1.0), (1e-6, -1e3)] {
            for speed in [1e-9, 1e-3, 1e9] {
                crate::conforms(&LogarithmicRate { friction, rate, speed }).unwrap();
            }
        }
    }
}
