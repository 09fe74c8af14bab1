//! Smooth transition from Coulomb's to Tresca's law.

use crate::{Dual, DualNum, FrictionLaw, InterfacePoint, Kind, LawInfo, Parameter, Range, Response, Unit, dual::tanh};
use serde::{Deserialize, Serialize};

/// `|q| <= tau f(mu p / tau)` with `f(x) = tanh x` or `f(x) = 1 - exp(-x)`.
///
/// Coulomb friction at low pressure, `b -> mu p`, and shear at the strength `tau` of the softer surface at high pressure,
/// `b -> tau`, without the kink of a cap. Shaw, Ber and Mamin explain it by the real area of contact, which approaches the
/// apparent one. As `f <= x` and `f <= 1`, the bound lies below `min(mu p, tau)`: at `mu p = tau` by 24 % (tanh) or 37 %
/// (exponential). `tau` and `p` are true stresses.
///
/// Derivatives `db/dp = mu sech^2(mu p/tau)` or `mu exp(-mu p/tau)`, falling from `mu` to 0; `db/ds = 0`.
/// Limits: `tau -> infinity` is Coulomb's law, `mu -> infinity` Tresca's, `mu = 0` no friction.
///
/// Reference: M. C. Shaw, A. Ber and P. A. Mamin, J. Basic Eng. 82 (1960) 342. The two functions are common ways to write the
/// transition found there; the printed equation was not checked against the source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shaw {
    /// Coefficient of friction `mu >= 0` at low pressure.
    pub friction: f64,
    /// Shear strength `tau > 0`, the bound at high pressure (stress).
    pub strength: f64,
    /// Function of the transition.
    #[serde(default)]
    pub form: Transition,
}

/// How friction approaches the strength in [`Shaw`]'s law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Transition {
    /// `tanh x`.
    #[default]
    Tanh,
    /// `1 - exp(-x)`, slower.
    Exponential,
}

#[typetag::serde(name = "shaw")]
impl FrictionLaw for Shaw {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        let x = at.pressure * (self.friction / self.strength);
        let share = match self.form {
            Transition::Tanh => tanh(x),
            Transition::Exponential => -(-x).exp_m1(),
        };
        Response::Threshold(share * self.strength)
    }

    fn frictionless(&self) -> bool {
        self.friction == 0.0
    }
}

inventory::submit! {
    LawInfo {
        name: "shaw",
        kind: Kind::SetValued,
        equation: "|q| <= strength * f(friction * p / strength), f(x) = tanh x or 1 - exp(-x)",
        parameters: &[
            Parameter::new("friction", Unit::ONE, Range::AtLeast(0.0), "coefficient of friction at low pressure"),
            Parameter::new("strength", Unit::STRESS, Range::Above(0.0), "bound at high pressure"),
            Parameter::new("form", Unit::ONE, Range::Choice(&["tanh", "exponential"]), "function f").or("tanh"),
        ],
        reference: "M. C. Shaw, A. Ber and P. A. Mamin, J. Basic Eng. 82 (1960) 342",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dual::derivatives;

    const FORMS: [Transition; 2] = [Transition::Tanh, Transition::Exponential];

    #[test]
    fn coulomb_below_tresca_above() {
        for form in FORMS {
            let law = Shaw { friction: 0.5, strength: 2.0, form };
            let bound = |p| derivatives(&law.response(&InterfacePoint::new(p, 0.1, 1.0), &[], &mut []).value());
            assert_eq!(bound(0.0), (0.0, [0.5, 0.0]));
            assert!((bound(1e-12).0 / 0.5e-12 - 1.0).abs() < 1e-12);
            assert_eq!(bound(1e4).0, 2.0);
            assert!(bound(1e4).1[0] < 1e-300);
            for p in [0.1, 1.0, 4.0, 30.0] {
                assert!(bound(p).0 < 0.5 * p && bound(p).0 < 2.0);
            }
        }
    }

    #[test]
    fn transition_at_the_crossing_of_both_laws() {
        let share = |form| {
            Shaw { friction: 0.5, strength: 2.0, form }
                .response(&InterfacePoint::new(4.0, 0.0, 1.0), &[], &mut [])
                .value()
                .re
                / 2.0
        };
        let e = std::f64::consts::E;
        assert!((share(FORMS[0]) - (e * e - 1.0) / (e * e + 1.0)).abs() < 1e-15);
        assert!((share(FORMS[1]) - (1.0 - 1.0 / e)).abs() < 1e-15);
    }

    #[test]
    fn conforms() {
        for form in FORMS {
            for (friction, strength) in [(0.3, 1.0), (0.0, 1.0), (10.0, 1e-9), (1e-6, 1e9), (1e3, 1e3)] {
                crate::conforms(&Shaw { friction, strength, form }).unwrap();
            }
        }
    }
}
