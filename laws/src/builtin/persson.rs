//! Adhesive friction of rubber: shear stress in the area of real contact.

use super::savkoor::floor_below_peak;
use crate::{
    Dual, DualNum, FrictionLaw, InterfacePoint, Kind, LawError, LawInfo, Parameter, Range, Response, Unit,
    dual::{decay, erf, hypot},
};
use serde::{Deserialize, Serialize};

/// `|q| <= tau(v, T) A(p)`, `tau = tau_0 exp(-c log10^2(a_T w/v_p))`, `A = erf(sqrt(pi)/2 p/p_c)`, `w = sqrt(v^2 + v_f^2)`.
///
/// The true contact area, a share `A` of the apparent one, shears at a stress `tau` that is a wide bell over the logarithm of
/// the speed: chains of the rubber bind and detach. Lorenz et al. found `c` about 0.1, `tau_0` several MPa, `v_p` of mm/s to
/// cm/s. `A` is Persson's area for a randomly rough surface: `p/p_c` at low pressure, 0.79 at `p_c`, 1 in full contact; for a
/// surface of root mean square slope `h'`, `A = erf(sqrt(2) p / (E* h'))`, it is `p_c = sqrt(pi/8) E* h'`. `p`, `tau` and `p_c`
/// are true stresses.
///
/// **Temperature** shifts the speed by `log10 a_T = -c1 (T - T_0) / (c2 + T - T_0)` (Williams, Landel, Ferry), `T_0` where
/// `v_p` was measured. Universal: `c1 = 8.86, c2 = 101.5 K` with `T_0` 50 K above the glass transition. An Arrhenius law with
/// activation energy `E` is the same function with `c2 = T_0` (absolute) and `c1 = E / (k_B T_0 ln 10)`; 1 eV at 293 K gives
/// `c1 = 17.2`. A scene without temperature is at `T_0`; `c1 = 0`, the default, shifts nothing. At and below `T_0 - c2` the
/// rubber is frozen: `a_T` has passed all bounds and is held at 1e308.
///
/// At rest the bell would fall to nothing within decades of speed that no step resolves. The floor `v_f < v_p` ends it; the
/// contact creeps there anyway. Derivatives `db/dp = tau exp(-pi p^2 / 4 p_c^2) / p_c`,
/// `db/ds = -2 c log10(a_T w/v_p) b v / (w^2 ln(10) dt)`, smooth and 0 at rest. Above `v_p` friction weakens: see the warning
/// at [`crate::builtin::Stribeck`]. Limits: peak `b = tau_0 A` at `sqrt(v_p^2/a_T^2 - v_f^2)`; for `p << p_c` the law of a
/// coefficient `tau/p_c`; `p >> p_c` shear at `tau` (Tresca's law for `c = 0`).
///
/// Reference: B. Lorenz, Y. R. Oh, S. K. Nam, S. H. Jeon and B. N. J. Persson, J. Chem. Phys. 142 (2015) 194701; area: B. N. J.
/// Persson, J. Chem. Phys. 115 (2001) 3840; shift: M. L. Williams, R. F. Landel and J. D. Ferry, J. Am. Chem. Soc. 77 (1955)
/// 3701. The printed equations were not checked against the sources; the floor is ours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Persson {
    /// Shear stress `tau_0 >= 0` of the true contact at the peak.
    pub strength: f64,
    /// Speed `v_p` of the peak at the reference temperature.
    pub peak_speed: f64,
    /// Curvature `c >= 0` of the bell per square decade of speed.
    pub curvature: f64,
    /// Speed `v_f > 0` below which the shear stress stays constant.
    pub floor_speed: f64,
    /// Pressure `p_c > 0` at which the area would be full if it went on growing as at first (stress).
    pub saturation_pressure: f64,
    /// Temperature `T_0` at which `peak_speed` holds.
    #[serde(default)]
    pub reference_temperature: f64,
    /// Largest shift `c1 >= 0` in decades, 0 for none.
    #[serde(default)]
    pub wlf_c1: f64,
    /// Temperature `c2` above the frozen state; above 0 if there is a shift.
    #[serde(default)]
    pub wlf_c2: f64,
}

