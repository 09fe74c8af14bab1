//! Friction that follows a power of the speed.

use crate::{
    Dual, FrictionLaw, InterfacePoint, Kind, LawInfo, Parameter, Range, Response, Unit,
    dual::{hypot, power},
};
use serde::{Deserialize, Serialize};

/// `|q| <= mu_0 (w/v_0)^m p`, `w = sqrt(v^2 + v_f^2)`.
///
/// A straight line of slope `m` in a double logarithmic plot, `mu_0` at the speed `v_0`: `m > 0` strengthens (shear of a thin
/// power-law fluid or of ice), `m < 0` weakens and is ill-posed in quasi-static models at small time steps (see
/// [`crate::builtin::Stribeck`]). The power itself vanishes (`m > 0`) or diverges (`m < 0`) at rest with infinite slope, so the
/// speed is rounded at a floor `v_f`, below which the coefficient stays at its value at rest, `mu_0 (v_f/v_0)^m`; at
/// `v = 10 v_f` the difference to the power is `m/2` %.
///
/// Derivatives `db/dp = mu`, `db/ds = m mu p v / (w^2 dt)`, smooth and 0 at rest. Limit `m = 0`: Coulomb's law.
///
/// Reference: W. F. Budd, P. L. Keage and N. A. Blundy, J. Glaciol. 23 (1979) 157, for ice (speed as a power of friction and
/// pressure). The printed equation was not checked against the source; the floor is ours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PowerRate {
    /// Coefficient `mu_0 >= 0` at the reference speed.
    pub friction: f64,
    /// Reference speed `v_0 > 0`.
    pub speed: f64,
    /// Exponent `m` of the speed, from -1 to 1.
    pub exponent: f64,
    /// Speed `v_f > 0` below which the coefficient stays constant.
    pub floor_speed: f64,
}

#[typetag::serde(name = "power-rate")]
impl FrictionLaw for PowerRate {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        let speed = hypot(at.velocity(), self.floor_speed);
        Response::Threshold(at.pressure * (power(speed / self.speed, self.exponent) * self.friction))
    }

    fn frictionless(&self) -> bool {
        self.friction == 0.0
    }
}

inventory::submit! {
    LawInfo {
        name: "power-rate",
        kind: Kind::SetValued,
        equation: "|q| <= friction (w/speed)^exponent p, w = sqrt(v^2 + floor_speed^2)",
        parameters: &[
            Parameter::new("friction", Unit::ONE, Range::AtLeast(0.0), "coefficient at the reference speed"),
            Parameter::new("speed", Unit::VELOCITY, Range::Above(0.0), "reference speed"),
            Parameter::new("exponent", Unit::ONE, Range::Between(-1.0, 1.0), "exponent of the speed"),
            Parameter::new("floor_speed", Unit::VELOCITY, Range::Above(0.0), "speed below which friction is constant"),
        ],
        reference: "W. F. Budd, P. L. Keage and N. A. Blundy, J. Glaciol. 23 (1979) 157",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dual::derivatives;

    fn friction(exponent: f64, speed: f64) -> (f64, [f64; 2]) {
        let law = PowerRate { friction: 0.3, speed: 1e-2, exponent, floor_speed: 1e-6 };
        derivatives(&law.response(&InterfacePoint::new(1.0, speed, 1.0), &[], &mut []).value())
    }

    #[test]
    fn floor_at_rest_and_a_power_above() {
        for exponent in [-0.5, 0.25, 1.0] {
            let (value, slope) = friction(exponent, 0.0);
            assert!((value / (0.3 * 1e-4f64.powf(exponent)) - 1.0).abs() < 1e-14);
            assert_eq!(slope[1], 0.0);
            let (value, slope) = friction(exponent, -1e3);
            let expected = 0.3 * 1e5f64.powf(exponent);
            assert!((value / expected - 1.0).abs() < 1e-14);
            assert!((slope[1] / (expected * exponent / -1e3) - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn half_a_percent_of_the_exponent_at_ten_times_the_floor() {
        for exponent in [-0.2, 0.2] {
            let found = friction(exponent, 1e-5).0 / (0.3 * 1e-3f64.powf(exponent)) - 1.0;
            assert!((found - 0.005 * exponent).abs() < 5e-5 * exponent.abs());
        }
    }

    #[test]
    fn conforms() {
        for friction in [0.0, 0.3, 1e3] {
            for exponent in [-1.0, -0.1, 0.0, 0.3, 1.0] {
                for (speed, floor_speed) in [(1e-2, 1e-6), (1.0, 1e-12), (1e-9, 1e3)] {
                    crate::conforms(&PowerRate { friction, speed, exponent, floor_speed }).unwrap();
                }
            }
        }
    }
}
