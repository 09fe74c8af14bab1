//! The compiled law.

use super::spec::{Open, Parameter, Spec, Tabulated, finite, invalid, parameter, state, unit};
use crate::{
    Dual, InterfacePoint, Kind, LawError, Response, Unit, Variable,
    dual::constant,
    evolve,
    explain::{answer, fault, place},
    expression::{Curve, Program, Symbol, Symbols, compile},
};
use std::sync::Arc;

/// Symbols of the interface by slot; the states follow.
const GIVEN: [&str; 5] = ["p", "v", "s", "dt", "T"];
const TEMPERATURE: usize = 4;
const MOST_STATES: usize = 4;
/// Magnitudes of pressure and velocity tried at reading: some unit system has the answer finite at one of them.
const TRIED: [f64; 3] = [1e-6, 1e-3, 1.0];

type Slots = [Dual; GIVEN.len() + MOST_STATES];

#[derive(Clone, Debug)]
pub(super) struct Formulas {
    kind: Kind,
    answer: Program,
    states: Vec<State>,
    temperature: Option<f64>,
}

#[derive(Clone, Debug)]
struct State {
    name: String,
    unit: Unit,
    initial: f64,
    reset: bool,
    rate: Program,
}

impl State {
    fn new(name: &str, value: &toml::Value, spec: &Spec, symbols: &Symbols) -> Result<Self, LawError> {
        let (key, state) = (format!("states.{name}"), state(name, value)?);
        Ok(Self {
            name: name.into(),
            unit: unit(&key, state.unit.as_ref())?,
            initial: state.initial,
            reset: state.open == Open::Reset,
            rate: program(&format!("{key}.rate"), &state.rate, spec, symbols)?,
        })
    }
}

fn program(key: &str, text: &str, spec: &Spec, symbols: &Symbols) -> Result<Program, LawError> {
    let program = compile(text, symbols).map_err(|message| invalid(key, message))?;
    if program.uses(TEMPERATURE) && spec.temperature.is_none() {
        return Err(invalid(key, "`T` needs `temperature = ...`: its value where the scene has none"));
    }
    Ok(program)
}

impl Formulas {
    pub(super) fn new(spec: &Spec) -> Result<Self, LawError> {
        let (kind, key, text) = match (&spec.threshold, &spec.traction) {
            (Some(text), None) => (Kind::SetValued, "threshold", text),
            (None, Some(text)) => (Kind::Direct, "traction", text),
            (None, None) => {
                let message = "needs `threshold = \"...\"` (a bound on |q|) or `traction = \"...\"` (q itself)";
                return Err(invalid("type", message));
            }
            (Some(_), Some(_)) => return Err(invalid("traction", "`threshold` and `traction` exclude each other")),
        };
        let symbols = symbols(spec)?;
        let states = spec.states.iter().map(|(name, value)| State::new(name, value, spec, &symbols));
        let formulas = Self {
            kind,
            states: states.collect::<Result<_, _>>()?,
            answer: program(key, text, spec, &symbols)?,
            temperature: spec.temperature.map(|x| finite("temperature", x)).transpose()?,
        };
        formulas.probe()?;
        Ok(formulas)
    }

    pub(super) fn variables(&self) -> Vec<Variable> {
        self.states.iter().map(|state| Variable::new(state.name.clone(), state.unit, state.initial)).collect()
    }

    pub(super) fn response(&self, at: &InterfacePoint, old: &[f64], new: &mut [Dual]) -> Response {
        let mut slots = self.slots(at);
        self.advance(&slots, at.dt, old, new);
        slots[GIVEN.len()..][..new.len()].copy_from_slice(new);
        self.answer(&slots)
    }

    pub(super) fn open(&self, at: &InterfacePoint, old: &[f64], new: &mut [f64]) {
        let mut duals = vec![constant(f64::NAN); new.len()];
        self.advance(&self.slots(at), at.dt, old, &mut duals);
        for ((new, dual), state) in new.iter_mut().zip(&duals).zip(&self.states) {
            *new = if state.reset { state.initial } else { dual.re };
        }
    }

    /// The key of the formula that fails at this point, and how.
    pub(super) fn fault(&self, at: &InterfacePoint, old: &[f64]) -> Option<(String, String)> {
        let names: Vec<&str> = self.states.iter().map(|state| state.name.as_str()).collect();
        let mut slots = self.slots(at);
        let mut new = vec![constant(f64::NAN); old.len()];
        self.advance(&slots, at.dt, old, &mut new);
        let with = |mut slots: Slots, states: &mut dyn Iterator<Item = Dual>| {
            slots[GIVEN.len()..].iter_mut().zip(states).for_each(|(slot, state)| *slot = state);
            slots
        };
        if let Some(wrong) =
            names.iter().zip(&new).find_map(|(name, x)| Some(format!("the state `{name}` {}", fault(x)?)))
        {
            slots = with(slots, &mut old.iter().map(|x| constant(*x)));
            let part = self.states.iter().find_map(|state| Some((&state.name, state.rate.fault(&slots)?)));
            let place = place(at, &names, old);
            let (name, why) =
                part.unwrap_or_else(|| (&self.states[0].name, "no end of this step was found from here".into()));
            return Some((format!("states.{name}.rate"), format!("{wrong} at {place}: {why}")));
        }
        slots = with(slots, &mut new.iter().copied());
        let wrong = answer(&self.answer(&slots))?;
        let ends: Vec<f64> = new.iter().map(|x| x.re).collect();
        let part = self.answer.fault(&slots).map_or(String::new(), |part| format!(": {part}"));
        Some((self.key().into(), format!("{wrong} at {}{part}", place(at, &names, &ends))))
    }

