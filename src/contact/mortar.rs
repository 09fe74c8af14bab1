//! Mortar contact of two curves: sites, multipliers and the evaluation of one pair.
//!
//! Residual (design section 4), with sites `a`, multipliers read as `p_a = sum_A M_aA p_A`:
//!
//! ```text
//! R_u  = sum_a w_a ( -p^_a dg_a/du + q^_a (virtual slip)_a )
//! R_pA = sum_a M_aA w_a (p^_a - p_a)/r_N            R_qA = sum_a M_aA w_a (q^_a - q_a)/r_T
//! ```
//!
//! A site is a weighted group of quadrature points: `w_a g_a = sum_i c_ai g_i`. At `quadrature` sites the group is the
//! point itself and `M_aA = R_A`; at `nodal` sites it is the support of control point `A`, `c_ai = w_i R_A`, and `M = 1`.

use std::sync::Arc;

use asperity_laws::{FrictionLaw, InterfacePoint};

use crate::geometry::{Basis, Curve};
use crate::math::{GaussRule, gauss};

use super::assembly::Assembly;
use super::complementarity::{SiteAnswer, SiteInput, complementarity};
use super::integration::{EdgeFunctions, QuadraturePoint, mortar_cuts};
use super::interface::{
    Configuration, ContactDiscretization, ContactStatus, Integration, InterfaceForces, InterfaceStart, InterfaceTrial,
    Numerics, SiteMemory, Tangent,
};
use super::kinematics::Orientation;
use super::point::{Curves, PointState, seeker};
use super::projection::Target;
use super::sites::{Site, SiteState, group, recall};
use super::start::{Partners, StartPartners};

/// A mortar pair. See the module documentation.
#[derive(Clone, Debug)]
pub struct Mortar {
    nonmortar: Curve,
    mortar: Curve,
    multiplier: Option<Arc<dyn Basis>>,
    law: Option<Arc<dyn FrictionLaw>>,
    variables: Vec<f64>,
    numerics: Numerics,
    orientation: Orientation,
    rule: GaussRule,
    path_rule: GaussRule,
    points: Vec<QuadraturePoint>,
    modulus: f64,
    lengths: Vec<f64>,
    /// `E / (shortest span)`.
    augmentation: f64,
    reach: f64,
    start: StartPartners,
}

impl Mortar {
    /// The same pair with its augmentations taken to a power: `1` leaves them, `0` makes them `E/h`.
    pub fn eased(&self, power: f64) -> Self {
        let mut eased = self.clone();
        let numerics = &mut eased.numerics;
        (numerics.r, numerics.r_tangential) = (numerics.r.powf(power), numerics.r_tangential.powf(power));
        eased
    }

    /// A pair of curves under a law. `modulus` is the stress scale `E` of the softer body; `multiplier` a basis on the
    /// spans of the nonmortar curve, by default the functions of the curve itself.
    pub fn new(
        nonmortar: Curve,
        mortar: Curve,
        law: Arc<dyn FrictionLaw>,
        multiplier: Option<Arc<dyn Basis>>,
        numerics: Numerics,
        modulus: f64,
    ) -> Self {
        let rule = gauss(numerics.points);
        let functions = EdgeFunctions { curve: &nonmortar, multiplier: multiplier.as_deref() };
        let points = functions.points(&rule, &[]);
        let mut lengths = vec![0.0; nonmortar.spans()];
        points.iter().for_each(|p| lengths[p.span] += p.weight);
        let total: f64 = lengths.iter().sum();
        let shortest = lengths.iter().fold(f64::INFINITY, |m, h| m.min(*h));
        let orientation =
            Orientation { projection: numerics.projection, nonmortar: nonmortar.side, mortar: mortar.side };
        let variables = law.variables().iter().map(|v| v.initial).collect();
        Self {
            path_rule: gauss(mortar.basis.degree() + 2),
            modulus,
            lengths,
            augmentation: modulus / shortest,
            reach: total,
            start: StartPartners::default(),
            law: (!law.frictionless()).then_some(law),
            nonmortar,
            mortar,
            multiplier,
            variables,
            numerics,
            orientation,
            rule,
            points,
        }
    }

    /// Choices of this pair.
    pub fn numerics(&self) -> &Numerics {
        &self.numerics
    }

