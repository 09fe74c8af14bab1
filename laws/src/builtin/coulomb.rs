//! Coulomb's law.

use crate::{Dual, FrictionLaw, InterfacePoint, Kind, LawInfo, Parameter, Range, Response, Unit};
use serde::{Deserialize, Serialize};

/// `|q| <= mu p`; `q = mu p sign(s)` where it slips.
///
/// The bound is proportional to the pressure and blind to speed and history. Derivatives `db/dp = mu`, `db/ds = 0`: the tangent of a
/// slipping point is not symmetric. `mu = 0` is the frictionless law, `mu -> infinity` ties the surfaces while they touch.
/// Since the bound is homogeneous in the pressure, nominal and true tractions give the same law.
///
/// Usual values: lubricated 0.01-0.1, steel on steel 0.15-0.6, dry rubber 0.5-1.5. For large `mu` the quasi-static problem can lose
/// existence or uniqueness (Klarbring 1990: one contact node, `mu |k_nt| < k_t` needed).
///
/// Reference: C. A. Coulomb, Theorie des machines simples, 1785; as used in Alart and Curnier, CMAME 92 (1991) 353.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coulomb {
    /// Coefficient of friction `mu >= 0`.
    pub friction: f64,
}

#[typetag::serde(name = "coulomb")]
impl FrictionLaw for Coulomb {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        Response::Threshold(at.pressure * self.friction)
    }

    fn frictionless(&self) -> bool {
        self.friction == 0.0
    }
}

inventory::submit! {
    LawInfo {
        name: "coulomb",
        kind: Kind::SetValued,
        equation: "|q| <= friction * p",
        parameters: &[Parameter::new("friction", Unit::ONE, Range::AtLeast(0.0), "coefficient of friction")],
        reference: "C. A. Coulomb 1785; Alart and Curnier, CMAME 92 (1991) 353",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bound_is_friction_times_pressure_whatever_the_slip() {
        for slip in [-3.0, 0.0, 1e9] {
            let Response::Threshold(bound) =
                Coulomb { friction: 0.3 }.response(&InterfacePoint::new(2.0, slip, 0.1), &[], &mut [])
            else {
                panic!("a set-valued law")
            };
            assert_eq!(crate::dual::derivatives(&bound), (0.6, [0.3, 0.0]));
        }
    }

    #[test]
    fn conforms() {
        for friction in [0.0, 1e-12, 0.3, 10.0] {
            crate::conforms(&Coulomb { friction }).unwrap();
        }
    }
}
