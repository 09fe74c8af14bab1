//! Rate-and-state friction.

use crate::{
    Dual, DualNum, FrictionLaw, InterfacePoint, Kind, LawInfo, Parameter, Range, Response, Unit, Variable,
    dual::{self, chain, constant},
};
use serde::{Deserialize, Serialize};

/// `q = p a asinh[ V/(2 V0) exp((mu0 + b ln(V0 theta/Dc))/a) ]`, the regularised form of `mu = mu0 + a ln(V/V0) + b ln(V0 theta/Dc)`.
///
/// `V = s/dt` is signed and the law odd in it, so this is a direct law: at rest `q = 0` exactly, below the steady coefficient it creeps
/// with `V = 2 V0 exp(-(mu0 + ..)/a) sinh(q/(a p))`, and it never sticks. The state `theta > 0` (time) is the age of the contacts:
///
/// ```text
/// aging   theta' = 1 - V theta/Dc                  slip   theta' = -(V theta/Dc) ln(V theta/Dc)
/// prz     theta' = 1 - (V theta/(2 Dc))^2
/// ```
///
/// Steady sliding: `theta = Dc/V` (prz: `2 Dc/V`), `mu_ss = mu0 + (a - b) ln(V/V0)` (prz: `+ b ln 2`); weakening for `b > a`.
/// A step of velocity gives `+a ln(V2/V1)` at once and `(a - b) ln(V2/V1)` in the end; under the slip law the way there is `exp(-x/Dc)` exactly.
/// At rest `theta` grows with time (aging, prz) or stays (slip); an open contact behaves as one at rest.
///
/// The age is advanced by the exact solution for the constant velocity of the step, `x = |s|/Dc`:
///
/// ```text
/// aging   theta1 = theta0 e^-x + dt (1 - e^-x)/x      slip   ln(V theta1/Dc) = e^-x ln(V theta0/Dc)
/// prz     theta1 = (theta0 + dt tanh(x/2)/(x/2)) / (1 + V theta0/(2 Dc) tanh(x/2))
/// ```
///
/// positive in steps of any length, while backward Euler needs many steps to each `Dc` and, in `ln theta`, misses the growth of a long
/// hold. Hence no step is suggested: only a changing velocity asks for short ones. `q s >= 0` always. Scaling `mu0, a, b` together scales `q`.
///
/// Usual values for rock: `a` 0.005-0.015, `b` 0.005-0.02, `Dc` 1-100 um, `V0` 1e-6 m/s, `mu0` 0.6. The slope at rest holds
/// `exp(mu0/a)`; for it to be a number `mu0/a <= 300`. On a spring of stiffness `k` steady sliding is unstable for `k < (b - a) p/Dc`.
///
/// Reference: Dieterich, JGR 84 (1979) 2161 (aging); Ruina, JGR 88 (1983) 10359 (slip); Perrin, Rice and Zheng, JMPS 43 (1995) 1461 (prz);
/// Lapusta, Rice, Ben-Zion and Zheng, JGR 105 (2000) 23765 (regularised). The printed equations were not checked against the sources.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RateAndState {
    /// Coefficient `mu0 >= 0` of steady sliding at `speed`.
    pub friction: f64,
    /// Direct effect `a > 0`.
    pub direct_effect: f64,
    /// Evolution effect `b >= 0`.
    pub evolution_effect: f64,
    /// Distance `Dc > 0` over which the contacts are renewed (length).
    pub distance: f64,
    /// Reference velocity `V0 > 0`.
    pub speed: f64,
    /// How the state evolves.
    #[serde(default)]
    pub evolution: Evolution,
    /// Age `theta > 0` at the start (time); by default that of steady sliding at `speed` under the aging law, `Dc/V0`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub initial_age: Option<f64>,
}

/// Evolution law of the age of the contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Evolution {
    /// Dieterich: contacts age at rest.
    #[default]
    Aging,
    /// Ruina: the state changes only with slip.
    Slip,
    /// Perrin, Rice and Zheng: ages at rest, quadratic in the velocity.
    Prz,
}

impl RateAndState {
    /// `theta` at the end of the step.
    fn age(&self, at: &InterfacePoint, old: f64) -> Dual {
        let x = dual::abs(at.slip) / self.distance;
        let half = tanh_over(x * 0.5);
        match self.evolution {
            Evolution::Aging => (-x).exp() * old + half / (x * half * 0.5 + 1.0) * at.dt,
            Evolution::Slip if x.re == 0.0 => constant(old),
            Evolution::Slip => ((at.speed() * old / self.distance).ln() * -(-x).exp_m1()).exp().recip() * old,
            Evolution::Prz => (half * at.dt + old) / (x * x * half * (0.25 * old / at.dt) + 1.0),
        }
    }
}

#[typetag::serde(name = "rate-and-state")]
impl FrictionLaw for RateAndState {
    fn variables(&self) -> Vec<Variable> {
        vec![Variable::new("theta", Unit::TIME, self.initial_age.unwrap_or(self.distance / self.speed))]
    }

