//! Savkoor's law of rubber friction.

use crate::{
    Dual, DualNum, FrictionLaw, InterfacePoint, Kind, LawError, LawInfo, Parameter, Range, Response, Unit,
    dual::{decay, hypot},
};
use serde::{Deserialize, Serialize};

/// `|q| <= mu(v) p`, `mu = mu_s + (mu_m - mu_s) exp(-h^2 log10^2(w/v_m))`, `w = sqrt(v^2 + v_f^2)`.
///
/// Dry rubber on a hard track: over the logarithm of the speed the coefficient is a bell, with its peak `mu_m` at the speed
/// `v_m` and `mu_s` on both sides; at `h |log10(v/v_m)| = 1` the bell has fallen to `1/e`. Below `v_m` friction strengthens
/// (stable creep instead of a sharp onset of sliding), above it weakens: see the warning at [`crate::builtin::Stribeck`]. Usual
/// values: `mu_m` 1 to 3, `v_m` mm/s to cm/s, `h` 0.3 to 0.5.
///
/// The bell is smooth at `v = 0` in theory (all derivatives vanish) but falls within decades of speed that no step resolves;
/// the floor `v_f < v_m` ends it: below, the coefficient stays at its value at `v_f`, close to `mu_s`. The peak then lies at
/// `sqrt(v_m^2 - v_f^2)`.
///
/// Derivatives `db/dp = mu`, `db/ds = -2 h^2 log10(w/v_m) (mu - mu_s) p v / (w^2 ln(10) dt)`, smooth and 0 at rest.
/// Limits: `mu_m = mu_s` is Coulomb's law, `h -> 0` Coulomb's with `mu_m`.
///
/// Reference: A. R. Savkoor, Wear 8 (1965) 222. The printed equation was not checked against the source; the floor is ours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Savkoor {
    /// Coefficient far from the peak, `mu_s >= 0`.
    pub static_friction: f64,
    /// Coefficient at the peak, `mu_m >= mu_s`.
    pub peak_friction: f64,
    /// Speed `v_m` of the peak.
    pub peak_speed: f64,
    /// Inverse width `h > 0` of the bell, per decade of speed.
    pub sharpness: f64,
    /// Speed `v_f > 0` below which the coefficient stays constant.
    pub floor_speed: f64,
}

#[typetag::serde(name = "savkoor")]
impl FrictionLaw for Savkoor {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        let decades = (hypot(at.velocity(), self.floor_speed) / self.peak_speed).log10() * self.sharpness;
        let friction = decay(self.peak_friction, self.static_friction, decades * decades);
        Response::Threshold(at.pressure * friction)
    }

    fn validate(&self) -> Result<(), LawError> {
        if self.peak_friction < self.static_friction {
            let message = format!("`peak_friction` must not be below `static_friction` ({})", self.static_friction);
            return Err(LawError::invalid("savkoor", "peak_friction", message));
        }
        floor_below_peak("savkoor", self.floor_speed, self.peak_speed)
    }

    fn frictionless(&self) -> bool {
        self.peak_friction == 0.0
    }
}

/// A bell over the speed needs its peak above the floor.
pub(super) fn floor_below_peak(law: &str, floor_speed: f64, peak_speed: f64) -> Result<(), LawError> {
    if floor_speed >= peak_speed {
        let message = format!("`floor_speed` must be below `peak_speed` ({peak_speed}), or there is no peak");
        return Err(LawError::invalid(law, "floor_speed", message));
    }
    Ok(())
}

inventory::submit! {
    LawInfo {
        name: "savkoor",
        kind: Kind::SetValued,
        equation: "|q| <= [static_friction + (peak_friction - static_friction) exp(-sharpness^2 log10^2(w/peak_speed))] p, \
                   w = sqrt(v^2 + floor_speed^2)",
        parameters: &[
            Parameter::new("static_friction", Unit::ONE, Range::AtLeast(0.0), "coefficient far from the peak"),
            Parameter::new("peak_friction", Unit::ONE, Range::AtLeast(0.0), "coefficient at the peak; >= static_friction"),
            Parameter::new("peak_speed", Unit::VELOCITY, Range::Above(0.0), "speed of the peak"),
            Parameter::new("sharpness", Unit::ONE, Range::Above(0.0), "inverse width of the bell, per decade of speed"),
            Parameter::new(
                "floor_speed",
                Unit::VELOCITY,
                Range::Above(0.0),
                "speed below which friction is constant; < peak_speed",
            ),
        ],
        reference: "A. R. Savkoor, Wear 8 (1965) 222",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dual::derivatives;

    const LAW: Savkoor =
        Savkoor { static_friction: 0.5, peak_friction: 2.0, peak_speed: 1e-2, sharpness: 0.4, floor_speed: 1e-9 };

    fn friction(law: &Savkoor, speed: f64) -> (f64, [f64; 2]) {
        derivatives(&law.response(&InterfacePoint::new(1.0, speed, 1.0), &[], &mut []).value())
    }

    #[test]
    fn the_peak_lies_at_the_peak_speed_corrected_for_the_floor() {
        for floor_speed in [1e-9, 5e-3] {
            let law = Savkoor { floor_speed, ..LAW };
            let peak = (1e-4 - floor_speed * floor_speed).sqrt();
            let (value, slope) = friction(&law, -peak);
            assert!((value - 2.0).abs() < 1e-15 && slope[1].abs() < 1e-12);
            assert!(friction(&law, 0.8 * peak).0 < value && friction(&law, 1.2 * peak).0 < value);
        }
    }

    #[test]
    fn symmetric_over_the_decades_and_one_e_th_at_the_width() {
        let width = 10f64.powf(1.0 / 0.4);
        for speed in [1e-2 * width, 1e-2 / width] {
            assert!((friction(&LAW, speed).0 - (0.5 + 1.5 / std::f64::consts::E)).abs() < 1e-9);
        }
    }

    #[test]
    fn rest_is_the_floor_and_far_away_is_static() {
        let (value, slope) = friction(&LAW, 0.0);
        assert!((value - (0.5 + 1.5 * (-0.16f64 * 49.0).exp())).abs() < 1e-14 && slope[1] == 0.0);
        assert!((friction(&LAW, 1e30).0 - 0.5).abs() < 1e-15);
    }

    #[test]
    fn a_dip_and_a_floor_above_the_peak_are_refused() {
        assert_eq!(crate::validate(&Savkoor { peak_friction: 0.4, ..LAW }).unwrap_err().key(), "peak_friction");
        assert_eq!(crate::validate(&Savkoor { floor_speed: 1e-2, ..LAW }).unwrap_err().key(), "floor_speed");
    }

    #[test]
    fn conforms() {
        for (static_friction, peak_friction) in [(0.5, 2.0), (0.3, 0.3), (0.0, 1e-6), (0.0, 0.0), (1.0, 1e3)] {
            for (peak_speed, floor_speed) in [(1e-2, 1e-6), (1e9, 1e-9), (1e-9, 5e-10)] {
                for sharpness in [1e-3, 0.4, 10.0] {
                    let law = Savkoor { static_friction, peak_friction, peak_speed, sharpness, floor_speed };
                    crate::conforms(&law).unwrap();
                }
            }
        }
    }
}
