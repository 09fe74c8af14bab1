//! Tresca's law.

use crate::{Dual, FrictionLaw, InterfacePoint, Kind, LawInfo, Parameter, Range, Response, Unit, dual::constant};
use serde::{Deserialize, Serialize};

/// `|q| <= tau` while in contact, whatever the pressure.
///
/// The interface shears at a constant true stress `tau`, the limit of metal forming and of soft solids in full adhesive contact.
/// Derivatives vanish, so the tangent is symmetric, a step is the minimum of an energy, and in small strain its solution is
/// unique for every `tau`. The bound does not vanish with the pressure: it acts on points in contact only, and jumps as a point opens.
///
/// Being a stress, `tau` is compared with the true traction, not with the nominal one. For metals `tau = m sigma_y / sqrt 3`, `m <= 1`.
///
/// Reference: H. Tresca, C. R. Acad. Sci. 59 (1864) 754; as a friction law in Duvaut and Lions, Les inequations en mecanique et en
/// physique, Dunod 1972, chapter 3.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tresca {
    /// Shear strength `tau >= 0` of the interface (stress).
    pub strength: f64,
}

#[typetag::serde(name = "tresca")]
impl FrictionLaw for Tresca {
    fn response(&self, _: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        Response::Threshold(constant(self.strength))
    }

    fn frictionless(&self) -> bool {
        self.strength == 0.0
    }
}

inventory::submit! {
    LawInfo {
        name: "tresca",
        kind: Kind::SetValued,
        equation: "|q| <= strength in contact",
        parameters: &[Parameter::new("strength", Unit::STRESS, Range::AtLeast(0.0), "shear strength of the interface")],
        reference: "H. Tresca 1864; Duvaut and Lions, Les inequations en mecanique et en physique, 1972",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bound_is_the_strength_at_any_pressure() {
        for pressure in [0.0, 1e-9, 1e9] {
            let answer = Tresca { strength: 0.2 }.response(&InterfacePoint::new(pressure, 1.0, 0.1), &[], &mut []);
            assert_eq!(crate::dual::derivatives(&answer.value()), (0.2, [0.0, 0.0]));
        }
    }

    #[test]
    fn conforms() {
        for strength in [0.0, 1e-12, 1.0, 1e9] {
            crate::conforms(&Tresca { strength }).unwrap();
        }
    }
}
