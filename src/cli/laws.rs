//! `asperity laws [NAME]`.

use asperity::laws::{Kind, LawInfo, find, linked};
use asperity::scene::{Issue, KeyPath, SceneError};

use super::outcome::{Exit, Failure, say};

/// Prints all linked laws, or one of them in full.
pub fn laws(name: Option<&str>) -> Result<Exit, Failure> {
    match name {
        None => say(&table(&linked()))?,
        Some(name) => say(&in_full(find(name).ok_or_else(|| unknown(name))?))?,
    }
    Ok(Exit::Done)
}

fn unknown(name: &str) -> SceneError {
    let names: Vec<&str> = linked().iter().map(|info| info.name).collect();
    Issue::value(KeyPath::default(), format!("no law `{name}` is linked into this program")).known(name, &names).into()
}

fn table(laws: &[&LawInfo]) -> String {
    let width = laws.iter().map(|info| info.name.len()).max().unwrap_or(0);
    let mut text = String::new();
    for info in laws {
        let kind = match info.kind {
            Kind::SetValued => "set-valued",
            Kind::Direct => "direct",
            Kind::Either => "either",
        };
        text += &format!("{:width$}  {kind:10}  {}\n", info.name, info.equation);
    }
    text + "\nAsk `asperity laws NAME` for parameters, units, ranges and the reference.\n"
}

fn in_full(info: &LawInfo) -> String {
    let needed = info.parameters.iter().filter(|parameter| parameter.default.is_none());
    let keys: String = needed.map(|parameter| format!(", {} = ...", parameter.name)).collect();
    format!("{info}\n  in a scene: law = {{ type = \"{}\"{keys} }}\n", info.name)
}
