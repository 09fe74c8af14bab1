//! The LuGre model.

use super::bristle::{Damping, curve, ordered};
use crate::{
    Dual, FrictionLaw, InterfacePoint, Kind, LawError, LawInfo, Parameter, Range, Response, Unit, Variable,
    dual::constant, evolve,
};
use serde::{Deserialize, Serialize};

/// `q = p [sigma0 z + sigma1(v) z' + sigma2 v]`, `z' = v - sigma0 |v| z/g(v)`, `g(v) = mu_k + (mu_s - mu_k) exp(-(v/v_s)^2)`: bristles of
/// mean deflection `z` (length) that bend, yield and damp.
///
/// Per unit of pressure: `sigma0` in 1/length, `sigma1`, `sigma2` in time/length. Steady sliding: `q = p [g(v) sign(v) + sigma2 v]`;
/// presliding: a spring `p sigma0` up to about `g/sigma0`. `sigma0 |z| <= mu_s` always. `sigma0 -> infinity` with `sigma1 = sigma2 = 0`,
/// `mu_s = mu_k` is Coulomb's law; without damping and weakening it is Dahl's with bound `mu_s/sigma0` on `z`. Friction 0 is
/// the viscous remainder `sigma2`; all of it 0 carries nothing.
///
/// **Passivity.** With the energy `p sigma0 z^2/2`, `q v` exceeds its rate by `|v| (g y^2 + sigma1 |v| (1 - y)) + sigma2 v^2`, `y = sigma0 z sign(v)/g`;
/// that can only be negative if `sigma1 > 4 g/|v|` (Barahanov and Ortega 2000). `damping_form = "passive"` keeps
/// `sigma1(v) = sigma1/(1 + sigma1 |v|/(4 g))` below it; backward Euler inherits the argument, so no step creates energy. `"constant"` is
/// the law as published. All this at constant pressure: the energy `p sigma0 z^2/2` grows with the pressure without tangential work.
///
/// Known defects of the model: it drifts under a small load that oscillates, at loads far below friction (see `elasto-plastic`), and its
/// break-away force falls with the rate of loading. First order in the step: presliding is resolved by slips below some `0.1 g/sigma0`;
/// longer ones land on steady sliding, so no step is suggested. An opening contact forgets `z`.
///
/// Published set, per newton of load: `sigma0` 1e5 1/m, `sigma1` sqrt(1e5) s/m, `sigma2` 0.4 s/m, `mu_k` 1, `mu_s` 1.5, `v_s` 1e-3 m/s.
///
/// Reference: Canudas de Wit, Olsson, Astrom and Lischinsky, IEEE Trans. Autom. Control 40 (1995) 419; Barahanov and Ortega, ibid. 45 (2000)
/// 949. The printed equations were not checked against the sources; the passive form of `sigma1(v)` is this program's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LuGre {
    /// Coefficient `mu_s` at rest.
    pub rest: f64,
    /// Coefficient `mu_k` at high speed, `0 < mu_k <= mu_s`.
    pub kinetic: f64,
    /// Velocity `v_s > 0` of the transition.
    pub speed: f64,
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

#[typetag::serde(name = "lugre")]
impl FrictionLaw for LuGre {
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
        let rate = |z: Dual| v - at.speed() * z / g * self.stiffness;
        let [z] = evolve(at.dt, old, new, |[z]| [rate(z)]);
        let damping = self.damping_form.at(self.damping, v, g);
        Response::Traction(at.pressure * (z * self.stiffness + damping * rate(z) + v * self.viscosity))
    }

    fn open(&self, _: &InterfacePoint, _: &[f64], new: &mut [f64]) {
        new[0] = 0.0;
    }

    fn validate(&self) -> Result<(), LawError> {
        ordered("lugre", self.rest, self.kinetic)
    }
}

inventory::submit! {
    LawInfo {
        name: "lugre",
        kind: Kind::Direct,
        equation: "q = p [stiffness z + damping(v) z' + viscosity v], z' = v - stiffness |v| z/g(v), g = kinetic + (rest - kinetic) exp(-(v/speed)^2)",
        parameters: &[
            Parameter::new("rest", Unit::ONE, Range::AtLeast(0.0), "coefficient at rest"),
            Parameter::new("kinetic", Unit::ONE, Range::AtLeast(0.0), "coefficient at high speed, <= rest, 0 only if rest is"),
            Parameter::new("speed", Unit::VELOCITY, Range::Above(0.0), "velocity of the transition"),
            Parameter::new("stiffness", Unit::ONE.per(Unit::LENGTH), Range::Above(0.0), "bristle stiffness sigma0 per pressure"),
            Parameter::new("damping", Unit::ONE.per(Unit::VELOCITY), Range::AtLeast(0.0), "bristle damping sigma1 per pressure").or("0"),
            Parameter::new("damping_form", Unit::ONE, Range::Choice(&["passive", "constant"]), "sigma1/(1 + sigma1 |v|/(4 g)), or sigma1").or("passive"),
            Parameter::new("viscosity", Unit::ONE.per(Unit::VELOCITY), Range::AtLeast(0.0), "viscous coefficient sigma2 per pressure").or("0"),
        ],
        reference: "Canudas de Wit, Olsson, Astrom and Lischinsky, IEEE Trans. Autom. Control 40 (1995) 419",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PUBLISHED: LuGre = LuGre {
        rest: 1.5,
        kinetic: 1.0,
        speed: 1e-3,
        stiffness: 1e5,
        damping: 316.22776601683796,
        damping_form: Damping::Passive,
        viscosity: 0.4,
    };

    #[test]
    fn conforms() {
        for law in [
            PUBLISHED,
            LuGre { viscosity: 0.0, ..PUBLISHED },
            LuGre { rest: 1.0, damping: 0.0, viscosity: 0.0, ..PUBLISHED },
            LuGre { stiffness: 1e-6, damping: 1e9, speed: 1e6, ..PUBLISHED },
            LuGre { rest: 1e-9, kinetic: 1e-12, ..PUBLISHED },
            LuGre { rest: 0.0, kinetic: 0.0, ..PUBLISHED },
            LuGre { rest: 1.0, damping_form: Damping::Constant, ..PUBLISHED },
        ] {
            crate::conforms(&law).unwrap_or_else(|violation| panic!("{law:?}: {violation}"));
        }
    }

    #[test]
    fn coefficients_out_of_order_are_refused() {
        for (rest, kinetic) in [(0.3, 0.4), (0.3, 0.0)] {
            assert_eq!(crate::validate(&LuGre { rest, kinetic, ..PUBLISHED }).unwrap_err().key(), "kinetic");
        }
    }
}
