//! `asperity laws NAME --probe FILE.toml`.

use std::path::{Path, PathBuf};

use crate::laws::LawInfo;
use crate::output::RunFolder;
use crate::scene::Probe;

use super::outcome::{Exit, Failure, say};

/// Drives a law at one contact point through the programmes of a file.
pub fn probe(info: &LawInfo, file: &Path, out: Option<&Path>) -> Result<Exit, Failure> {
    let (probe, law) = Probe::load(file, info)?;
    let out = out.map_or_else(|| default_folder(file), Path::to_path_buf);
    let folder = RunFolder::create(&out)
        .map_err(|error| Failure::input(format!("{error}\n  = argument: --out {}", out.display())))?;
    let outcome = probe.run(&*law, &folder).map_err(Failure::internal)?;
    let broken: Vec<String> =
        outcome.iter().filter_map(|(name, failure)| Some(format!("{name}: {}", failure.as_ref()?))).collect();
    if broken.is_empty() {
        say(&format!("done: {} programmes; results in {}\n", outcome.len(), out.display()))?;
        return Ok(Exit::Done);
    }
    let kept = format!("  = help: everything before is kept in {}; more `steps` may help", out.display());
    Err(Failure::not_converged(format!("{}\n{kept}", broken.join("\n"))))
}

fn default_folder(file: &Path) -> PathBuf {
    Path::new("out").join(file.file_stem().unwrap_or(file.as_os_str()))
}
