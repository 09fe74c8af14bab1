//! A point on a spring that is pulled.

use super::{
    Answer, History, Record, ask,
    history::Reached,
    point,
    root::{self, Residual},
};
use crate::{FrictionLaw, Response, dual};

/// A mass `m` (or none) that rubs under a constant pressure, pulled by a spring `k` whose end moves with the velocity `V`:
///
/// ```text
/// m v' = f - q,    f' = k (V - v)            q: traction of the law, f: force of the spring
/// ```
///
/// With the slip `s` of a step as the only unknown both are one equation
///
/// ```text
/// f0 + k V dt/gamma + gamma m v0/dt - (k/gamma + gamma m/dt^2) s = q(s),      v1 = gamma s/dt - (gamma - 1) v0
/// ```
///
/// A mass under a set-valued law takes `gamma = 2`, the midpoint rule: second order as long as the law has no states, and it conserves
/// energy but for `q s`. All else takes `gamma = 1`, backward Euler: first order, and steady where a direct law is so stiff that the
/// midpoint rule would ring. Where several slips balance, the one nearest in the direction of the unbalanced force is taken.
///
/// A set-valued law sticks exactly: `s = 0` as long as `|f| <= b`. With mass the end of sticking and of sliding are found to
/// round-off and end a step, so that stick and slip never share one. States follow the law's own rule, usually of first order.
#[derive(Clone, Debug, PartialEq)]
pub struct Slider {
    /// Mass per area `>= 0` (stress time^2/length).
    pub mass: f64,
    /// Stiffness of the spring per area `> 0` (stress/length).
    pub stiffness: f64,
    /// Velocity `V` of its end (length/time); 0 for a free oscillator.
    pub velocity: f64,
    /// Pressure (stress).
    pub pressure: f64,
    /// Force of the spring at the start (stress).
    pub initial_force: f64,
    /// Slip velocity at the start (length/time); without mass only a first guess.
    pub initial_velocity: f64,
    /// Internal variables of the law at the start; by default its own.
    pub states: Option<Vec<f64>>,
}

/// A slider at the start of a step of length `dt`.
struct Trial<'a> {
    slider: &'a Slider,
    law: &'a dyn FrictionLaw,
    from: &'a Record,
    dt: f64,
    gamma: f64,
}

impl Slider {
    /// Runs for `duration` in `steps` nominal steps.
    pub fn run(&self, law: &dyn FrictionLaw, duration: f64, steps: usize) -> History {
        let start = Record {
            velocity: self.initial_velocity,
            traction: self.initial_force,
            force: self.initial_force,
            ..Record::start(law, self.states.as_deref(), self.pressure)
        };
        let mut history = History::from(start);
        for step in 1..=steps {
            let end = duration * (step as f64 / steps as f64);
            if !history.reach(end, |from, dt| Trial { slider: self, law, from, dt, gamma: 1.0 }.attempt()) {
                break;
            }
        }
        history
    }
}

