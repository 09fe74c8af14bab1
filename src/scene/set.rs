//! `--set PATH=VALUE`: one value of the scene replaced from the command line, before anything is validated.
//!
//! `PATH` is a dotted key of TOML in which entries of an array are numbered from 0; `VALUE` is a value of TOML, so text
//! needs quotes: `--set 'contact.0.law.friction=0.1'`, `--set 'title="steep"'`.

use serde_json::Value as Schema;
use toml::Value;
use toml::de::DeTable;

use super::grammar::{Grammar, Step};
use super::issue::{Issue, KeyPath, Place, SceneError};
use super::source::Source;
use super::tree::{Item, Node, Origin};

impl Source {
    /// Applies one `--set` argument.
    ///
    /// # Errors
    /// The argument is not `PATH=VALUE`, or the scene has no such key; the message lists the keys known at that level.
    pub fn set(&mut self, grammar: &Grammar, argument: &str) -> Result<(), SceneError> {
        let index = self.sets.len();
        self.sets.push(format!("--set '{argument}'"));
        let result = parse(argument, index).and_then(|(path, value)| self.replace(grammar, &path, value));
        result.map_err(|issue| self.blamed_on_last(issue))
    }

    /// Replaces the value at `path`; `origin` stands in messages for the place where the new one was written.
    ///
    /// # Errors
    /// The scene has no such key.
    pub fn put(&mut self, grammar: &Grammar, path: &KeyPath, value: &Value, origin: &str) -> Result<(), SceneError> {
        let index = self.sets.len();
        self.sets.push(origin.to_string());
        let result = self.replace(grammar, path, Node::of(value, index));
        result.map_err(|issue| self.blamed_on_last(issue))
    }

    fn replace(&mut self, grammar: &Grammar, path: &KeyPath, value: Node) -> Result<(), Issue> {
        *slot(&mut self.root, grammar, path, self.sets.len() - 1)? = value;
        Ok(())
    }

    fn blamed_on_last(&self, issue: Issue) -> SceneError {
        let place = self.sets.last().map(|origin| Box::new(Place::Argument(origin.clone())));
        Issue { place, ..issue }.into()
    }
}

impl KeyPath {
    /// A dotted key of TOML, e.g. `contact.0.law.friction`; `None` for any other text.
    pub fn parse(text: &str) -> Option<Self> {
        let document = format!("{text}=0");
        DeTable::parse(&document).ok().and_then(|keys| chain(keys.get_ref()))
    }
}

/// Path and value of an argument.
fn parse(argument: &str, index: usize) -> Result<(KeyPath, Node), Issue> {
    let wrong = |message: &str| Issue::value(KeyPath::default(), message).allowed("PATH=VALUE, e.g. time.steps=152");
    let (path, value) = argument.split_once('=').ok_or_else(|| wrong("no `=` in the argument of --set"))?;
    let path = KeyPath::parse(path).ok_or_else(|| wrong(&format!("{path:?} is not a dotted key")))?;

    let text = format!("value={value}");
    let parsed = DeTable::parse(&text).map_err(|error| {
        Issue::value(path.clone(), format!("`{value}` is not a value of TOML: {}", error.message()))
            .allowed("a number, \"text\", true, [list], { key = value }")
            .help("text needs quotes of its own: --set 'title=\"steep flanks\"'")
    })?;
    let locate = |_| Origin::Set(index);
    let tree = Node::from_table(&parsed, &locate).map_err(|bad| Issue::value(path.clone(), bad.message))?;
    match tree.item {
        Item::Table(mut map) if map.len() == 1 => match map.remove("value") {
            Some(node) => Ok((path, node)),
            None => Err(wrong("no value after `=`")),
        },
        _ => Err(wrong("more than one value in the argument of --set")),
    }
}

/// The keys of a document that holds nothing but one dotted key.
fn chain(table: &DeTable<'_>) -> Option<KeyPath> {
    let mut keys = vec![];
    let mut table = table;
    loop {
        let mut entries = table.iter();
        let (key, value) = entries.next().filter(|_| table.len() == 1)?;
        keys.push(key.get_ref().to_string());
        match value.get_ref().as_table() {
            Some(inner) => table = inner,
            None => return Some(keys.into_iter().collect()),
        }
    }
}

/// The node at `path`; makes keys that are absent but known.
fn slot<'a>(root: &'a mut Node, grammar: &Grammar, path: &KeyPath, index: usize) -> Result<&'a mut Node, Issue> {
    let mut node = root;
    let mut schema: &Schema = grammar.root();
    let mut walked = KeyPath::default();
    for key in path.segments() {
        let step = grammar.step(schema, node, key);
        let (here, found) = (walked.at(key), node.found());
        node = match &mut node.item {
            Item::Array(nodes) => entry(nodes, key, &here)?,
            Item::Table(map) => {
                let names: Vec<String> = match &step {
                    Step::Known(_) | Step::Open => vec![],
                    Step::Name(_) => map.keys().cloned().collect(),
                    Step::Unknown(known) => known.clone(),
                };
                let makes = matches!(step, Step::Known(_) | Step::Open);
                if !makes && !map.contains_key(key) {
                    let message = format!("unknown key `{key}`{}", below(&walked));
                    return Err(Issue::key(here, message).known(key, &names));
                }
                map.entry(key.clone()).or_insert_with(|| Node::empty_table(index))
            }
            Item::Leaf(_) => return Err(Issue::key(here, format!("`{walked}` is {found} and has no keys"))),
        };
        schema = match step {
            Step::Known(inner) | Step::Name(inner) => inner,
            Step::Open | Step::Unknown(_) => grammar.anything(),
        };
        walked = here;
    }
    Ok(node)
}

fn below(table: &KeyPath) -> String {
    if table.segments().is_empty() { String::new() } else { format!(" in `{table}`") }
}

fn entry<'a>(nodes: &'a mut [Node], key: &str, here: &KeyPath) -> Result<&'a mut Node, Issue> {
    let count = nodes.len();
    let wrong = Issue::key(here.clone(), format!("no entry `{key}` in a list of {count}"));
    let allowed = match count {
        0 => "(the list is empty)".to_string(),
        _ => format!("0 to {}", count - 1),
    };
    let found = key.parse::<usize>().ok().and_then(|k| nodes.get_mut(k));
    found.ok_or_else(|| wrong.allowed(allowed))
}
