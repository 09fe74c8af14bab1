//! Mohr-Coulomb law with cohesion and a cap.

use crate::{
    Dual, FrictionLaw, InterfacePoint, Kind, LawError, LawInfo, Parameter, Range, Response, Unit,
    dual::{constant, min},
};
use serde::{Deserialize, Serialize};

/// `|q| <= min(c + mu p, tau)`: Coulomb's law shifted by a cohesion `c` (Mohr-Coulomb) and cut at the shear strength `tau` (Orowan).
///
/// In metal forming the pressure grows beyond what the softer surface can carry in shear: friction stops growing at its shear
/// strength `tau = m sigma_y / sqrt 3`, `m <= 1`. Adhesive contacts resist by `c` even without pressure; like Tresca's, this
/// part acts while the point is in contact and jumps as it opens. All of `c`, `tau` and `p` are true stresses.
///
/// Derivatives `db/dp = mu` below the cap and `0` above (mean at the kink), `db/ds = 0`.
/// Limits: `c = 0` without cap is Coulomb's law, `mu = 0` Tresca's with `tau = c`, both zero no friction.
///
/// Reference: E. Orowan, Proc. Inst. Mech. Eng. 150 (1943) 140; cohesion as in C. A. Coulomb 1776 and O. Mohr 1900.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CohesionCap {
    /// Bound `c >= 0` at no pressure (stress).
    #[serde(default)]
    pub cohesion: f64,
    /// Coefficient of friction `mu >= 0` below the cap.
    pub friction: f64,
    /// Largest bound `tau > c` (stress); none: the law of Mohr and Coulomb.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub strength: Option<f64>,
}

#[typetag::serde(name = "cohesion-cap")]
impl FrictionLaw for CohesionCap {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        let bound = at.pressure * self.friction + self.cohesion;
        Response::Threshold(self.strength.map_or(bound, |strength| min(bound, constant(strength))))
    }

    fn validate(&self) -> Result<(), LawError> {
        if self.strength.is_some_and(|strength| strength <= self.cohesion) {
            let message =
                format!("`strength` must be above `cohesion` ({}): it caps their sum with friction", self.cohesion);
            return Err(LawError::invalid("cohesion-cap", "strength", message));
        }
        Ok(())
    }

    fn frictionless(&self) -> bool {
        self.cohesion == 0.0 && self.friction == 0.0
    }
}

inventory::submit! {
    LawInfo {
        name: "cohesion-cap",
        kind: Kind::SetValued,
        equation: "|q| <= min(cohesion + friction * p, strength) in contact",
        parameters: &[
            Parameter::new("cohesion", Unit::STRESS, Range::AtLeast(0.0), "bound at no pressure").or("0"),
            Parameter::new("friction", Unit::ONE, Range::AtLeast(0.0), "coefficient of friction below the cap"),
            Parameter::new("strength", Unit::STRESS, Range::Above(0.0), "largest bound").or("no cap"),
        ],
        reference: "E. Orowan, Proc. Inst. Mech. Eng. 150 (1943) 140",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dual::derivatives;

    #[test]
    fn line_kink_and_cap() {
        let law = CohesionCap { cohesion: 0.5, friction: 0.25, strength: Some(1.0) };
        let bound = |p| derivatives(&law.response(&InterfacePoint::new(p, 0.1, 1.0), &[], &mut []).value());
        assert_eq!(bound(0.0), (0.5, [0.25, 0.0]));
        assert_eq!(bound(1.0), (0.75, [0.25, 0.0]));
        assert_eq!(bound(2.0), (1.0, [0.125, 0.0]));
        assert_eq!(bound(1e9), (1.0, [0.0, 0.0]));
    }

    #[test]
    fn a_cap_below_the_cohesion_is_refused() {
        let error = crate::validate(&CohesionCap { cohesion: 1.0, friction: 0.3, strength: Some(1.0) }).unwrap_err();
        assert_eq!(error.key(), "strength");
    }

    #[test]
    fn conforms() {
        for (cohesion, friction) in [(0.0, 0.3), (1e-6, 1e-3), (1e6, 10.0), (2.0, 0.0), (0.0, 0.0)] {
            for above in [None, Some(1e-3), Some(1.0), Some(1e9)] {
                let strength = above.map(|above| cohesion + above);
                crate::conforms(&CohesionCap { cohesion, friction, strength }).unwrap();
            }
        }
    }
}
