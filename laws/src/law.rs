//! The trait of all friction laws, what a law is told and what it answers.

use crate::{
    dual::{self, Dual},
    explain::explain,
    info::{Kind, Unit},
    registry::LawError,
};
use std::{borrow::Cow, fmt::Debug};

/// A friction law at one contact point. Immutable: whatever it remembers is in its internal variables, which the engine owns.
///
/// A law is a serialisable struct of parameters (`#[serde(deny_unknown_fields)]`), this trait, and one [`crate::LawInfo`] submitted beside it.
/// [`crate::conforms`] checks all that is said here. `typetag_name()` is the `type` of the law in a scene.
#[typetag::serde(tag = "type")]
pub trait FrictionLaw: Debug + Send + Sync {
    /// The internal variables, in the order of `old` and `new`.
    fn variables(&self) -> Vec<Variable> {
        Vec::new()
    }

    /// What the interface carries at the end of the step.
    ///
    /// `old` holds the internal variables at the start of the step; the law writes every entry of `new`, their values at the end, and never reads it.
    /// Must be a pure function of the arguments, finite for every pressure `>= 0`, slip and `dt > 0`. NaN means that no answer was
    /// found (see [`crate::evolve()`]): the engine then cuts the step.
    fn response(&self, at: &InterfacePoint, old: &[f64], new: &mut [Dual]) -> Response;

    /// Advances the internal variables over a step at whose end the point is open. By default the point ages on with `response` at no
    /// pressure and no slip; a law whose variable is a deflection of touching bristles sets it back here.
    /// `at` has pressure and slip zero. Writes every entry of `new`.
    fn open(&self, at: &InterfacePoint, old: &[f64], new: &mut [f64]) {
        let mut duals = vec![dual::constant(f64::NAN); new.len()];
        self.response(at, old, &mut duals);
        new.iter_mut().zip(&duals).for_each(|(value, dual)| *value = dual.re);
    }

    /// Conditions among several parameters; single ranges are declared in [`crate::LawInfo`] and checked by [`crate::validate`].
    ///
    /// # Errors
    /// Names the offending parameter ([`LawError::Invalid`]).
    fn validate(&self) -> Result<(), LawError> {
        Ok(())
    }

    /// Largest time step that this law accepts at a converged point (`old` as in `response`). Below `at.dt`: the step is
    /// thrown away and repeated with at most this size; else a bound for the next step. `None`: no opinion.
    fn suggested_step(&self, at: &InterfacePoint, old: &[f64]) -> Option<f64> {
        let _ = (at, old);
        None
    }

    /// What is not finite, or negative where it may not be, in the answer at this point, and at which values: the message for a run that
    /// ends there. `None` where the answer is sound.
    fn explain(&self, at: &InterfacePoint, old: &[f64]) -> Option<String> {
        let mut new = vec![dual::constant(f64::NAN); old.len()];
        let response = self.response(at, old, &mut new);
        explain(self.typetag_name(), &self.variables(), at, old, &response, &new)
    }

    /// Units of the numbers in the table of the law by dotted key (`parameters.vs.value`), for a law whose record cannot know them;
    /// an entry without one leaves the unit check of the conformance kit out. `None`: as in [`crate::LawInfo`].
    fn units(&self) -> Option<Vec<(String, Option<Unit>)>> {
        None
    }

    /// True if the answer is `Threshold(0)` at every point for ever: the engine then models no tangential unknowns at all.
    fn frictionless(&self) -> bool {
        false
    }
}

/// Answer of a law. Tractions are true (Cauchy) ones, positive against the slip, so `q s >= 0` is dissipated.
#[derive(Clone, Copy, Debug)]
pub enum Response {
    /// Set-valued law: bound `b >= 0` on `|q|`; sticks below, slips at the bound. Even in the slip. Only asked for a touching
    /// point; a bound that does not vanish with the pressure (cohesion) acts while the contact is closed.
    Threshold(Dual),
    /// Direct law: the traction `q` itself, odd in the slip (together with the state).
    Traction(Dual),
}

impl Response {
    /// The bound or the traction.
    pub fn value(&self) -> Dual {
        match self {
            Self::Threshold(x) | Self::Traction(x) => *x,
        }
    }

    /// Which of the two it is.
    pub fn kind(&self) -> Kind {
        match self {
            Self::Threshold(_) => Kind::SetValued,
            Self::Traction(_) => Kind::Direct,
        }
    }
}

/// One internal variable of a law.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Column name in the output.
    pub name: Cow<'static, str>,
    /// Physical dimension.
    pub unit: Unit,
    /// Value before the first contact.
    pub initial: f64,
}

impl Variable {
    /// A variable with its name, dimension and value before the first contact.
    pub fn new(name: impl Into<Cow<'static, str>>, unit: Unit, initial: f64) -> Self {
        Self { name: name.into(), unit, initial }
    }
}

/// What a law is told about one contact point and one step.
#[derive(Clone, Copy, Debug)]
pub struct InterfacePoint {
    /// True (Cauchy) contact pressure at the end of the step, `>= 0`.
    pub pressure: Dual,
    /// Slip increment over the step along the tangent, signed (length).
    pub slip: Dual,
    /// Length of the step, `> 0`.
    pub dt: f64,
    /// Current place of the point.
    pub position: [f64; 2],
    /// Temperature where the scene has one.
    pub temperature: Option<f64>,
}

impl InterfacePoint {
    /// A point at the origin without temperature; pressure and slip are the independent variables of the derivatives.
    pub fn new(pressure: f64, slip: f64, dt: f64) -> Self {
        Self {
            pressure: dual::pressure_dual(pressure),
            slip: dual::slip_dual(slip),
            dt,
            position: [0.0; 2],
            temperature: None,
        }
    }

    /// Mean slip velocity of the step, `slip / dt`, signed.
    pub fn velocity(&self) -> Dual {
        self.slip / self.dt
    }

    /// Magnitude of [`Self::velocity`]; derivative 0 at rest.
    pub fn speed(&self) -> Dual {
        dual::abs(self.velocity())
    }
}
