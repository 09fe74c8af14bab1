//! Edge profiles of a block: the keys of the scene. Their checks and heights are in `heights`.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Profile of an edge: a height that points out of the body (up on `top`, down on `bottom`).
///
/// Bumps sit at `centers` (x of the body before `position`), or are `count` bumps at distance `spacing` around the middle
/// of the edge; without any of these there is one bump in the middle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Profile {
    /// Straight edge.
    Flat(Flat),
    /// Cosine bumps.
    Cosine(Cosine),
    /// Circular arcs.
    Arc(ArcProfile),
    /// Wedges with a round tip.
    Wedge(Wedge),
    /// Heights given in the scene.
    Polyline(Polyline),
    /// Heights given in a file.
    Csv(Csv),
}

impl Default for Profile {
    fn default() -> Self {
        Self::Flat(Flat {})
    }
}

/// Straight edge; has no keys.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Flat {}

/// `h(x) = height/2 (1 + cos(2 pi (x - c)/wavelength))` for `|x - c| <= wavelength/2`, else 0; bumps add up.
///
/// Interpolated at the nodes of the basis with x(u) = u; where a bump ends an element ends too, with continuity C1, so
/// that the error is of order `degree + 1` in the element size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cosine {
    /// Height of a bump; a negative one is a dimple.
    pub height: f64,
    /// Width of a bump.
    pub wavelength: f64,
    /// Middle of each bump.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub centers: Option<Vec<f64>>,
    /// Number of bumps, instead of `centers`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<usize>,
    /// Distance of the bumps, with `count`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spacing: Option<f64>,
}

/// Circular arcs. Without `height` one arc spans the whole edge and meets it at both ends; with `height` (the rise of the
/// apex) arc bumps of width `2 sqrt(2 radius height - height^2)` sit on a flat edge.
///
/// Exact for `nurbs` of degree 2 or more; other bases have their nodes on the arc.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ArcProfile {
    /// Radius of curvature.
    pub radius: f64,
    /// Rise of the apex above the edge, below `radius`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<f64>,
    /// Middle of each bump, with `height`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub centers: Option<Vec<f64>>,
    /// Number of bumps, instead of `centers`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<usize>,
    /// Distance of the bumps, with `count`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spacing: Option<f64>,
}

/// Wedges: straight flanks, tangent to a round tip whose apex is at `height`. Exact like [`ArcProfile`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Wedge {
    /// Height of the apex of the round tip.
    pub height: f64,
    /// Half the width at the foot; this or `angle`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub half_width: Option<f64>,
    /// Slope of the flanks against the edge in degrees; this or `half_width`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
    /// Radius of the tip.
    pub tip_radius: f64,
    /// Middle of each wedge.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub centers: Option<Vec<f64>>,
    /// Number of wedges, instead of `centers`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<usize>,
    /// Distance of the wedges, with `count`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spacing: Option<f64>,
}

/// Heights at given places, constant beyond the first and the last.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Polyline {
    /// `[x, height]`, x increasing.
    pub points: Vec<[f64; 2]>,
    /// false: broken line with a kink at every point. true: smooth curve through the points, as for `csv`.
    #[serde(default)]
    pub smooth: bool,
}

/// Heights from a file of two columns x, height (comma, semicolon or blank between them; one header line, empty lines and
/// lines that start with `#` are allowed). The points must cover the edge and are joined by a monotone cubic
/// interpolant, which makes no peaks of its own; the basis interpolates that at its nodes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Csv {
    /// File, relative to the scene.
    pub file: PathBuf,
}
