//! A scene file as text: syntax, `--set` arguments, and the place of every key in it.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use toml::de::DeTable;

use super::fail_on;
use super::grammar::Grammar;
use super::issue::{Focus, Issue, KeyPath, Place, SceneError};
use super::tree::{Node, Origin};

/// Syntax errors beyond this number are mostly consequences of the first.
const MAX_SYNTAX_ERRORS: usize = 5;

/// The text of a scene with the changes that `--set` made to it.
#[derive(Clone, Debug)]
pub struct Source {
    file: PathBuf,
    text: String,
    /// Where values came from that replaced those of the file, as shown in messages.
    pub(super) sets: Vec<String>,
    pub(super) root: Node,
}

impl Source {
    /// Parses `text`; `file` is for messages only.
    ///
    /// # Errors
    /// Syntax errors and numbers that do not fit, each with its place.
    pub fn parse(file: &Path, text: String) -> Result<Self, SceneError> {
        let mut source = Self { file: file.to_path_buf(), text, sets: vec![], root: Node::empty_table(0) };
        let (table, errors) = DeTable::parse_recoverable(&source.text);
        let issues: Vec<Issue> = errors.iter().take(MAX_SYNTAX_ERRORS).map(|e| source.syntax(e)).collect();
        if !issues.is_empty() {
            return Err(SceneError(issues));
        }
        let tree = Node::from_table(&table, &Origin::File);
        source.root = tree.map_err(|bad| {
            let place = Some(Box::new(source.place(&bad.at)));
            let key = bad.upwards.into_iter().rev().collect();
            SceneError::from(Issue { place, ..Issue::value(key, bad.message) })
        })?;
        Ok(source)
    }

    /// The text of a file; `kind` says in messages what it was taken for.
    ///
    /// # Errors
    /// The path and the reason.
    pub fn text_of(file: &Path, kind: &str) -> Result<String, SceneError> {
        std::fs::read_to_string(file).map_err(|error| {
            let message = format!("cannot read the {kind} {}: {error}", file.display());
            Issue::value(KeyPath::default(), message).allowed("a TOML file in UTF-8").into()
        })
    }

    /// Reads the document as what its grammar describes. Issues have keys; [`Source::locate`] gives them lines.
    ///
    /// # Errors
    /// Everything that does not fit the grammar.
    pub fn read<T: DeserializeOwned>(&self, grammar: &Grammar) -> Result<T, SceneError> {
        fail_on(grammar.check(&self.root))?;
        // what fits the schema can be read; this is the net below the schema
        T::deserialize(self.root.to_value()).map_err(|error| Issue::value(KeyPath::default(), error.to_string()).into())
    }

    /// The document as a plain value of TOML, with everything that was replaced in it.
    pub fn to_value(&self) -> toml::Value {
        self.root.to_value()
    }

    fn syntax(&self, error: &toml::de::Error) -> Issue {
        let place = error.span().map(|span| Box::new(self.place(&Origin::File(span))));
        Issue { place, ..Issue::value(KeyPath::default(), format!("not valid TOML: {}", error.message())) }
    }

    /// Fills in where each issue was written and sorts them by place.
    pub fn locate(&self, error: SceneError) -> SceneError {
        let mut found: Vec<_> = error.0.into_iter().map(|issue| self.located(issue)).collect();
        found.sort_by_key(|(start, _)| *start);
        found.dedup();
        SceneError(found.into_iter().map(|(_, issue)| issue).collect())
    }

    fn located(&self, issue: Issue) -> (usize, Issue) {
        let (node, exact) = self.nearest_node(&issue.key);
        let origin = if exact && issue.focus == Focus::Key { &node.key_at } else { &node.at };
        let start = match origin {
            Origin::File(span) => span.start,
            Origin::Set(k) => self.text.len() + k,
        };
        let place = issue.place.clone().or_else(|| Some(Box::new(self.place(origin))));
        (start, Issue { place, ..issue })
    }

    /// The node at `key`, or the nearest table above it; whether it is the node itself.
    fn nearest_node(&self, key: &KeyPath) -> (&Node, bool) {
        let mut node = &self.root;
        for segment in key.segments() {
            match node.get(segment) {
                Some(child) => node = child,
                None => return (node, false),
            }
        }
        (node, true)
    }

    fn place(&self, origin: &Origin) -> Place {
        match origin {
            Origin::File(span) => self.line_of(span),
            Origin::Set(k) => Place::Argument(self.sets.get(*k).cloned().unwrap_or_default()),
        }
    }

    fn line_of(&self, span: &Range<usize>) -> Place {
        let clip = |byte: usize| (0..=byte.min(self.text.len())).rev().find(|&b| self.text.is_char_boundary(b));
        let (start, end) = (clip(span.start).unwrap_or(0), clip(span.end).unwrap_or(0));
        let line_start = self.text[..start].rfind('\n').map_or(0, |k| k + 1);
        let line_end = self.text[start..].find('\n').map_or(self.text.len(), |k| start + k);
        Place::File {
            file: self.file.clone(),
            line: self.text[..start].matches('\n').count() + 1,
            column: self.text[line_start..start].chars().count() + 1,
            text: self.text[line_start..line_end].trim_end().to_string(),
            width: self.text[start..end.clamp(start, line_end)].trim_end().chars().count().max(1),
        }
    }
}
