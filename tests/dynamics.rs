//! Inertia: vibrations, flight, impact, sliding, against closed forms.

#[path = "dynamics/bars.rs"]
mod bars;
#[path = "dynamics/flight.rs"]
mod flight;
#[path = "dynamics/impact.rs"]
mod impact;
#[path = "dynamics/slow.rs"]
mod slow;
#[path = "dynamics/scene.rs"]
mod scene;