impl Persson {
    /// Decades `log10 a_T` by which the temperature shifts the speed.
    fn shift(&self, temperature: Option<f64>) -> f64 {
        const FROZEN: f64 = f64::MAX_10_EXP as f64;
        let above = temperature.unwrap_or(self.reference_temperature) - self.reference_temperature;
        if self.wlf_c1 == 0.0 {
            0.0
        } else if above <= -self.wlf_c2 {
            FROZEN
        } else {
            (-self.wlf_c1 * above / (self.wlf_c2 + above)).min(FROZEN)
        }
    }
}

#[typetag::serde(name = "persson")]
impl FrictionLaw for Persson {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        let decades = (hypot(at.velocity(), self.floor_speed) / self.peak_speed).log10() + self.shift(at.temperature);
        let stress = decay(self.strength, 0.0, decades * decades * self.curvature);
        let half_root_pi = std::f64::consts::FRAC_2_SQRT_PI.recip();
        Response::Threshold(erf(at.pressure * (half_root_pi / self.saturation_pressure)) * stress)
    }

    fn validate(&self) -> Result<(), LawError> {
        if self.wlf_c1 > 0.0 && self.wlf_c2 == 0.0 {
            let message = "`wlf_c1` above 0 needs `wlf_c2` > 0, the temperature from the frozen state to the reference";
            return Err(LawError::invalid("persson", "wlf_c2", message));
        }
        floor_below_peak("persson", self.floor_speed, self.peak_speed)
    }

    fn frictionless(&self) -> bool {
        self.strength == 0.0
    }
}

