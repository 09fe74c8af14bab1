//! Why a step was not made.

use crate::math::SolveError;

/// Why a step was thrown away.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StepFailure {
    /// No convergence.
    #[error(
        "Newton's method did not converge in {iterations} iterations (residual {residual:.1e} of the largest nodal force{}){hint}",
        cycling(cycle)
    )]
    Iterations {
        /// Linear solves.
        iterations: usize,
        /// Last residual over the largest nodal force.
        residual: f64,
        /// Period with which the sets of open, sticking and slipping sites came round, where they did.
        cycle: Option<usize>,
        /// What the last iterate suggests, starting with a separator; may be empty.
        hint: String,
    },
    /// A body was turned inside out and no shorter step helped.
    #[error("a body is turned inside out (det F <= 0) in iteration {0}")]
    Inverted(usize),
    /// The linear system could not be solved.
    #[error("{0}")]
    Linear(#[from] SolveError),
    /// A friction law gave no number.
    #[error("a friction law gives no number {0}")]
    Law(String),
    /// Converged, but too long for the friction law, or for viscosity.
    #[error(
        "{by} asks for steps of {step:.3e}, the step taken was {taken:.3e}: its time scale is finer than the steps"
    )]
    Vetoed {
        /// Step that converged.
        taken: f64,
        /// Longest step that it accepts.
        step: f64,
        /// Who asks.
        by: &'static str,
    },
    /// Converged to an equilibrium that is not stable: friction takes away this many times the tangential stiffness.
    #[error("found an equilibrium that is not stable (friction takes {0:.2} times the tangential stiffness)")]
    Unstable(f64),
    /// Converged, but over a snap: see `solve::release`.
    #[error("leapt to another equilibrium path: sets free {0:.3e}, more than the work of the step can explain")]
    Leapt(f64),
    /// Converged, but with contact at another flank: see `solve::release`.
    #[error("{sites} contact sites, the first at ({x:.4}, {y:.4}), left their flank for another one")]
    Jumped {
        /// How many.
        sites: usize,
        /// Where the first is now.
        x: f64,
        /// Where the first is now.
        y: f64,
    },
    /// A motion under drag that found no equilibrium, see `solve::crossing`.
    #[error("moved on under drag the bodies do not come to rest")]
    Restless,
    /// Stopped from outside.
    #[error("interrupted")]
    Interrupted,
}

impl StepFailure {
    /// True where Newton's method found no equilibrium.
    pub fn lost(&self) -> bool {
        matches!(self, Self::Iterations { .. } | Self::Inverted(_) | Self::Linear(_))
    }
}

fn cycling(cycle: &Option<usize>) -> String {
    cycle.map_or(String::new(), |period| format!(", contact states repeat every {period} iterations"))
}
