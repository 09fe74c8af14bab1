//! What the records of a model can be held to.

use asperity_laws::{FrictionLaw, Kind, kind};
use serde::{Deserialize, Serialize};

use crate::model::{Control, Model, Pair};

/// Forces below this share of `E` times the size of the model are round-off of the solver (which accepts residuals of
/// 1e-14 of it, and audits ask for 1e-6 of the peak force).
const NEGLIGIBLE: f64 = 1e-8;

/// Properties of a model that audits depend on.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Expectations {
    /// The coefficient, where all contacts touch the driven body from the same side and share one constant coefficient
    /// of Coulomb friction (0 for frictionless contact): `mu_global` then follows from the contact angle.
    pub friction: Option<f64>,
    /// True where friction of every law is lost work: set-valued laws, and direct laws without memory.
    pub dissipative: bool,
    /// True where all work is done by the motion that records report: steps then bound the error of the work.
    pub single_drive: bool,
    /// True where inertia is modelled.
    pub inertia: bool,
    /// True where bodies are viscous.
    pub viscosity: bool,
    /// Shortest contact element.
    pub element_size: f64,
    /// Force per depth below which forces are not told from zero.
    pub negligible_force: f64,
}

impl Expectations {
    /// Reads them off a model.
    pub fn of(model: &Model) -> Self {
        Self {
            friction: if one_sided(model) { shared_friction(&model.pairs) } else { None },
            dissipative: model.pairs.iter().all(|pair| pair.contact.law().is_none_or(|law| dissipates(&**law))),
            single_drive: single_drive(model),
            inertia: model.inertia.is_some(),
            viscosity: model.viscosity.is_some(),
            element_size: model.element_size,
            negligible_force: NEGLIGIBLE * model.modulus * model.size(),
        }
    }
}

/// True where the driven body is the same side of all pairs: slip of one sign is then slip in one direction.
fn one_sided(model: &Model) -> bool {
    let on = |side: fn(&Pair) -> usize| model.pairs.iter().all(|pair| side(pair) == model.driven);
    on(|pair| pair.nonmortar.body) || on(|pair| pair.mortar.body)
}

fn shared_friction(pairs: &[Pair]) -> Option<f64> {
    let of = |pair: &Pair| pair.contact.law().map_or(Some(0.0), |law| coefficient(&**law));
    let first = of(pairs.first()?)?;
    pairs.iter().all(|pair| of(pair) == Some(first)).then_some(first)
}

/// The coefficient of Coulomb's law; `None` for every other law.
fn coefficient(law: &dyn FrictionLaw) -> Option<f64> {
    let written = serde_json::to_value(law).ok()?;
    let coulomb = written.get("type")?.as_str()? == "coulomb";
    written.get("friction")?.as_f64().filter(|_| coulomb)
}

/// A direct law with memory may store and return work (bristles); a law that is not registered may do anything.
fn dissipates(law: &dyn FrictionLaw) -> bool {
    kind(law).is_some_and(|kind| kind == Kind::SetValued || law.variables().is_empty())
}

/// Fixed displacements do no work; everything else must be at most one motion per component, of the driven body.
fn single_drive(model: &Model) -> bool {
    let working = || {
        model.motions.iter().filter(|motion| match &motion.control {
            Control::Displacement(table) => !table.is_constant(),
            Control::Force(_) => true,
        })
    };
    let alone = |component: usize| working().filter(|m| m.component == component).count() <= 1;
    working().all(|motion| motion.body == model.driven && motion.drive) && alone(0) && alone(1)
}
