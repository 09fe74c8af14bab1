//! Reading single keywords of a JSON schema, and putting a schema into words.

use serde_json::Value as Schema;
use toml::Value;

use super::grammar::Grammar;
use super::issue::{Issue, KeyPath, listed};
use super::tree::{Item, Node};

/// Added where a law is not known.
const LINKED_LAWS: &str =
    "A law of another crate is linked by `use that_crate as _;` in its program, see examples/own_law";

/// The schema of a declared key.
pub(super) fn property<'a>(schema: &'a Schema, key: &str) -> Option<&'a Schema> {
    schema.get("properties")?.get(key)
}

/// All declared keys.
pub(super) fn property_names(schema: &Schema) -> Vec<String> {
    let keys = schema.get("properties").and_then(Schema::as_object);
    keys.map(|map| map.keys().cloned().collect()).unwrap_or_default()
}

/// The keys that have no default.
pub(super) fn required(schema: &Schema) -> impl Iterator<Item = &str> {
    let keys = schema.get("required").and_then(Schema::as_array);
    keys.into_iter().flatten().filter_map(Schema::as_str)
}

/// The schema of the k-th entry of a list.
pub(super) fn item(schema: &Schema, k: usize) -> Option<&Schema> {
    let entry = schema.get("prefixItems").and_then(|entries| entries.get(k));
    entry.or_else(|| schema.get("items").filter(|items| items.is_object()))
}

/// The texts of a closed set.
pub(super) fn texts(schema: &Schema) -> Option<Vec<String>> {
    if let Some(text) = schema.get("const").and_then(Schema::as_str) {
        return Some(vec![text.to_string()]);
    }
    let names = schema.get("enum")?.as_array()?;
    Some(names.iter().filter_map(Schema::as_str).map(str::to_string).collect())
}

/// Whether an integer is the one that is asked for.
pub(super) fn constant(schema: &Schema, number: i64) -> bool {
    schema.get("const").and_then(Schema::as_i64).is_none_or(|wanted| wanted == number)
}

/// Whether a number lies within the bounds of the schema.
pub(super) fn in_range(schema: &Schema, number: f64) -> bool {
    let bound = |name: &str| schema.get(name).and_then(Schema::as_f64);
    bound("minimum").is_none_or(|b| number >= b)
        && bound("maximum").is_none_or(|b| number <= b)
        && bound("exclusiveMinimum").is_none_or(|b| number > b)
        && bound("exclusiveMaximum").is_none_or(|b| number < b)
}

/// Whether the type of `node` is one that the schema takes.
pub(super) fn admits(schema: &Schema, node: &Node) -> bool {
    let kinds: &[&str] = match &node.item {
        Item::Table(_) => &["object"],
        Item::Array(_) => &["array"],
        Item::Leaf(Value::String(_)) => &["string"],
        Item::Leaf(Value::Integer(_)) => &["integer", "number"],
        Item::Leaf(Value::Float(_)) => &["number"],
        Item::Leaf(Value::Boolean(_)) => &["boolean"],
        Item::Leaf(_) => &[],
    };
    let wanted = types(schema);
    wanted.is_empty() || wanted.iter().any(|kind| kinds.contains(kind))
}

fn types(schema: &Schema) -> Vec<&str> {
    match schema.get("type") {
        Some(Schema::String(kind)) => vec![kind],
        Some(Schema::Array(kinds)) => kinds.iter().filter_map(Schema::as_str).filter(|kind| *kind != "null").collect(),
        _ => vec![],
    }
}

/// The key by which tables tell which of several branches they are, if there is one.
pub(super) fn tag(branches: &[&Schema]) -> Option<String> {
    let names = property_names(branches.first()?);
    let tells = |name: &String| branches.iter().all(|b| property(b, name).is_some_and(|p| p.get("const").is_some()));
    names.into_iter().find(tells)
}

