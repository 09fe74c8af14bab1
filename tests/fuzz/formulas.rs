//! Formulas that are right by construction.

use proptest::prelude::*;

/// Text of a formula of the language of `type = "expression"`.
pub fn formula() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        prop::sample::select(vec![
            "p", "v", "s", "dt", "T", "pi", "mu", "table", "0", "1.5", ".5", "2.", "1e-3", "1E+5", "1e-300", "1e300"
        ])
        .prop_map(str::to_string),
        any::<f64>().prop_filter("finite", |x| x.is_finite()).prop_map(|x| format!("{:e}", x.abs())),
    ];
    leaf.prop_recursive(5, 24, 3, |inner| {
        let binary = prop::sample::select(vec!["+", "-", "*", "/", "^", "**", " + ", " ^ "]);
        let unary = prop::sample::select(vec![
            "exp", "ln", "log10", "sqrt", "abs", "sign", "tanh", "sinh", "cosh", "asinh", "atan", "sin", "cos",
        ]);
        prop_oneof![
            (inner.clone(), binary, inner.clone()).prop_map(|(a, op, b)| format!("({a}{op}{b})")),
            (unary, inner.clone()).prop_map(|(f, a)| format!("{f}({a})")),
            (prop::sample::select(vec!["-", "+", "- ", "--"]), inner.clone())
                .prop_map(|(sign, a)| format!("{sign}{a}")),
            (prop::sample::select(vec!["min", "max"]), inner.clone(), inner)
                .prop_map(|(f, a, b)| format!("{f}({a}, {b})")),
        ]
    })
}
