//! Values and derivatives of the bases.

use asperity::geometry::{Basis, Lagrange, Shape, rational};

use super::{inside, uneven};

/// de Boor's recursion straight from the definition (0/0 = 0), for function `i` of degree `p`.
fn de_boor(knots: &[f64], i: usize, p: usize, xi: f64) -> f64 {
    if p == 0 {
        return f64::from(u8::from(knots[i] <= xi && xi < knots[i + 1]));
    }
    let part = |numerator: f64, denominator: f64, j: usize| {
        if denominator == 0.0 { 0.0 } else { numerator / denominator * de_boor(knots, j, p - 1, xi) }
    };
    part(xi - knots[i], knots[i + p] - knots[i], i)
        + part(knots[i + p + 1] - xi, knots[i + p + 1] - knots[i + 1], i + 1)
}

#[test]
fn bspline_values_match_de_boor_recursion() {
    for degree in 0..=8 {
        let basis = uneven(degree);
        for (span, xi) in inside(basis.breaks()) {
            let s = basis.evaluate(span, xi);
            let sum: f64 = s.d[0].iter().sum();
            assert!((sum - 1.0).abs() < 1e-14, "degree {degree} at {xi}: sum {sum}");
            for i in 0..basis.len() {
                let alive = (s.first..s.first + s.count).contains(&i);
                let value = if alive { s.d[0][i - s.first] } else { 0.0 };
                let exact = de_boor(basis.knot_vector(), i, degree, xi);
                assert!((value - exact).abs() < 1e-14, "degree {degree}, function {i} at {xi}: {value} {exact}");
            }
        }
    }
}

/// Fourth-order central difference of row `k - 1` against row `k`.
fn check_derivatives(evaluate: impl Fn(f64) -> Shape, xi: f64, what: &str) {
    let h = 1e-3;
    let s = evaluate(xi);
    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|t| evaluate(xi + t * h));
    for k in 1..=3 {
        for i in 0..s.count {
            let at = |s: &Shape| s.d[k - 1][i];
            let difference = (at(&a) - 8.0 * at(&b) + 8.0 * at(&c) - at(&d)) / (12.0 * h);
            let scale = s.d[k].iter().fold(1.0, |m: f64, v| m.max(v.abs()));
            assert!(
                (s.d[k][i] - difference).abs() < 1e-6 * scale,
                "{what}, order {k}, function {i} at {xi}: {} {difference}",
                s.d[k][i]
            );
        }
    }
}

#[test]
fn derivatives_match_differences_also_rational_and_outside_the_span() {
    for degree in 1..=6 {
        let basis = uneven(degree);
        let weights: Vec<f64> = (0..basis.len()).map(|i| 1.0 + 0.3 * (i as f64 * 1.7).sin()).collect();
        for (span, xi) in inside(basis.breaks()) {
            check_derivatives(|t| basis.evaluate(span, t), xi, "polynomial");
            check_derivatives(|t| rational(&basis.evaluate(span, t), &weights), xi, "rational");
        }
        check_derivatives(|t| basis.evaluate(0, t), -0.6, "outside");
    }
    for degree in 1..=2 {
        let basis = Lagrange::new(degree, vec![0.0, 0.4, 1.0, 2.5]).expect("valid");
        for (span, xi) in inside(basis.breaks()) {
            check_derivatives(|t| basis.evaluate(span, t), xi, "lagrange");
        }
    }
}

#[test]
fn lagrange_functions_are_one_at_their_node_and_zero_at_the_others() {
    for degree in 1..=2 {
        let basis = Lagrange::new(degree, vec![0.0, 0.4, 1.0, 2.5]).expect("valid");
        let nodes = basis.nodes();
        assert_eq!(nodes.len(), basis.len());
        for span in 0..3 {
            for (i, &node) in nodes.iter().enumerate().skip(degree * span).take(degree + 1) {
                let s = basis.evaluate(span, node);
                assert_eq!(s.first, degree * span);
                for a in 0..s.count {
                    let expected = f64::from(u8::from(s.first + a == i));
                    assert!((s.d[0][a] - expected).abs() < 1e-14);
                }
            }
        }
    }
}

#[test]
fn greville_nodes_reproduce_the_linear_map() {
    for degree in 1..=5 {
        let basis = uneven(degree);
        let nodes = basis.nodes();
        for (span, xi) in inside(basis.breaks()) {
            let s = basis.evaluate(span, xi);
            let x: f64 = (0..s.count).map(|a| s.d[0][a] * nodes[s.first + a]).sum();
            assert!((x - xi).abs() < 1e-14);
        }
    }
}
