//! Regularised Coulomb friction.

use crate::{
    Dual, DualNum, FrictionLaw, InterfacePoint, Kind, LawInfo, Parameter, Range, Response, Unit,
    dual::{chain, tanh},
};
use serde::{Deserialize, Serialize};

/// `q = mu p f(v/v_e)` with a smooth, odd `f` from -1 to 1: Coulomb's law with the jump at rest spread over the velocity `v_e`.
///
/// ```text
/// tanh   f = tanh x                  missing at speed v: 2 exp(-2 v/v_e)      creep under q: v = v_e atanh(q/(mu p))
/// atan   f = (2/pi) atan x                               (2/pi) v_e/v
/// root   f = x / sqrt(1 + x^2)                           (v_e/v)^2 / 2
/// ```
///
/// There is no stick: under any load the contact creeps. `v_e -> 0` is Coulomb's law; the tangent at rest, `mu p f'(0)/(v_e dt)`, grows
/// without bound on the way. `q v >= 0` always; `mu = 0` carries nothing. A set-valued law (`coulomb`) costs no more and sticks exactly;
/// this one is for comparison with codes that regularise, and for lubricated contacts that do creep.
///
/// Reference: Oden and Pires, J. Appl. Mech. 50 (1983) 67 (tanh among others); atan: user manuals of finite-element codes. The printed
/// equations were not checked against the sources.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Regularised {
    /// Coefficient of friction `mu >= 0`.
    pub friction: f64,
    /// Velocity `v_e > 0` over which friction rises.
    pub speed: f64,
    /// The function `f`.
    #[serde(default)]
    pub shape: Shape,
}

/// How friction rises with the velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// Hyperbolic tangent: exponentially close to Coulomb.
    #[default]
    Tanh,
    /// Inverse tangent: first order in `v_e`.
    Atan,
    /// `x / sqrt(1 + x^2)`: second order in `v_e`.
    Root,
}

impl Shape {
    fn of(self, x: Dual) -> Dual {
        match self {
            Self::Tanh => tanh(x),
            Self::Atan => x.atan() * std::f64::consts::FRAC_2_PI,
            Self::Root => {
                let root = x.re.hypot(1.0);
                chain(x, x.re / root, root.powi(-3))
            }
        }
    }
}

#[typetag::serde(name = "regularised")]
impl FrictionLaw for Regularised {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        Response::Traction(at.pressure * self.shape.of(at.velocity() / self.speed) * self.friction)
    }
}

inventory::submit! {
    LawInfo {
        name: "regularised",
        kind: Kind::Direct,
        equation: "q = friction p f(v/speed); f(x) = tanh x (tanh), (2/pi) atan x (atan), x/sqrt(1 + x^2) (root)",
        parameters: &[
            Parameter::new("friction", Unit::ONE, Range::AtLeast(0.0), "coefficient of friction"),
            Parameter::new("speed", Unit::VELOCITY, Range::Above(0.0), "velocity over which friction rises"),
            Parameter::new("shape", Unit::ONE, Range::Choice(&["tanh", "atan", "root"]), "function of the velocity").or("tanh"),
        ],
        reference: "Oden and Pires, J. Appl. Mech. 50 (1983) 67",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Shape; 3] = [Shape::Tanh, Shape::Atan, Shape::Root];

    fn coefficient(shape: Shape, velocity: f64, speed: f64) -> f64 {
        let at = InterfacePoint::new(2.0, velocity * 0.1, 0.1);
        Regularised { friction: 0.3, speed, shape }.response(&at, &[], &mut []).value().re / 2.0
    }

    #[test]
    fn tends_to_coulomb_at_the_stated_rates() {
        let missing = |shape, speed| 1.0 - coefficient(shape, 1.0, speed) / 0.3;
        for speed in [1e-2, 1e-3] {
            assert!((missing(Shape::Atan, speed) / (std::f64::consts::FRAC_2_PI * speed) - 1.0).abs() < speed);
            assert!((missing(Shape::Root, speed) / (0.5 * speed * speed) - 1.0).abs() < 1e-4);
        }
        assert!((missing(Shape::Tanh, 0.2) / (2.0 * (-10.0f64).exp()) - 1.0).abs() < 1e-4);
        assert!(missing(Shape::Tanh, 0.05).abs() < 1e-15);
    }

    #[test]
    fn creeps_under_any_load() {
        let velocity = 1e-3 * f64::atanh(0.5);
        assert!((coefficient(Shape::Tanh, velocity, 1e-3) - 0.15).abs() < 1e-15);
    }

    #[test]
    fn carries_nothing_at_zero_friction() {
        for shape in ALL {
            let law = Regularised { friction: 0.0, speed: 1.0, shape };
            let answer = law.response(&InterfacePoint::new(1e9, 1e9, 1e-9), &[], &mut []).value();
            assert_eq!(crate::dual::derivatives(&answer), (0.0, [0.0, 0.0]));
        }
    }

    #[test]
    fn conforms() {
        for shape in ALL {
            for (friction, speed) in [(0.3, 1e-3), (0.0, 1.0), (10.0, 1e9), (1e-9, 1e-12)] {
                crate::conforms(&Regularised { friction, speed, shape }).unwrap();
            }
        }
    }
}
