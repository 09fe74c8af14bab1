//! Friction that follows a power of the pressure.

use crate::{
    Dual, FrictionLaw, InterfacePoint, Kind, LawError, LawInfo, Parameter, Range, Response, Unit, dual::offset_power,
};
use serde::{Deserialize, Serialize};

/// `|q| <= mu_r p_r [((p + p_0)/p_r)^n - (p_0/p_r)^n]`, that is `k [(p + p_0)^n - p_0^n]` with `k = mu_r p_r^(1-n)`.
///
/// Friction follows the real area of contact. A smooth elastic asperity (Hertz) gives `n = 2/3`, so that the coefficient falls
/// as `p^(-1/3)`: Schallamach's rubber. Many asperities of many sizes give `n -> 1` (Archard). `mu_r` is the coefficient at the
/// pressure `p_r`, for `p_0 = 0`, and saves `k` its broken unit. `p` is the true pressure.
///
/// For `n < 1` the slope of the power is infinite at `p = 0`; the offset `p_0 > 0` makes it finite,
/// `db/dp = n mu_r ((p + p_0)/p_r)^(n-1)`, and the law Coulomb's with this coefficient for `p << p_0`. `db/ds = 0`. Limit
/// `n = 1`: Coulomb's law with `mu_r`, whatever the offset.
///
/// Reference: A. Schallamach, Proc. Phys. Soc. B 65 (1952) 657; J. F. Archard, Proc. R. Soc. A 243 (1957) 190. The offset is ours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PressurePower {
    /// Coefficient `mu_r >= 0` at the reference pressure without offset.
    pub friction: f64,
    /// Reference pressure `p_r > 0` (stress).
    pub reference_pressure: f64,
    /// Exponent `n > 0` of the pressure.
    pub exponent: f64,
    /// Pressure `p_0 >= 0` below which the law is linear; above 0 if `n < 1`.
    #[serde(default)]
    pub offset_pressure: f64,
}

#[typetag::serde(name = "pressure-power")]
impl FrictionLaw for PressurePower {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        let scale = self.reference_pressure;
        let share = offset_power(at.pressure / scale, self.offset_pressure / scale, self.exponent);
        Response::Threshold(share * (self.friction * scale))
    }

    fn validate(&self) -> Result<(), LawError> {
        finite_slope("pressure-power", "exponent", self.exponent, self.offset_pressure)
    }

    fn frictionless(&self) -> bool {
        self.friction == 0.0
    }
}

/// An exponent of the pressure below one needs an offset.
pub(super) fn finite_slope(law: &str, key: &str, exponent: f64, offset_pressure: f64) -> Result<(), LawError> {
    if exponent < 1.0 && offset_pressure == 0.0 {
        let message = format!(
            "`{key} = {exponent}` below 1 has an infinite slope at no pressure; it needs `offset_pressure` > 0"
        );
        return Err(LawError::invalid(law, "offset_pressure", message));
    }
    Ok(())
}

inventory::submit! {
    LawInfo {
        name: "pressure-power",
        kind: Kind::SetValued,
        equation: "|q| <= friction * r [((p + o)/r)^exponent - (o/r)^exponent], r = reference_pressure, o = offset_pressure",
        parameters: &[
            Parameter::new("friction", Unit::ONE, Range::AtLeast(0.0), "coefficient at the reference pressure"),
            Parameter::new("reference_pressure", Unit::STRESS, Range::Above(0.0), "pressure at which `friction` holds"),
            Parameter::new("exponent", Unit::ONE, Range::Above(0.0), "exponent of the pressure"),
            Parameter::new(
                "offset_pressure",
                Unit::STRESS,
                Range::AtLeast(0.0),
                "pressure below which the law is linear; > 0 if exponent < 1",
            )
            .or("0"),
        ],
        reference: "A. Schallamach, Proc. Phys. Soc. B 65 (1952) 657",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dual::derivatives;

    fn bound(law: &PressurePower, pressure: f64) -> (f64, [f64; 2]) {
        derivatives(&law.response(&InterfacePoint::new(pressure, 1.0, 1.0), &[], &mut []).value())
    }

    #[test]
    fn schallamach_coefficient_falls_with_the_cube_root() {
        let law = PressurePower { friction: 0.6, reference_pressure: 5.0, exponent: 2.0 / 3.0, offset_pressure: 5e-12 };
        let friction = |p| bound(&law, p).0 / p;
        assert!((friction(5.0) - 0.6).abs() < 1e-7);
        assert!((friction(40.0) / friction(5.0) - 0.5).abs() < 1e-7);
    }

    #[test]
    fn coulomb_below_the_offset_and_for_exponent_one() {
        let mut law = PressurePower { friction: 0.6, reference_pressure: 5.0, exponent: 0.5, offset_pressure: 20.0 };
        let (value, slope) = bound(&law, 1e-15);
        assert!((value / 1e-15 - 0.15).abs() < 1e-14 && (slope[0] - 0.15).abs() < 1e-14);
        law.exponent = 1.0;
        for p in [1e-9, 1.0, 1e9] {
            assert!((bound(&law, p).0 / (0.6 * p) - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn infinite_slope_is_refused() {
        let law = PressurePower { friction: 0.3, reference_pressure: 1.0, exponent: 0.5, offset_pressure: 0.0 };
        let error = crate::validate(&law).unwrap_err();
        assert!(error.key() == "offset_pressure" && error.to_string().contains("infinite slope"), "{error}");
    }

    #[test]
    fn conforms() {
        for (exponent, offset_pressure) in
            [(2.0 / 3.0, 1e-3), (0.1, 1e-9), (1.0, 0.0), (1.0, 1e6), (1.5, 0.0), (2.0, 0.0), (3.0, 1.0)]
        {
            for (friction, reference_pressure) in [(0.0, 1.0), (0.3, 1e-6), (0.3, 1.0), (10.0, 1e6)] {
                crate::conforms(&PressurePower { friction, reference_pressure, exponent, offset_pressure }).unwrap();
            }
        }
    }
}
