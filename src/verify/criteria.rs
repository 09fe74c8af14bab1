//! What the audits of a run accept, and what it means where they do not.

use super::finding::{Criterion, Severity};

use Severity::{Failure, Warning};

/// Sums of a few thousand terms: round-off 1e-16 each, 1e-13 expected.
pub const INTERFACE_FORCE: Criterion = Criterion {
    name: "interface_force",
    tolerance: 1e-10,
    severity: Failure,
    meaning: "resultant of all contact forces over the sum of their magnitudes; more than round-off means that action is \
              not reaction",
};
/// As for the force.
pub const INTERFACE_MOMENT: Criterion = Criterion {
    name: "interface_moment",
    tolerance: 1e-10,
    severity: Failure,
    meaning: "moment of all contact forces over the sum of their magnitudes; more than round-off means that contact \
              forces turn the bodies",
};
/// The solver accepts 1e-9 of the largest nodal force at every control point; hundreds of them add up.
pub const DRIVEN_REACTION: Criterion = Criterion {
    name: "driven_reaction",
    tolerance: 1e-6,
    severity: Failure,
    meaning: "force on the driven body less the reaction of all others, over the peak force; more means that the bodies \
              are not in equilibrium",
};
/// Same origin as for the reaction.
pub const FRICTION_IDENTITY: Criterion = Criterion {
    name: "friction_identity",
    tolerance: 1e-6,
    severity: Failure,
    meaning: "atan(mu_global) - contact_angle less atan(mu) at fully slipping steps, times the force over the peak force; \
              more means that the friction forces are not those of the law",
};
/// Friction work of a step is a sum of non-negative terms.
pub const DISSIPATION: Criterion = Criterion {
    name: "dissipation",
    tolerance: 1e-9,
    severity: Failure,
    meaning: "decrease of the dissipated work in a step over the largest energy; more means that friction drives the slip",
};
/// An error of the time steps: the two-asperity problem (mu = 0.3) shows 9.7 % with steps of two elements, 2.9 % with one,
/// 0.8 % with half an element.
pub const ENERGY_BALANCE: Criterion = Criterion {
    name: "energy_balance",
    tolerance: 0.02,
    severity: Warning,
    meaning: "external work less stored and dissipated energy (what bodies start with set aside), over the largest \
              energy; more means that the time steps are \
              too long for the energies, or that a sudden slip released energy: take more `time.steps`",
};
/// What the bound on the error of time stepping leaves out: rules of laws with memory, forces that turn within a step.
pub const ENERGY_CREATED: Criterion = Criterion {
    name: "energy_created",
    tolerance: 0.05,
    severity: Failure,
    meaning: "stored and dissipated energy beyond the external work and beyond what the time steps can explain, over the \
              largest energy; more means that energy comes from nowhere",
};
/// Quadrature sites at `r = E/h` overlap by about `p h/E`.
pub const PENETRATION: Criterion = Criterion {
    name: "penetration",
    tolerance: 0.2,
    severity: Warning,
    meaning: "largest penetration over the shortest contact element; more means that the contact is too coarse for its \
              pressure: take more elements along the contact edges",
};
/// A contact that ends by itself has hardly any force left in the step before.
pub const CONTACT_LOST: Criterion = Criterion {
    name: "contact_lost",
    tolerance: 0.2,
    severity: Warning,
    meaning: "force, over the peak force, of a contact that vanished in the next step although it was driven against; more \
              means that the bodies may have passed through each other or slid off an edge: take more `time.steps`",
};
/// Far enough from 1 that the second digit of the estimate does not matter.
pub const RATE_WEAKENING: Criterion = Criterion {
    name: "rate_weakening",
    tolerance: 0.5,
    severity: Warning,
    meaning: "share of the bodies' tangential stiffness that friction takes away by falling with the slip rate; near 1 the               slip jumps, beyond it the quasi-static problem has several solutions, and smaller steps make it worse: drive               slower, take longer steps, or a law with direct effect",
};
/// Any snap is worth a word; below this it is an error of the time steps.
pub const SNAP: Criterion = Criterion {
    name: "snap",
    tolerance: 1e-3,
    severity: Warning,
    meaning: "energy set free in a step in which the equilibrium path ended and the bodies snapped to another equilibrium, \
              over the largest energy; the run went on behind it, the column snap_loss tells how much was lost in all. A real \
              effect of soft, steep asperities; without inertia the equilibrium behind need not be the one that a fast \
              motion reaches",
};
/// What a user who asked for inertia would want to know of.
pub const NUMERICAL_LOSS: Criterion = Criterion {
    name: "numerical_loss",
    tolerance: 0.05,
    severity: Warning,
    meaning: "energy that the time integration of inertia took away, over the largest energy; more means that motions which \
              matter are too fast for the steps: take more `time.steps`, or a `dynamics.spectral_radius` nearer to 1",
};
/// A regularisation that takes more is a part of the model.
pub const VISCOSITY: Criterion = Criterion {
    name: "viscosity",
    tolerance: 0.02,
    severity: Warning,
    meaning: "work of the viscous stresses over the largest energy; more means that `solution.viscosity` changes the result \
              (or that it took the place of a snap: then this share tends to what the snap sets free, not to 0, as it falls)",
};
