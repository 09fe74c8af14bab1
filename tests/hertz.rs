//! Hertz' line contact: a cylinder on a rigid plane and two cylinders, against the half-space solution
//! (Johnson, Contact Mechanics, 1985, section 4.2(c); theory.md 4.2)
//!
//! ```text
//! a = sqrt(4 F R/(pi E*)),   p0 = 2 F/(pi a),   p = p0 sqrt(1 - x^2/a^2)
//! ```
//!
//! E = 1, nu = 0.3, small strain, a = 1, cylinders of radius 2000 cut to blocks 80 wide and 40 high, pressed by a force.
//! The errors depend on where the contact edge lies inside an element: every figure is the mean (and the worst) over
//! loads whose a/h is spread evenly over one element. L2 and maximal error are taken inside |x| < 0.9 a.

#[path = "support/hertz.rs"]
mod machinery;

use asperity::contact::{Integration, Sites};
use asperity::geometry::BasisSpec;
use machinery::{Case, PLANE, TWO};

/// Loads per element.
const PHASES: usize = 5;

/// Mean and worst `[L2, maximum, peak]` over the phases; prints a row.
fn measure(name: &str, case: Case) -> [[f64; 3]; 2] {
    let phase = |k: usize| 1.0 + ((k as f64 + 0.5) / PHASES as f64 - 0.5) / case.per_a;
    let all: Vec<[f64; 3]> = (0..PHASES).map(|k| Case { a: phase(k), ..case }.errors()).collect();
    let mean = [0, 1, 2].map(|i| all.iter().map(|e| e[i]).sum::<f64>() / PHASES as f64);
    let worst = [0, 1, 2].map(|i| all.iter().map(|e| e[i]).fold(0.0, f64::max));
    let cell = |i: usize| format!("{:6.3} ({:6.3})", mean[i], worst[i]);
    println!("{name:44} {:4.1}  {}  {}  {}", case.per_a, cell(0), cell(1), cell(2));
    [mean, worst]
}

fn heading() {
    println!("{:44}  a/h  L2 mean (worst)  max of p0        peak         all in %", "");
}

/// Errors at a/h = 4.5, 9, 18 with the defaults, their bounds and rates.
///
/// The means are below the best peers (issue: 1.1 %, 1.9 % and 0.9 % at a/h = 9; 2.9 % maximal at 18). The worst load is
/// the one whose contact ends just inside an element: the error is that of the last half element before x = a.
fn converges(name: &str, case: Case) {
    heading();
    let [coarse, middle, fine] = [4.5, 9.0, 18.0].map(|per_a| measure(name, Case { per_a, ..case }));
    let rate = |i: usize| (coarse[0][i] / fine[0][i]).log2() / 2.0;
    println!("{name:44} rate {:5.2}            {:5.2}", rate(0), rate(1));
    below(middle, [0.8, 1.9, 0.1], [1.5, 4.0, 0.2]);
    below(fine, [0.25, 0.9, 0.2], [0.4, 1.4, 0.2]);
    assert!(rate(0) > 1.3 && rate(1) > 0.8, "p has a vertical tangent at x = a");
}

/// Asserts bounds of the mean and of the worst.
fn below(found: [[f64; 3]; 2], mean: [f64; 3], worst: [f64; 3]) {
    for (found, bound) in found.into_iter().zip([mean, worst]) {
        assert!(found.iter().zip(bound).all(|(e, b)| *e < b), "{found:?} should be below {bound:?}");
    }
}

#[test]
fn cylinder_on_a_rigid_plane() {
    converges("plane, nurbs 2", PLANE);
    below(measure("plane, nurbs 2, r = 2", Case { r: 2.0, ..PLANE }), [0.6, 1.5, 0.1], [0.9, 2.5, 0.2]);
}

#[test]
fn two_cylinders() {
    converges("two, nurbs 2", TWO);
}

#[test]
fn other_bases_and_sites() {
    heading();
    let lagrange = |degree| Case { basis: BasisSpec::Lagrange { degree }, ..PLANE };
    let cubic = Case { basis: BasisSpec::Nurbs { degree: 3 }, ..PLANE };
    below(measure("plane, nurbs 3", cubic), [0.8, 1.9, 0.2], [1.2, 2.5, 0.2]);
    // Lagrange elements of degree 2 have twice the nodes.
    below(measure("plane, lagrange 2", lagrange(2)), [0.4, 1.5, 0.1], [0.8, 2.2, 0.1]);
    below(measure("plane, lagrange 1", lagrange(1)), [1.8, 5.5, 0.9], [2.8, 8.0, 0.9]);
    let segments = Case { plane: false, integration: Integration::Segment, ..lagrange(2) };
    below(measure("two, lagrange 2, segments", segments), [0.5, 1.7, 0.1], [0.9, 3.0, 0.2]);
    let nodal = Case { sites: Sites::Nodal, ..PLANE };
    below(measure("plane, nurbs 2, nodal sites", nodal), [2.2, 6.0, 0.2], [4.0, 10.0, 0.2]);
    let nodal = Case { per_a: 18.0, ..nodal };
    below(measure("plane, nurbs 2, nodal sites", nodal), [0.7, 2.9, 0.1], [1.1, 4.0, 0.2]);
    let fine = Case { per_a: 18.0, ..lagrange(2) };
    below(measure("plane, lagrange 2", fine), [0.1, 0.4, 0.1], [0.2, 0.6, 0.1]);
}

/// Kinks of the mortar side inside a nonmortar element: few Gauss points and quadratic multipliers make waves of them that do not
/// go away with h (6 % here). The default, linear multipliers and more points, keeps them small; segments end at the kinks.
#[test]
fn kinks_of_the_mortar_side() {
    let case = Case { basis: BasisSpec::Lagrange { degree: 2 }, per_a: 14.0, ..TWO };
    let element = case.errors();
    let segment = Case { integration: Integration::Segment, ..case }.errors();
    println!("two, lagrange 2, a/h = 14: elements {element:.3?}, segments {segment:.3?} (L2, max, peak in %)");
    assert!(element[0] < 0.8 && segment[0] < 0.3 * element[0]);
}

/// What the half-space solution itself is worth here: twice the domain moves the errors by less than 0.1 % of p0.
#[test]
fn domain_is_large_enough() {
    for case in [PLANE, TWO] {
        let case = Case { per_a: 14.0, ..case };
        let [small, large] = [40.0, 80.0].map(|size| Case { size, ..case }.errors());
        println!("domain 40 a {small:.3?}, 80 a {large:.3?} (L2, max, peak in %)");
        assert!(small.iter().zip(large).all(|(s, l)| (s - l).abs() < 0.1));
    }
}
