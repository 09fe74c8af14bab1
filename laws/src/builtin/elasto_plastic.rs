//! Elasto-plastic presliding.

use super::bristle::{Damping, curve, ordered};
use crate::{
    Dual, DualNum, FrictionLaw, InterfacePoint, Kind, LawError, LawInfo, Parameter, Range, Response, Unit, Variable,
    dual::constant, evolve,
};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// `q = p [sigma0 z + sigma1(v) z' + sigma2 v]`, `z' = v [1 - alpha(z, v) z/z_ss(v)]`: LuGre with bristles that are purely elastic at
/// small deflections, so that a load below break-away does not make it drift.
///
/// ```text
/// z_ss = sign(v) g(v)/sigma0 ,  g(v) = mu_k + (mu_s - mu_k) exp(-(v/v_s)^2) ,  z_ba = elastic mu_k/sigma0
/// alpha = 0                                                      |z| <= z_ba, or z and v of opposite sign
///       = 1/2 + 1/2 sin(pi [|z| - (|z_ss| + z_ba)/2]/(|z_ss| - z_ba))      z_ba < |z| < |z_ss|
///       = 1                                                      |z| >= |z_ss|
/// ```
///
/// Up to `z_ba` the contact is a spring `p sigma0` and all displacement is recovered; beyond, part of it stays; at `|z| = |z_ss|` all of it:
/// `q = p [g(v) sign(v) + sigma2 v]` as in `lugre`, which is `alpha = 1` everywhere. Unloading is elastic. Units, passivity
/// of the damping, size of the step, opening and zero friction as in `lugre`. `sigma0 -> infinity` is Coulomb's law for `mu_s = mu_k`, no damping.
///
/// The step `z1 = z0 + s [1 - alpha z1/z_ss]` has one solution: its bracket falls with `z1 sign(s)`. [`evolve()`] finds it up to slips of some
/// 1e18 `z_ss`; beyond, the answer is NaN and the step is cut.
///
/// Reference: Dupont, Hayward, Armstrong and Altpeter, IEEE Trans. Autom. Control 47 (2002) 787. The printed equations were not checked
/// against the source; the passive form of `sigma1(v)` is this program's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ElastoPlastic {
    /// Coefficient `mu_s` at rest.
    pub rest: f64,
    /// Coefficient `mu_k` at high speed, `0 < mu_k <= mu_s`.
    pub kinetic: f64,
    /// Velocity `v_s > 0` of the transition.
    pub speed: f64,
    /// Fraction of `mu_k` up to which the contact is elastic.
    pub elastic: f64,
    /// Bristle stiffness `sigma0 > 0` per unit of pressure (1/length).
    pub stiffness: f64,
    /// Bristle damping `sigma1 >= 0` per unit of pressure (time/length).
    #[serde(default)]
    pub damping: f64,
    /// Whether the damping falls with the speed.
    #[serde(default)]
    pub damping_form: Damping,
    /// Viscous coefficient `sigma2 >= 0` per unit of pressure (time/length).
    #[serde(default)]
    pub viscosity: f64,
}

impl ElastoPlastic {
    /// `alpha z / |z_ss|` from the carried coefficient `load = sigma0 z sign(v)` and `g(v)`; positive loads only.
    fn yielding(&self, load: Dual, g: Dual) -> Dual {
        let elastic = self.elastic * self.kinetic;
        if load.re <= elastic {
            return constant(0.0);
        }
        let share = (load - elastic) / (g - elastic);
        let alpha = if share.re < 1.0 { ((share - 0.5) * PI).sin() * 0.5 + 0.5 } else { constant(1.0) };
        alpha * load / g
    }
}

#[typetag::serde(name = "elasto-plastic")]
impl FrictionLaw for ElastoPlastic {
    fn variables(&self) -> Vec<Variable> {
        vec![Variable::new("deflection", Unit::LENGTH, 0.0)]
    }

