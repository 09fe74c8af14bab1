//! Independent checks of converged states.
