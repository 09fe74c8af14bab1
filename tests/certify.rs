//! The conic method against the Newton method: same solutions from the same starts, planted errors found, non-uniqueness told.

#[path = "certify/oracle.rs"]
mod oracle;
#[path = "certify/planted.rs"]
mod planted;
#[path = "certify/random.rs"]
mod random;
#[path = "certify/rescue.rs"]
mod rescue;
#[path = "certify/scenes.rs"]
mod scenes;
mod support;
