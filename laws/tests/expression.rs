//! The law `expression`: laws written in text against closed forms, the conformance kit on them, and their errors.

use asperity_laws::{dual::derivatives, *};

fn read(text: &str) -> Result<Box<dyn FrictionLaw>, LawError> {
    parse(format!("type = 'expression'\n{text}").parse().expect("TOML"))
}

fn law(text: &str) -> Box<dyn FrictionLaw> {
    read(text).unwrap_or_else(|error| panic!("{error}"))
}

/// Response and states with their derivatives.
fn ask(law: &dyn FrictionLaw, at: &InterfacePoint, old: &[f64]) -> Vec<(f64, [f64; 2])> {
    let mut new = vec![dual::constant(f64::NAN); old.len()];
    let response = law.response(at, old, &mut new);
    std::iter::once(&response.value()).chain(&new).map(derivatives).collect()
}

fn same(found: (f64, [f64; 2]), expected: (f64, [f64; 2])) {
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-14 * b.abs();
    let slopes = close(found.1[0], expected.1[0]) && close(found.1[1], expected.1[1]);
    assert!(close(found.0, expected.0) && slopes, "{found:?} instead of {expected:?}");
}

const COULOMB: &str = "threshold = 'mu*p'\nparameters = { mu = { value = 0.3, unit = '1' } }";
const STRIBECK: &str = "threshold = 'p*(mk + (ms - mk)*exp(-abs(v)/vs))'
[parameters]
ms = { value = 0.5, unit = '1' }
mk = { value = 0.3, unit = '1' }
vs = { value = 0.01, unit = 'length/time' }";
const REGULARISED: &str = "traction = 'mu*p*tanh(v/vs)'
parameters = { mu = { value = 0.3, unit = '1' }, vs = { value = 0.01, unit = 'length/time' } }";
const DAHL: &str = "traction = 'mu*p*z/d'
parameters = { mu = { value = 0.3, unit = '1' }, d = { value = 1e-3, unit = 'length' } }
states.z = { rate = 'v - abs(v)*z/d', open = 'reset', unit = 'length' }";
/// Static friction lost over a slip distance and regained at rest.
const WEAKENING: &str = "threshold = 'p*(mu + drop*h)'
[parameters]
mu = { value = 0.3, unit = '1' }
drop = { value = 0.2, unit = '1' }
d = { value = 0.05, unit = 'length' }
tau = { value = 3, unit = 'time' }
[states]
h = { rate = '(1 - h)/tau - abs(v)*h/d', initial = 1.0, unit = '1' }
age = { rate = '1 - abs(v)*age/d', unit = 'time' }";
const MEASURED: &str = "threshold = 'mu*p'
parameters.mu = { over = 'v', at = [0, 0.1, 1, 10], value = [0.5, 0.4, 0.3, 0.35], unit = '1' }";

#[test]
fn laws_in_text_equal_their_closed_forms() {
    let coulomb = law(COULOMB);
    for (p, s, dt) in [(2.0, 0.003, 0.1), (1e-6, -4e-4, 0.02), (0.0, 0.0, 1.0), (5.0, 0.0, 1.0), (3.0, 7.0, 1e-3)] {
        let at = InterfacePoint::new(p, s, dt);
        let builtin = ask(&builtin::Coulomb { friction: 0.3 }, &at, &[]);
        assert_eq!(ask(&*coulomb, &at, &[]), builtin);
        let (v, sign) = (s / dt, if s == 0.0 { 0.0 } else { f64::signum(s) });
        let decay = (-v.abs() / 0.01).exp();
        let mu = 0.3 + 0.2 * decay;
        same(ask(&*law(STRIBECK), &at, &[])[0], (mu * p, [mu, -0.2 * p * decay * sign / (0.01 * dt)]));
        let x: f64 = v / 0.01;
        let slope = if x.abs() < 400.0 { 0.3 * p * x.cosh().powi(-2) / (0.01 * dt) } else { 0.0 };
        same(ask(&*law(REGULARISED), &at, &[])[0], (0.3 * p * x.tanh(), [0.3 * x.tanh(), slope]));
    }
}

#[test]
fn a_state_follows_backward_euler_with_its_tangent() {
    let dahl = law(DAHL);
    for (p, s, old) in [(2.0, 3e-4, 2e-4), (1.0, -2e-3, 5e-4), (0.5, 0.0, -1e-4)] {
        let answer = ask(&*dahl, &InterfacePoint::new(p, s, 0.1), &[old]);
        let (d, sign) = (1e-3, if s == 0.0 { 0.0 } else { f64::signum(s) });
        let below = 1.0 + s.abs() / d;
        let (z, slope) = ((old + s) / below, (1.0 - sign * (old + s) / below / d) / below);
        same(answer[1], (z, [0.0, slope]));
        same(answer[0], (0.3 * p * z / d, [0.3 * z / d, 0.3 * p * slope / d]));
    }
    let mut new = [f64::NAN];
    dahl.open(&InterfacePoint::new(0.0, 0.0, 0.1), &[5e-4], &mut new);
    assert_eq!(new, [0.0], "reset");
    let (weakening, mut new) = (law(WEAKENING), [f64::NAN; 2]);
    weakening.open(&InterfacePoint::new(0.0, 0.0, 0.5), &[2.0, 0.4], &mut new);
    let expected = [2.5, (0.4 + 0.5 / 3.0) / (1.0 + 0.5 / 3.0)];
    assert!(new.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14), "goes on: {new:?}");
    let variable = Variable::new("age", Unit::TIME, 0.0);
    assert_eq!(weakening.variables()[0], variable);
}