    fn response(&self, at: &InterfacePoint, old: &[f64], new: &mut [Dual]) -> Response {
        let age = self.age(at, old[0]);
        new[0] = age;
        let state = (age * self.speed / self.distance).ln() * self.evolution_effect;
        let coefficient =
            asinh_of_product(at.velocity() / (2.0 * self.speed), (state + self.friction) / self.direct_effect);
        Response::Traction(at.pressure * coefficient * self.direct_effect)
    }

    fn validate(&self) -> Result<(), crate::LawError> {
        let message = "`friction / direct_effect` must be <= 300: the slope at rest grows with its exponential".into();
        let valid = self.friction <= 300.0 * self.direct_effect;
        let error = || crate::LawError::Invalid { law: "rate-and-state".into(), key: "direct_effect".into(), message };
        if valid { Ok(()) } else { Err(error()) }
    }
}

/// `tanh(y)/y`. Below 1e-3 its series: the quotient would lose the digits of its slope, the next term (17 y^6/315) is below round-off.
fn tanh_over(y: Dual) -> Dual {
    let square = y * y;
    if y.re < 1e-3 { square * (square * (2.0 / 15.0) - 1.0 / 3.0) + 1.0 } else { dual::tanh(y) / y }
}

/// `asinh(x e^k)` without overflow: `ln|x| + k + ln(1 + sqrt(1 + (x e^k)^-2))` where the argument is large.
fn asinh_of_product(x: Dual, k: Dual) -> Dual {
    if x.re.abs().ln() + k.re <= 0.0 {
        return (x * k.exp()).asinh();
    }
    let logarithm = dual::abs(x).ln() + k;
    let size = logarithm + (((logarithm * -2.0).exp() + 1.0).sqrt() + 1.0).ln();
    chain(size, size.re.copysign(x.re), x.re.signum())
}

inventory::submit! {
    LawInfo {
        name: "rate-and-state",
        kind: Kind::Direct,
        equation: "q = p a asinh[v/(2 V0) exp((mu0 + b ln(V0 theta/Dc))/a)], a = direct_effect, b = evolution_effect, mu0 = friction, V0 = speed, Dc = distance; theta' = 1 - v theta/Dc (aging), -(v theta/Dc) ln(v theta/Dc) (slip), 1 - (v theta/2 Dc)^2 (prz)",
        parameters: &[
            Parameter::new("friction", Unit::ONE, Range::AtLeast(0.0), "coefficient of steady sliding at `speed`"),
            Parameter::new("direct_effect", Unit::ONE, Range::Above(0.0), "a, answer to a jump of the velocity; friction/a <= 300"),
            Parameter::new("evolution_effect", Unit::ONE, Range::AtLeast(0.0), "b, strengthening with the age of the contacts"),
            Parameter::new("distance", Unit::LENGTH, Range::Above(0.0), "slip that renews the contacts"),
            Parameter::new("speed", Unit::VELOCITY, Range::Above(0.0), "reference velocity"),
            Parameter::new("evolution", Unit::ONE, Range::Choice(&["aging", "slip", "prz"]), "evolution law of the age").or("aging"),
            Parameter::new("initial_age", Unit::TIME, Range::Above(0.0), "age of the contacts at the start").or("distance / speed"),
        ],
        reference: "Dieterich, JGR 84 (1979) 2161; Ruina, JGR 88 (1983) 10359; Lapusta et al., JGR 105 (2000) 23765",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn asinh_of_a_product_in_both_branches_and_beyond_the_largest_number() {
        for (x, k) in [(1e-3, 2.0), (-3.0, 4.0), (0.2, 1.6094379124341003), (-1e-9, 20.0)] {
            let value = asinh_of_product(constant(x), constant(k)).re;
            assert!((value - (x * f64::exp(k)).asinh()).abs() < 1e-15 * (1.0 + value.abs()), "{value}");
        }
        let huge = asinh_of_product(constant(-1e3), constant(1e4)).re;
        assert!((huge + 2f64.ln() + 1e3f64.ln() + 1e4).abs() < 1e-11);
    }

    const ROCK: RateAndState = RateAndState {
        friction: 0.6,
        direct_effect: 0.01,
        evolution_effect: 0.015,
        distance: 1e-5,
        speed: 1e-6,
        evolution: Evolution::Aging,
        initial_age: None,
    };

    #[test]
    fn conforms() {
        for evolution in [Evolution::Aging, Evolution::Slip, Evolution::Prz] {
            for law in [
                RateAndState { evolution, ..ROCK },
                RateAndState { evolution, friction: 0.1, ..ROCK },
                RateAndState { evolution, friction: 0.0, evolution_effect: 0.0, initial_age: Some(1e6), ..ROCK },
                RateAndState { evolution, direct_effect: 1.0, distance: 1e3, speed: 1e3, ..ROCK },
                RateAndState { evolution, direct_effect: 1e-12, friction: 1e-12, evolution_effect: 1e-12, ..ROCK },
            ] {
                crate::conforms(&law).unwrap();
            }
        }
    }

    #[test]
    fn a_slope_at_rest_beyond_numbers_is_refused() {
        let law = RateAndState { direct_effect: 0.001, ..ROCK };
        assert_eq!(crate::validate(&law).unwrap_err().key(), "direct_effect");
    }
}
