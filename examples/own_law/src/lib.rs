//! A friction law of one's own: a film between the surfaces that sliding wears away and that grows again at rest.

use asperity_laws::{inventory, *};
use serde::{Deserialize, Serialize};

/// `|q| <= [bare + (coated - bare) c] p`, with the coverage `c` of the film between 0 and 1:
///
/// ```text
/// dc/dt = (1 - c)/recovery - c |v|/wear        steady state   c = 1 / (1 + recovery |v| / wear)
/// ```
///
/// At rest the film covers the surface (`c -> 1` within the time `recovery`), fast sliding wears it off within the length
/// `wear`. Made up for this example.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Film {
    pub coated: f64,
    pub bare: f64,
    pub recovery: f64,
    pub wear: f64,
}

#[typetag::serde(name = "film")]
impl FrictionLaw for Film {
    fn variables(&self) -> Vec<Variable> {
        vec![Variable::new("coverage", Unit::ONE, 1.0)]
    }

    fn response(&self, at: &InterfacePoint, old: &[f64], new: &mut [Dual]) -> Response {
        let [c] = evolve(at.dt, old, new, |[c]| [(-c + 1.0) / self.recovery - at.speed() * c / self.wear]);
        Response::Threshold(at.pressure * (c * (self.coated - self.bare) + self.bare))
    }
}

inventory::submit! { LawInfo {
    name: "film", kind: Kind::SetValued,
    equation: "|q| <= [bare + (coated - bare) c] p,  dc/dt = (1 - c)/recovery - c |v|/wear",
    parameters: &[
        Parameter::new("coated", Unit::ONE, Range::AtLeast(0.0), "coefficient under a full film"),
        Parameter::new("bare", Unit::ONE, Range::AtLeast(0.0), "coefficient without film"),
        Parameter::new("recovery", Unit::TIME, Range::Above(0.0), "time in which the film grows again"),
        Parameter::new("wear", Unit::LENGTH, Range::Above(0.0), "sliding length over which it is worn off"),
    ],
    reference: "example of the asperity README",
} }
