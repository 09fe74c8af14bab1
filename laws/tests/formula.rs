//! The language of the law `expression`: meaning, derivatives, errors, and that no text makes it panic.

use asperity_laws::{
    dual::{Dual, constant, derivatives, pressure_dual, slip_dual},
    expression::{Program, Symbol, Symbols, compile},
};
use proptest::{prelude::*, test_runner::TestRunner};

/// Symbols `x`, `y` with the derivatives `[1, 0]`, `[0, 1]`, and the number `mu`.
fn symbols() -> Symbols {
    let mut symbols = Symbols::default();
    symbols.add("x", Symbol::Slot(0)).unwrap();
    symbols.add("y", Symbol::Slot(1)).unwrap();
    symbols.add("mu", Symbol::Number(0.25)).unwrap();
    symbols
}

fn formula(text: &str) -> Program {
    compile(text, &symbols()).unwrap_or_else(|error| panic!("{error}"))
}

fn value(text: &str, x: f64, y: f64) -> (f64, [f64; 2]) {
    derivatives(&formula(text).value(&[pressure_dual(x), slip_dual(y)]))
}

fn wrong(text: &str) -> String {
    compile(text, &symbols()).expect_err(text)
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-14 * b.abs()
}

#[test]
fn operators_bind_as_in_mathematics() {
    for (text, expected) in [
        ("1 + 2*3 - 4/2", 5.0),
        ("2 - 3 - 4", -5.0),
        ("16/4/2", 2.0),
        ("-2^2", -4.0),
        ("(-2)^2", 4.0),
        ("2^3^2", 512.0),
        ("2**-1", 0.5),
        ("2^-3*8", 1.0),
        ("-2*-3", 6.0),
        ("+3 - -1", 4.0),
        (".5 + 1. + 2e-1 + 3E+0", 4.7),
        ("max(1, 2, 3) + min(4, 5)", 7.0),
        ("4*mu", 1.0),
        ("cos(pi)", -1.0),
        (" ( 1 +\n 1 )\t* 2 ", 4.0),
        ("2e", f64::NAN),
    ] {
        match compile(text, &symbols()) {
            Ok(program) => assert!(close(program.value(&[constant(0.0); 2]).re, expected), "{text}"),
            Err(error) => assert!(expected.is_nan(), "{error}"),
        }
    }
}

type Closed = fn(f64) -> (f64, f64);

#[test]
fn derivatives_are_those_of_the_closed_forms() {
    let table: [(&str, Closed); 18] = [
        ("exp(x)", |x| (x.exp(), x.exp())),
        ("ln(x)", |x| (x.ln(), 1.0 / x)),
        ("log10(x)", |x| (x.log10(), 1.0 / (x * std::f64::consts::LN_10))),
        ("sqrt(x)", |x| (x.sqrt(), 0.5 / x.sqrt())),
        ("abs(-x)", |x| (x, 1.0)),
        ("sign(-x)", |_| (-1.0, 0.0)),
        ("tanh(x)", |x| (x.tanh(), x.cosh().powi(-2))),
        ("sinh(x)", |x| (x.sinh(), x.cosh())),
        ("cosh(x)", |x| (x.cosh(), x.sinh())),
        ("asinh(x)", |x| (x.asinh(), 1.0 / (1.0 + x * x).sqrt())),
        ("atan(x)", |x| (x.atan(), 1.0 / (1.0 + x * x))),
        ("sin(x)", |x| (x.sin(), x.cos())),
        ("cos(x)", |x| (x.cos(), -x.sin())),
        ("x^3", |x| (x * x * x, 3.0 * x * x)),
        ("(-x)^3", |x| (-x * x * x, -3.0 * x * x)),
        ("2^x", |x| (x.exp2(), x.exp2() * std::f64::consts::LN_2)),
        ("x^x", |x| (x.powf(x), x.powf(x) * (x.ln() + 1.0))),
        ("1/x + x/2 - x*x", |x| (1.0 / x + x / 2.0 - x * x, -1.0 / (x * x) + 0.5 - 2.0 * x)),
    ];
    for x in [1e-3, 0.7, 1.9, 12.0] {
        for (text, closed) in table {
            let ((found, slopes), (expected, slope)) = (value(text, x, 0.0), closed(x));
            assert!(close(found, expected) && close(slopes[0], slope), "{text} at {x}: {found} {slopes:?}");
            assert_eq!(slopes[1], 0.0);
        }
    }
}

