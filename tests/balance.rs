//! What must balance at every step (design section 7): forces, moments, reactions, work, complementarity, cone.

mod support;

use asperity::contact::{ContactStatus, Sites};
use asperity::model::{Control, Table};
use asperity::solve::Status;
use support::{Pass, all_choices, climb, done, pass, run};

#[test]
fn frictionless_pass_is_symmetric_and_conservative() {
    for sites in [Sites::Quadrature, Sites::Nodal] {
        let found = done(&Pass { friction: 0.0, element: 0.1, to: 0.6, steps: 24, sites: Some(sites), ..climb() });
        let (records, n) = (&found.records, found.records.len());
        let (mut odd, mut even) = (0.0_f64, 0.0_f64);
        for k in 0..n - 1 {
            let (a, b) = (&records[k], &records[n - 2 - k]);
            odd = odd.max((a.force[0] + b.force[0]).abs() / found.peak(0));
            even = even.max((a.force[1] - b.force[1]).abs() / found.peak(1));
        }
        let net: f64 = records.iter().map(|r| r.force[0]).sum();
        let absolute: f64 = records.iter().map(|r| r.force[0].abs()).sum();
        println!(
            "{sites:?}: Fx odd to {odd:.1e}, Fy even to {even:.1e}, net work {:.1e} of the absolute",
            net.abs() / absolute
        );
        assert!(odd < 1e-6 && even < 1e-6 && net.abs() < 1e-6 * absolute);
        assert!(records[n - 1].strain_energy < 1e-12, "no energy is left: {:e}", records[n - 1].strain_energy);
    }
}

#[test]
fn forces_balance_and_identity_holds_at_every_step() {
    for (sites, projection) in all_choices() {
        let setup =
            Pass { element: 0.1, to: 0.3, steps: 18, sites: Some(sites), projection: Some(projection), ..climb() };
        let (found, mut worst, mut slipping) = (done(&setup), [0.0_f64; 4], 0);
        for r in found.touching() {
            let scale = r.force[0].hypot(r.force[1]);
            let reaction = (r.force[0] - r.reaction_base[0]).hypot(r.force[1] - r.reaction_base[1]) / scale;
            let identity = r.mu_global - (setup.friction.atan() + r.contact_angle).tan();
            let identity = if r.fully_slipping { identity.abs() } else { 0.0 };
            slipping += usize::from(r.fully_slipping);
            let found = [r.force_imbalance, r.moment_imbalance, reaction, identity];
            worst = std::array::from_fn(|k| worst[k].max(found[k]));
        }
        println!(
            "{sites:?} {projection:?}: force {:.1e}, moment {:.1e}, reactions {:.1e}, identity {:.1e} in {slipping} fully slipping steps",
            worst[0], worst[1], worst[2], worst[3]
        );
        assert!(worst[0] <= 1e-13 && worst[1] <= 1e-13 && worst[2] < 1e-8 && worst[3] < 1e-8, "{worst:?}");
        assert!(slipping > 5, "{slipping}");
    }
}

#[test]
fn nodal_sites_are_complementary_in_the_cone_and_dissipate() {
    let mut met = [0; 3];
    for friction in [0.3, 0.8] {
        let mut model = pass(&Pass { friction, element: 0.1, sites: Some(Sites::Nodal), ..climb() });
        // forth to -0.2, then a little back: some sites stick before all slip the other way
        let table = Table { time: vec![0.0, 0.5, 1.0], value: vec![0.0, 0.4, 0.36] };
        let drag = model.motions.iter_mut().find(|m| m.drive && m.component == 0).expect("a drive");
        drag.control = Control::Displacement(table);
        let found = run(model, 16);
        assert_eq!(found.outcome.status, Status::Done);
        let mut worst = [0.0_f64; 3];
        for row in found.rows.iter().flatten().filter(|r| !r.gap.is_nan()) {
            let (p, q, excess) = (row.pressure, row.traction, row.traction.abs() - friction * row.pressure);
            let mismatch = match row.status {
                ContactStatus::Open => p.abs() + q.abs(),
                ContactStatus::Stick => row.slip.abs(),
                ContactStatus::Slip => excess.abs(),
            };
            met[row.status as usize] += 1;
            let found = [(-row.gap).max(p * row.gap.abs()), excess, mismatch];
            worst = std::array::from_fn(|k| worst[k].max(found[k]));
            assert!(p >= 0.0 && q * row.slip >= -1e-12, "{row:?}");
        }
        println!(
            "nodal, mu = {friction}: complementarity {:.1e}, cone {:.1e}, status {:.1e}",
            worst[0], worst[1], worst[2]
        );
        assert!(worst.iter().all(|w| *w < 1e-9), "{worst:?}");
        assert!(found.records.windows(2).all(|w| w[1].dissipated >= w[0].dissipated - 1e-14));
    }
    println!("open, stick, slip met {met:?} times");
    assert!(met.iter().all(|m| *m > 0), "{met:?}");
}
