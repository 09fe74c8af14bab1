//! No friction.

use crate::{Dual, FrictionLaw, InterfacePoint, Kind, LawInfo, Response, dual::constant};
use serde::{Deserialize, Serialize};

/// `q = 0`: the surfaces slide freely. The engine carries no tangential unknowns for such a pair, and its tangent is symmetric.
///
/// The reference for every other law at zero strength, and for steep surfaces, whose global friction does not vanish with the local one at
/// every instant, only on average over a symmetric pass.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Frictionless {}

#[typetag::serde(name = "frictionless")]
impl FrictionLaw for Frictionless {
    fn response(&self, _: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        Response::Threshold(constant(0.0))
    }

    fn frictionless(&self) -> bool {
        true
    }
}

inventory::submit! {
    LawInfo {
        name: "frictionless",
        kind: Kind::SetValued,
        equation: "q = 0",
        parameters: &[],
        reference: "the limit of any law at zero strength",
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn conforms() {
        crate::conforms(&super::Frictionless {}).unwrap();
    }
}
