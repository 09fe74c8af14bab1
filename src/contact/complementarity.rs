//! One site's semismooth contact and friction conditions.
//!
//! Augmented values, projected (theory 2.3; Alart and Curnier, CMAME 92 (1991) 353):
//!
//! ```text
//! p^ = max(0, p - r_N g)        q^ = clamp(q + r_T (s + e), -b, +b),   b = law(p^, s)       set-valued law
//!                               q^ = law(p^, s)                                             direct law
//! ```
//!
//! At nodal sites the conditions hold where `p^ = p` and `q^ = q`. At quadrature sites `q` is the projection of the `q^`,
//! and a sticking site is held by `s + e = (q^ - q)/r_T`: the deflection `e` accumulates over the steps, `e <- (q^ - q)/r_T`,
//! so that the answer does not depend on how many steps a stick lasts. It is zero at nodal sites.
//!
//! Laws see true (Cauchy) stresses: with the boundary stretch `J`,
//! `b = J law(p^/J, s)`, so `db/dp^ = B_p`, `db/dJ = B - (p^/J) B_p`, `db/ds = J B_s`; for Coulomb's law `db/dJ = 0`.
//! Open sites carry no traction whatever the law says.

use asperity_laws::dual::{constant, derivatives};
use asperity_laws::{FrictionLaw, InterfacePoint, Response};

use super::interface::ContactStatus;

/// A site as the conditions see it.
#[derive(Clone, Copy, Debug)]
pub struct SiteInput<'a> {
    /// Pressure multiplier (nominal).
    pub p: f64,
    /// Traction multiplier (nominal).
    pub q: f64,
    /// Gap.
    pub gap: f64,
    /// Slip increment.
    pub slip: f64,
    /// Augmentation of the pressure (stress/length).
    pub r_normal: f64,
    /// Augmentation of the traction (stress/length).
    pub r_tangential: f64,
    /// Boundary stretch.
    pub stretch: f64,
    /// False where no point of the site has a partner: the site is open.
    pub has_partner: bool,
    /// Deflection at the start of the step.
    pub deflection: f64,
    /// Time step.
    pub dt: f64,
    /// Position, for laws that vary in space.
    pub position: [f64; 2],
    /// Leave out the falling slope of the law, see [`super::Tangent::Lagged`].
    pub lagged: bool,
    /// Internal variables at the start of the step.
    pub old: &'a [f64],
}

/// Projected values and their derivatives.
#[derive(Clone, Debug)]
pub struct SiteAnswer {
    /// Projected pressure `p^` (nominal).
    pub p: f64,
    /// Projected traction `q^` (nominal).
    pub q: f64,
    /// `dp^/dp`; `dp^/dg = -r_N dp^/dp`.
    pub dp_dp: f64,
    /// `dp^/dg`.
    pub dp_dg: f64,
    /// `dq^/dp^`, to be chained with `dp^`.
    pub dq_dp: f64,
    /// `dq^/dq`.
    pub dq_dq: f64,
    /// `dq^/ds`.
    pub dq_ds: f64,
    /// `dq^/dJ`.
    pub dq_dstretch: f64,
    /// `max(0, -dq^/ds)` of the law, also where the tangent is lagged.
    pub weakening: f64,
    /// Open, stick or slip.
    pub status: ContactStatus,
    /// Deflection at the end of the step.
    pub deflection: f64,
    /// Internal variables at the end of the step.
    pub variables: Vec<f64>,
}

/// Evaluates the conditions at one site; `law = None` for a frictionless pair.
pub fn complementarity(law: Option<&dyn FrictionLaw>, site: &SiteInput) -> SiteAnswer {
    let trial = site.p - site.r_normal * site.gap;
    let open = !site.has_partner || trial.is_nan() || trial <= 0.0;
    let mut answer = SiteAnswer {
        p: if open { 0.0 } else { trial },
        q: 0.0,
        dp_dp: if open { 0.0 } else { 1.0 },
        dp_dg: if open { 0.0 } else { -site.r_normal },
        dq_dp: 0.0,
        dq_dq: 0.0,
        dq_ds: 0.0,
        dq_dstretch: 0.0,
        weakening: 0.0,
        status: if open { ContactStatus::Open } else { ContactStatus::Slip },
        deflection: 0.0,
        variables: site.old.to_vec(),
    };
    if let Some(law) = law {
        rub(law, site, &mut answer);
    }
    answer
}

/// Adds the tangential part to an answer whose normal part is known.
fn rub(law: &dyn FrictionLaw, site: &SiteInput, answer: &mut SiteAnswer) {
    if answer.status == ContactStatus::Open {
        let at = InterfacePoint { position: site.position, ..InterfacePoint::new(0.0, 0.0, site.dt) };
        return law.open(&at, site.old, &mut answer.variables);
    }
    let at =
        InterfacePoint { position: site.position, ..InterfacePoint::new(answer.p / site.stretch, site.slip, site.dt) };
    let mut new = vec![constant(f64::NAN); site.old.len()];
    let response = law.response(&at, site.old, &mut new);
    answer.variables.iter_mut().zip(&new).for_each(|(value, dual)| *value = derivatives(dual).0);
    let (value, slopes @ [d_pressure, d_slip]) = derivatives(&response.value());
    let trial = site.q + site.r_tangential * (site.slip + site.deflection);
    match response {
        Response::Threshold(_) if value > 0.0 && trial.abs() <= site.stretch * value => {
            answer.q = trial;
            answer.dq_dq = 1.0;
            answer.dq_ds = site.r_tangential;
            answer.status = ContactStatus::Stick;
        }
        Response::Threshold(_) => {
            let sign = if trial < 0.0 { -1.0 } else { 1.0 };
            set_direct(answer, site, sign * value, [sign * d_pressure, sign * d_slip]);
        }
        Response::Traction(_) => set_direct(answer, site, value, slopes),
    }
    if matches!(response, Response::Threshold(_)) {
        answer.deflection = (answer.q - site.q) / site.r_tangential;
    }
}

/// `q^ = J Q(p^/J, s)` with `Q` and its derivatives given.
fn set_direct(answer: &mut SiteAnswer, site: &SiteInput, value: f64, [d_pressure, d_slip]: [f64; 2]) {
    answer.q = site.stretch * value;
    answer.dq_dp = d_pressure;
    let slope = site.stretch * d_slip;
    answer.dq_ds = if site.lagged { slope.max(0.0) } else { slope };
    answer.weakening = (-slope).max(0.0);
    answer.dq_dstretch = value - answer.p / site.stretch * d_pressure;
}
