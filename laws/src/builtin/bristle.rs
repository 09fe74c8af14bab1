//! What the bristle models (LuGre, elasto-plastic) share: the friction curve and the damping of the bristles.

use crate::{Dual, DualNum, LawError, dual::abs};
use serde::{Deserialize, Serialize};

/// Whether the damping of the bristles falls with the speed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Damping {
    /// `sigma1 / (1 + sigma1 |v| / (4 g))`: never above the bound `4 g/|v|` of passivity, equal to `sigma1` at rest.
    #[default]
    Passive,
    /// `sigma1` as published: creates energy in some histories if it exceeds that bound.
    Constant,
}

impl Damping {
    /// `sigma1(v)`, given `sigma1` and the friction curve `g(v) > 0`.
    pub(super) fn at(self, damping: f64, velocity: Dual, curve: Dual) -> Dual {
        match self {
            Self::Passive => curve * (4.0 * damping) / (abs(velocity) * damping + curve * 4.0),
            Self::Constant => curve * 0.0 + damping,
        }
    }
}

/// `g(v) = mu_k + (mu_s - mu_k) exp(-(v/v_s)^2)`.
pub(super) fn curve(rest: f64, kinetic: f64, speed: f64, velocity: Dual) -> Dual {
    let x = velocity / speed;
    (-(x * x)).exp() * (rest - kinetic) + kinetic
}

/// `0 < kinetic <= rest`, or both zero.
pub(super) fn ordered(law: &str, rest: f64, kinetic: f64) -> Result<(), LawError> {
    let message = "must not exceed `rest`, and be > 0 unless both are 0";
    let valid = kinetic <= rest && (kinetic > 0.0 || rest == 0.0);
    let error =
        || LawError::Invalid { law: law.into(), key: "kinetic".into(), message: format!("`kinetic` {message}") };
    if valid { Ok(()) } else { Err(error()) }
}
