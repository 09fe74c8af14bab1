//! `asperity laws [NAME] [--probe FILE]`.

use crate::laws::{Kind, LawInfo, find, linked};
use crate::scene::{Issue, KeyPath, SceneError};

use std::path::Path;

use super::outcome::{Exit, Failure, say};
use super::probe::probe;

/// Prints all linked laws or one of them in full, or drives one through the programmes of a file.
pub fn laws(name: Option<&str>, file: Option<&Path>, out: Option<&Path>) -> Result<Exit, Failure> {
    let Some(name) = name else {
        say(&table(&linked()))?;
        return Ok(Exit::Done);
    };
    let info = find(name).ok_or_else(|| unknown(name))?;
    if let Some(file) = file {
        return probe(info, file, out);
    }
    say(&in_full(info))?;
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
    text + "\nAsk `asperity laws NAME` for parameters, units, ranges and the reference,\nand `asperity laws NAME --probe FILE.toml` to drive one at a single contact point.\n"
}

fn in_full(info: &LawInfo) -> String {
    let needed = info.parameters.iter().filter(|parameter| parameter.default.is_none());
    let keys: String = needed.map(|parameter| format!(", {} = ...", parameter.name)).collect();
    format!(
        "{info}\n  in a scene: law = {{ type = \"{}\"{keys} }}\n  on its own: asperity laws {} --probe FILE.toml (see examples/probe.toml)\n",
        info.name, info.name
    )
}
