//! The scene as written: a tree of TOML values in which each remembers where it came from.
//!
//! Tagged enums lose the positions of TOML while they are read, so positions are looked up here afterwards, by key.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::de::{DeTable, DeValue};
use toml::{Spanned, Value};

/// Where a key or a value was written.
#[derive(Clone, Debug)]
pub(super) enum Origin {
    /// Bytes of the file.
    File(Range<usize>),
    /// The n-th replacement: a `--set` argument, or a value that a study puts in.
    Set(usize),
}

/// A value with its origin.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Where the key stands; for an entry of an array, where the value stands.
    pub key_at: Origin,
    /// Where the value stands; for a table with a header, the header.
    pub at: Origin,
    pub item: Item,
}

/// A value of TOML.
#[derive(Clone, Debug)]
pub(super) enum Item {
    Table(BTreeMap<String, Node>),
    Array(Vec<Node>),
    /// Anything that is neither table nor array.
    Leaf(Value),
}

/// Turns the span of a piece of text into its origin.
pub(super) type Locator<'a> = &'a dyn Fn(Range<usize>) -> Origin;

/// A number that cannot be held, and where it stands.
pub(super) struct BadNumber {
    /// Keys from the number up to the document.
    pub upwards: Vec<String>,
    pub at: Origin,
    pub message: String,
}

impl BadNumber {
    fn below(mut self, key: impl ToString) -> Self {
        self.upwards.push(key.to_string());
        self
    }
}

impl Node {
    /// An empty table that was called for by the n-th `--set` argument.
    pub fn empty_table(set: usize) -> Self {
        Self { key_at: Origin::Set(set), at: Origin::Set(set), item: Item::Table(BTreeMap::new()) }
    }

    /// A plain value that came from the n-th replacement.
    pub fn of(value: &Value, set: usize) -> Self {
        let item = match value {
            Value::Table(map) => Item::Table(map.iter().map(|(key, v)| (key.clone(), Self::of(v, set))).collect()),
            Value::Array(values) => Item::Array(values.iter().map(|v| Self::of(v, set)).collect()),
            leaf => Item::Leaf(leaf.clone()),
        };
        Self { key_at: Origin::Set(set), at: Origin::Set(set), item }
    }

    /// The tree below a parsed document or table.
    pub fn from_table(table: &Spanned<DeTable<'_>>, locate: Locator) -> Result<Self, BadNumber> {
        let at = locate(table.span());
        Ok(Self { key_at: at.clone(), at, item: entries(table.get_ref(), locate)? })
    }

    fn from_value(key_at: Origin, value: &Spanned<DeValue<'_>>, locate: Locator) -> Result<Self, BadNumber> {
        let at = locate(value.span());
        let item = match value.get_ref() {
            DeValue::Table(table) => entries(table, locate)?,
            DeValue::Array(array) => {
                let node = |v: &Spanned<_>| Self::from_value(locate(v.span()), v, locate);
                let nodes = array.iter().enumerate().map(|(k, v)| node(v).map_err(|bad| bad.below(k)));
                Item::Array(nodes.collect::<Result<_, _>>()?)
            }
            DeValue::String(text) => Item::Leaf(Value::String(text.to_string())),
            DeValue::Boolean(flag) => Item::Leaf(Value::Boolean(*flag)),
            DeValue::Datetime(time) => Item::Leaf(Value::Datetime(*time)),
            DeValue::Integer(number) => match i64::from_str_radix(number.as_str(), number.radix()) {
                Ok(number) => Item::Leaf(Value::Integer(number)),
                Err(_) => return bad(at, format!("the integer {} does not fit into 64 bits", number.as_str())),
            },
            DeValue::Float(number) => match number.as_str().parse() {
                Ok(number) => Item::Leaf(Value::Float(number)),
                Err(_) => return bad(at, format!("{} is not a number", number.as_str())),
            },
        };
        Ok(Self { key_at, at, item })
    }

    /// The entry named or numbered `key`.
    pub fn get(&self, key: &str) -> Option<&Node> {
        match &self.item {
            Item::Table(map) => map.get(key),
            Item::Array(nodes) => nodes.get(key.parse::<usize>().ok()?),
            Item::Leaf(_) => None,
        }
    }

    /// The plain TOML value without positions.
    pub fn to_value(&self) -> Value {
        match &self.item {
            Item::Table(map) => Value::Table(map.iter().map(|(k, n)| (k.clone(), n.to_value())).collect()),
            Item::Array(nodes) => Value::Array(nodes.iter().map(Node::to_value).collect()),
            Item::Leaf(value) => value.clone(),
        }
    }

    /// What was found, for messages: `the string "abc"`, `the number 0.5`, `a table`.
    pub fn found(&self) -> String {
        match &self.item {
            Item::Table(_) => "a table".into(),
            Item::Array(nodes) => format!("a list of {}", nodes.len()),
            Item::Leaf(Value::String(text)) => format!("the string {text:?}"),
            Item::Leaf(Value::Integer(number)) => format!("the integer {number}"),
            Item::Leaf(Value::Float(number)) => format!("the number {number:?}"),
            Item::Leaf(value) => value.to_string(),
        }
    }
}

fn bad(at: Origin, message: String) -> Result<Node, BadNumber> {
    Err(BadNumber { upwards: vec![], at, message })
}

fn entries(table: &DeTable<'_>, locate: Locator) -> Result<Item, BadNumber> {
    let pairs = table.iter().map(|(key, value)| {
        let node = Node::from_value(locate(key.span()), value, locate).map_err(|bad| bad.below(key.get_ref()))?;
        Ok((key.get_ref().to_string(), node))
    });
    Ok(Item::Table(pairs.collect::<Result<_, _>>()?))
}
