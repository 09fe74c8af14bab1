//! Made-up histories for tests: two cosine bumps that pass each other.

use crate::model::{ContactStatus, InterfaceRow, Record};

/// Rows with the given force over `t` in `(0, 1]`; everything else follows crudely.
pub fn history(steps: usize, force: impl Fn(f64) -> [f64; 2]) -> Vec<Record> {
    let mut records: Vec<Record> = Vec::with_capacity(steps);
    for step in 1..=steps {
        let time = step as f64 / steps as f64;
        let force = force(time);
        let previous = records.last().map_or(0.0, |record| record.external_work);
        let work = previous + 3.8 / steps as f64 * force[0];
        records.push(row(step, time, force, work));
    }
    records
}

/// A pass at constant height: `Fx` peaks before the apex, `Fy` after it, `Fx` turns negative.
pub fn pass(steps: usize, mu: f64) -> Vec<Record> {
    let mut records = history(steps, |t| force(t, mu));
    for record in &mut records {
        record.contact_angle = angle(record.time);
        let bump = shape(record.time);
        record.strain_energy = 0.012 * bump.powf(1.6) + 2e-6 * (40.0 * record.time).sin();
        record.dissipated = (record.external_work - record.strain_energy) * if mu > 0.0 { 0.999 } else { 0.0 };
    }
    records
}

fn shape(t: f64) -> f64 {
    (1.0 - ((t - 0.5) / 0.21).powi(2)).max(0.0)
}

fn angle(t: f64) -> f64 {
    if shape(t) > 0.0 { 0.62 * (-(t - 0.5) / 0.21 * 1.2).tanh() } else { 0.0 }
}

fn force(t: f64, mu: f64) -> [f64; 2] {
    let (normal, angle) = (0.11 * shape(t).powf(1.5), angle(t));
    let (s, c) = (normal * angle.sin(), normal * angle.cos());
    [s + mu * c, c - mu * s]
}

fn row(step: usize, time: f64, force: [f64; 2], work: f64) -> Record {
    Record {
        step,
        time,
        drive: [3.8 * time, 0.0],
        force,
        mu_global: if force[1] == 0.0 { f64::NAN } else { force[0] / force[1] },
        contact_angle: 0.0,
        contact_length: 0.4,
        pressure_max: 0.3,
        penetration_max: 1e-12,
        strain_energy: 0.5 * work,
        dissipated: 0.5 * work,
        external_work: work,
        newton_iterations: 5,
        cuts: 0,
        converged: true,
        wall_s: 0.1,
        reaction_base: [-force[0], -force[1]],
        fully_slipping: true,
        force_imbalance: 1e-16,
        moment_imbalance: 1e-16,
        weakening: 0.0,
        snaps: 0,
        snap_loss: 0.0,
        ..Record::default()
    }
}

/// Two bumps, one pointing up at `x = 0`, one down at the driven position: heights of both surfaces over `x`.
pub fn surfaces(x: f64, drive: f64) -> [f64; 2] {
    let bump = |x: f64| if x.abs() < 0.95 { 0.2 * (1.0 + (x * std::f64::consts::PI / 0.95).cos()) } else { 0.0 };
    [bump(x), 0.5 - bump(x - drive + 1.9)]
}

/// Sites on the lower edge of the driven body for every row of a history; pressure grows with the overlap.
pub fn interface(records: &[Record], mu: f64) -> Vec<InterfaceRow> {
    records.iter().flat_map(|record| (0..160).map(move |index| site(record, index, mu))).collect()
}

fn site(record: &Record, index: usize, mu: f64) -> InterfaceRow {
    let arc = 2.0 * (f64::from(u32::try_from(index).unwrap()) + 0.5) / 160.0;
    let x = record.drive[0] - 1.9 - 1.0 + arc;
    let middle = |x: f64| surfaces(x, record.drive[0]).iter().sum::<f64>() / 2.0;
    let [lower, upper] = surfaces(x, record.drive[0]);
    let angle = ((middle(x + 1e-4) - middle(x - 1e-4)) / 2e-4).atan();
    let pressure = 0.6 * (lower - upper).max(0.0).powf(0.7);
    let contact = pressure > 0.0;
    InterfaceRow {
        step: record.step,
        pair: 0,
        index,
        x,
        y: if contact { middle(x) } else { upper },
        arc,
        normal: [-angle.sin(), angle.cos()],
        tangent: [angle.cos(), angle.sin()],
        pressure,
        traction: mu * pressure,
        gap: (upper - lower).max(0.0),
        slip: 0.05,
        status: if contact { ContactStatus::Slip } else { ContactStatus::Open },
        weight: 2.0 / 160.0,
        variables: Vec::new(),
    }
}
