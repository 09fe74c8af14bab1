//! Inertia: vibrations, flight, impact, sliding, against closed forms.

#[path = "dynamics/bars.rs"]
mod bars;
#[path = "dynamics/scene.rs"]
mod scene;