inventory::submit! {
    LawInfo {
        name: "persson",
        kind: Kind::SetValued,
        equation: "|q| <= strength exp(-curvature L^2) erf(sqrt(pi)/2 p/saturation_pressure), \
                   L = log10(w/peak_speed) - wlf_c1 D / (wlf_c2 + D), \
                   D = T - reference_temperature, w = sqrt(v^2 + floor_speed^2)",
        parameters: &[
            Parameter::new("strength", Unit::STRESS, Range::AtLeast(0.0), "shear stress of the true contact at the peak"),
            Parameter::new("peak_speed", Unit::VELOCITY, Range::Above(0.0), "speed of the peak at the reference temperature"),
            Parameter::new("curvature", Unit::ONE, Range::AtLeast(0.0), "fall of ln(stress) per square decade of speed"),
            Parameter::new(
                "floor_speed",
                Unit::VELOCITY,
                Range::Above(0.0),
                "speed below which friction is constant; < peak_speed",
            ),
            Parameter::new("saturation_pressure", Unit::STRESS, Range::Above(0.0), "pressure at which contact would be full, were the area p/p_c"),
            Parameter::new("reference_temperature", Unit::TEMPERATURE, Range::Number, "temperature without shift").or("0"),
            Parameter::new("wlf_c1", Unit::ONE, Range::AtLeast(0.0), "shift in decades, far above the reference").or("0"),
            Parameter::new(
                "wlf_c2",
                Unit::TEMPERATURE,
                Range::AtLeast(0.0),
                "reference temperature above the frozen state; > 0 if wlf_c1 > 0",
            )
            .or("0"),
        ],
        reference: "B. Lorenz et al., J. Chem. Phys. 142 (2015) 194701; B. N. J. Persson, J. Chem. Phys. 115 (2001) 3840",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dual::derivatives;

    const LAW: Persson = Persson {
        strength: 6.0,
        peak_speed: 1e-2,
        curvature: 0.1,
        floor_speed: 1e-9,
        saturation_pressure: 20.0,
        reference_temperature: 293.0,
        wlf_c1: 0.0,
        wlf_c2: 0.0,
    };

    fn bound(law: &Persson, pressure: f64, speed: f64, temperature: Option<f64>) -> (f64, [f64; 2]) {
        let at = InterfacePoint { temperature, ..InterfacePoint::new(pressure, speed, 1.0) };
        derivatives(&law.response(&at, &[], &mut []).value())
    }

    #[test]
    fn peak_at_the_peak_speed_and_a_bell_around() {
        let (value, slope) = bound(&LAW, 1e9, -1e-2, None);
        assert!((value - 6.0).abs() < 1e-14 && slope[1].abs() < 1e-10);
        for speed in [1e-5, 10.0] {
            assert!((bound(&LAW, 1e9, speed, None).0 / (6.0 * (-0.9f64).exp()) - 1.0).abs() < 1e-8);
        }
        let (value, slope) = bound(&LAW, 1e9, 0.0, None);
        assert!((value / (6.0 * (-4.9f64).exp()) - 1.0).abs() < 1e-14 && slope[1] == 0.0);
    }

    #[test]
    fn area_is_linear_at_first_and_full_at_last() {
        let (value, slope) = bound(&LAW, 1e-9, 1e-2, None);
        assert!((value / (6.0 * 1e-9 / 20.0) - 1.0).abs() < 1e-14 && (slope[0] / 0.3 - 1.0).abs() < 1e-14);
        assert!((bound(&LAW, 200.0, 1e-2, None).0 - 6.0).abs() < 1e-14);
    }

    #[test]
    fn temperature_shifts_the_speed_as_wlf_or_arrhenius() {
        let wlf = Persson { wlf_c1: 8.86, wlf_c2: 101.5, ..LAW };
        let decades = 8.86 * 20.0 / 121.5;
        assert_eq!(bound(&wlf, 3.0, 0.2, None), bound(&LAW, 3.0, 0.2, None));
        assert_eq!(bound(&wlf, 3.0, 0.2, Some(293.0)), bound(&LAW, 3.0, 0.2, None));
        let cold = bound(&LAW, 3.0, 0.2, None).0;
        assert!((bound(&wlf, 3.0, 0.2 * 10f64.powf(decades), Some(313.0)).0 / cold - 1.0).abs() < 1e-12);

        let energy = 11604.5; // 1 eV over the Boltzmann constant, in kelvin
        let arrhenius = Persson { wlf_c1: energy / 293.0 / 10f64.ln(), wlf_c2: 293.0, ..LAW };
        let factor = (energy * (1.0 / 293.0 - 1.0 / 313.0)).exp();
        assert!((bound(&arrhenius, 3.0, 0.2 * factor, Some(313.0)).0 / cold - 1.0).abs() < 1e-12);
    }

    #[test]
    fn frozen_rubber_carries_nothing_and_gets_there_continuously() {
        let wlf = Persson { wlf_c1: 8.86, wlf_c2: 101.5, ..LAW };
        for temperature in [0.0, 293.0 - 101.5, 293.0 - 101.5 + 1e-12, 200.0] {
            assert!(bound(&wlf, 3.0, 1.0, Some(temperature)).0 < 1e-100);
        }
    }

    #[test]
    fn a_floor_above_the_peak_and_a_shift_without_scale_are_refused() {
        assert_eq!(crate::validate(&Persson { floor_speed: 1e-2, ..LAW }).unwrap_err().key(), "floor_speed");
        assert_eq!(crate::validate(&Persson { wlf_c1: 8.86, ..LAW }).unwrap_err().key(), "wlf_c2");
    }

    #[test]
    fn conforms() {
        for (strength, saturation_pressure) in [(6.0, 20.0), (0.0, 1.0), (1e9, 1e-6), (1e-9, 1e9)] {
            for (wlf_c1, wlf_c2) in [(0.0, 0.0), (8.86, 101.5), (17.2, 293.0)] {
                for (peak_speed, curvature, floor_speed) in [(1e-2, 0.1, 1e-6), (1e6, 0.0, 1e-9), (1e-9, 3.0, 5e-10)] {
                    let speeds = Persson { peak_speed, curvature, floor_speed, ..LAW };
                    crate::conforms(&Persson { strength, saturation_pressure, wlf_c1, wlf_c2, ..speeds }).unwrap();
                }
            }
        }
    }
}
