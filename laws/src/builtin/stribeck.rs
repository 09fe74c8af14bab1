//! Friction that falls (or rises) from static to kinetic with the speed.

use crate::{
    Dual, FrictionLaw, InterfacePoint, Kind, LawInfo, Parameter, Range, Response, Unit,
    dual::{decay, power},
};
use serde::{Deserialize, Serialize};

/// `|q| <= mu(v) p`, `mu(v) = mu_k + (mu_s - mu_k) exp(-(|v|/v_s)^d) + c |v|`: the Stribeck curve.
///
/// One law for all common forms: `d = 1` is the exponential decay of Tustin, of Oden and Martins and of most finite element
/// codes (their decay coefficient is `1/v_s`); `d = 2`, the default, is the Gaussian Stribeck curve; `c` adds the viscous
/// branch of a lubricated contact (a viscous coefficient of friction: its share of the traction is `c |v| p`). `mu_k > mu_s` is
/// allowed: a curve that rises.
///
/// Limits: `v -> 0` gives `mu_s`, `v -> infinity` gives `mu_k + c |v|`; `mu_s = mu_k, c = 0` is Coulomb's law. Derivative
/// `db/ds = sign(s) (p/dt) [c - (mu_s - mu_k) d |v|^(d-1) / v_s^d exp(-(|v|/v_s)^d)]`, 0 at rest (the mean of both sides, which
/// matters for `d = 1` and for `c > 0`, where the curve has a corner).
///
/// **Falling branches are ill-posed in a quasi-static model.** The tangential stiffness of a sliding point, `k_t`, competes
/// with `p mu'(v) / dt`: where `dt < p |mu'| / k_t` the sum is negative, the step has several solutions or none, and cutting
/// the step makes it worse. It needs inertia or a law with a state. Usual `v_s`: 1e-3 to 1e-1 m/s.
///
/// Reference: R. Stribeck, Z. VDI 46 (1902) 1341; `d`: L. C. Bo and D. Pavelescu, Wear 82 (1982) 277; B. Armstrong-Helouvry, P.
/// Dupont and C. Canudas de Wit, Automatica 30 (1994) 1083; `d = 1`: J. T. Oden and J. A. C. Martins, CMAME 52 (1985) 527.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stribeck {
    /// Coefficient at rest, `mu_s >= 0`.
    pub static_friction: f64,
    /// Coefficient at high speed without the viscous term, `mu_k >= 0`.
    pub kinetic_friction: f64,
    /// Stribeck speed `v_s > 0`.
    pub speed: f64,
    /// Exponent `d >= 1`.
    #[serde(default = "gaussian")]
    pub exponent: f64,
    /// Growth `c >= 0` of the coefficient with the speed (time per length).
    #[serde(default)]
    pub viscous: f64,
}

fn gaussian() -> f64 {
    2.0
}

#[typetag::serde(name = "stribeck")]
impl FrictionLaw for Stribeck {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        let x = power(at.speed() / self.speed, self.exponent);
        let friction = decay(self.static_friction, self.kinetic_friction, x);
        Response::Threshold(at.pressure * (friction + at.speed() * self.viscous))
    }

    fn frictionless(&self) -> bool {
        self.static_friction == 0.0 && self.kinetic_friction == 0.0 && self.viscous == 0.0
    }
}

inventory::submit! {
    LawInfo {
        name: "stribeck",
        kind: Kind::SetValued,
        equation: "|q| <= [kinetic_friction + (static_friction - kinetic_friction) exp(-(|v|/speed)^exponent) + viscous |v|] p",
        parameters: &[
            Parameter::new("static_friction", Unit::ONE, Range::AtLeast(0.0), "coefficient at rest"),
            Parameter::new("kinetic_friction", Unit::ONE, Range::AtLeast(0.0), "coefficient at high speed"),
            Parameter::new("speed", Unit::VELOCITY, Range::Above(0.0), "Stribeck speed of the decay"),
            Parameter::new("exponent", Unit::ONE, Range::AtLeast(1.0), "1: exponential, 2: Gaussian decay").or("2"),
            Parameter::new(
                "viscous",
                Unit::ONE.per(Unit::VELOCITY),
                Range::AtLeast(0.0),
                "growth of the coefficient with the speed",
            )
            .or("0"),
        ],
        reference: "R. Stribeck, Z. VDI 46 (1902) 1341; exponent 1: Oden and Martins, CMAME 52 (1985) 527",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dual::derivatives;

    fn law(exponent: f64, viscous: f64) -> Stribeck {
        Stribeck { static_friction: 0.5, kinetic_friction: 0.2, speed: 0.01, exponent, viscous }
    }

    fn bound(law: &Stribeck, slip: f64, dt: f64) -> (f64, [f64; 2]) {
        derivatives(&law.response(&InterfacePoint::new(2.0, slip, dt), &[], &mut []).value())
    }

    #[test]
    fn static_at_rest_and_kinetic_at_speed() {
        for exponent in [1.0, 1.5, 2.0, 20.0] {
            assert_eq!(bound(&law(exponent, 0.0), 0.0, 0.1), (1.0, [0.5, 0.0]));
            assert_eq!(bound(&law(exponent, 0.0), -1e9, 0.1), (0.4, [0.2, 0.0]));
            let (value, slope) = bound(&law(exponent, 0.25), 1e3, 0.125);
            assert_eq!((value, slope), (2.0 * (0.2 + 2000.0), [2000.2, 2.0 * 0.25 / 0.125]));
        }
    }

    #[test]
    fn at_the_stribeck_speed_one_e_th_is_left_whatever_the_exponent() {
        let e = std::f64::consts::E;
        for exponent in [1.0, 2.0, 7.0] {
            let (value, slope) = bound(&law(exponent, 0.0), -0.001, 0.1);
            assert!((value - 2.0 * (0.2 + 0.3 / e)).abs() < 1e-14);
            let expected = 2.0 * 0.3 / e * exponent / 0.01 / 0.1;
            assert!((slope[1] - expected).abs() < 1e-12 * expected, "{} instead of {expected}", slope[1]);
        }
    }

    #[test]
    fn an_exponent_below_one_is_refused() {
        let error = crate::validate(&law(0.5, 0.0)).unwrap_err();
        assert_eq!(error.key(), "exponent");
    }

    #[test]
    fn conforms() {
        for (static_friction, kinetic_friction) in [(0.5, 0.3), (0.3, 0.3), (0.0, 1.0), (1.0, 0.0), (0.0, 0.0)] {
            for (speed, exponent, viscous) in [(0.01, 1.0, 0.0), (1e-9, 2.0, 1e-3), (1e9, 10.0, 0.0), (1.0, 1.5, 1e6)] {
                let law = Stribeck { static_friction, kinetic_friction, speed, exponent, viscous };
                crate::conforms(&law).unwrap();
            }
        }
    }
}
