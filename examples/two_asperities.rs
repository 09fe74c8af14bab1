//! The two-asperity pass driven from Rust: build a model, march, read the forces.
//!
//! `cargo run --release --example two_asperities -- [mu] [level] [nurbs|lagrange] [degree] [steps] [sites]`

use std::convert::Infallible;
use std::error::Error;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use asperity::bulk::NeoHookean;
use asperity::contact::Sites;
use asperity::geometry::shapes::{Block, Cosine};
use asperity::geometry::{BasisSpec, Edge, Profile, ShapeSpec, build};
use asperity::laws::FrictionLaw;
use asperity::laws::builtin::Coulomb;
use asperity::math::CondensedSolver;
use asperity::model::{BodySpec, Builder, Control, Model, PairSpec, State, Table};
use asperity::solve;

fn asperity(up: bool, basis: BasisSpec, h: f64) -> Result<BodySpec, Box<dyn Error>> {
    let bump =
        Profile::Cosine(Cosine { height: 0.4, wavelength: 1.6, centers: Some(vec![0.0]), count: None, spacing: None });
    let flat = Profile::default();
    let (block, position) = if up {
        (Block { x: [-2.0, 2.0], y: [-1.0, 0.0], top: bump, bottom: flat }, [0.0, 0.0])
    } else {
        (Block { x: [-1.0, 1.0], y: [0.0, 1.0], top: flat, bottom: bump }, [-1.9, 0.6])
    };
    let elements = [((block.x[1] - block.x[0]) / h).round() as usize, (1.0 / h).round() as usize];
    let patch = build(&ShapeSpec::Block(block), &basis, elements, None, position, Path::new("."))?;
    Ok(BodySpec::Deformable(patch, Arc::new(NeoHookean { youngs_modulus: 1.0, poissons_ratio: 0.3 })))
}

fn model(mu: f64, h: f64, basis: BasisSpec, sites: Sites) -> Result<Model, Box<dyn Error>> {
    let mut builder = Builder::default();
    builder.body("lower", asperity(true, basis, h)?)?.body("upper", asperity(false, basis, 0.93 * h)?)?;
    let hold = || Control::Displacement(Table::constant(0.0));
    let drag = Control::Displacement(Table { time: vec![0.0, 1.0], value: vec![0.0, 3.8] });
    builder.motion("lower", Edge::Bottom, 0, hold(), false)?.motion("lower", Edge::Bottom, 1, hold(), false)?;
    builder.motion("upper", Edge::Top, 0, drag, true)?.motion("upper", Edge::Top, 1, hold(), true)?;
    let law: Arc<dyn FrictionLaw> = Arc::new(Coulomb { friction: mu });
    let mut pair = PairSpec::new(("upper", Edge::Bottom), ("lower", Edge::Top), law);
    pair.sites = Some(sites);
    builder.contact(pair);
    Ok(builder.build()?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let argument = |k: usize, default: &str| arguments.get(k).map_or(default, String::as_str).to_owned();
    let (mu, level): (f64, i32) = (argument(0, "0.3").parse()?, argument(1, "1").parse()?);
    let degree = argument(3, "2").parse()?;
    let basis = match argument(2, "nurbs").as_str() {
        "lagrange" => BasisSpec::Lagrange { degree },
        _ => BasisSpec::Nurbs { degree },
    };
    let steps = argument(4, "76").parse()?;
    let sites = if argument(5, "quadrature") == "nodal" { Sites::Nodal } else { Sites::Quadrature };
    let model = model(mu, 0.05 / 2f64.powi(level - 1), basis, sites)?;
    println!("{} unknowns", model.unknowns());
    println!("{:>4} {:>8} {:>12} {:>12} {:>10} {:>10} it cuts", "step", "x_c", "Fx", "Fy", "mu_global", "angle");
    let control = solve::Control { end: 1.0, steps, max_cuts: 8, strategy: Default::default() };
    let outcome = solve::march(
        &model,
        State::initial(&model),
        &control,
        &mut CondensedSolver::default(),
        &AtomicBool::new(false),
        |report| {
            let r = &report.record;
            let x = r.drive[0] - 1.9;
            println!(
                "{:4} {x:8.4} {:12.8} {:12.8} {:10.6} {:10.6} {:2} {:2}",
                r.step, r.force[0], r.force[1], r.mu_global, r.contact_angle, r.newton_iterations, r.cuts
            );
            Ok::<(), Infallible>(())
        },
    )?;
    println!("{:?} after {} iterations, {} cuts", outcome.status, outcome.iterations, outcome.cuts);
    Ok(())
}
