//! Where a run begins: at the start, or where an interrupted one stopped.

use std::path::Path;

use crate::model::Model;
use crate::output::RunFolder;
use crate::scene::{Checkpoint, Scene};

use super::RunArguments;
use super::outcome::{Failure, note, warn};

/// The checkpoint to go on from. With `--resume` the one in the folder, where there is one; the user is told which it is.
pub fn begin(
    arguments: &RunArguments,
    scene: &Scene,
    model: &Model,
    folder: &RunFolder,
) -> Result<Checkpoint, Failure> {
    let (out, start) = (folder.root().display(), || Checkpoint::start(scene, model));
    let tell = |text: String| {
        if !arguments.quiet {
            note(text);
        }
    };
    if !arguments.resume {
        if let Some((step, steps)) = Checkpoint::unfinished(folder).filter(|_| !arguments.quiet) {
            warn(format!(
                "{out} held an unfinished run (step {step} of {steps}); it is replaced, --resume goes on with one"
            ));
        }
        return Ok(start());
    }
    let help =
        format!("\n  = help: nothing was changed; without --resume the run starts again and replaces what is in {out}");
    match Checkpoint::load(folder, scene, model).map_err(|error| Failure::input(format!("{error}{help}")))? {
        Some(found) if found.step() > 0 => {
            if !found.finished(scene) {
                tell(format!("going on after step {} of {}", found.step(), scene.time.steps));
            }
            Ok(found)
        }
        None if folder.holds_rows() => {
            Err(Failure::input(format!("{out} holds results but no checkpoint to go on from{help}")))
        }
        _ => {
            tell(format!("no step of this run is in {out}: it starts from the beginning"));
            Ok(start())
        }
    }
}

/// The command that goes on with an interrupted run, to be pasted into a shell.
pub fn command(arguments: &RunArguments, out: &Path) -> String {
    let program = std::env::args().next().unwrap_or_else(|| "asperity".into());
    let mut words = vec![program, "run".into(), arguments.scene.scene.display().to_string()];
    words.extend(arguments.scene.sets.iter().flat_map(|set| ["--set".to_string(), set.clone()]));
    words.extend(["--out".into(), out.display().to_string(), "--resume".into()]);
    words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
}

/// A word as a POSIX shell reads it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=:,+%@".contains(c);
    if !word.is_empty() && word.chars().all(plain) { word.into() } else { format!("'{}'", word.replace('\'', r"'\''")) }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn words_survive_a_shell() {
        for word in ["plain", "time.steps=3", "title=\"it's\"", "a b", "", "$HOME `x` \\ *", "elements=[4, 2]"] {
            let said = std::process::Command::new("sh").args(["-c", &format!("printf %s {}", quoted(word))]).output();
            assert_eq!(String::from_utf8_lossy(&said.unwrap().stdout), word);
        }
    }
}