    /// Refuses a law that fails at rest, or for one sign of the slip at whatever magnitude.
    fn probe(&self) -> Result<(), LawError> {
        let old: Vec<f64> = self.states.iter().map(|state| state.initial).collect();
        for (pressed, sign) in [0.0, 1.0].into_iter().flat_map(|p| [0.0, 1.0, -1.0].map(|sign| (p, sign))) {
            let pairs = TRIED.iter().flat_map(|p| TRIED.map(|v| (pressed * p, sign * v)));
            let faults = pairs.map(|(p, v)| self.fault(&InterfacePoint::new(p, v, 1.0), &old));
            if let Some((key, message)) = faults.collect::<Option<Vec<_>>>().and_then(|mut all| all.pop()) {
                return Err(invalid(key, message));
            }
        }
        Ok(())
    }

    fn key(&self) -> &'static str {
        if self.kind == Kind::Direct { "traction" } else { "threshold" }
    }

    fn slots(&self, at: &InterfacePoint) -> Slots {
        let mut slots = [constant(0.0); GIVEN.len() + MOST_STATES];
        let temperature = at.temperature.or(self.temperature).unwrap_or(f64::NAN);
        let given = [at.pressure, at.velocity(), at.slip, constant(at.dt), constant(temperature)];
        slots[..GIVEN.len()].copy_from_slice(&given);
        slots
    }

    fn answer(&self, slots: &Slots) -> Response {
        let value = self.answer.value(slots);
        if self.kind == Kind::Direct { Response::Traction(value) } else { Response::Threshold(value) }
    }

    fn advance(&self, slots: &Slots, dt: f64, old: &[f64], new: &mut [Dual]) {
        match self.states.len() {
            0 => {}
            1 => self.evolve::<1>(slots, dt, old, new),
            2 => self.evolve::<2>(slots, dt, old, new),
            3 => self.evolve::<3>(slots, dt, old, new),
            _ => self.evolve::<MOST_STATES>(slots, dt, old, new),
        }
    }

    fn evolve<const N: usize>(&self, slots: &Slots, dt: f64, old: &[f64], new: &mut [Dual]) {
        evolve(dt, old, new, |z: [Dual; N]| {
            let mut slots = *slots;
            slots[GIVEN.len()..][..N].copy_from_slice(&z);
            std::array::from_fn(|i| self.states[i].rate.value(&slots))
        });
    }
}

/// All names that the formulas may use.
fn symbols(spec: &Spec) -> Result<Symbols, LawError> {
    if spec.states.len() > MOST_STATES {
        return Err(invalid("states", format!("{} states; at most {MOST_STATES}", spec.states.len())));
    }
    let mut symbols = Symbols::default();
    let mut slots: Vec<&str> = GIVEN.to_vec();
    slots.extend(spec.states.keys().map(String::as_str));
    for (slot, name) in slots.iter().enumerate() {
        symbols.add(name, Symbol::Slot(slot)).map_err(|message| invalid(format!("states.{name}"), message))?;
    }
    for (name, value) in &spec.parameters {
        let key = format!("parameters.{name}");
        let symbol = match parameter(name, value)? {
            Parameter::Number(x) => Symbol::Number(finite(&key, x)?),
            Parameter::Quantity(quantity) => {
                unit(&key, quantity.unit.as_ref())?;
                Symbol::Number(finite(&format!("{key}.value"), quantity.value)?)
            }
            Parameter::Table(table) => tabulated(&key, table, &slots)?,
        };
        symbols.add(name, symbol).map_err(|message| invalid(key, message))?;
    }
    Ok(symbols)
}

fn tabulated(key: &str, table: Tabulated, slots: &[&str]) -> Result<Symbol, LawError> {
    unit(key, table.unit.as_ref())?;
    let admitted = |name: &&&str| !["s", "dt"].contains(name);
    let slot = slots.iter().position(|name| *name == table.over && admitted(&name));
    let Some(slot) = slot else {
        let known: Vec<&str> = slots.iter().filter(admitted).copied().collect();
        return Err(invalid(format!("{key}.over"), format!("`{}` is none of: {}", table.over, known.join(", "))));
    };
    let curve =
        Curve::new(table.at, table.value).map_err(|(list, message)| invalid(format!("{key}.{list}"), message))?;
    Ok(Symbol::Curve { slot, magnitude: table.over == "v", curve: Arc::new(curve) })
}
