//! Friction laws for `asperity`: one trait, the built-in laws, and the kit that checks any law.
//!
//! A law is one file: a struct of parameters, its response, its record. Nothing else has to be edited.
//!
//! ```
//! use asperity_laws::{dual, inventory, *};
//! use serde::{Deserialize, Serialize};
//!
//! /// Static friction that falls to kinetic friction with the speed: `b = [mu_k + (mu_s - mu_k) exp(-|v|/v_s)] p`.
//! #[derive(Debug, Serialize, Deserialize)]
//! #[serde(deny_unknown_fields)]
//! struct Falling { rest: f64, kinetic: f64, speed: f64 }
//!
//! #[typetag::serde(name = "falling")]
//! impl FrictionLaw for Falling {
//!     fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
//!         let decay = (-at.speed() / self.speed).exp();
//!         Response::Threshold(at.pressure * (decay * (self.rest - self.kinetic) + self.kinetic))
//!     }
//! }
//!
//! inventory::submit! { LawInfo {
//!     name: "falling", kind: Kind::SetValued,
//!     equation: "|q| <= [kinetic + (rest - kinetic) exp(-|v|/speed)] p",
//!     parameters: &[
//!         Parameter::new("rest", Unit::ONE, Range::AtLeast(0.0), "coefficient at rest"),
//!         Parameter::new("kinetic", Unit::ONE, Range::AtLeast(0.0), "coefficient at high speed"),
//!         Parameter::new("speed", Unit::VELOCITY, Range::Above(0.0), "decay speed"),
//!     ],
//!     reference: "Oden and Martins, CMAME 52 (1985) 527",
//! } }
//!
//! conforms(&Falling { rest: 0.5, kinetic: 0.3, speed: 0.01 }).unwrap();
//! ```
//!
//! Internal variables are advanced by [`evolve()`] from their rates. Another crate's laws are linked by `use that_crate as _;`.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `p` | true (Cauchy) contact pressure, `>= 0` in compression | stress |
//! | `s` | slip increment over the step, signed | length |
//! | `dt`, `v = s/dt` | time step, slip velocity | time, length/time |
//! | `q` | tangential traction against the slip, `q s >= 0` dissipates | stress |
//! | `b` | bound on `abs(q)`, `>= 0` | stress |
#![warn(missing_docs)]

pub mod builtin;
pub mod check;
pub mod drive;
pub mod dual;
pub mod evolve;
mod explain;
pub mod expression;
pub mod info;
pub mod law;
pub mod registry;

pub use check::conforms;
pub use dual::{Dual, DualNum};
pub use evolve::evolve;
pub use info::{Kind, LawInfo, Parameter, Range, Unit};
pub use inventory;
pub use law::{FrictionLaw, InterfacePoint, Response, Variable};
pub use registry::{LawError, find, kind, linked, parse, schema, validate};
