//! The two-asperity problem under laws of every kind, to the end; laws that reduce to Coulomb's give its forces.

mod support;

use asperity::laws::{self, FrictionLaw};
use asperity::math::CondensedSolver;
use asperity::solve::{Status, Strategy, solve_step};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use support::{Pass, Run, climb, done, pass, run};

fn law(table: &str) -> Arc<dyn FrictionLaw> {
    Arc::from(laws::parse(table.parse().expect("TOML")).expect(table))
}

/// Parameters at which each law matters at the sliding speed of 3.8 and a sliding length of about 1.
const LAWS: [(&str, &str); 10] = [
    ("coulomb", "type='coulomb'\nfriction=0.3"),
    ("stribeck", "type='stribeck'\nstatic_friction=0.3\nkinetic_friction=0.2\nspeed=8.0\nexponent=2.0\nviscous=0.01"),
    ("weakening", "type='stribeck'\nstatic_friction=0.3\nkinetic_friction=0.1\nspeed=0.5\nexponent=1.0"),
    ("lugre", "type='lugre'\nrest=0.4\nkinetic=0.2\nspeed=8.0\nstiffness=4.0\ndamping=0.01\nviscosity=0.01"),
    ("dahl", "type='dahl'\nfriction=0.3\nstiffness=0.3"),
    ("elasto-plastic", "type='elasto-plastic'\nrest=0.3\nkinetic=0.3\nspeed=8.0\nelastic=0.7\nstiffness=2.0"),
    (
        "rate-and-state",
        "type='rate-and-state'\nfriction=0.3\ndirect_effect=0.03\nevolution_effect=0.04\ndistance=0.2\nspeed=1.0",
    ),
    (
        "slip law",
        "type='rate-and-state'\nfriction=0.3\ndirect_effect=0.03\nevolution_effect=0.02\ndistance=0.2\nspeed=1.0\nevolution='slip'",
    ),
    (
        "ostermeyer",
        "type='ostermeyer'\nalpha=5.0\nbeta=0.2\ngamma=0.001\ndelta=5.0\nzeta=100.0\nambient=60.0\ninitial_friction=0.3",
    ),
    ("heated", "type='heated'\nfriction=0.3\nrange=1.0\ncapacity=0.05\nambient=0.0\nform='exponential'"),
];

/// Order `ln r[k+1] / ln r[k]` of the last iteration over some steps in contact, repeated from their start: smallest, median.
fn orders(found: &Run) -> [f64; 2] {
    let length = |k: usize| found.records[k].contact_length;
    let longest = (0..found.records.len()).map(length).fold(0.0, f64::max);
    let steps = (1..found.records.len()).filter(|k| length(*k) > 0.5 * longest).step_by(3);
    let mut orders: Vec<f64> = steps
        .map(|k| {
            let (mut solver, quiet, mut count) = (CondensedSolver::default(), AtomicBool::new(false), 0);
            let (start, time) = (&found.states[k - 1], found.states[k].time);
            let step = solve_step(&found.model, start, time, Strategy::default(), &mut solver, &quiet, &mut count)
                .expect("converges again");
            let r: Vec<f64> = step.residuals.iter().map(|v| v / step.evaluation.force_scale).collect();
            match r[..] {
                [.., before, last] => last.max(1e-13).ln() / before.ln(),
                _ => f64::INFINITY,
            }
        })
        .collect();
    orders.sort_by(f64::total_cmp);
    [orders[0], orders[orders.len() / 2]]
}

#[test]
fn passes_under_every_kind_of_law_reach_the_end() {
    let coulomb = done(&Pass::default());
    for (name, table) in LAWS {
        let setup = Pass { law: Some(law(table)), ..Pass::default() };
        let found = run(pass(&setup), setup.steps);
        assert_eq!(found.outcome.status, Status::Done, "{name}");
        let touching: Vec<_> = found.touching().collect();
        let iterations: usize = touching.iter().map(|r| r.newton_iterations).sum();
        let mean = iterations as f64 / touching.len() as f64;
        let (order, shift) = (orders(&found), (found.peak(0) / coulomb.peak(0) - 1.0).abs());
        println!(
            "{name:15} {mean:.2} iterations per contact step, {} cuts, last order {order:.2?}, peak Fx {:.4} ({shift:.2} off Coulomb)",
            found.outcome.cuts,
            found.peak(0)
        );
        assert!(found.outcome.cuts == 0 && found.outcome.lagged == 0, "{name}");
        assert!(mean < 5.0, "{name}");
        assert!(order[0] > 1.4 && order[1] > 1.7, "{name}: {order:?}");
        assert!(shift > 0.02 || name == "coulomb", "{name}: the law matters");
        let states = setup.law.expect("a law").variables().len();
        assert!(found.rows.iter().flatten().all(|row| row.variables.len() == states));
        assert!(found.rows.iter().flatten().flat_map(|row| &row.variables).all(|v| v.is_finite()), "{name}");
    }
}

