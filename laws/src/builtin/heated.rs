//! Friction that fades as the contact heats up.

use crate::{
    Dual, DualNum, FrictionLaw, InterfacePoint, Kind, LawError, LawInfo, Parameter, Range, Response, Unit, Variable,
    dual::{constant, max, min},
    evolve,
};
use serde::{Deserialize, Serialize};

/// `|q| <= mu(T) p`, `mu = mu_inf + (mu0 - mu_inf) f(x)`, `x = (T - T_ref)/T_c`, with the contact temperature from its heat balance:
///
/// ```text
/// linear        f = max(0, 1 - x)          C T' = beta mu(T) p |v| - h (T - T_amb)
/// exponential   f = exp(-x)
/// ```
///
/// Both forms start with the slope `-(mu0 - mu_inf)/T_c` at `T_ref`; at and below `T_ref` the coefficient is `mu0`, so `mu_inf <= mu <= mu0`. The
/// heat is the work of friction of a slipping contact, of which the fraction `beta` flows into the surface: `beta = e1/(e1 + e2)`,
/// `e = sqrt(k rho c)`. Per area: `C` heat capacity of the layer that takes part, `h` heat transfer to the body. The ambient temperature is
/// that of the scene where it has one, else `ambient`. An open contact cools on.
///
/// Backward Euler takes in exactly `beta |q s|` per step: `C dT + h (T1 - T_amb) dt = beta |q s|`. Its equation has one solution, since
/// `mu` does not rise with `T` (`mu_inf <= mu0` is required for this). It is stable in steps of any length, so none is suggested. In one step the bound
/// falls by at most `beta mu0 (mu0 - mu_inf) p^2/(C T_c)` per length of slip, however short the step: well-posed under refinement on
/// stiffer supports. `mu_inf = mu0`, or `beta = 0` and `T_amb <= T_ref`, is Coulomb's law; `mu0 = 0` is frictionless.
///
/// Reference: heat balance and partition: Carslaw and Jaeger, Conduction of Heat in Solids, 1959; H. Blok 1937. The coefficient is a
/// two-parameter fit in use for brakes and polymers. The printed equations were not checked against the sources.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Heated {
    /// Coefficient `mu0 >= 0` at and below the reference temperature.
    pub friction: f64,
    /// Coefficient `mu_inf` of the hot contact, `0 <= mu_inf <= mu0`.
    #[serde(default)]
    pub limit: f64,
    /// How the coefficient falls.
    #[serde(default)]
    pub form: Fading,
    /// Reference temperature `T_ref`; by default `ambient`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<f64>,
    /// Temperature rise `T_c > 0` that halves or more the coefficient.
    pub range: f64,
    /// Heat capacity `C > 0` per area (stress length/temperature).
    pub capacity: f64,
    /// Heat transfer `h >= 0` per area (stress velocity/temperature).
    #[serde(default)]
    pub transfer: f64,
    /// Fraction `beta` of the heat that stays on this side.
    #[serde(default = "all")]
    pub partition: f64,
    /// Temperature at the start, and `T_amb` unless the scene has a temperature.
    pub ambient: f64,
}

fn all() -> f64 {
    1.0
}

/// How the coefficient falls with the temperature.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Fading {
    /// Straight to the limit.
    #[default]
    Linear,
    /// Ever slower towards the limit.
    Exponential,
}

impl Heated {
    fn reference(&self) -> f64 {
        self.reference.unwrap_or(self.ambient)
    }

    /// `mu` from what is left of the range, `1 - x`: a coefficient that has nearly gone keeps its digits.
    fn coefficient(&self, left: Dual) -> Dual {
        let left = min(left, constant(1.0));
        let fading = match self.form {
            Fading::Linear => max(left, constant(0.0)),
            Fading::Exponential => (left - 1.0).exp(),
        };
        fading * (self.friction - self.limit) + self.limit
    }
}

#[typetag::serde(name = "heated")]
impl FrictionLaw for Heated {
    fn variables(&self) -> Vec<Variable> {
        vec![Variable::new("temperature", Unit::TEMPERATURE, self.ambient)]
    }

