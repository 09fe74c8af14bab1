//! What is wrong with a scene, where, and what would be right: the error type of this room.

use std::fmt;
use std::path::PathBuf;

/// Dotted path of a key, e.g. `contact.0.law.friction`; entries of an array are numbered from 0.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct KeyPath(Vec<String>);

impl KeyPath {
    /// The path of a key of the document itself.
    pub fn of(key: impl ToString) -> Self {
        Self(vec![key.to_string()])
    }

    /// The path one level below `self`.
    pub fn at(&self, key: impl ToString) -> Self {
        let mut segments = self.0.clone();
        segments.push(key.to_string());
        Self(segments)
    }

    /// Keys from the document down.
    pub fn segments(&self) -> &[String] {
        &self.0
    }
}

impl FromIterator<String> for KeyPath {
    fn from_iter<I: IntoIterator<Item = String>>(keys: I) -> Self {
        Self(keys.into_iter().collect())
    }
}

impl fmt::Display for KeyPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, key) in self.0.iter().enumerate() {
            if k > 0 {
                f.write_str(".")?;
            }
            let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
            if !key.is_empty() && key.chars().all(bare) {
                f.write_str(key)?;
            } else {
                write!(f, "{key:?}")?;
            }
        }
        Ok(())
    }
}

/// Whether an issue is with a key's name or with what stands behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Focus {
    /// The name of the key.
    Key,
    /// The value of the key (of the nearest table above it, if the key is absent).
    Value,
}

/// Where the offending key or value was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// A line of the scene file.
    File {
        /// Path as given by the user.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
        /// The source line.
        text: String,
        /// Number of characters to underline, at least 1.
        width: usize,
    },
    /// An argument of the command line, e.g. `--set 'time.steps=0'`.
    Argument(String),
}

/// One thing that is wrong with a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Issue {
    /// The key concerned; empty where the text is no TOML at all.
    pub key: KeyPath,
    /// Key or value.
    pub focus: Focus,
    /// What was found, and why it will not do.
    pub message: String,
    /// What would be accepted here.
    pub allowed: Option<String>,
    /// A likely remedy.
    pub help: Option<String>,
    /// Where it was written; `None` for scenes that were made by a program.
    pub place: Option<Box<Place>>,
}

impl Issue {
    /// An issue with the value of `key`.
    pub fn value(key: KeyPath, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { key, focus: Focus::Value, message, allowed: None, help: None, place: None }
    }

    /// An issue with the name of `key`.
    pub fn key(key: KeyPath, message: impl Into<String>) -> Self {
        Self { focus: Focus::Key, ..Self::value(key, message) }
    }

    /// Adds what would be accepted.
    pub fn allowed(self, allowed: impl Into<String>) -> Self {
        Self { allowed: Some(allowed.into()), ..self }
    }

    /// Adds a likely remedy, after those that are there.
    pub fn help(self, help: impl Into<String>) -> Self {
        let before = self.help.as_ref().map_or(String::new(), |help| format!("{help} "));
        Self { help: Some(before + &help.into()), ..self }
    }

    /// Adds the names that are known here, and the nearest of them to what was written.
    pub fn known<S: AsRef<str>>(self, found: &str, names: &[S]) -> Self {
        let allowed = if names.is_empty() { "(none)".into() } else { listed(names) };
        match nearest(found, names) {
            Some(name) => self.help(format!("did you mean `{name}`?")).allowed(allowed),
            None => self.allowed(allowed),
        }
    }
}

/// Characters of a source line that are shown around the offence: long point lists are cut.
const SHOWN: usize = 120;

impl fmt::Display for Issue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "error: {}", self.message)?;
        let mut margin = 1;
        match self.place.as_deref() {
            Some(Place::File { file, line, column, text, width }) => {
                margin = line.to_string().len();
                writeln!(f, "{:margin$}--> {}:{line}:{column}", "", file.display())?;
                let skipped = column.saturating_sub(SHOWN);
                let shown: String = text.chars().skip(skipped).take(SHOWN + 40).collect();
                let (pad, carets) = (column - 1 - skipped, "^".repeat(*width));
                writeln!(f, "{:margin$} |", "")?;
                writeln!(f, "{line} | {}", shown.replace('\t', " "))?;
                writeln!(f, "{:margin$} | {:pad$}{carets}", "", "")?;
            }
            Some(Place::Argument(argument)) => writeln!(f, "{:margin$}--> {argument}", "")?,
            None => {}
        }
        if !self.key.segments().is_empty() {
            writeln!(f, "{:margin$} = key: {}", "", self.key)?;
        }
        for (label, text) in [("allowed", &self.allowed), ("help", &self.help)] {
            if let Some(text) = text {
                writeln!(f, "{:margin$} = {label}: {text}", "")?;
            }
        }
        Ok(())
    }
}

/// A scene that cannot be used: everything that was found wrong at once, in the order of the file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", rendered(.0))]
pub struct SceneError(pub Vec<Issue>);

impl From<Issue> for SceneError {
    fn from(issue: Issue) -> Self {
        Self(vec![issue])
    }
}

fn rendered(issues: &[Issue]) -> String {
    let texts: Vec<String> = issues.iter().map(Issue::to_string).collect();
    texts.join("\n").trim_end().to_string()
}

/// `a`, `b`, `c` for messages.
pub(crate) fn listed<S: AsRef<str>>(names: &[S]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{}`", name.as_ref())).collect();
    quoted.join(", ")
}

/// The name with the fewest edits from `found`, if at most half of its letters differ.
pub(crate) fn nearest<'a, S: AsRef<str>>(found: &str, names: &'a [S]) -> Option<&'a str> {
    let limit = found.chars().count() / 2;
    let scored = names.iter().map(|name| (edits(found, name.as_ref()), name.as_ref()));
    scored.filter(|(distance, _)| *distance <= limit).min_by_key(|(distance, _)| *distance).map(|(_, name)| name)
}

/// Edit distance where inserting, deleting and replacing a letter and swapping two neighbours cost 1 each
/// (optimal string alignment).
fn edits(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut table = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            table[i][j] = if i == 0 || j == 0 {
                i + j
            } else {
                let replaced = table[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
                let mut best = replaced.min(table[i - 1][j] + 1).min(table[i][j - 1] + 1);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    best = best.min(table[i - 2][j - 2] + 1);
                }
                best
            };
        }
    }
    table[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_key_is_found_through_swaps_and_rejects_strangers() {
        let names = ["friction", "type", "youngs_modulus"];
        assert_eq!(nearest("frcition", &names), Some("friction"));
        assert_eq!(nearest("young_modulus", &names), Some("youngs_modulus"));
        assert_eq!(nearest("zzzzzz", &names), None);
        assert_eq!(edits("ab", "ba"), 1);
    }

    #[test]
    fn keys_that_are_not_bare_are_quoted() {
        assert_eq!(KeyPath::of("body").at("a.b").at(0).to_string(), r#"body."a.b".0"#);
    }
}