#[test]
fn ties_have_the_mean_derivative() {
    assert_eq!(value("abs(y)", 1.0, 0.0), (0.0, [0.0, 0.0]));
    assert_eq!(value("max(x, y)", 2.0, 2.0), (2.0, [0.5, 0.5]));
    assert_eq!(value("min(2*x, y)", 2.0, 2.0), (2.0, [0.0, 1.0]));
    assert_eq!(value("sign(x)", 0.0, 0.0), (0.0, [0.0, 0.0]));
    assert_eq!(value("x^1 + x^2 + x^0", 0.0, 0.0), (1.0, [1.0, 0.0]));
}

#[test]
fn mistakes_are_pointed_at() {
    for (text, message, line, pointer) in [
        ("mu*x*exq(y)", "unknown symbol `exq` (did you mean `exp`?); known: mu, pi, x, y", "mu*x*exq(y)", "     ^^^"),
        ("mu x", "an operator is missing before this, character 4", "mu x", "   ^"),
        ("2x", "an operator is missing before this", "2x", " ^"),
        ("(x + 1", "this `(` is not closed", "(x + 1", "^"),
        ("x + 1)", "this `)` closes nothing", "x + 1)", "     ^"),
        ("x + * y", "a number, a symbol or `(` is expected here", "x + * y", "    ^"),
        ("x +", "a number, a symbol or `(` is expected here, character 4", "x +", "   ^"),
        ("", "a number, a symbol or `(` is expected here, character 1", "", "^"),
        ("x ? y", "unexpected `?`", "x ? y", "  ^"),
        ("exp*x", "`exp` is a function, `exp(...)`", "exp*x", "^^^"),
        ("mu(x)", "`mu` is no function; a product is written `mu*(...)`", "mu(x)", "^^"),
        ("exp(x, y)", "`exp` takes one argument", "exp(x, y)", "     ^"),
        ("x + min(y)", "`min` takes two or more arguments", "x + min(y)", "    ^^^^^^"),
        ("x + 1e999", "not a number", "x + 1e999", "    ^^^^^"),
        ("µ + ±x", "unknown symbol `µ`", "µ + ±x", "^"),
        ("1 + ±x", "expected here", "1 + ±x", "    ^"),
        ("x +\n  yy*2", "unknown symbol `yy`", "  yy*2", "  ^^"),
    ] {
        let error = wrong(text);
        assert!(error.contains(message), "{error}");
        assert!(error.ends_with(&format!(":\n    {line}\n    {pointer}")), "{error}");
    }
    assert!(wrong("x +\n  yy*2").contains("line 2, character 3"));
    assert!(wrong(&"(".repeat(100_000)).contains("nested too deeply"));
    assert!(wrong(&"-".repeat(100_000)).contains("nested too deeply"));
    assert!(wrong(&"x+(".repeat(60)).contains("too many unfinished operations"));
}

#[test]
fn names_are_identifiers_and_used_once() {
    let mut symbols = symbols();
    for (name, why) in
        [("x", "taken"), ("exp", "taken"), ("pi", "taken"), ("2x", "no name"), ("a b", "no name"), ("", "no name")]
    {
        assert!(symbols.add(name, Symbol::Number(1.0)).unwrap_err().contains(why), "{name}");
    }
}

#[test]
fn the_part_that_fails_first_is_shown() {
    let fault = |text: &str, x: f64| formula(text).fault(&[pressure_dual(x), slip_dual(0.0)]).unwrap_or_default();
    assert_eq!(fault("mu*(1 + mu/x)", 0.0), "`mu/x` is inf, character 9:\n    mu*(1 + mu/x)\n            ^^^^");
    assert!(fault("mu + exp(ln(x))", -1.0).starts_with("`ln(x)` is NaN, character 10"));
    assert!(fault("2*sqrt(x)", 0.0).starts_with("`sqrt(x)` is 0 with an infinite slope"));
    assert_eq!(fault("2*sqrt(x)", 1.0), "");
}

fn tries(cases: u32, strategy: impl Strategy<Value = String>) {
    let config = ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() };
    let symbols = symbols();
    TestRunner::new(config)
        .run(&strategy, |text| {
            if let Ok(program) = compile(&text, &symbols) {
                let slots: [Dual; 2] = [pressure_dual(0.5), slip_dual(-0.5)];
                program.value(&slots);
                program.fault(&slots);
            }
            Ok(())
        })
        .unwrap();
}

#[test]
fn no_text_panics() {
    const WORDS: [&str; 24] = [
        "x", "y", "mu", "pi", "1", "2.5", "1e-3", ".", "e", "+", "-", "*", "/", "^", "**", "(", ")", ",", " ", "exp",
        "max", "\n", "é", "%",
    ];
    tries(60_000, ".{0,40}");
    tries(
        60_000,
        proptest::collection::vec(proptest::sample::select(&WORDS[..]), 0..30).prop_map(|words| words.concat()),
    );
}