/// The branch whose tag is the one of `node`.
pub(super) fn pick_tagged<'a>(
    branches: &[&'a Schema],
    tag: &str,
    node: &Node,
    path: &KeyPath,
) -> Result<&'a Schema, Issue> {
    let name = |branch: &Schema| property(branch, tag).and_then(texts).and_then(|mut t| t.pop()).unwrap_or_default();
    let names: Vec<String> = branches.iter().map(|branch| name(branch)).collect();
    let here = path.at(tag);
    match node.get(tag).map(|value| &value.item) {
        None => Err(Issue::value(here, format!("missing key `{tag}`")).allowed(listed(&names))),
        Some(Item::Leaf(Value::String(found))) => {
            let unknown = || {
                let linked = here.segments().iter().any(|key| key == "law").then_some(LINKED_LAWS);
                let issue = Issue::value(here, format!("unknown {tag} \"{found}\"")).known(found, &names);
                linked.into_iter().fold(issue, Issue::help)
            };
            branches.iter().zip(&names).find(|(_, name)| *name == found).map(|(b, _)| *b).ok_or_else(unknown)
        }
        Some(_) => Err(Issue::value(here, format!("`{tag}` is not a string")).allowed(listed(&names))),
    }
}

/// A key that does not belong into its table; `peers` are the other forms that the table may take.
pub(super) fn stranger<'a>(
    key: &str,
    here: KeyPath,
    names: &[String],
    peers: &[&Schema],
    mut present: impl Iterator<Item = &'a String>,
) -> Issue {
    let elsewhere = peers.iter().any(|peer| property(peer, key).is_some());
    match present.find(|other| elsewhere && *other != key && *other != "type" && names.contains(other)) {
        Some(other) => Issue::key(here, format!("`{key}` does not go together with `{other}`")).allowed(listed(names)),
        None => Issue::key(here, format!("unknown key `{key}`")).known(key, names),
    }
}

/// Every number below `node` that is not finite.
pub(super) fn infinite(node: &Node, path: &KeyPath) -> Vec<Issue> {
    match &node.item {
        Item::Table(map) => map.iter().flat_map(|(key, child)| infinite(child, &path.at(key))).collect(),
        Item::Array(nodes) => nodes.iter().enumerate().flat_map(|(k, child)| infinite(child, &path.at(k))).collect(),
        Item::Leaf(Value::Float(number)) if !number.is_finite() => {
            let key = path.segments().last().map_or("", String::as_str);
            vec![Issue::value(path.clone(), format!("`{key}` is {number}")).allowed("a finite number")]
        }
        Item::Leaf(_) => vec![],
    }
}

impl Grammar {
    /// A schema in words, for "allowed: ...".
    pub(super) fn describe(&self, schema: &Schema) -> String {
        let schema = self.resolve(schema);
        if let Some(branches) = self.branches(schema) {
            let mut words: Vec<String> = branches.iter().map(|branch| self.describe(branch)).collect();
            words.dedup();
            return words.join(", or ");
        }
        if let Some(names) = texts(schema) {
            return listed(&names);
        }
        if let Some(wanted) = schema.get("const") {
            return wanted.to_string();
        }
        let kinds: Vec<String> = types(schema).into_iter().map(|kind| self.describe_type(kind, schema)).collect();
        if kinds.is_empty() { "any value".into() } else { kinds.join(" or ") }
    }

    fn describe_type(&self, kind: &str, schema: &Schema) -> String {
        match kind {
            "number" => format!("a number{}", bounds(schema)),
            "integer" => format!("an integer{}", bounds(schema)),
            "boolean" => "true or false".into(),
            "array" => self.describe_list(schema),
            "object" => describe_table(schema),
            other => format!("a {other}"),
        }
    }

    fn describe_list(&self, schema: &Schema) -> String {
        let bound = |name: &str| schema.get(name).and_then(Schema::as_u64);
        let count = match (bound("minItems"), bound("maxItems")) {
            (Some(min), Some(max)) if min == max => format!(" of {min}"),
            (Some(min), _) if min > 0 => format!(" of at least {min}"),
            _ => String::new(),
        };
        let entry = item(schema, 0).map_or_else(String::new, |inner| format!(", each {}", self.describe(inner)));
        format!("a list{count}{entry}")
    }
}

fn describe_table(schema: &Schema) -> String {
    let names = property_names(schema);
    match property(schema, "type").and_then(texts) {
        Some(tag) => format!("{{ type = \"{}\", ... }}", tag.join("|")),
        None if names.is_empty() => "a table".into(),
        None => format!("a table with {}", listed(&names)),
    }
}

fn bounds(schema: &Schema) -> String {
    let mut words = vec![];
    for (name, sign) in [("exclusiveMinimum", ">"), ("minimum", ">="), ("exclusiveMaximum", "<"), ("maximum", "<=")] {
        if let Some(bound) = schema.get(name).and_then(Schema::as_f64) {
            words.push(format!(" {sign} {bound}"));
        }
    }
    words.join(" and")
}
