//! Thirion's law of rubber friction.

use crate::{Dual, DualNum, FrictionLaw, InterfacePoint, Kind, LawInfo, Parameter, Range, Response, Unit};
use serde::{Deserialize, Serialize};

/// `|q| <= mu p`, `1/mu = c_1 + c_2 p/E`: the inverse of the coefficient of rubber grows linearly with the pressure.
///
/// Written with the coefficient at low pressure `mu_0 = 1/c_1`: `b = mu_0 p / (1 + mu_0 c_2 p/E)`. The bound rises with the
/// slope `mu_0` and saturates at the shear strength `E/c_2` of the full contact, much more slowly than in
/// [`crate::builtin::Shaw`]: at `p = E/(mu_0 c_2)` half of it is reached. Only the ratio `c_2/E` counts; both are kept since
/// Thirion measured `c_2` over rubbers of several moduli. `p` is the true pressure.
///
/// Derivatives `db/dp = mu_0 / (1 + mu_0 c_2 p/E)^2`, `db/ds = 0`. Limits: `c_2 = 0` is Coulomb's law, `mu_0 = 0` no friction.
///
/// Reference: P. Thirion, Rev. Gen. Caoutch. 23 (1946) 101. The printed equation was not checked against the source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Thirion {
    /// Coefficient at low pressure, `mu_0 = 1/c_1 >= 0`.
    pub friction: f64,
    /// Growth `c_2 >= 0` of the inverse coefficient with `p/E`.
    pub slope: f64,
    /// Young's modulus `E > 0` of the rubber (stress).
    pub modulus: f64,
}

#[typetag::serde(name = "thirion")]
impl FrictionLaw for Thirion {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        let growth = at.pressure * (self.friction * self.slope / self.modulus) + 1.0;
        Response::Threshold(at.pressure * self.friction * growth.recip())
    }

    fn frictionless(&self) -> bool {
        self.friction == 0.0
    }
}

inventory::submit! {
    LawInfo {
        name: "thirion",
        kind: Kind::SetValued,
        equation: "|q| <= p / (1/friction + slope * p / modulus)",
        parameters: &[
            Parameter::new("friction", Unit::ONE, Range::AtLeast(0.0), "coefficient at low pressure, 1/c1"),
            Parameter::new("slope", Unit::ONE, Range::AtLeast(0.0), "growth of 1/mu with p/modulus, c2"),
            Parameter::new("modulus", Unit::STRESS, Range::Above(0.0), "Young's modulus of the rubber"),
        ],
        reference: "P. Thirion, Rev. Gen. Caoutch. 23 (1946) 101",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_coefficient_is_linear_in_the_pressure() {
        let law = Thirion { friction: 0.8, slope: 1.5, modulus: 3.0 };
        let bound = |p| law.response(&InterfacePoint::new(p, 1.0, 1.0), &[], &mut []).value().re;
        for p in [1e-9, 1.0, 7.0, 1e9] {
            let expected = 1.0 / 0.8 + 1.5 * p / 3.0;
            assert!((p / bound(p) / expected - 1.0).abs() < 1e-14);
        }
        assert!((bound(1e30) - 2.0).abs() < 1e-15);
    }

    #[test]
    fn conforms() {
        for (friction, slope, modulus) in
            [(0.8, 1.5, 3.0), (0.3, 0.0, 1.0), (0.0, 1.0, 1.0), (10.0, 1e6, 1e-6), (1e-3, 1e-6, 1e9)]
        {
            crate::conforms(&Thirion { friction, slope, modulus }).unwrap();
        }
    }
}