    fn response(&self, at: &InterfacePoint, old: &[f64], new: &mut [Dual]) -> Response {
        let share = |temperature: f64| 1.0 - (temperature - self.reference()) / self.range;
        let surroundings = share(at.temperature.unwrap_or(self.ambient));
        let heating = at.pressure * at.speed() * (self.partition / (self.capacity * self.range));
        let cooling = self.transfer / self.capacity;
        let rate = |left: Dual| -heating * self.coefficient(left) - (left - surroundings) * cooling;
        let [left] = evolve(at.dt, &[share(old[0])], &mut [constant(0.0)], |[left]| [rate(left)]);
        new[0] = (-left + 1.0) * self.range + self.reference();
        Response::Threshold(at.pressure * self.coefficient(left))
    }

    fn validate(&self) -> Result<(), LawError> {
        let message =
            format!("`limit` must not exceed `friction` = {}: the coefficient falls with the heat", self.friction);
        let error = || LawError::Invalid { law: "heated".into(), key: "limit".into(), message };
        if self.limit <= self.friction { Ok(()) } else { Err(error()) }
    }

    fn frictionless(&self) -> bool {
        self.friction == 0.0
    }
}

const CAPACITY: Unit = Unit::STRESS.times(Unit::LENGTH).per(Unit::TEMPERATURE);

inventory::submit! {
    LawInfo {
        name: "heated",
        kind: Kind::SetValued,
        equation: "|q| <= mu p, mu = limit + (friction - limit) f((T - reference)/range), f(x) = 1 at x <= 0, above max(0, 1 - x) (linear) or exp(-x) (exponential); capacity T' = partition mu p |v| - transfer (T - ambient)",
        parameters: &[
            Parameter::new("friction", Unit::ONE, Range::AtLeast(0.0), "coefficient at and below the reference temperature"),
            Parameter::new("limit", Unit::ONE, Range::AtLeast(0.0), "coefficient of the hot contact, <= friction").or("0"),
            Parameter::new("form", Unit::ONE, Range::Choice(&["linear", "exponential"]), "how the coefficient falls").or("linear"),
            Parameter::new("reference", Unit::TEMPERATURE, Range::Number, "temperature above which it falls").or("ambient"),
            Parameter::new("range", Unit::TEMPERATURE, Range::Above(0.0), "temperature rise over which it falls"),
            Parameter::new("capacity", CAPACITY, Range::Above(0.0), "heat capacity per area"),
            Parameter::new("transfer", CAPACITY.per(Unit::TIME), Range::AtLeast(0.0), "heat transfer per area").or("0"),
            Parameter::new("partition", Unit::ONE, Range::Between(0.0, 1.0), "fraction of the heat that stays on this side").or("1"),
            Parameter::new("ambient", Unit::TEMPERATURE, Range::Number, "temperature at the start and around"),
        ],
        reference: "Carslaw and Jaeger, Conduction of Heat in Solids, 1959 (heat balance)",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::{Envelope, conforms_within};

    #[test]
    fn conforms() {
        for form in [Fading::Linear, Fading::Exponential] {
            let law = Heated {
                friction: 0.5,
                limit: 0.1,
                form,
                reference: None,
                range: 100.0,
                capacity: 2.0,
                transfer: 0.5,
                partition: 0.5,
                ambient: 300.0,
            };
            // a coefficient that can vanish, where it does not: the faint derivatives of `T` would drown in `T`
            let mild = Envelope { pressure: [1e-9, 1e3], slip: [1e-9, 1e3], ..Envelope::default() };
            conforms_within(&Heated { limit: 0.0, transfer: 0.0, capacity: 1e6, ..law.clone() }, &mild).unwrap();
            for law in [
                Heated { capacity: 1e-6, reference: Some(350.0), range: 1e-3, ..law.clone() },
                Heated { friction: 10.0, capacity: 1e6, ..law.clone() },
                Heated { friction: 0.0, limit: 0.0, ..law.clone() },
                law,
            ] {
                crate::conforms(&law).unwrap_or_else(|violation| panic!("{law:?}: {violation}"));
            }
        }
    }
}
