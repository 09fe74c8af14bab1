//! Dahl's presliding model.

use crate::{
    Dual, DualNum, FrictionLaw, InterfacePoint, Kind, LawInfo, Parameter, Range, Response, Unit, Variable,
    dual::{constant, max, min},
};
use serde::{Deserialize, Serialize};

/// `q = k z`, `dz/dx = (1 - u)^i` along the slip path `x` with `u = sign(s) z/B`, `B = mu p/k`, and `|z| <= B`: friction
/// as a spring that yields gradually. `i = 1` is the usual law `z' = v - |v| k z/(mu p)`; `i = 0` an elastic, perfectly plastic contact.
///
/// First loading for `i = 1`: `q = mu p (1 - exp(-k x/(mu p)))`; the loop of amplitude `X >> B` encloses `4 mu p X`. Rate
/// independent. `k -> infinity` is Coulomb's law. `mu = 0` carries nothing.
///
/// **When the pressure changes** the stiffness `k` (stress per length) stays and the bound `B` on the deflection follows the pressure: a
/// deflection beyond it slips back, so `|q| <= mu p` also while the pressure falls. The other reading, `q = p sigma z` with a fixed
/// bound on `z`, keeps `|q| <= mu p` too, but its stored energy `p sigma z^2/2` grows with the pressure although no tangential
/// work is done: deflect at low pressure, return at high pressure, and energy comes from nothing. Here it is `k z^2/2`, slipping back only
/// loses of it, and the work of friction is never less than the energy stored, whatever the pressure does.
///
/// `z` is advanced by the exact solution for the constant direction and pressure of the step, from `z0` cut to `|z0| <= B`, `x = |s|/B`:
///
/// ```text
/// i = 1    z1 = z0 e^-x + sign(s) B (1 - e^-x)
/// else     the same with (1 + (i - 1) x w^(i - 1))^(-1/(i - 1)) for e^-x ,   w = 1 - sign(s) z0/B ;  0 where the bracket is <= 0
/// ```
///
/// not by its rates: these are infinite as `p -> 0` and their start value depends on the pressure. An opening contact forgets `z`.
///
/// Reference: P. R. Dahl, A solid friction model, Aerospace Corporation TOR-0158(3107-18)-1 (1968); AIAA J. 14 (1976) 1675. The printed
/// equations were not checked against the sources.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dahl {
    /// Coefficient of friction `mu >= 0`.
    pub friction: f64,
    /// Tangential stiffness `k > 0` of the unloaded contact (stress per length).
    pub stiffness: f64,
    /// Exponent `i`: 0 brittle to 1 and above, ductile.
    #[serde(default = "linear")]
    pub exponent: f64,
}

fn linear() -> f64 {
    1.0
}

impl Dahl {
    /// Deflection at the end of the step.
    fn deflection(&self, at: &InterfacePoint, old: f64) -> Dual {
        let bound = at.pressure * (self.friction / self.stiffness);
        let start = max(min(constant(old), bound), -bound);
        let sign = if at.slip.re == 0.0 { 0.0 } else { at.slip.re.signum() };
        if bound.re == 0.0 {
            let side = if sign == 0.0 { old.partial_cmp(&0.0).map_or(0.0, |o| f64::from(o as i8)) } else { sign };
            return bound * side;
        }
        let (u, i) = (start / bound, self.exponent);
        if sign == 0.0 {
            let slopes = [1.0 - u.re, 1.0 + u.re].map(|w| w.powf(i));
            return start + at.slip * (0.5 * (slopes[0] + slopes[1]));
        }
        let w = -u * sign + 1.0;
        if w.re <= 0.0 {
            return bound * sign;
        }
        match logarithm_of_what_is_left(at.slip * sign / bound, w, i) {
            Some(left) => start * left.exp() - bound * sign * left.exp_m1(),
            None => bound * sign,
        }
    }
}

/// `ln(w1/w0)` for `dw/dx = -w^i`; `None` if `w` has reached zero.
fn logarithm_of_what_is_left(x: Dual, w: Dual, i: f64) -> Option<Dual> {
    if i == 1.0 {
        return Some(-x);
    }
    let yielded = x * (w.ln() * (i - 1.0)).exp() * (i - 1.0);
    (yielded.re > -1.0).then(|| -yielded.ln_1p() / (i - 1.0))
}

#[typetag::serde(name = "dahl")]
impl FrictionLaw for Dahl {
    fn variables(&self) -> Vec<Variable> {
        vec![Variable::new("deflection", Unit::LENGTH, 0.0)]
    }

    fn response(&self, at: &InterfacePoint, old: &[f64], new: &mut [Dual]) -> Response {
        new[0] = self.deflection(at, old[0]);
        Response::Traction(new[0] * self.stiffness)
    }

    fn open(&self, _: &InterfacePoint, _: &[f64], new: &mut [f64]) {
        new[0] = 0.0;
    }
}

inventory::submit! {
    LawInfo {
        name: "dahl",
        kind: Kind::Direct,
        equation: "q = stiffness z, |z| <= B = friction p/stiffness; dz/dx = (1 - z/B)^exponent along the slip x (z' = v - |v| z/B for exponent 1)",
        parameters: &[
            Parameter::new("friction", Unit::ONE, Range::AtLeast(0.0), "coefficient of friction"),
            Parameter::new("stiffness", Unit::STRESS.per(Unit::LENGTH), Range::Above(0.0), "tangential stiffness of the contact"),
            Parameter::new("exponent", Unit::ONE, Range::Between(0.0, 4.0), "0: elastic, perfectly plastic; 1: exponential").or("1"),
        ],
        reference: "Dahl, Aerospace Corporation TOR-0158(3107-18)-1 (1968); AIAA J. 14 (1976) 1675",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conforms() {
        for (friction, stiffness) in [(0.3, 100.0), (0.0, 1.0), (10.0, 1e-9), (1e-9, 1e12)] {
            for exponent in [0.0, 0.5, 1.0, 1.5, 4.0] {
                crate::conforms(&Dahl { friction, stiffness, exponent }).unwrap();
            }
        }
    }

    #[test]
    fn an_open_contact_forgets_and_zero_friction_carries_nothing() {
        let law = Dahl { friction: 0.0, stiffness: 1.0, exponent: 1.0 };
        let mut new = [constant(f64::NAN)];
        let answer = law.response(&InterfacePoint::new(1e9, 1e9, 1.0), &[0.0], &mut new).value();
        assert_eq!(crate::dual::derivatives(&answer), (0.0, [0.0, 0.0]));
        let mut open = [f64::NAN];
        law.open(&InterfacePoint::new(0.0, 0.0, 1.0), &[1.0], &mut open);
        assert_eq!(open, [0.0]);
    }
}
