//! Hertz' line contact: a cylinder on a rigid plane and two cylinders, against the half-space solution
//! (Johnson, Contact Mechanics, 1985, section 4.2(c); theory.md 4.2).

use std::convert::Infallible;
use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use asperity::bulk::LinearElastic;
use asperity::contact::Sites;
use asperity::geometry::shapes::{Along, ArcProfile, Block};
use asperity::geometry::{BasisSpec, Edge, Grading, Profile, ShapeSpec, build, build_edge};
use asperity::laws::builtin::Frictionless;
use asperity::math::SparseLu;
use asperity::model::{BodySpec, Builder, Control, Model, PairSpec, State, Table};
use asperity::solve::{self, Status};

const NU: f64 = 0.3;

/// A Hertz problem with E = 1 and the nominal contact half-width a = 1.
#[derive(Clone, Copy, Debug)]
struct Case {
    rigid: bool,
    per_a: f64,
    basis: BasisSpec,
    sites: Sites,
    /// Half the width of a body, and its height.
    size: f64,
    radius: f64,
    growth: f64,
    zone: f64,
    points: usize,
    r: f64,
    target: f64,
}

impl Case {
    fn modulus(&self) -> f64 {
        let plane_strain = 1.0 / (1.0 - NU * NU);
        if self.rigid { plane_strain } else { 0.5 * plane_strain }
    }
    fn curvature_radius(&self) -> f64 {
        if self.rigid { self.radius } else { 0.5 * self.radius }
    }
    fn force(&self) -> f64 {
        PI * self.modulus() * self.target.powi(2) / (4.0 * self.curvature_radius())
    }
    fn mesh(&self, edge: Edge, h: f64) -> ([usize; 2], Grading) {
        let (g, zone) = (self.growth, self.zone);
        let ratios = [self.size - zone, self.size].map(|length| 1.0 + g * length / h);
        let outside = ratios.map(|ratio| ratio.ln() / g);
        let along = Along { center: 0.0, half_width: zone, ratio: ratios[0] };
        let elements = [2 * (zone / h + outside[0]).round() as usize, outside[1].round() as usize];
        (elements, Grading { toward: Some(edge), ratio: Some(ratios[1]), along: Some(along) })
    }
    fn cylinder(&self, up: bool) -> BodySpec {
        let arc = Profile::Arc(ArcProfile { radius: self.radius, height: None, centers: None, count: None, spacing: None });
        let x = [-self.size, self.size];
        let rise = self.radius - (self.radius.powi(2) - self.size.powi(2)).sqrt();
        let overlap = 0.1 / self.radius;
        let (block, edge, y, h) = if up {
            (Block { x, y: [-self.size, 0.0], top: arc, bottom: Profile::default() }, Edge::Top, -rise, 0.93 / self.per_a)
        } else {
            let block = Block { x, y: [0.0, self.size], top: Profile::default(), bottom: arc };
            (block, Edge::Bottom, rise - overlap, 1.0 / self.per_a)
        };
        let (elements, grading) = self.mesh(edge, h);
        let patch = build(&ShapeSpec::Block(block), &self.basis, elements, Some(&grading), [0.0, y], Path::new("."));
        let material = LinearElastic { youngs_modulus: 1.0, poissons_ratio: NU };
        BodySpec::Deformable(patch.expect("a block"), Arc::new(material))
    }
    fn plane(&self) -> BodySpec {
        let x = [-2.0 * self.size, 2.0 * self.size];
        let block = Block { x, y: [-1.0, 0.0], top: Profile::default(), bottom: Profile::default() };
        let shape = ShapeSpec::Block(block);
        let basis = BasisSpec::Nurbs { degree: 1 };
        let curve = build_edge(&shape, Edge::Top, &basis, [1, 1], None, [0.0, 0.0], Path::new("."));
        BodySpec::Rigid(vec![(Edge::Top, curve.expect("a line"))])
    }
    fn model(&self) -> Model {
        let mut builder = Builder::default();
        let hold = || Control::Displacement(Table::constant(0.0));
        let press = Control::Force(Table::constant(-self.force()));
        let mut pair = PairSpec::new(("upper", Edge::Bottom), ("lower", Edge::Top), Arc::new(Frictionless {}));
        pair.sites = Some(self.sites);
        pair.r = Some(self.r);
        if self.points > 0 { pair.points = Some(self.points); }
        let built = (|| {
            builder.body("upper", self.cylinder(false))?;
            builder.body("lower", if self.rigid { self.plane() } else { self.cylinder(true) })?;
            builder.motion("lower", Edge::Bottom, 0, hold(), false)?.motion("lower", Edge::Bottom, 1, hold(), false)?;
            builder.motion("upper", Edge::Top, 0, hold(), true)?.motion("upper", Edge::Top, 1, press, true)?;
            builder.contact(pair);
            builder.build()
        })();
        built.expect("a valid model")
    }
}

