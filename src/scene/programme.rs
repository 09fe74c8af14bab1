//! Programmes of a probe: what one contact point goes through.

use std::f64::consts::TAU;

use asperity_laws::FrictionLaw;
use asperity_laws::drive::{History, Slider, Step, follow};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::issue::{Issue, KeyPath};

/// What a contact point goes through. Every programme starts at rest, at slip 0, with the law's initial states.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Programme {
    /// Steady sliding at one velocity after another.
    VelocitySteps {
        /// Pressure (stress).
        #[schemars(extend("minimum" = 0))]
        pressure: f64,
        /// Velocities one after another, signed, not zero (length/time).
        #[schemars(length(min = 1))]
        velocity: Vec<f64>,
        /// Distance covered at each velocity (length).
        #[schemars(extend("exclusiveMinimum" = 0))]
        distance: f64,
        /// Steps at each velocity.
        #[serde(default = "steps")]
        #[schemars(range(min = 1, max = 1_000_000))]
        steps: usize,
    },
    /// Sliding that is stopped for some time, again and again.
    SlideHoldSlide {
        /// Pressure (stress).
        #[schemars(extend("minimum" = 0))]
        pressure: f64,
        /// Velocity of sliding (length/time).
        #[schemars(extend("exclusiveMinimum" = 0))]
        velocity: f64,
        /// Distance slid before, between and after the holds (length).
        #[schemars(extend("exclusiveMinimum" = 0))]
        distance: f64,
        /// Durations of the holds (time).
        #[schemars(schema_with = "durations")]
        hold: Vec<f64>,
        /// Steps of each slide and of each hold.
        #[serde(default = "steps")]
        #[schemars(range(min = 1, max = 1_000_000))]
        steps: usize,
    },
    /// Slip `amplitude sin(2 pi t/period)`.
    Harmonic {
        /// Pressure (stress).
        #[schemars(extend("minimum" = 0))]
        pressure: f64,
        /// Amplitude of the slip (length).
        #[schemars(extend("exclusiveMinimum" = 0))]
        amplitude: f64,
        /// Period (time).
        #[schemars(extend("exclusiveMinimum" = 0))]
        period: f64,
        /// Number of periods.
        #[serde(default = "cycles")]
        #[schemars(range(min = 1, max = 10_000))]
        cycles: usize,
        /// Steps of each period.
        #[serde(default = "steps")]
        #[schemars(range(min = 1, max = 1_000_000))]
        steps: usize,
    },
    /// A mass on a spring whose end is pulled; quantities per unit of area.
    SpringSlider {
        /// Pressure (stress).
        #[schemars(extend("minimum" = 0))]
        pressure: f64,
        /// Stiffness of the spring (stress/length).
        #[schemars(extend("exclusiveMinimum" = 0))]
        stiffness: f64,
        /// Mass (stress time^2/length); 0: equilibrium at all times.
        #[serde(default)]
        #[schemars(extend("minimum" = 0))]
        mass: f64,
        /// Velocity at which the end of the spring is pulled (length/time).
        velocity: f64,
        /// Slip velocity at the start (length/time).
        #[serde(default)]
        initial_velocity: f64,
        /// Force of the spring at the start (stress).
        #[serde(default)]
        initial_force: f64,
        /// Duration (time).
        #[schemars(extend("exclusiveMinimum" = 0))]
        duration: f64,
        /// Steps of the whole.
        #[serde(default = "steps")]
        #[schemars(range(min = 1, max = 1_000_000))]
        steps: usize,
    },
}

fn steps() -> usize {
    1000
}

fn cycles() -> usize {
    3
}

fn durations(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let duration = schemars::json_schema!({ "type": "number", "exclusiveMinimum": 0 });
    schemars::json_schema!({ "type": "array", "items": duration, "minItems": 1 })
}

impl Programme {
    /// Its `type`.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::VelocitySteps { .. } => "velocity-steps",
            Self::SlideHoldSlide { .. } => "slide-hold-slide",
            Self::Harmonic { .. } => "harmonic",
            Self::SpringSlider { .. } => "spring-slider",
        }
    }

    /// What the schema cannot say.
    pub(super) fn check(&self, key: &KeyPath) -> Option<Issue> {
        let Self::VelocitySteps { velocity, .. } = self else { return None };
        let zero = velocity.iter().position(|v| *v == 0.0)?;
        let issue = Issue::value(key.at("velocity").at(zero), "the distance is never covered at velocity 0");
        Some(issue.allowed("a number that is not 0").help("the programme `slide-hold-slide` has times of rest"))
    }

    /// Drives a law.
    pub fn run(&self, law: &dyn FrictionLaw) -> History {
        match *self {
            Self::SpringSlider {
                pressure,
                stiffness,
                mass,
                velocity,
                initial_velocity,
                initial_force,
                duration,
                steps,
            } => Slider { mass, stiffness, velocity, pressure, initial_force, initial_velocity, states: None }
                .run(law, duration, steps),
            _ => follow(law, None, &self.path()),
        }
    }

    /// The steps of a programme that prescribes the slip.
    fn path(&self) -> Vec<Step> {
        match *self {
            Self::VelocitySteps { pressure, ref velocity, distance, steps } => {
                velocity.iter().flat_map(|v| uniform(pressure, *v, distance / v.abs(), steps)).collect()
            }
            Self::SlideHoldSlide { pressure, velocity, distance, ref hold, steps } => {
                let slide = || uniform(pressure, velocity, distance / velocity, steps);
                let again = hold.iter().flat_map(|time| uniform(pressure, 0.0, *time, steps).chain(slide()));
                slide().chain(again).collect()
            }
            Self::Harmonic { pressure, amplitude, period, cycles, steps } => {
                let place = |k: usize| amplitude * (TAU * (k % steps) as f64 / steps as f64).sin();
                let step = |k: usize| Step { dt: period / steps as f64, pressure, slip: place(k + 1) - place(k) };
                (0..cycles * steps).map(step).collect()
            }
            Self::SpringSlider { .. } => vec![],
        }
    }
}

fn uniform(pressure: f64, velocity: f64, duration: f64, steps: usize) -> impl Iterator<Item = Step> {
    let dt = duration / steps as f64;
    std::iter::repeat_n(Step { dt, pressure, slip: velocity * dt }, steps)
}
