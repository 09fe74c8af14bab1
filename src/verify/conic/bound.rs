//! What a friction law lets a site carry: value and slopes of its bound or of its traction.
//!
//! Laws see true stresses. With the boundary stretch `J`, nominal stresses are `J` times as large: `b = J B(p^/J, s)`, hence
//! `db/dp^ = B_p` and `db/ds = J B_s`; likewise for the traction of a direct law.

use asperity_laws::dual::{constant, derivatives};
use asperity_laws::{FrictionLaw, InterfacePoint, Response};

use crate::contact::SiteKinematics;

/// Answer of a law at one site (nominal stresses).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carries {
    /// Set-valued law: bound on `|q^|`, `d/dp^`, `d/d|s|`.
    Bound([f64; 3]),
    /// Direct law: `q^` itself, `d/dp^`, `d/ds`.
    Traction([f64; 3]),
}

/// Asks the law at a closed site under the pressure `p^`.
pub fn carries(law: &dyn FrictionLaw, site: &SiteKinematics, pressure: f64, dt: f64) -> Carries {
    let stretch = site.stretch;
    let at = InterfacePoint { position: site.position, ..InterfacePoint::new(pressure / stretch, site.slip, dt) };
    let mut new = vec![constant(f64::NAN); site.old.len()];
    let response = law.response(&at, &site.old, &mut new);
    let (value, [by_pressure, by_slip]) = derivatives(&response.value());
    let nominal = |by_slip: f64| [stretch * value, by_pressure, stretch * by_slip];
    match response {
        Response::Threshold(_) => Carries::Bound(nominal(if site.slip < 0.0 { -by_slip } else { by_slip })),
        Response::Traction(_) => Carries::Traction(nominal(by_slip)),
    }
}
