//! Ostermeyer's dynamic friction of brakes.

use crate::{
    Dual, DualNum, FrictionLaw, InterfacePoint, Kind, LawError, LawInfo, Parameter, Range, Response, Unit, Variable,
};
use serde::{Deserialize, Serialize};

/// `|q| <= mu p` with a coefficient that follows the birth and destruction of hard patches in the contact:
///
/// ```text
/// mu' = -alpha { [beta + P] mu - gamma T }             P = p |v|  (power per area and per unit of mu)
/// T'  = -delta { epsilon (T - T0) - zeta P mu }
/// ```
///
/// Patches are destroyed at a rate that grows with `P` and are born by heat; the contact is heated by the friction power `P mu` and
/// cools to `T0`, an absolute level: with `T0 = 0` there is no friction left in the end. Both states stay positive.
///
/// Stationary: `mu = gamma T0 / (beta + P (1 - gamma zeta/epsilon))`, `T - T0 = (zeta/epsilon) P mu`: friction fades with the power. At rest
/// `mu -> gamma T0/beta`, `T -> T0`, also while open. `alpha = 0` is Coulomb's law; `gamma = 0` with no initial friction is frictionless.
///
/// **Range.** At constant `P` the law is stable iff `epsilon (beta + P) > gamma zeta P`. It is asked for at any power, so `gamma zeta < epsilon` is
/// required: beyond, heat breeds friction that breeds heat, without bound above `P = epsilon beta/(gamma zeta - epsilon)`.
///
/// Backward Euler is a linear system of two. It is solved in closed form: all terms of its determinant
/// `(1 + dt alpha beta)(1 + dt delta epsilon) + dt alpha P (1 + dt delta (epsilon - gamma zeta))` and of the solution are positive, so both states
/// stay positive, to full accuracy, at any power and in steps of any length, where elimination loses its digits. So no step is suggested. In one step
/// `mu` falls with the slip at the finite rate `alpha p mu` per length, however short the step: unlike a law that weakens
/// with the speed it stays well-posed under refinement on supports stiffer than `alpha p^2 mu`.
///
/// Reference: G. P. Ostermeyer, Forsch. Ingenieurwes. 66 (2001) 267; Wear 254 (2003) 852; Ostermeyer and Mueller, Tribol. Int. 39 (2006)
/// 370. The equations are written from memory, for a point of pressure `p` in place of a pad of force `N`; the printed
/// equations, their coefficients and above all that for `T` were not checked against the sources.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ostermeyer {
    /// Rate of change of the patches `>= 0` (1/(stress length)).
    pub alpha: f64,
    /// Destruction without power `> 0` (stress length/time).
    pub beta: f64,
    /// Birth by heat `>= 0` (stress length/time per temperature).
    pub gamma: f64,
    /// Rate of the temperature `>= 0` (1/time).
    pub delta: f64,
    /// Cooling `> 0`.
    #[serde(default = "one")]
    pub epsilon: f64,
    /// Heating by friction `>= 0` (temperature per stress length/time).
    pub zeta: f64,
    /// Level `T0 >= 0` to which the contact cools (absolute temperature).
    pub ambient: f64,
    /// Coefficient before the first contact; by default the stationary one at rest, `gamma T0/beta`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub initial_friction: Option<f64>,
}

fn one() -> f64 {
    1.0
}

impl Ostermeyer {
    fn initial(&self) -> f64 {
        self.initial_friction.unwrap_or(self.gamma * self.ambient / self.beta)
    }
}

#[typetag::serde(name = "ostermeyer")]
impl FrictionLaw for Ostermeyer {
    fn variables(&self) -> Vec<Variable> {
        vec![
            Variable::new("mu", Unit::ONE, self.initial()),
            Variable::new("temperature", Unit::TEMPERATURE, self.ambient),
        ]
    }

    fn response(&self, at: &InterfacePoint, old: &[f64], new: &mut [Dual]) -> Response {
        let power = at.pressure * at.speed();
        let (a, d) = (self.alpha * at.dt, self.delta * at.dt);
        let cooling = 1.0 + d * self.epsilon;
        let heat = old[1] + d * self.epsilon * self.ambient;
        let determinant =
            power * (a * (1.0 + d * (self.epsilon - self.gamma * self.zeta))) + (1.0 + a * self.beta) * cooling;
        let mu = determinant.recip() * (old[0] * cooling + a * self.gamma * heat);
        new[0] = mu;
        new[1] = (power * mu * (d * self.zeta) + heat) / cooling;
        Response::Threshold(at.pressure * mu)
    }

