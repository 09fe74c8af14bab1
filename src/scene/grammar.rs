//! Structure of a scene: the JSON schema that `asperity schema` prints, walked against the tree of what was written.
//!
//! One declaration (the structs of `spec`) thus yields the reader, the schema, and messages with exact places: every
//! unknown or missing key, wrong type and number out of range is found in one go, also inside tagged tables, where serde
//! itself would report the first one only, at the head of the table. Understood are the keywords that schemars emits:
//! `$ref`, `type`, `const`, `enum`, `anyOf`, `oneOf`, `properties`, `required`, `additionalProperties`, `items`,
//! `prefixItems`, `minItems`, `maxItems`, `minimum`, `maximum`, `exclusiveMinimum`, `exclusiveMaximum`.

use serde_json::Value as Schema;
use toml::Value;

use super::issue::{Issue, KeyPath};
use super::schema::{
    admits, constant, in_range, infinite, item, pick_tagged, property, property_names, required, stranger, tag, texts,
};
use super::tree::{Item, Node};

/// The JSON schema of a scene, ready to be walked.
#[derive(Clone, Debug)]
pub struct Grammar {
    root: Schema,
    anything: Schema,
}

/// What a schema says of one more key.
#[derive(Debug)]
pub(super) enum Step<'a> {
    /// A declared key or an entry of a list.
    Known(&'a Schema),
    /// A name chosen by the user, e.g. of a body.
    Name(&'a Schema),
    /// Not described here.
    Open,
    /// Not allowed; the keys that are.
    Unknown(Vec<String>),
}

impl Grammar {
    /// A grammar from a JSON schema.
    pub fn new(root: Schema) -> Self {
        Self { root, anything: Schema::Bool(true) }
    }

    /// The schema itself.
    pub fn root(&self) -> &Schema {
        &self.root
    }

    /// The schema of what is not described.
    pub(super) fn anything(&self) -> &Schema {
        &self.anything
    }

    /// Everything about the structure of `tree` that does not fit the schema.
    pub(super) fn check(&self, tree: &Node) -> Vec<Issue> {
        let mut issues = vec![];
        self.walk(&self.root, tree, &KeyPath::default(), &mut issues);
        issues
    }

    /// Where `key` leads from `node`, which is described by `schema`.
    pub(super) fn step<'a>(&'a self, schema: &'a Schema, node: &Node, key: &str) -> Step<'a> {
        let schema = self.resolve(schema);
        if let Some(branches) = self.branches(schema) {
            return match self.pick(&branches, node, &KeyPath::default()) {
                Ok(branch) => self.step(branch, node, key),
                Err(_) => self.step_any(&branches, key),
            };
        }
        if let Some(inner) = property(schema, key) {
            return Step::Known(inner);
        }
        if let (Item::Array(_), Some(inner)) = (&node.item, item(schema, key.parse().unwrap_or(0))) {
            return Step::Known(inner);
        }
        match schema.get("additionalProperties") {
            Some(Schema::Bool(false)) => Step::Unknown(property_names(schema)),
            Some(inner @ Schema::Object(_)) => Step::Name(inner),
            _ => Step::Open,
        }
    }

    /// As `step` where the node does not tell which branch is meant.
    fn step_any<'a>(&'a self, branches: &[&'a Schema], key: &str) -> Step<'a> {
        let mut names: Vec<String> = branches.iter().flat_map(|b| property_names(b)).collect();
        names.sort();
        names.dedup();
        let known = branches.iter().find_map(|branch| property(branch, key));
        known.map_or(Step::Unknown(names), Step::Known)
    }

    fn walk(&self, schema: &Schema, node: &Node, path: &KeyPath, issues: &mut Vec<Issue>) {
        let schema = self.resolve(schema);
        if let Some(branches) = self.branches(schema) {
            match self.pick(&branches, node, path) {
                Ok(branch) => self.walk_branch(branch, &branches, node, path, issues),
                Err(issue) => issues.push(issue),
            }
            return;
        }
        if !admits(schema, node) {
            issues.push(self.unfit(&[schema], node, path));
            return;
        }
        match &node.item {
            Item::Table(_) => self.walk_table(schema, &[], node, path, issues),
            Item::Array(nodes) => self.walk_array(schema, nodes, path, issues),
            Item::Leaf(value) => issues.extend(self.leaf(schema, value, node, path)),
        }
    }

    fn walk_branch(&self, branch: &Schema, all: &[&Schema], node: &Node, path: &KeyPath, issues: &mut Vec<Issue>) {
        match &node.item {
            Item::Table(_) => self.walk_table(branch, all, node, path, issues),
            _ => self.walk(branch, node, path, issues),
        }
    }

    fn walk_table(&self, schema: &Schema, peers: &[&Schema], node: &Node, path: &KeyPath, issues: &mut Vec<Issue>) {
        let Item::Table(map) = &node.item else { return };
        for key in required(schema).filter(|key| !map.contains_key(*key)) {
            let missing = Issue::value(path.at(key), format!("missing key `{key}`"));
            let allowed = property(schema, key).map_or_else(String::new, |inner| self.describe(inner));
            issues.push(missing.allowed(allowed));
        }
        for (key, child) in map {
            let here = path.at(key);
            match self.step(schema, node, key) {
                Step::Known(inner) | Step::Name(inner) => self.walk(inner, child, &here, issues),
                Step::Open => issues.extend(infinite(child, &here)),
                Step::Unknown(names) => issues.push(stranger(key, here, &names, peers, map.keys())),
            }
        }
    }

    fn walk_array(&self, schema: &Schema, nodes: &[Node], path: &KeyPath, issues: &mut Vec<Issue>) {
        let bound = |name| schema.get(name).and_then(Schema::as_u64);
        let count = nodes.len() as u64;
        if bound("minItems").is_some_and(|min| count < min) || bound("maxItems").is_some_and(|max| count > max) {
            let message = format!("a list of {count} entries has the wrong length");
            issues.push(Issue::value(path.clone(), message).allowed(self.describe(schema)));
            return;
        }
        for (k, node) in nodes.iter().enumerate() {
            match item(schema, k) {
                Some(inner) => self.walk(inner, node, &path.at(k), issues),
                None => issues.extend(infinite(node, &path.at(k))),
            }
        }
    }

    /// Constants, closed sets, ranges and finiteness.
    fn leaf(&self, schema: &Schema, value: &Value, node: &Node, path: &KeyPath) -> Option<Issue> {
        if let Some(issue) = infinite(node, path).pop() {
            return Some(issue);
        }
        let fits = match value {
            Value::String(text) => texts(schema).is_none_or(|names| names.contains(text)),
            Value::Integer(number) => in_range(schema, *number as f64) && constant(schema, *number),
            Value::Float(number) => in_range(schema, *number),
            _ => true,
        };
        (!fits).then(|| self.unfit(&[schema], node, path))
    }

    /// The branch of a choice that is meant by `node`.
    fn pick<'a>(&self, branches: &[&'a Schema], node: &Node, path: &KeyPath) -> Result<&'a Schema, Issue> {
        let fitting: Vec<&Schema> = branches.iter().copied().filter(|branch| admits(branch, node)).collect();
        if fitting.len() < 2 {
            return fitting.first().copied().ok_or_else(|| self.unfit(branches, node, path));
        }
        if let Item::Leaf(value) = &node.item {
            let fits = |b: &&&Schema| self.leaf(b, value, node, path).is_none();
            return fitting.iter().find(fits).copied().ok_or_else(|| self.unfit(branches, node, path));
        }
        if let Some(tag) = tag(&fitting) {
            return pick_tagged(&fitting, &tag, node, path);
        }
        let score = |branch: &&Schema| {
            let known = property_names(branch).iter().filter(|name| node.get(name).is_some()).count();
            (known, std::cmp::Reverse(required(branch).filter(|name| node.get(name).is_none()).count()))
        };
        // `max_by_key` takes the last of equals, the first declared branch is the plainest
        fitting.iter().rev().copied().max_by_key(score).ok_or_else(|| self.unfit(branches, node, path))
    }

    fn unfit(&self, branches: &[&Schema], node: &Node, path: &KeyPath) -> Issue {
        let key = path.segments().last().map_or("scene", String::as_str);
        let issue = Issue::value(path.clone(), format!("`{key}` is {}", node.found()));
        let names: Vec<String> = branches.iter().filter_map(|b| texts(b)).flatten().collect();
        match &node.item {
            Item::Leaf(Value::String(text)) if !names.is_empty() => issue.known(text, &names),
            _ => {
                let texts: Vec<String> = branches.iter().map(|branch| self.describe(branch)).collect();
                issue.allowed(texts.join(", or "))
            }
        }
    }

    /// Follows references.
    pub(super) fn resolve<'a>(&'a self, schema: &'a Schema) -> &'a Schema {
        let pointer = schema.get("$ref").and_then(Schema::as_str).and_then(|r| r.strip_prefix('#'));
        match pointer.and_then(|pointer| self.root.pointer(pointer)) {
            Some(target) => self.resolve(target),
            None => schema,
        }
    }

    /// The alternatives of a choice, flattened; TOML has no null, so "nothing" is left out.
    pub(super) fn branches<'a>(&'a self, schema: &'a Schema) -> Option<Vec<&'a Schema>> {
        let choices = schema.get("anyOf").or_else(|| schema.get("oneOf"))?.as_array()?;
        let mut flat = vec![];
        for choice in choices.iter().map(|choice| self.resolve(choice)) {
            match self.branches(choice) {
                Some(inner) => flat.extend(inner),
                None if choice.get("type").is_some_and(|kind| kind == "null") => {}
                None => flat.push(choice),
            }
        }
        Some(flat)
    }
}
