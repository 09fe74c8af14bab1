//! The figures of a folder in the order of interest, with captions that say what is seen.

use std::fs;
use std::path::Path;

use super::html;
use crate::output::OutputError;

/// Beginning of a name, caption, and whether the figure takes the whole width.
const KNOWN: [(&str, &str, bool); 7] = [
    (
        "animation",
        "The pass. Colour: von Mises stress; hatched: contact pressure on the driven body; arrow: contact force on it. Below: \
         resistance Fx and support Fy, the dots at the instant shown.",
        true,
    ),
    (
        "bodies",
        "Deformed bodies at the instants marked by letters in the charts. Colour: von Mises stress; hatched: contact pressure; \
         arrow: contact force on the driven body.",
        true,
    ),
    (
        "mu_global",
        "Global friction Fx/Fy over the pass, with the local coefficient and the bounds that the mean contact angle sets where the \
         law is Coulomb's. Points between the bounds stick, at least in part.",
        false,
    ),
    ("forces", "Resistance Fx and support Fy felt by the driven body, per unit depth.", false),
    ("energy", "External work, stored energy and dissipation, and what their balance leaves open.", false),
    ("interface", "Contact pressure and traction along the interface at the instants marked by letters.", false),
    ("states", "Internal variables of the friction law over the touching points: range and mean.", false),
];

/// All figures of a folder as HTML, nothing where there are none; those of a study in the `order` of its quantities.
pub fn section(folder: &Path, order: &[&str]) -> Result<String, OutputError> {
    let mut figures = vec![];
    for name in names(&folder.join("figures")) {
        let path = folder.join("figures").join(format!("{name}.svg"));
        let svg = fs::read_to_string(&path).map_err(OutputError::io("read", &path))?;
        let place = KNOWN.iter().position(|(known, _, _)| belongs(&name, known));
        let (caption, wide) = place.map_or_else(|| (said(&name), false), |k| (caption(&name, k), KNOWN[k].2));
        let quantity = name.split_once("-over-").and_then(|(own, _)| order.iter().position(|known| *known == own));
        figures.push((
            place.map_or_else(|| quantity.map(|k| k + KNOWN.len()), Some),
            name,
            html::figure(&svg, &caption, wide),
        ));
    }
    figures.sort_by(|a, b| (a.0.is_none(), a.0, &a.1).cmp(&(b.0.is_none(), b.0, &b.1)));
    let content: String = figures.into_iter().map(|(_, _, html)| html).collect();
    Ok(if content.is_empty() { content } else { format!("<div class=\"figures\">\n{content}</div>\n") })
}

/// Names of all SVG files without their ending.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().filter_map(Result::ok);
    let paths = entries.map(|entry| entry.path()).filter(|path| path.extension().is_some_and(|e| e == "svg"));
    paths.filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned())).collect()
}

fn belongs(name: &str, known: &str) -> bool {
    name == known || name.strip_prefix(known).is_some_and(|rest| rest.starts_with("_") && !rest.contains("-over-"))
}

fn caption(name: &str, k: usize) -> String {
    let (known, caption, _) = KNOWN[k];
    match name.strip_prefix(known).map(|rest| rest.trim_start_matches('_')) {
        Some(pair) if !pair.is_empty() => format!("Contact {pair}: {caption}"),
        _ => caption.to_owned(),
    }
}

/// The caption of a figure of a study, whose name says all.
fn said(name: &str) -> String {
    let words = name.replace("-over-", " over ");
    format!("{words}. Each line is one value of the axis in the key; gaps are points that failed.")
}
