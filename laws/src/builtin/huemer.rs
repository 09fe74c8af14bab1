//! Rubber on concrete and ice: the law of Huemer, Liu, Eberhardsteiner and Mang.

use super::pressure_power::finite_slope;
use crate::{
    Dual, FrictionLaw, InterfacePoint, Kind, LawError, LawInfo, Parameter, Range, Response, Unit,
    dual::{hypot, offset_power, power},
};
use serde::{Deserialize, Serialize};

/// `|q| <= mu(p, v) p`, `mu = (alpha |p|^(n-1) + beta) / (a + b |v|^(-1/m) + c |v|^(-2/m))`, fitted to block tests.
///
/// The numerator falls with the pressure (`n < 1`, rubber), the denominator is a parabola in `x = |v|^(-1/m)`: with `b < 0` the
/// coefficient has a maximum over the speed at `x = -b/2c`, else it grows from rest to high speed, where it tends to
/// `(alpha p^(n-1) + beta) / a`. Pressure and speed are counted in units of a reference, `p/p_r` and `|v|/v_r` (those of the
/// fit, say 1 MPa and 1 mm/s), which makes all coefficients pure numbers. `p` is the true pressure.
///
/// Regularised twice. `p |p/p_r|^(n-1)` has an infinite slope at `p = 0` for `n < 1`: it becomes
/// `p_r [((p+p_0)/p_r)^n - (p_0/p_r)^n]` as in [`crate::builtin::PressurePower`]. The coefficient tends to 0 at rest, with
/// infinite slope: `|v|` becomes `sqrt(v^2 + v_f^2)`, so that a contact at rest sticks with what it carries at the floor `v_f`.
/// The bound is smooth with `db/ds = 0` at rest.
///
/// The denominator must not vanish: `a > 0`, `c >= 0`, and `b^2 < 4 a c` if `b < 0`. Falling branches over the speed: see the
/// warning at [`crate::builtin::Stribeck`]. Limits: `alpha = b = c = 0` is Coulomb's law with `beta/a`, `alpha = beta = 0` no
/// friction.
///
/// Reference: T. Huemer, W. N. Liu, J. Eberhardsteiner and H. A. Mang, Eng. Comput. 18 (2001) 417. The printed equation was not
/// checked against the source; the regularisation is ours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Huemer {
    /// Pressure-dependent part of the numerator, `alpha >= 0`.
    pub alpha: f64,
    /// Exponent `n > 0` of the traction over the pressure.
    pub n: f64,
    /// Constant part of the numerator, `beta >= 0`.
    pub beta: f64,
    /// Denominator at high speed, `a > 0`.
    pub a: f64,
    /// Linear coefficient of the denominator.
    pub b: f64,
    /// Quadratic coefficient `c >= 0` of the denominator.
    pub c: f64,
    /// Root `m > 0` of the speed.
    pub m: f64,
    /// Unit `p_r > 0` of the pressure in the fit (stress).
    pub reference_pressure: f64,
    /// Unit `v_r > 0` of the speed in the fit.
    pub reference_speed: f64,
    /// Pressure `p_0 >= 0` below which the law is linear; above 0 if `n < 1`.
    #[serde(default)]
    pub offset_pressure: f64,
    /// Speed `v_f > 0` below which the coefficient stays constant.
    pub floor_speed: f64,
}

#[typetag::serde(name = "huemer")]
impl FrictionLaw for Huemer {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        let scale = self.reference_pressure;
        let falling = offset_power(at.pressure / scale, self.offset_pressure / scale, self.n) * (self.alpha * scale);
        let x = power(hypot(at.velocity(), self.floor_speed) / self.reference_speed, -1.0 / self.m);
        Response::Threshold((falling + at.pressure * self.beta) / ((x * self.c + self.b) * x + self.a))
    }

    fn validate(&self) -> Result<(), LawError> {
        if self.b < 0.0 && self.b * self.b >= 4.0 * self.a * self.c {
            let message =
                format!("`b = {}` < 0 needs b^2 < 4 a c = {}: the denominator vanishes", self.b, 4.0 * self.a * self.c);
            return Err(LawError::invalid("huemer", "b", message));
        }
        finite_slope("huemer", "n", self.n, self.offset_pressure)
    }

    fn frictionless(&self) -> bool {
        self.alpha == 0.0 && self.beta == 0.0
    }
}

