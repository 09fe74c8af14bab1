//! Contact: projection, mortar integration, complementarity, and what the model sees of an interface.

mod assembly;
mod complementarity;
mod integration;
mod interface;
mod kinematics;
mod loaded;
mod mortar;
mod outline;
mod point;
mod projection;
mod sites;
mod slip;
mod start;

pub use complementarity::{SiteAnswer, SiteInput, complementarity};
pub use interface::{
    Configuration, ContactDiscretization, ContactStatus, Integration, InterfaceForces, InterfaceStart, InterfaceTrial,
    Numerics, Projection, SiteMemory, SiteRecord, Sites, Tangent,
};
pub use kinematics::{Frame, Orientation, SLOTS, SlotMatrix, Slots};
pub use loaded::{LoadedInterface, SiteKinematics, SiteLoad, SiteRow};
pub use mortar::Mortar;
pub use projection::{Partner, Seeker, Target};
