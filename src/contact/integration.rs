//! Quadrature points on the nonmortar edge, element by element or segment by segment.

use crate::geometry::{Basis, Curve, Shape};
use crate::math::{GaussRule, rot90};

use super::interface::{Configuration, Projection};
use super::projection::{Seeker, Target};

/// A quadrature point of the nonmortar edge.
#[derive(Clone, Copy, Debug)]
pub struct QuadraturePoint {
    /// Span of the edge.
    pub span: usize,
    /// Reference length it stands for.
    pub weight: f64,
    /// Reference arc length from the start of the edge.
    pub arc: f64,
    /// `|dX/dxi|` of the reference edge.
    pub reference_stretch: f64,
    /// Nonmortar shape functions.
    pub shape: Shape,
    /// Multiplier functions.
    pub multiplier: Shape,
}

/// The functions of an edge: its geometry and the multiplier space on the same spans.
#[derive(Clone, Copy)]
pub struct EdgeFunctions<'a> {
    /// The edge in the reference configuration.
    pub curve: &'a Curve,
    /// Multiplier basis; `None`: the functions of the edge itself, weights included.
    pub multiplier: Option<&'a dyn Basis>,
}

impl EdgeFunctions<'_> {
    /// Gauss points on every span, each span cut at the parameters `cuts` (sorted) that fall inside it.
    pub fn points(&self, rule: &GaussRule, cuts: &[f64]) -> Vec<QuadraturePoint> {
        let breaks = self.curve.basis.breaks();
        let mut out = Vec::with_capacity((breaks.len() - 1 + cuts.len()) * rule.points.len());
        let mut travelled = 0.0;
        for span in 0..self.curve.spans() {
            let (start, end) = (breaks[span], breaks[span + 1]);
            let sliver = 1e-10 * (end - start);
            let inside = cuts.iter().copied().filter(|&c| c > start + sliver && c < end - sliver);
            let mut low = start;
            for high in inside.chain([end]) {
                if high - low > sliver {
                    self.segment(rule, span, low, high, &mut travelled, &mut out);
                    low = high;
                }
            }
        }
        out
    }

    fn segment(
        &self,
        rule: &GaussRule,
        span: usize,
        low: f64,
        high: f64,
        travelled: &mut f64,
        out: &mut Vec<QuadraturePoint>,
    ) {
        let from = out.len();
        for (s, w) in rule.points.iter().zip(&rule.weights) {
            let xi = low + s * (high - low);
            let shape = self.curve.shape(span, xi);
            let reference_stretch = self.curve.place(&shape, 1, &self.curve.points).norm();
            let multiplier = self.multiplier.map_or(shape, |basis| basis.evaluate(span, xi));
            let weight = w * (high - low) * reference_stretch;
            out.push(QuadraturePoint { span, weight, arc: *s, reference_stretch, shape, multiplier });
        }
        let length: f64 = out[from..].iter().map(|p| p.weight).sum();
        for point in &mut out[from..] {
            point.arc = *travelled + point.arc * length;
        }
        *travelled += length;
    }
}

/// Parameters of the nonmortar edge at which a mortar element begins or ends, sorted: where the integrands of the
/// interface are not smooth. Found by inverting the projection for every mortar element end.
pub fn mortar_cuts(
    nonmortar: &Curve,
    mortar: &Curve,
    at: &Configuration,
    projection: Projection,
    reach: f64,
) -> Vec<f64> {
    let breaks = mortar.basis.breaks();
    // Closest point on the mortar: x lies on the mortar normal, a ray from the mortar end. Ray: the reverse roles.
    let inverse = match projection {
        Projection::Closest => Projection::Ray,
        Projection::Ray => Projection::Closest,
    };
    let target = Target::new(nonmortar, at.nonmortar, inverse, reach);
    let mut cuts: Vec<f64> = (0..breaks.len())
        .filter_map(|k| {
            let span = k.min(mortar.spans() - 1);
            let shape = mortar.shape(span, breaks[k]);
            let tangent = mortar.place(&shape, 1, at.mortar).normalize();
            let x = mortar.place(&shape, 0, at.mortar);
            let seeker = Seeker { x, tangent, normal: rot90(tangent) * mortar.side };
            target.project(&seeker).map(|partner| partner.xi)
        })
        .collect();
    cuts.sort_by(f64::total_cmp);
    cuts
}
