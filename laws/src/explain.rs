//! What is wrong with an answer, in words.

use crate::{Dual, InterfacePoint, Response, Variable, dual::derivatives};

/// The first thing that is not finite, or negative where it may not be; see [`crate::FrictionLaw::explain`].
pub(crate) fn explain(
    law: &str,
    variables: &[Variable],
    at: &InterfacePoint,
    old: &[f64],
    response: &Response,
    new: &[Dual],
) -> Option<String> {
    let names: Vec<&str> = variables.iter().map(|variable| &*variable.name).collect();
    let states =
        names.iter().zip(new).find_map(|(name, x)| fault(x).map(|wrong| format!("the state `{name}` {wrong}")));
    let wrong = states.or_else(|| answer(response))?;
    Some(format!("law `{law}`: {wrong} at {}", place(at, &names, old)))
}

/// What is wrong with the bound or the traction.
pub(crate) fn answer(response: &Response) -> Option<String> {
    let (name, value) = match response {
        Response::Threshold(value) => ("the bound on the traction", value),
        Response::Traction(value) => ("the traction", value),
    };
    let negative =
        || (matches!(response, Response::Threshold(_)) && value.re < 0.0).then(|| format!("is negative, {}", value.re));
    fault(value).or_else(negative).map(|wrong| format!("{name} {wrong}"))
}

/// What is not finite in a number.
pub(crate) fn fault(x: &Dual) -> Option<String> {
    let (value, slopes) = derivatives(x);
    if !value.is_finite() {
        return Some(format!("is {value}"));
    }
    let finite = slopes.iter().all(|slope| slope.is_finite());
    (!finite).then(|| format!("is {value}, but its derivatives by pressure and slip are {slopes:?}"))
}

/// The arguments of a law.
pub(crate) fn place(at: &InterfacePoint, names: &[&str], states: &[f64]) -> String {
    let values = [("p", at.pressure.re), ("v", at.velocity().re), ("s", at.slip.re), ("dt", at.dt)];
    let temperature = at.temperature.map(|value| ("T", value));
    let states = names.iter().copied().zip(states.iter().copied());
    let all: Vec<String> =
        values.into_iter().chain(temperature).chain(states).map(|(n, x)| format!("{n} = {x}")).collect();
    all.join(", ")
}
