//! `asperity`: large-deformation frictional contact of soft asperities in plane strain.
//!
//! NURBS or Lagrange bodies, mortar contact, a semismooth augmented-Lagrangian Newton method and friction laws as
//! plug-ins, after Ostermeyer, Tong and Mueller, *Tribology International* 2021, DOI 10.1016/j.triboint.2021.106889.
//!
//! One direction: `Scene -> Model + State(n) -> step -> State(n+1) -> Record`.
//!
//! # Symbols
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `x`, `y(xi)` | nonmortar point, mortar curve | length |
//! | `g` | gap, `>= 0` open | length |
//! | `p` | contact pressure, `>= 0` in compression | stress |
//! | `s` | slip increment over the step along the mortar tangent | length |
//! | `q` | tangential traction, against the slip: `q s >= 0` | stress |
//! | `n`, `t` | outward normal and unit tangent of the mortar curve | - |
//! | `r_N`, `r_T` | augmentation, about `E/h` | stress/length |
//! | `w_a`, `M_aA` | weight of site `a`, multiplier basis at the site | length, - |
//! | `Fx`, `Fy` | resistance and support felt by the driven body, per unit depth | stress * length |
//!
//! The rooms below are listed in import order: each imports only rooms above it.

pub mod math;
pub mod geometry;
pub mod bulk;
pub mod contact;
pub mod model;
pub mod solve;
pub mod verify;
pub mod output;
pub mod scene;
pub mod study;
pub mod cli;

pub use asperity_laws as laws;
