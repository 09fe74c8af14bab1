//! Smoothed friction with a peak: the law of Bengisu and Akay.

use crate::{Dual, DualNum, FrictionLaw, InterfacePoint, Kind, LawInfo, Parameter, Range, Response, Unit, dual::decay};
use serde::{Deserialize, Serialize};

/// `q = p sign(v) (1 - exp(-|v|/v_r)) [mu_k + (mu_s - mu_k) exp(-|v|/v_d)]`: rises from zero at rest over the speed `v_r`, then
/// falls to kinetic friction over the speed `v_d`.
///
/// A direct law: one function of the velocity replaces stick and slip. There is no sharp stick, a loaded contact creeps at
/// `v = v_r q / (mu_s p)` to first order. In the symbols of the paper
/// `F = N mu_k sign(v) (1 - e^(-B|v|)) (1 + (f_r - 1) e^(-A|v|))` with `B = 1/v_r`, `A = 1/v_d` and `f_r = mu_s / mu_k`, the
/// ratio of static to kinetic friction. The peak comes near `mu_s` only for `v_r << v_d`, the usual choice: where the first
/// factor has risen, the bracket must not have fallen yet.
///
/// `q` is odd in the slip and once continuously differentiable, with `dq/ds = p mu_s / (v_r dt)` at rest; dissipation
/// `q s >= 0` always. Limits: `v -> 0` gives 0, `v -> infinity` gives `mu_k p`; `mu_s = mu_k` and `v >> v_r` is sliding under
/// Coulomb's law. Between peak and `v_d` the curve falls, with the same warning as for [`crate::builtin::Stribeck`].
///
/// Reference: M. T. Bengisu and A. Akay, J. Sound Vib. 171 (1994) 557. The printed equation was not checked against the source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BengisuAkay {
    /// Static coefficient `mu_s >= 0`, which the peak approaches for `v_r << v_d`.
    pub static_friction: f64,
    /// Coefficient at high speed, `mu_k >= 0`.
    pub kinetic_friction: f64,
    /// Speed `v_r > 0` of the rise from rest.
    pub rise_speed: f64,
    /// Speed `v_d > 0` of the decay from static to kinetic friction.
    pub decay_speed: f64,
}

#[typetag::serde(name = "bengisu-akay")]
impl FrictionLaw for BengisuAkay {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        let sign = 1f64.copysign(at.slip.re);
        // not `at.speed()`: the traction is odd, so its derivative at rest is that of either side
        let speed = at.velocity() * sign;
        let rise = -(-speed / self.rise_speed).exp_m1();
        let friction = decay(self.static_friction, self.kinetic_friction, speed / self.decay_speed);
        Response::Traction(at.pressure * rise * friction * sign)
    }
}

inventory::submit! {
    LawInfo {
        name: "bengisu-akay",
        kind: Kind::Direct,
        equation: "q = p sign(v) (1 - exp(-|v|/rise_speed)) \
                   [kinetic_friction + (static_friction - kinetic_friction) exp(-|v|/decay_speed)]",
        parameters: &[
            Parameter::new("static_friction", Unit::ONE, Range::AtLeast(0.0), "static coefficient, approached by the peak"),
            Parameter::new("kinetic_friction", Unit::ONE, Range::AtLeast(0.0), "coefficient at high speed"),
            Parameter::new("rise_speed", Unit::VELOCITY, Range::Above(0.0), "speed of the rise from rest"),
            Parameter::new("decay_speed", Unit::VELOCITY, Range::Above(0.0), "speed of the decay to kinetic friction"),
        ],
        reference: "M. T. Bengisu and A. Akay, J. Sound Vib. 171 (1994) 557",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dual::derivatives;

    fn traction(law: &BengisuAkay, speed: f64) -> (f64, [f64; 2]) {
        derivatives(&law.response(&InterfacePoint::new(2.0, speed * 0.5, 0.5), &[], &mut []).value())
    }

    #[test]
    fn slope_at_rest_and_kinetic_friction_at_speed() {
        let law =
            BengisuAkay { static_friction: 0.5, kinetic_friction: 0.25, rise_speed: 1.0 / 1024.0, decay_speed: 1.0 };
        for zero in [0.0, -0.0] {
            assert_eq!(traction(&law, zero), (0.0, [0.0, 2.0 * 0.5 * 1024.0 / 0.5]));
        }
        assert_eq!(traction(&law, 1e6), (0.5, [0.25, 0.0]));
        assert_eq!(traction(&law, -1e6), (-0.5, [-0.25, 0.0]));
    }

    #[test]
    fn peak_without_kinetic_friction_in_closed_form() {
        // d/dv (1 - e^(-v/r)) e^(-v/d) = 0  at  v = r ln(1 + d/r)
        let (r, d) = (0.01f64, 0.3f64);
        let law = BengisuAkay { static_friction: 0.5, kinetic_friction: 0.0, rise_speed: r, decay_speed: d };
        let peak = r * (d / r).ln_1p();
        let (value, slope) = traction(&law, peak);
        assert!(slope[1].abs() < 1e-13 * traction(&law, 0.0).1[1]);
        assert!((value - 2.0 * 0.5 * (d / (r + d)) * (1.0 + d / r).powf(-r / d)).abs() < 1e-15);
    }

    #[test]
    fn one_coefficient_is_coulomb_as_soon_as_it_slides() {
        let law = BengisuAkay { static_friction: 0.3, kinetic_friction: 0.3, rise_speed: 1e-6, decay_speed: 1.0 };
        for speed in [1e-4, 1.0, 1e6] {
            assert_eq!(traction(&law, speed).0, 2.0 * 0.3);
            assert_eq!(traction(&law, -speed).0, -2.0 * 0.3);
        }
    }

    #[test]
    fn conforms() {
        for (static_friction, kinetic_friction) in [(0.5, 0.3), (0.3, 0.3), (0.0, 1.0), (1.0, 0.0), (0.0, 0.0)] {
            for (rise_speed, decay_speed) in [(1e-3, 1e-1), (1e-9, 1.0), (1e9, 1e9), (1.0, 1e-6)] {
                crate::conforms(&BengisuAkay { static_friction, kinetic_friction, rise_speed, decay_speed }).unwrap();
            }
        }
    }
}