/// `Fx` over a climb into contact.
fn forces(law: Arc<dyn FrictionLaw>) -> Vec<f64> {
    let found = done(&Pass { law: Some(law), ..climb() });
    found.records.iter().map(|r| r.force[0]).collect()
}

/// Largest difference relative to the largest value.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let largest = b.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest
}

#[test]
fn laws_that_reduce_to_coulomb_give_its_forces() {
    let coulomb = forces(law("type='coulomb'\nfriction=0.3"));
    let all: toml::Table = include_str!("../laws/tests/reductions.toml").parse().expect("TOML");
    let exact = all["coulomb"].as_array().expect("laws").iter().map(|table| table.to_string());
    let with_states = [
        "type='ostermeyer'\nalpha=0\nbeta=1\ngamma=0\ndelta=0\nzeta=0\nambient=0\ninitial_friction=0.3",
        "type='heated'\nfriction=0.3\nlimit=0.3\nrange=1.0\ncapacity=1.0\nambient=0.0",
        "type='expression'\nthreshold='0.3*p'",
        "type='persson'\nstrength=9.820171823688425e149\npeak_speed=0.01\ncurvature=0.0\nfloor_speed=1e-6\nsaturation_pressure=3.273390607896142e150",
    ];
    let inline = |table: String| format!("law = {table}").parse::<toml::Table>().expect("TOML")["law"].clone();
    let exact = exact.map(|table| inline(table).as_table().expect("a table").to_string());
    for table in exact.chain(with_states.map(str::to_owned)) {
        let difference = apart(&forces(law(&table)), &coulomb);
        assert!(difference < 1e-8, "{table}: {difference:.1e}");
    }
}

#[test]
fn regularised_laws_tend_to_coulomb_at_their_rates() {
    let coulomb = forces(law("type='coulomb'\nfriction=0.3"));
    // (law with its parameter left open, values, least order of the error in the parameter)
    let open = [
        ("type='dahl'\nfriction=0.3\nexponent=0\nstiffness=", [1e1, 1e2, 1e3]),
        ("type='lugre'\nrest=0.3\nkinetic=0.3\nspeed=1.0\nstiffness=", [1e3, 1e4, 1e5]),
        ("type='elasto-plastic'\nrest=0.3\nkinetic=0.3\nspeed=1.0\nelastic=0.7\nstiffness=", [1e3, 1e4, 1e5]),
        ("type='regularised'\nfriction=0.3\nshape='atan'\nspeed=", [1e-2, 1e-3, 1e-4]),
        ("type='regularised'\nfriction=0.3\nspeed=", [1e-1, 1e-2, 1e-3]),
        (
            "type='rate-and-state'\nfriction=0.3\nevolution_effect=0.0\ndistance=1.0\nspeed=1.0\ndirect_effect=",
            [2e-2, 4e-3, 1e-3],
        ),
        (
            "type='bengisu-akay'\nstatic_friction=0.3\nkinetic_friction=0.3\ndecay_speed=1.0\nrise_speed=",
            [1e-1, 1e-2, 1e-3],
        ),
    ];
    for (table, values) in open {
        let errors = values.map(|value| apart(&forces(law(&format!("{table}{value:?}"))), &coulomb));
        println!("{}: {errors:?}", table.replace('\n', ", "));
        assert!(errors[2] < 0.3 * errors[1] || errors[2] < 1e-8, "{table}: {errors:?}");
        assert!(errors[2] < 1e-2, "{table}: {errors:?}");
    }
}

/// Coulomb's law that wants short steps while it rubs.
#[derive(Debug, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Impatient {
    step: f64,
}

#[typetag::serde(name = "test-impatient")]
impl FrictionLaw for Impatient {
    fn response(&self, at: &laws::InterfacePoint, _: &[f64], _: &mut [laws::Dual]) -> laws::Response {
        laws::Response::Threshold(at.pressure * 0.3)
    }

    fn suggested_step(&self, _: &laws::InterfacePoint, _: &[f64]) -> Option<f64> {
        Some(self.step)
    }
}

#[test]
fn a_law_may_ask_for_shorter_steps() {
    let nominal = 1.0 / climb().steps as f64;
    let under = |step: f64| run(pass(&Pass { law: Some(Arc::new(Impatient { step })), ..climb() }), climb().steps);
    let free = under(nominal);
    assert_eq!((free.outcome.cuts, free.outcome.steps), (0, climb().steps), "a step as long as asked for is accepted");
    let found = under(0.26 * nominal);
    let touching = found.records.iter().filter(|r| r.contact_length > 0.0).count();
    assert_eq!(found.outcome.status, Status::Done);
    // once as the tip touches, once more if the first short step ends before that
    assert!(found.outcome.cuts <= 2, "the steps after a veto are short at once: {}", found.outcome.cuts);
    assert!(found.outcome.steps >= 3 * touching + (climb().steps - touching), "{} steps", found.outcome.steps);
    let Status::NotConverged { reason, .. } = under(1e-9 * nominal).outcome.status else { panic!("too short") };
    assert!(reason.contains("the friction law asks for steps of 1.250e-10"), "{reason}");
}