#[test]
fn one_to_four_states_are_independent() {
    for count in 1..=4 {
        let names = &["a", "b", "c", "d"][..count];
        let states: String =
            names.iter().map(|z| format!("states.{z} = {{ rate = '1 - k*{z}', initial = 0.5 }}\n")).collect();
        let law = law(&format!("threshold = 'p*({})'\nparameters.k = 3\n{states}", names.join(" + ")));
        let answer = ask(&*law, &InterfacePoint::new(2.0, 0.0, 0.1), &vec![0.5; count]);
        let end = (0.5 + 0.1) / (1.0 + 0.3);
        same(answer[0], (2.0 * end * count as f64, [end * count as f64, 0.0]));
    }
}

#[test]
fn measured_tables_are_met_at_their_points_and_even_in_the_speed() {
    let law = law(MEASURED);
    for (v, mu) in [(0.0, 0.5), (0.1, 0.4), (1.0, 0.3), (10.0, 0.35), (100.0, 0.35)] {
        for v in [v, -v] {
            assert!((ask(&*law, &InterfacePoint::new(2.0, v, 1.0), &[])[0].0 - 2.0 * mu).abs() < 1e-14);
        }
    }
    let warm = read(
        "threshold = 'mu*p'\ntemperature = 300\nparameters.mu = { over = 'T', at = [300, 400], value = [0.5, 0.1] }",
    )
    .unwrap();
    let at = InterfacePoint::new(1.0, 0.0, 1.0);
    assert_eq!(ask(&*warm, &at, &[])[0].0, 0.5);
    let hot = InterfacePoint { temperature: Some(350.0), ..at };
    assert!((ask(&*warm, &hot, &[])[0].0 - 0.3).abs() < 1e-15);
}

#[test]
fn laws_in_text_conform() {
    for text in [COULOMB, STRIBECK, REGULARISED, DAHL, WEAKENING, MEASURED] {
        conforms(&*law(text)).unwrap_or_else(|violation| panic!("{text}\n{violation}"));
    }
    assert_eq!((kind(&*law(COULOMB)), kind(&*law(DAHL))), (Some(Kind::SetValued), Some(Kind::Direct)));
}

#[test]
fn the_kit_catches_faults_in_text() {
    let units = "parameters = { mu = { value = 0.3, unit = '1' }, vs = { value = 1.0, unit = 'length/time' } }";
    for (text, property) in [
        ("traction = '-mu*p*tanh(v/vs)'", "dissipation"),
        ("threshold = 'mu*p*(2 + tanh(v/vs))'", "mirror"),
        ("traction = 'mu*p*sign(v)'", "tangent"),
        ("threshold = 'mu*p*exp(-abs(v))'", "units"),
        ("threshold = 'mu*p*(1 - abs(v)/vs)'", "finite"),
        ("threshold = 'mu*p*(1 + z)'\nstates.z = { rate = '1/dt', unit = '1' }", "refinement"),
    ] {
        let violation = conforms(&*law(&format!("{text}\n{units}"))).expect_err(text);
        assert_eq!(violation.property, property, "{violation}");
    }
    // units that are not declared cannot be checked
    conforms(&*law("threshold = '0.3*p*exp(-abs(v)/vs)'\nparameters = { vs = 0.01 }")).unwrap();
}

