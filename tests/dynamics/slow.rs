//! Slow motions: inertia fades, and the quasi-static result is left.
