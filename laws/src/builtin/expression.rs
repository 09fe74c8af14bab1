//! A law written in the scene.

mod formulas;
mod spec;

use crate::{
    Dual, FrictionLaw, InterfacePoint, Kind, LawError, LawInfo, Parameter, Range, Response, Unit, Variable,
    dual::constant,
};
use formulas::Formulas;
use serde::{Deserialize, Serialize};
use spec::Spec;

/// `|q| <= threshold` or `q = traction`, with formulas in text; nothing is compiled by a Rust compiler.
///
/// ```toml
/// law = { type = "expression", threshold = "(mu + drop*exp(-z/d))*p", parameters = { mu = 0.3, drop = 0.2, d = 0.01 }, states = { z = { rate = "abs(v)" } } }
/// ```
///
/// Exactly one of
/// * `threshold`: the bound on `|q|`, `>= 0` and even in the slip (write `abs(v)`);
/// * `traction`: `q` itself, odd in the slip, positive against it: `q s >= 0` dissipates.
///
/// Symbols: pressure `p >= 0`, slip velocity `v = s/dt` and slip increment `s` (signed), time step `dt`, temperature `T`, the
/// parameters and the states. For the language see [`crate::expression`]. Derivatives are exact.
///
/// `parameters` are numbers, `{ value = 0.01, unit = "length/time" }`, or measured tables `{ over = "v", at = [..], value = [..] }` over
/// `p`, `T`, a state or `v`, where `v` means the speed `|v|` so that friction is even in it. Between the points runs a monotone cubic
/// ([`crate::expression::Curve`]), outside it is constant.
///
/// `states` are up to four internal variables, `{ rate = "..", initial = 0.0, open = "age" }`, advanced by backward Euler
/// ([`crate::evolve()`]); `threshold` and `traction` see their values at the end of the step. While the point is open a state
/// goes on with its rate at no pressure and no slip (`open = "age"`, the default) or is set to `initial` (`open = "reset"`).
///
/// `temperature` is the value of `T` where the scene has none; it must be given if `T` is used.
///
/// At reading the formulas are tried at rest and for each sign of the slip, with and without pressure; one that divides by zero at
/// rest is refused at once. That says nothing about dissipation, symmetry or other velocities: [`crate::conforms`] checks those. Its unit
/// check needs a `unit` for every parameter and state, and is left out if one is missing; a number with a dimension inside of a formula
/// fails it.
///
/// Reference: none; the law is yours.
#[derive(Clone, Serialize, Deserialize)]
#[serde(from = "Spec", into = "Spec")]
pub struct Expression {
    spec: Spec,
    formulas: Result<Formulas, LawError>,
}

impl From<Spec> for Expression {
    fn from(spec: Spec) -> Self {
        Self { formulas: Formulas::new(&spec), spec }
    }
}

impl From<Expression> for Spec {
    fn from(law: Expression) -> Self {
        law.spec
    }
}

impl std::fmt::Debug for Expression {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        self.spec.fmt(f)
    }
}

#[typetag::serde(name = "expression")]
impl FrictionLaw for Expression {
    fn variables(&self) -> Vec<Variable> {
        self.formulas.as_ref().map_or(vec![], Formulas::variables)
    }

    fn response(&self, at: &InterfacePoint, old: &[f64], new: &mut [Dual]) -> Response {
        let unread = |_: &LawError| Response::Threshold(constant(f64::NAN));
        self.formulas.as_ref().map_or_else(unread, |formulas| formulas.response(at, old, new))
    }

    fn open(&self, at: &InterfacePoint, old: &[f64], new: &mut [f64]) {
        if let Ok(formulas) = &self.formulas {
            formulas.open(at, old, new);
        }
    }

    fn validate(&self) -> Result<(), LawError> {
        self.formulas.as_ref().map(|_| ()).map_err(Clone::clone)
    }

    fn explain(&self, at: &InterfacePoint, old: &[f64]) -> Option<String> {
        match &self.formulas {
            Ok(formulas) => formulas.fault(at, old).map(|(key, why)| format!("law `expression`, `{key}`: {why}")),
            Err(error) => Some(error.to_string()),
        }
    }

    fn units(&self) -> Option<Vec<(String, Option<Unit>)>> {
        Some(self.spec.units())
    }
}

inventory::submit! {
    LawInfo {
        name: "expression",
        kind: Kind::Either,
        equation: "|q| <= threshold(p, v, ...) or q = traction(p, v, ...), formulas in text",
        parameters: &[
            Parameter::new("threshold", Unit::STRESS, Range::Text("a text with a formula of p, v, s, dt, T, parameters and states"), "bound on |q|")
                .or("none, `traction` is given"),
            Parameter::new("traction", Unit::STRESS, Range::Text("a text with a formula, odd in the slip"), "q itself, positive against the slip")
                .or("none, `threshold` is given"),
            Parameter::new("parameters", Unit::ONE, Range::Other(
                "a table of numbers, { value, unit } or { over = \"v\", at = [..], value = [..] } over |v|, p, T or a state"
            ), "names for the formulas, with units of their own").or("none"),
            Parameter::new("states", Unit::ONE, Range::Other(
                "a table of up to 4 { rate = \"..\", initial = 0.0, open = \"age\" or \"reset\", unit }"
            ), "internal variables, each advanced by its rate").or("none"),
            Parameter::new("temperature", Unit::TEMPERATURE, Range::Number, "T where the scene has none").or("none, T is not used"),
        ],
        reference: "written in the scene: threshold = \"mu*p\", parameters = { mu = 0.3 }",
    }
}