inventory::submit! {
    LawInfo {
        name: "huemer",
        kind: Kind::SetValued,
        equation: "|q| <= p (alpha P^(n-1) + beta) / (a + b V^(-1/m) + c V^(-2/m)), \
                   P = p/reference_pressure, V = |v|/reference_speed; linear in p below offset_pressure, constant in v below floor_speed",
        parameters: &[
            Parameter::new("alpha", Unit::ONE, Range::AtLeast(0.0), "pressure-dependent part of the numerator"),
            Parameter::new("n", Unit::ONE, Range::Above(0.0), "exponent of the traction over the pressure"),
            Parameter::new("beta", Unit::ONE, Range::AtLeast(0.0), "constant part of the numerator"),
            Parameter::new("a", Unit::ONE, Range::Above(0.0), "denominator at high speed"),
            Parameter::new("b", Unit::ONE, Range::Number, "linear coefficient of the denominator; b^2 < 4 a c if b < 0"),
            Parameter::new("c", Unit::ONE, Range::AtLeast(0.0), "quadratic coefficient of the denominator"),
            Parameter::new("m", Unit::ONE, Range::Above(0.0), "root of the speed"),
            Parameter::new("reference_pressure", Unit::STRESS, Range::Above(0.0), "unit of the pressure in the fit"),
            Parameter::new("reference_speed", Unit::VELOCITY, Range::Above(0.0), "unit of the speed in the fit"),
            Parameter::new(
                "offset_pressure",
                Unit::STRESS,
                Range::AtLeast(0.0),
                "pressure below which the law is linear; > 0 if n < 1",
            )
            .or("0"),
            Parameter::new("floor_speed", Unit::VELOCITY, Range::Above(0.0), "speed below which friction is constant"),
        ],
        reference: "T. Huemer, W. N. Liu, J. Eberhardsteiner and H. A. Mang, Eng. Comput. 18 (2001) 417",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dual::derivatives;

    const LAW: Huemer = Huemer {
        alpha: 0.6,
        n: 0.8,
        beta: 0.2,
        a: 1.0,
        b: -1.5,
        c: 0.8,
        m: 4.0,
        reference_pressure: 2.0,
        reference_speed: 10.0,
        offset_pressure: 1e-12,
        floor_speed: 1e-12,
    };

    fn bound(law: &Huemer, pressure: f64, speed: f64) -> (f64, [f64; 2]) {
        derivatives(&law.response(&InterfacePoint::new(pressure, speed, 1.0), &[], &mut []).value())
    }

    #[test]
    fn the_formula_where_nothing_is_regularised() {
        for (p, v) in [(3.0, 5.0), (0.4, 200.0), (8.0, 1e-3)] {
            let x = (v / 10.0f64).powf(-0.25);
            let friction = (0.6 * (p / 2.0f64).powf(-0.2) + 0.2) / (1.0 - 1.5 * x + 0.8 * x * x);
            // the offset takes (p0/p)^n ~ 1e-10 away
            assert!((bound(&LAW, p, v).0 / (p * friction) - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn maximum_over_the_speed_at_the_vertex_of_the_parabola() {
        let peak = 10.0 * (1.5f64 / 1.6).powf(-4.0);
        let (value, slope) = bound(&LAW, 2.0, peak);
        assert!(slope[1].abs() < 1e-13 * value / peak);
        let expected = 2.0 * 0.8 / (1.0 - 1.5 * 1.5 / (4.0 * 0.8));
        assert!((value / expected - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_denominator_that_vanishes_is_refused() {
        assert_eq!(crate::validate(&Huemer { b: -2.0, ..LAW }).unwrap_err().key(), "b");
        assert_eq!(crate::validate(&Huemer { offset_pressure: 0.0, ..LAW }).unwrap_err().key(), "offset_pressure");
    }

    #[test]
    fn conforms() {
        let rounded = Huemer { offset_pressure: 1e-3, floor_speed: 1e-6, ..LAW };
        for law in [
            Huemer { ..rounded },
            Huemer { alpha: 0.0, beta: 0.3, b: 0.0, c: 0.0, ..rounded },
            Huemer { alpha: 0.0, beta: 0.0, ..rounded },
            Huemer { alpha: 1e3, n: 0.1, a: 1e-3, b: 1e3, c: 0.0, m: 0.5, ..rounded },
            Huemer { reference_pressure: 1e9, reference_speed: 1e-9, offset_pressure: 1e-6, floor_speed: 1e3, ..LAW },
            Huemer { m: 50.0, n: 1.0, offset_pressure: 0.0, floor_speed: 1e-9, ..LAW },
        ] {
            crate::conforms(&law).unwrap();
        }
    }
}