#[test]
fn mistakes_are_named_with_their_key() {
    for (text, key, words) in [
        ("", "type", "needs `threshold = \"...\"`"),
        ("threshold = 'p'\ntraction = 'v'", "traction", "exclude each other"),
        ("threshold = 'mu*p'", "threshold", "unknown symbol `mu`; known: T, dt, p, pi, s, v; functions: exp, ln,"),
        ("threshold = 'muu*p'\nparameters.mu = 0.3", "threshold", "did you mean `mu`?"),
        ("threshold = '0.3*p + '", "threshold", "character 9:\n    0.3*p + \n            ^"),
        ("threshold = 'p'\nstates.z = { initial = 0.0 }", "states.z", "missing field `rate`"),
        ("threshold = 'p'\nstates.z = { rate = 'v', inital = 0.0 }", "states.z.inital", "unknown field `inital`"),
        ("threshold = 'p'\nstates.z = { rate = 'v', open = 'close' }", "states.z", "expected `age` or `reset`"),
        ("threshold = 'p'\nstates.z = { rate = 'v*' }", "states.z.rate", "character 3:\n    v*\n      ^"),
        ("threshold = 'p'\nstates.v = { rate = 'v' }", "states.v", "the name `v` is taken"),
        ("threshold = 'p'\nstates = { a = 1, b = 1, c = 1, d = 1, e = 1 }", "states", "5 states; at most 4"),
        ("threshold = 'p'\nparameters.exp = 1", "parameters.exp", "the name `exp` is taken"),
        ("threshold = 'p'\nparameters.mu = 'x'", "parameters.mu", "a number"),
        ("threshold = 'p'\nparameters.mu = nan", "parameters.mu", "NaN is not a finite number"),
        ("threshold = 'p'\nparameters.mu = { value = 1, unit = 'm/s' }", "parameters.mu.unit", "`m/s` is no unit"),
        (
            "threshold = 'p'\nparameters.mu = { over = 'w', at = [0, 1], value = [0, 1] }",
            "parameters.mu.over",
            "none of: p, v, T",
        ),
        (
            "threshold = 'p'\nparameters.mu = { over = 'v', at = [0, 0], value = [0, 1] }",
            "parameters.mu.at",
            "must increase",
        ),
        (
            "threshold = 'p'\nparameters.mu = { over = 'v', at = [0, 1], value = [0] }",
            "parameters.mu.value",
            "1 values for 2",
        ),
        ("threshold = 'p*T'", "threshold", "`T` needs `temperature = ...`"),
        ("threshold = 'p'\nspeed = 1", "speed", "its parameters: threshold, traction, parameters, states, temperature"),
    ] {
        let error = read(text).expect_err(text);
        assert_eq!(error.key(), key, "{error}");
        assert!(error.to_string().contains(words), "`{words}` not in: {error}");
    }
}

#[test]
fn formulas_that_fail_at_rest_are_refused_with_place_and_values() {
    for (text, key, words) in [
        (
            "threshold = '0.3*p/abs(v)'",
            "threshold",
            "the bound on the traction is NaN at p = 0, v = 0, s = 0, dt = 1: `0.3*p/abs(v)` is NaN",
        ),
        (
            "threshold = 'mu*p + 1/v'\nparameters.mu = 1",
            "threshold",
            "`1/v` is inf, character 8:\n    mu*p + 1/v\n           ^^^",
        ),
        ("traction = 'p*sqrt(v)'", "traction", "`sqrt(v)` is 0 with an infinite slope"),
        ("threshold = 'p*v'", "threshold", "the bound on the traction is negative, -1 at p = 1, v = -1"),
        ("threshold = 'p*z'\nstates.z = { rate = 'ln(z)' }", "states.z.rate", "`ln(z)` is -inf, character 1"),
    ] {
        let error = read(text).expect_err(text);
        assert_eq!(error.key(), key, "{error}");
        assert!(error.to_string().contains(words), "`{words}` not in: {error}");
    }
    // what is large only in other units is not refused
    law("threshold = 'p/(1 + exp(abs(v)/1e-4))'");
}

#[test]
fn a_run_that_meets_no_number_is_told_where() {
    let law = law("threshold = 'p*sqrt(1 - z)'\nstates.z = { rate = 'abs(v)' }");
    assert_eq!(law.explain(&InterfacePoint::new(1.0, 0.5, 0.1), &[0.25]), None);
    let why = law.explain(&InterfacePoint::new(2.0, 0.5, 0.25), &[0.75]).unwrap();
    let start = "law `expression`, `threshold`: the bound on the traction is NaN at p = 2, v = 2, s = 0.5, dt = 0.25, z = 1.25: ";
    assert_eq!(why, format!("{start}`sqrt(1 - z)` is NaN, character 3:\n    p*sqrt(1 - z)\n      ^^^^^^^^^^^"));
    // any law has the plain form
    let why = builtin::Coulomb { friction: f64::NAN }.explain(&InterfacePoint::new(2.0, 0.5, 0.25), &[]).unwrap();
    assert_eq!(why, "law `coulomb`: the bound on the traction is NaN at p = 2, v = 2, s = 0.5, dt = 0.25");
    assert_eq!(builtin::Coulomb { friction: 0.3 }.explain(&InterfacePoint::new(2.0, 0.5, 0.25), &[]), None);
}

#[test]
fn units_are_read_as_they_are_printed() {
    for unit in
        [Unit::ONE, Unit::STRESS, Unit::VELOCITY, Unit::STRESS.per(Unit::VELOCITY), Unit::ONE.per(Unit::TEMPERATURE)]
    {
        assert_eq!(unit.to_string().parse(), Ok(unit));
    }
    assert_eq!("length / time".parse(), Ok(Unit::VELOCITY));
    assert_eq!("1/time^2".parse(), Ok(Unit::ONE.per(Unit::TIME).per(Unit::TIME)));
    for text in ["", "length/", "m", "length^x", "length^99", "length**time"] {
        assert!(text.parse::<Unit>().is_err(), "{text}");
    }
}