    /// Reference lengths of the nonmortar and the mortar edge, each as its Gauss points measure it and along a fine polygon.
    pub fn lengths(&self) -> [[f64; 2]; 2] {
        let rule = gauss(self.mortar.basis.degree() + 1);
        let points = EdgeFunctions { curve: &self.mortar, multiplier: None }.points(&rule, &[]);
        let polygon = |curve: &Curve| curve.span_lengths().iter().sum();
        [[self.reach, polygon(&self.nonmortar)], [points.iter().map(|p| p.weight).sum(), polygon(&self.mortar)]]
    }

    /// Length of a nonmortar element in mortar elements, the shortest of either side.
    pub fn contrast(&self) -> f64 {
        self.nonmortar.shortest_span() / self.mortar.shortest_span()
    }

    /// The law, where there is friction.
    pub fn law(&self) -> Option<&Arc<dyn FrictionLaw>> {
        self.law.as_ref()
    }

    /// Partners of the points at the start of the step.
    fn partners(&self, points: &[QuadraturePoint], at: &Configuration) -> Partners {
        let target = Target::new(&self.mortar, at.mortar, self.numerics.projection, self.reach);
        points.iter().map(|p| target.project(&seeker(&self.nonmortar, &p.shape, at.nonmortar))).collect()
    }

    /// A site with its group evaluated; `conditions` says what it carries.
    fn evaluate_site(
        &self,
        site: Site,
        number: (usize, usize),
        (points, states): (&[QuadraturePoint], &[Option<PointState>]),
        (start, trial, tangent): (&InterfaceStart, &InterfaceTrial, Tangent),
        conditions: impl FnOnce(&SiteInput, f64) -> SiteAnswer,
    ) -> SiteState {
        let (mut weight, mut gap, mut slip, mut stretch, mut r) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let mut position = [0.0; 2];
        let full: f64 = site.group.iter().map(|(_, c)| c).sum();
        for &(i, c) in &site.group {
            r += c / full * (self.modulus / self.lengths[points[i].span]);
            if let Some(state) = &states[i] {
                weight += c;
                gap += c * state.frame.gap;
                slip += c * state.path.length;
                stretch += c * state.z[6].hypot(state.z[7]) / points[i].reference_stretch;
                position[0] += c * state.x.x;
                position[1] += c * state.x.y;
            }
        }
        let has_partner = weight > 1e-8 * full;
        let mean = |v: f64| if has_partner { v / weight } else { 0.0 };
        let read = |values: &[f64]| site.reads.iter().map(|&(a, m)| m * values[a]).sum::<f64>();
        let (p, q) = (read(trial.pressure), if self.rubs() { read(trial.traction) } else { 0.0 });
        let element = self.modulus / r;
        let r = [r * self.numerics.r, r * self.numerics.r_tangential];
        let arc = site.group.iter().map(|&(i, c)| c / full * points[i].arc).sum();
        let memory = recall(start.sites, |m| m.arc, number, arc);
        let input = SiteInput {
            p,
            q,
            gap: mean(gap),
            slip: mean(slip),
            r_normal: r[0],
            r_tangential: r[1],
            stretch: if has_partner { stretch / weight } else { 1.0 },
            has_partner,
            dt: trial.dt,
            position: position.map(mean),
            deflection: memory.map_or(0.0, |m| m.deflection),
            lagged: tangent == Tangent::Lagged,
            old: memory.map_or(&self.variables, |m| &m.variables),
        };
        let answer = conditions(&input, arc);
        let none = if has_partner { 0.0 } else { f64::NAN };
        SiteState {
            weight: if has_partner { weight } else { full },
            element,
            arc,
            position: input.position,
            old: memory.map_or([0.0; 3], |m| [m.deflection, m.traction, m.closure]),
            closure: if has_partner { p - r[0] * input.gap } else { 0.0 },
            gap: input.gap + none,
            slip: input.slip + none,
            stretch: input.stretch,
            site,
            p,
            q,
            r,
            answer,
        }
    }
}

