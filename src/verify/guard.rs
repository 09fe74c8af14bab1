//! A look at mesh and time plan before anything is computed: edges that cannot be integrated, elements that do not see
//! each other, steps that contact cannot follow.

use crate::model::{Control, Model, Pair, Side};
use crate::solve;

/// Nominal steps beyond this many contact elements are reported: Newton's method then starts far from the solution, and
/// the energy balance is off by more than 5 % (measured on the two-asperity problem at mu = 0.3).
const ELEMENTS_PER_STEP: f64 = 2.0;
/// Round-off of the differences of a table, with a margin.
const ROUND_OFF: f64 = 1e-9;

/// Share of the length of a contact edge that its integration points may miss.
const MISSED: f64 = 0.01;

/// All warnings, in words; empty where nothing is wrong.
pub fn warnings(model: &Model, plan: &solve::Control) -> Vec<String> {
    let edges = model.pairs.iter().flat_map(|pair| edge_warnings(model, pair));
    edges.chain(step_warnings(model, plan)).collect()
}

fn edge_warnings(model: &Model, pair: &Pair) -> impl Iterator<Item = String> {
    let [nonmortar, mortar] = pair.contact.lengths();
    let name = |side: &Side| model.bodies[side.body].name.as_str();
    let crowded = [(&pair.nonmortar, nonmortar), (&pair.mortar, mortar)];
    let crowded = crowded.into_iter().filter_map(move |(side, lengths)| crowding(name(side), lengths));
    crowded.chain(contrast(pair, [name(&pair.nonmortar), name(&pair.mortar)]))
}

/// Weights far apart crowd the elements: their integration points then miss most of the edge, and of the body behind it.
fn crowding(name: &str, [measured, length]: [f64; 2]) -> Option<String> {
    ((measured / length - 1.0).abs() > MISSED).then(|| {
        format!(
            "the contact edge of body {name} is {length:.3e} long, but its integration points measure {measured:.3e}: its weights \
             crowd the elements, and forces will be wrong by as much; take weights nearer to one another, or more elements"
        )
    })
}

/// Mortar elements so short that a nonmortar element has not even one integration point for each.
fn contrast(pair: &Pair, [nonmortar, mortar]: [&str; 2]) -> Option<String> {
    let (contrast, points) = (pair.contact.contrast(), pair.contact.numerics().points);
    (contrast > points as f64).then(|| {
        format!(
            "the contact elements of body {nonmortar} are {contrast:.1} times as long as those of body {mortar} and have {points} \
             integration points each, which cannot see every one of those: take `numerics.points = {}`, or body {mortar} as the nonmortar \
             side",
            contrast.ceil()
        )
    })
}

/// Warnings about the motion of bodies in contact, in words; empty where nothing is wrong. Motion by force is not judged:
/// how far it goes is known afterwards only.
fn step_warnings(model: &Model, plan: &solve::Control) -> Vec<String> {
    let reach = model.pairs.iter().map(|pair| reach(model, pair)).fold(f64::INFINITY, f64::min);
    let touching = |body: &usize| model.pairs.iter().any(|pair| [pair.nonmortar.body, pair.mortar.body].contains(body));
    let judged = |body: usize| {
        let (step, travel) = longest(model, body, plan);
        let (name, h) = (&model.bodies[body].name, model.element_size);
        let steps = |limit: f64| (plan.steps as f64 * travel / limit).ceil();
        let moves = format!("`time.steps = {}`: body {name} moves by {travel:.3e} in step {step}", plan.steps);
        if travel > reach {
            let steps = steps(ELEMENTS_PER_STEP * h);
            return Some(format!(
                "{moves}, farther than contact is looked for ({reach:.3e}): it may pass through its counterpart \
                 unnoticed; take {steps} steps"
            ));
        }
        let limit = ELEMENTS_PER_STEP * h;
        (travel > limit * (1.0 + ROUND_OFF)).then(|| {
            format!(
                "{moves}, that is {:.1} of the shortest contact element: cuts and errors of the energy balance are to be \
                 expected; {} steps keep it below {ELEMENTS_PER_STEP}",
                travel / h,
                steps(limit)
            )
        })
    };
    (0..model.bodies.len()).filter(touching).filter_map(judged).collect()
}

/// The nominal step in which a body is moved farthest, and how far.
fn longest(model: &Model, body: usize, plan: &solve::Control) -> (usize, f64) {
    let moves: Vec<_> = model
        .motions
        .iter()
        .filter(|motion| motion.body == body)
        .filter_map(|motion| match &motion.control {
            Control::Displacement(table) if !table.is_constant() => Some((motion.component, table)),
            _ => None,
        })
        .collect();
    if moves.is_empty() {
        return (0, 0.0);
    }
    let time = |step: usize| plan.end * step as f64 / plan.steps as f64;
    let travel = |step: usize| {
        let mut travel = [0.0_f64; 2];
        for (component, table) in &moves {
            let way = (table.at(time(step)) - table.at(time(step - 1))).abs();
            travel[*component] = travel[*component].max(way);
        }
        travel[0].hypot(travel[1])
    };
    (1..=plan.steps)
        .map(|step| (step, travel(step)))
        .fold((0, 0.0), |a, b| if b.1 > a.1 * (1.0 + ROUND_OFF) { b } else { a })
}

/// Distance up to which a pair looks for partners: half the nonmortar edge, here by its control polygon.
fn reach(model: &Model, pair: &Pair) -> f64 {
    let body = &model.bodies[pair.nonmortar.body];
    let place = |node: usize| body.points[node - body.offset];
    0.5 * pair.nonmortar.nodes.windows(2).map(|ends| (place(ends[1]) - place(ends[0])).norm()).sum::<f64>()
}
