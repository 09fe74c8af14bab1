//! Fields for ParaView: every element as one rational Bezier cell, so that NURBS geometry arrives exactly.

mod base64;
pub mod bezier;
mod cells;
mod series;
mod xml;

pub use cells::{Grid, cell_order};
pub use series::FieldSeries;
pub use xml::write_vtu;

use crate::geometry::{Curve, Patch, Point};

/// Cauchy stress (plane strain) and volume change at one material point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CauchySample {
    /// Stress components `xx`, `yy`, `zz`, `xy`.
    pub stress: [f64; 4],
    /// Determinant of the deformation gradient.
    pub det_f: f64,
}

impl CauchySample {
    /// Von Mises stress, `sqrt(3/2 s:s)` with the deviator `s`, out-of-plane component included.
    pub fn von_mises(&self) -> f64 {
        let [xx, yy, zz, xy] = self.stress;
        let differences = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
        (0.5 * differences + 3.0 * xy * xy).sqrt()
    }
}

/// Stress at parameters `(u, v)` of element `[i, j]` of a patch; the parameters lie in the element's `span_box`.
pub type StressField<'a> = Box<dyn Fn([usize; 2], [f64; 2]) -> CauchySample + 'a>;

/// One body at one instant. Displacements belong to the control points of its patch or curve.
pub enum BodyField<'a> {
    /// A body with unknowns.
    Deformable {
        /// Name in the scene.
        name: &'a str,
        /// Reference geometry.
        patch: &'a Patch,
        /// Displacement of every control point.
        displacement: &'a [Point],
        /// Stress in the patch.
        stress: StressField<'a>,
    },
    /// A rigid body: its edge curve alone.
    Rigid {
        /// Name in the scene.
        name: &'a str,
        /// Reference geometry.
        curve: &'a Curve,
        /// Displacement of every control point.
        displacement: &'a [Point],
    },
}

impl BodyField<'_> {
    /// Name of the body in the scene.
    pub fn name(&self) -> &str {
        match self {
            Self::Deformable { name, .. } | Self::Rigid { name, .. } => name,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn von_mises_of_simple_states() {
        let sample = |stress| CauchySample { stress, det_f: 1.0 }.von_mises();
        assert_eq!(sample([2.0, 2.0, 2.0, 0.0]), 0.0);
        assert!((sample([3.0, 0.0, 0.0, 0.0]) - 3.0).abs() < 1e-15);
        assert!((sample([0.0, 0.0, 0.0, 1.0]) - 3.0_f64.sqrt()).abs() < 1e-15);
    }
}
