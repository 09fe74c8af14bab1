//! How accurate a run is, in words.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::model::{Body, Model};

/// What the error is one of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// Forces of the driven body.
    Forces,
    /// Way of the drive, where all its forces are given.
    Way,
}

/// The error of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// What the errors are errors of.
    pub quantity: Quantity,
    /// Root mean square over the steps in contact, over the peak; `None` where it is not known.
    pub error: Option<f64>,
    /// Share of the mesh in it, by itself.
    pub space: Option<f64>,
    /// Share of the overlap of the bodies, by itself.
    pub contact: Option<f64>,
    /// What straight lines between the nominal times leave out, over the peak.
    pub between_steps: Option<f64>,
    /// Steps at which it was measured.
    pub samples: usize,
    /// What is not seen, and why.
    pub not_estimated: Vec<String>,
    /// Largest displacement gradient `|F - I|` found.
    pub strain: f64,
    /// What the other strain measure (small for finite, finite for small) would change, as a share: the larger of the change of the
    /// strain energy and of the square of `strain`, since changes of the energy may cancel; `None` where a material has no other.
    pub strain_measure: Option<f64>,
}

impl Estimate {
    /// Where the small-strain theory is wrong by more than the discretization.
    pub fn warning(&self, model: &Model) -> Option<String> {
        let (error, change) = (self.error?, self.strain_measure?);
        let small = model.bodies.iter().filter_map(Body::material).any(|material| material.small_strain());
        (small && change > error).then(|| {
            format!(
                "small_strain: displacement gradients reach {:.1e}; finite strain would change about {change:.1e} of the \
                 forces, more than the estimated error {error:.1e}: take `type = \"neo-hookean\"`",
                self.strain
            )
        })
    }

    /// Where finite strain changes less than the discretization.
    pub fn advice(&self, model: &Model) -> Option<String> {
        let (error, change) = (self.error?, self.strain_measure?);
        let finite = model.bodies.iter().filter_map(Body::material).all(|material| !material.small_strain());
        (finite && change < error).then(|| {
            format!(
                "displacement gradients stay below {:.1e}; finite strain changes about {change:.1e} of the forces, less than the \
                 estimated error {error:.1e}: `type = \"linear-elastic\"` would do and halves the CPU time",
                self.strain
            )
        })
    }
}

impl fmt::Display for Estimate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let what = match self.quantity {
            Quantity::Forces => "Fx, Fy",
            Quantity::Way => "the way of the drive",
        };
        let percent = |share: Option<f64>| share.map_or("?".into(), |share| format!("{:.2e} %", 100.0 * share));
        match self.error {
            Some(_) => write!(
                f,
                "estimated error of {what}, of the peak: {} (mesh {}, contact {}); read off between steps: {}",
                percent(self.error),
                percent(self.space),
                percent(self.contact),
                percent(self.between_steps)
            )?,
            None => write!(f, "error of {what}: not estimated")?,
        }
        self.not_estimated.iter().try_for_each(|what| write!(f, "\n  not estimated: {what}"))
    }
}