impl Trial<'_> {
    fn attempt(&self) -> Result<Reached, String> {
        let at_rest = self.ask(0.0)?;
        match at_rest.response {
            Response::Traction(_) => self.creep(),
            Response::Threshold(bound) if self.slider.mass == 0.0 => match self.pull(self.dt).abs() <= bound.re {
                true => self.reached(0.0),
                false => self.slide(self.pull(self.dt).signum()),
            },
            Response::Threshold(_) => Self { gamma: 2.0, ..*self }.glide(),
        }
    }

    /// The same start with another length.
    fn of(&self, dt: f64) -> Self {
        Self { dt, ..*self }
    }

    fn ask(&self, slip: f64) -> Result<Answer, String> {
        ask(self.law, &point(self.slider.pressure, slip, self.dt, self.from.slip), &self.from.states)
    }

    /// Force of the spring after a time without slip.
    fn pull(&self, time: f64) -> f64 {
        self.from.force + self.slider.stiffness * self.slider.velocity * time
    }

    /// `a` and `c` of the balance `a - c s = q`.
    fn balance(&self) -> [f64; 2] {
        let Slider { mass, stiffness, .. } = *self.slider;
        let inertia = self.gamma * mass / self.dt;
        [self.pull(self.dt / self.gamma) + inertia * self.from.velocity, stiffness / self.gamma + inertia / self.dt]
    }

    /// What is left of the balance, for a set-valued law that slips in the direction `sign`.
    fn residual(&self, slip: f64, sign: f64) -> Result<Residual, String> {
        let [force, stiffness] = self.balance();
        let (traction, [_, slope]) = match self.ask(slip)?.response {
            Response::Traction(traction) => dual::derivatives(&traction),
            Response::Threshold(bound) => dual::derivatives(&(bound * sign)),
        };
        let scale = force.abs() + (stiffness * slip).abs() + traction.abs();
        Ok(Residual { value: force - stiffness * slip - traction, slope: -stiffness - slope, scale })
    }

    /// A direct law: from the slip of unchanged velocity, or from rest where there is no inertia, along the unbalanced force.
    fn creep(&self) -> Result<Reached, String> {
        let going = self.from.velocity * self.dt;
        let start = if self.slider.mass > 0.0 { going } else { 0.0 };
        let residual = |slip: f64| self.residual(slip, 1.0);
        let first = residual(start)?;
        if first.value == 0.0 {
            return self.reached(start);
        }
        let ends = root::bracket(residual, start, first.value / self.balance()[1])?;
        let ends = ends.ok_or_else(|| format!("no slip balances the spring in a step of {:e}", self.dt))?;
        self.reached(root::solve(residual, ends, going)?)
    }

    /// A mass under a set-valued law.
    fn glide(&self) -> Result<Reached, String> {
        if self.from.velocity == 0.0 { self.stick() } else { self.slide(self.from.velocity.signum()) }
    }

    /// A mass at rest under a set-valued law: sticks to the end of the step, or until the spring overcomes the bound, or starts to slide.
    fn stick(&self) -> Result<Reached, String> {
        let holds = |dt: f64| {
            let bound = self.of(dt).ask(0.0)?.response.value().re;
            Ok::<bool, String>(self.pull(dt).abs() <= bound)
        };
        if holds(self.dt)? {
            return self.reached(0.0);
        }
        let soon = self.dt * f64::EPSILON;
        if holds(soon)? {
            return self.of(root::event(self.dt, holds)?).reached(0.0);
        }
        self.slide(self.pull(0.5 * self.dt).signum())
    }

    /// A set-valued law that slips in the direction `sign`, until the end of the step or until the mass comes to rest.
    fn slide(&self, sign: f64) -> Result<Reached, String> {
        let goes_on =
            |trial: &Self| Ok::<bool, String>(trial.residual(trial.slip_to_rest(), sign)?.value * sign >= 0.0);
        if goes_on(self)? {
            let [force, stiffness] = self.balance();
            let ends = [self.slip_to_rest(), force / stiffness];
            return self.reached(root::solve(|slip| self.residual(slip, sign), ends, self.from.velocity * self.dt)?);
        }
        if self.slip_to_rest() == 0.0 {
            return self.reached(0.0); // pulled back before it starts
        }
        let stop = self.of(root::event(self.dt, |dt| goes_on(&self.of(dt)))?);
        stop.reached(stop.slip_to_rest())
    }

    /// Slip after which the velocity at the end of the step is zero.
    fn slip_to_rest(&self) -> f64 {
        (1.0 - 1.0 / self.gamma) * self.from.velocity * self.dt
    }

    fn reached(&self, slip: f64) -> Result<Reached, String> {
        let Slider { stiffness, velocity, pressure, .. } = *self.slider;
        let (from, dt) = (self.from, self.dt);
        let answer = self.ask(slip)?;
        let force = from.force + stiffness * (velocity * dt - slip);
        let traction = match answer.response {
            Response::Traction(traction) => traction.re,
            Response::Threshold(bound) if slip == 0.0 => force.clamp(-bound.re, bound.re),
            Response::Threshold(bound) => bound.re.copysign(slip),
        };
        let stops = slip == self.slip_to_rest(); // exactly, whatever the round-off
        let velocity = if stops { 0.0 } else { self.gamma * slip / dt - (self.gamma - 1.0) * from.velocity };
        let record = Record {
            time: from.time + dt,
            slip: from.slip + slip,
            velocity,
            pressure,
            traction,
            force,
            work: from.work + traction * slip,
            slipping: slip != 0.0,
            states: answer.states,
        };
        let at = point(pressure, slip, dt, from.slip);
        Ok(Reached { record, dt, largest: self.law.suggested_step(&at, &from.states) })
    }
}