    fn response(&self, at: &InterfacePoint, old: &[f64], new: &mut [Dual]) -> Response {
        let v = at.velocity();
        if self.rest == 0.0 {
            new[0] = constant(0.0);
            return Response::Traction(at.pressure * v * self.viscosity);
        }
        let g = curve(self.rest, self.kinetic, self.speed, v);
        let sign = if v.re < 0.0 { -1.0 } else { 1.0 };
        let rate = |z: Dual| v - v * self.yielding(z * (sign * self.stiffness), g);
        let [z] = evolve(at.dt, old, new, |[z]| [rate(z)]);
        let damping = self.damping_form.at(self.damping, v, g);
        Response::Traction(at.pressure * (z * self.stiffness + damping * rate(z) + v * self.viscosity))
    }

    fn open(&self, _: &InterfacePoint, _: &[f64], new: &mut [f64]) {
        new[0] = 0.0;
    }

    fn validate(&self) -> Result<(), LawError> {
        ordered("elasto-plastic", self.rest, self.kinetic)
    }
}

inventory::submit! {
    LawInfo {
        name: "elasto-plastic",
        kind: Kind::Direct,
        equation: "q = p [stiffness z + damping(v) z' + viscosity v], z' = v [1 - alpha(z, v) stiffness |z|/g(v)], g = kinetic + (rest - kinetic) exp(-(v/speed)^2); alpha rises from 0 at stiffness |z| = elastic kinetic to 1 at g, 0 if z and v oppose",
        parameters: &[
            Parameter::new("rest", Unit::ONE, Range::AtLeast(0.0), "coefficient at rest"),
            Parameter::new("kinetic", Unit::ONE, Range::AtLeast(0.0), "coefficient at high speed, <= rest, 0 only if rest is"),
            Parameter::new("speed", Unit::VELOCITY, Range::Above(0.0), "velocity of the transition"),
            Parameter::new("elastic", Unit::ONE, Range::Between(0.0, 0.99), "fraction of kinetic up to which the contact is elastic"),
            Parameter::new("stiffness", Unit::ONE.per(Unit::LENGTH), Range::Above(0.0), "bristle stiffness sigma0 per pressure"),
            Parameter::new("damping", Unit::ONE.per(Unit::VELOCITY), Range::AtLeast(0.0), "bristle damping sigma1 per pressure").or("0"),
            Parameter::new("damping_form", Unit::ONE, Range::Choice(&["passive", "constant"]), "sigma1/(1 + sigma1 |v|/(4 g)), or sigma1").or("passive"),
            Parameter::new("viscosity", Unit::ONE.per(Unit::VELOCITY), Range::AtLeast(0.0), "viscous coefficient sigma2 per pressure").or("0"),
        ],
        reference: "Dupont, Hayward, Armstrong and Altpeter, IEEE Trans. Autom. Control 47 (2002) 787",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: ElastoPlastic = ElastoPlastic {
        rest: 1.5,
        kinetic: 1.0,
        speed: 1e-3,
        elastic: 0.7,
        stiffness: 1e5,
        damping: 316.22776601683796,
        damping_form: Damping::Passive,
        viscosity: 0.4,
    };

    #[test]
    fn conforms() {
        for law in [
            LAW,
            ElastoPlastic { rest: 1.0, elastic: 0.0, damping: 0.0, viscosity: 0.0, ..LAW },
            ElastoPlastic { rest: 1.0, elastic: 0.99, damping: 0.0, viscosity: 0.0, ..LAW },
            ElastoPlastic { stiffness: 1e-6, damping: 1e9, speed: 1e6, ..LAW },
            ElastoPlastic { rest: 1e-2, kinetic: 1e-3, ..LAW },
            ElastoPlastic { rest: 0.0, kinetic: 0.0, ..LAW },
        ] {
            crate::conforms(&law).unwrap_or_else(|violation| panic!("{law:?}: {violation}"));
        }
    }
}