impl Mortar {
    /// All that a trial state says of the pair, the sites under the given conditions.
    pub(super) fn assembled<R>(
        &self,
        step: (&InterfaceStart, &InterfaceTrial, Tangent),
        conditions: impl Fn(&SiteInput, f64, (usize, usize)) -> SiteAnswer,
        take: impl FnOnce(Assembly) -> R,
    ) -> R {
        let (start, trial, tangent) = step;
        let curves = Curves {
            nonmortar: &self.nonmortar,
            mortar: &self.mortar,
            orientation: self.orientation,
            rule: &self.path_rule,
        };
        let segments = match self.numerics.integration {
            Integration::Element => None,
            Integration::Segment => {
                let cuts = mortar_cuts(&self.nonmortar, &self.mortar, &trial.at, self.numerics.projection, self.reach);
                let functions = EdgeFunctions { curve: &self.nonmortar, multiplier: self.multiplier.as_deref() };
                Some(functions.points(&self.rule, &cuts))
            }
        };
        let points = segments.as_deref().unwrap_or(&self.points);
        let find = || self.partners(points, &start.at);
        let old = if segments.is_some() { find() } else { self.start.at(&start.at, find) };
        let new = Target::new(&self.mortar, trial.at.mortar, self.numerics.projection, self.reach);
        let state = |(p, was): (&_, &Option<_>)| {
            curves.point(p, (was.as_ref(), start), (&new, trial), tangent != Tangent::None)
        };
        let states: Vec<Option<PointState>> = points.iter().zip(&*old).map(state).collect();
        let sites = group(points, self.numerics.sites, self.multipliers());
        let count = sites.len();
        let evaluate = |(index, site)| {
            let conditions = |input: &SiteInput, arc| conditions(input, arc, (index, count));
            self.evaluate_site(site, (index, count), (points, &states), step, conditions)
        };
        let sites: Vec<SiteState> = sites.into_iter().enumerate().map(evaluate).collect();
        let multipliers = self.multipliers();
        take(Assembly { curves, points, states: &states, sites: &sites, multipliers, rubs: self.rubs() })
    }

    /// What the law was asked at the closed sites, with the internal variables at the start of the step.
    fn asked<'a>(
        &'a self,
        memory: &'a [SiteMemory],
        found: &'a InterfaceForces,
        dt: f64,
    ) -> impl Iterator<Item = (InterfacePoint, &'a [f64])> {
        let closed = found.sites.iter().enumerate().filter(|(_, site)| site.status != ContactStatus::Open);
        closed.map(move |(index, site)| {
            let memory = recall(memory, |m| m.arc, (index, found.sites.len()), site.arc);
            let old = memory.map_or(&self.variables, |m| &m.variables);
            let position = [site.x.x, site.x.y];
            (InterfacePoint { position, ..InterfacePoint::new(site.pressure, site.slip, dt) }, old.as_slice())
        })
    }
}

impl ContactDiscretization for Mortar {
    fn multipliers(&self) -> usize {
        self.multiplier.as_ref().map_or(self.nonmortar.points.len(), |basis| basis.len())
    }

    fn rubs(&self) -> bool {
        self.law.is_some()
    }

    fn augmentation(&self) -> f64 {
        self.augmentation
    }

    fn variable_names(&self) -> Vec<String> {
        self.law.iter().flat_map(|law| law.variables()).map(|v| v.name.to_string()).collect()
    }

    fn suggested_step(&self, memory: &[SiteMemory], found: &InterfaceForces, dt: f64) -> f64 {
        let Some(law) = &self.law else { return f64::INFINITY };
        let wanted = self.asked(memory, found, dt).filter_map(|(at, old)| law.suggested_step(&at, old));
        wanted.fold(f64::INFINITY, f64::min)
    }

    fn explain(&self, memory: &[SiteMemory], found: &InterfaceForces, dt: f64) -> Option<String> {
        let law = self.law.as_ref()?;
        self.asked(memory, found, dt).find_map(|(at, old)| {
            let [x, y] = at.position;
            law.explain(&at, old).map(|why| format!("at the point ({x:.6e}, {y:.6e}): {why}"))
        })
    }

    fn evaluate(&self, start: &InterfaceStart, trial: &InterfaceTrial, tangent: Tangent) -> InterfaceForces {
        let conditions = |site: &SiteInput, _, _| complementarity(self.law.as_deref(), site);
        self.assembled((start, trial, tangent), conditions, |found| found.forces(trial, tangent))
    }
}
