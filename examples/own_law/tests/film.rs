//! The kit that the built-in laws pass, and one closed form.

use asperity_laws::{FrictionLaw, InterfacePoint, conforms, dual::constant};
use own_law::Film;

const FILM: Film = Film { coated: 0.1, bare: 0.4, recovery: 0.5, wear: 0.2 };

#[test]
fn conforms_to_what_the_engine_expects() {
    conforms(&FILM).unwrap();
}

#[test]
fn steady_sliding_leaves_the_steady_film() {
    let (mut state, mut new) = ([1.0], [constant(0.0)]);
    let speed = 0.8;
    for _ in 0..10_000 {
        FILM.response(&InterfacePoint::new(1.0, speed * 0.01, 0.01), &state, &mut new);
        state = [new[0].re];
    }
    assert!((state[0] - 1.0 / (1.0 + FILM.recovery * speed / FILM.wear)).abs() < 1e-12);
}