fn report(name: &str, case: &Case) -> [[f64;4];2] {
    let model = case.model();
    let clock = std::time::Instant::now();
    let control = solve::Control { end: 1.0, steps: 1, max_cuts: 6 };
    let quiet = AtomicBool::new(false);
    let mut found = None;
    let out = solve::march(&model, State::initial(&model), &control, &mut SparseLu::default(), &quiet, |r| {
        found = Some((r.state.clone(), r.evaluation.interfaces[0].clone(), r.record));
        Ok::<(), Infallible>(())
    }).unwrap();
    let Status::Done = out.status else { println!("{name} {case:?} {:?}", out.status); return [[f64::NAN;4];2]; };
    let (state, interface, record) = found.unwrap();
    let force = interface.normal_force.y;
    let (es, rr) = (case.modulus(), case.curvature_radius());
    let a = (4.0 * force * rr / (PI * es)).sqrt();
    let p0 = 2.0 * force / (PI * a);
    let hertz = |x: f64| p0 * (1.0 - (x / a).powi(2)).max(0.0).sqrt();
    let sites: Vec<[f64; 3]> = interface.sites.iter().map(|s| [s.x.x, s.pressure, s.weight]).collect();
    let Some(patch) = model.bodies[0].patch() else { unreachable!() };
    let curve = patch.boundary(Edge::Bottom);
    let breaks = curve.basis.breaks().to_vec();
    let mut field = vec![];
    for span in 0..curve.spans() {
        for k in 0..8 {
            let xi = breaks[span] + (breaks[span + 1] - breaks[span]) * (k as f64 + 0.5) / 8.0;
            let s = curve.shape(span, xi);
            let x = curve.place(&s, 0, &curve.points).x;
            let p: f64 = (0..s.count).map(|i| s.d[0][i] * state.pairs[0].pressure[s.first + i]).sum();
            field.push([x, p, (breaks[span + 1] - breaks[span]) / 8.0]);
        }
    }
    let measure = |f: &[[f64; 3]]| {
        let inside = || f.iter().filter(|s| s[0].abs() < 0.9 * a);
        let n: f64 = inside().map(|s| s[2] * (s[1] - hertz(s[0])).powi(2)).sum();
        let d: f64 = inside().map(|s| s[2] * hertz(s[0]).powi(2)).sum();
        let worst = inside().fold([0.0, 0.0], |m: [f64; 2], s| { let e = (s[1] - hertz(s[0])).abs() / p0; if e > m[1] { [s[0] / a, e] } else { m } });
        let peak = f.iter().fold(0.0_f64, |m, s| m.max(s[1])) / p0 - 1.0;
        [100.0 * (n / d).sqrt(), 100.0 * worst[1], worst[0], 100.0 * peak]
    };
    let (s, f) = (measure(&sites), measure(&field));
    if std::env::var("DUMP").is_ok() { for q in &sites { if q[0].abs() < 1.2*a { println!("{:8.4} {:9.5} {:9.5}", q[0]/a, q[1]/p0, hertz(q[0])/p0); } } }
    if std::env::var("EACH").is_ok() { println!("{name:26} n={:5} F/F0={:.8} a={a:.5} it={:2} cuts={} {:5.1}s  sites L2 {:6.3} max {:6.3} @{:6.3} peak {:6.3} | field L2 {:6.3} max {:6.3} @{:6.3} peak {:6.3}",
        model.unknowns(), force / case.force(), record.newton_iterations, record.cuts, clock.elapsed().as_secs_f64(), s[0], s[1], s[2], s[3], f[0], f[1], f[2], f[3]); }
    [s, f]
}

#[test]
fn lab() {
    let base = Case { rigid: true, per_a: 9.0, basis: BasisSpec::Nurbs { degree: 2 }, sites: Sites::Quadrature, size: 40.0, radius: 2000.0, growth: 0.2, zone: 1.5, points: 0, r: 1.0, target: 1.0 };
    let only = std::env::var("LAB").unwrap_or_default();
    let go = |name: &str, case: Case| if name.contains(&only) {
      for n in [4.5, 9.0, 18.0, 36.0] {
        let mut all = vec![];
        let clock = std::time::Instant::now();
        for k in 0..8 { let t = 1.0 + ((k as f64 + 0.5) / 8.0 - 0.5) / n; all.push(report(name, &Case { per_a: n, target: t, ..case })); }
        let mean = |w: usize, c: usize| all.iter().map(|r| r[w][c].abs()).sum::<f64>() / 8.0;
        let worst = |w: usize, c: usize| all.iter().map(|r| r[w][c].abs()).fold(0.0, f64::max);
        print!("{name:16} a/h={n:4} ");
        for w in 0..2 { print!(" {} L2 {:6.3} ({:6.3}) max {:6.3} ({:6.3}) peak {:6.3} ({:6.3})", ["sites", "field"][w], mean(w,0), worst(w,0), mean(w,1), worst(w,1), mean(w,3), worst(w,3)); }
        println!(" {:.1}s", clock.elapsed().as_secs_f64());
      }
    };
    let p = |degree| BasisSpec::Nurbs { degree };
    let l = |degree| BasisSpec::Lagrange { degree };
    go("A p2 plane", base);
    go("A p2 two", Case { rigid: false, ..base });
    go("B p2 plane nodal", Case { sites: Sites::Nodal, ..base });
    go("B p2 two nodal", Case { rigid: false, sites: Sites::Nodal, ..base });
    go("C p3 plane", Case { basis: p(3), ..base });
    go("C l2 plane", Case { basis: l(2), ..base });
    go("C l1 plane", Case { basis: l(1), ..base });
    go("C p3 two", Case { rigid: false, basis: p(3), ..base });
    go("C l2 two", Case { rigid: false, basis: l(2), ..base });
    go("C l1 two", Case { rigid: false, basis: l(1), ..base });
    go("D p2 plane size80", Case { size: 80.0, ..base });
    go("D p2 plane r.3", Case { r: 0.3, ..base });
    go("D p2 plane r3", Case { r: 3.0, ..base });
    go("D p2 plane growth.1", Case { growth: 0.1, ..base });
    go("D p2 plane points5", Case { points: 5, ..base });
    go("E l1 plane nodal", Case { basis: l(1), sites: Sites::Nodal, ..base });
    go("E l2 plane nodal", Case { basis: l(2), sites: Sites::Nodal, ..base });
}