    fn validate(&self) -> Result<(), LawError> {
        if self.gamma * self.zeta < self.epsilon {
            return Ok(());
        }
        let limit = self.epsilon * self.beta / (self.gamma * self.zeta - self.epsilon);
        let message = format!(
            "gamma * zeta = {} must be below epsilon = {}: friction and temperature grow without bound where p |v| > {limit}",
            self.gamma * self.zeta,
            self.epsilon
        );
        Err(LawError::Invalid { law: "ostermeyer".into(), key: "zeta".into(), message })
    }

    fn frictionless(&self) -> bool {
        self.gamma == 0.0 && self.initial() == 0.0
    }
}

/// Pressure times velocity.
const POWER: Unit = Unit::STRESS.times(Unit::VELOCITY);

inventory::submit! {
    LawInfo {
        name: "ostermeyer",
        kind: Kind::SetValued,
        equation: "|q| <= mu p, mu' = -alpha {[beta + P] mu - gamma T}, T' = -delta {epsilon (T - ambient) - zeta P mu}, P = p |v|",
        parameters: &[
            Parameter::new("alpha", Unit::ONE.per(Unit::STRESS.times(Unit::LENGTH)), Range::AtLeast(0.0), "rate of change of the patches"),
            Parameter::new("beta", POWER, Range::Above(0.0), "destruction of patches without power"),
            Parameter::new("gamma", POWER.per(Unit::TEMPERATURE), Range::AtLeast(0.0), "birth of patches by heat; gamma zeta < epsilon"),
            Parameter::new("delta", Unit::ONE.per(Unit::TIME), Range::AtLeast(0.0), "rate of the temperature"),
            Parameter::new("epsilon", Unit::ONE, Range::Above(0.0), "cooling").or("1"),
            Parameter::new("zeta", Unit::TEMPERATURE.per(POWER), Range::AtLeast(0.0), "heating by friction"),
            Parameter::new("ambient", Unit::TEMPERATURE, Range::AtLeast(0.0), "absolute temperature to which the contact cools"),
            Parameter::new("initial_friction", Unit::ONE, Range::AtLeast(0.0), "coefficient before the first contact").or("gamma ambient / beta"),
        ],
        reference: "Ostermeyer, Wear 254 (2003) 852; Ostermeyer and Mueller, Tribol. Int. 39 (2006) 370 (from memory)",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::{Envelope, conforms_within};

    const LAW: Ostermeyer = Ostermeyer {
        alpha: 1.0,
        beta: 1.0,
        gamma: 0.01,
        delta: 1.0,
        epsilon: 1.0,
        zeta: 20.0,
        ambient: 60.0,
        initial_friction: None,
    };

    /// Not over the whole default envelope: where all patches are gone (alpha p s >> 1), the faint derivatives of `T` drown in `T`.
    #[test]
    fn conforms() {
        let envelope = Envelope { pressure: [1e-9, 10.0], slip: [1e-9, 10.0], ..Envelope::default() };
        for law in [
            LAW,
            Ostermeyer { zeta: 90.0, ..LAW },
            Ostermeyer { alpha: 1e-3, beta: 1e3, ..LAW },
            Ostermeyer { gamma: 0.0, zeta: 0.0, initial_friction: Some(1.0), ..LAW },
            Ostermeyer { ambient: 0.0, initial_friction: Some(1e-9), ..LAW },
        ] {
            conforms_within(&law, &envelope).unwrap_or_else(|violation| panic!("{law:?}: {violation}"));
        }
        crate::conforms(&Ostermeyer { alpha: 0.0, delta: 0.0, initial_friction: Some(0.3), ..LAW }).unwrap();
        crate::conforms(&Ostermeyer { gamma: 0.0, ..LAW }).unwrap();
    }

    #[test]
    fn heat_that_breeds_itself_is_refused() {
        let error = crate::validate(&Ostermeyer { zeta: 200.0, ..LAW }).unwrap_err();
        assert!(error.key() == "zeta" && error.to_string().contains("p |v| > 1"), "{error}");
    }

    #[test]
    fn frictionless_without_birth_and_start() {
        assert!(Ostermeyer { gamma: 0.0, ..LAW }.frictionless() && !LAW.frictionless());
    }
}
