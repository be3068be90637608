//! The JSON schema of scene files, made from the comments in [`super::format`].

use std::sync::LazyLock;

use serde_json::Value;

use super::format::SceneFile;

static SCHEMA: LazyLock<Value> = LazyLock::new(|| {
    let mut schema = schemars::schema_for!(SceneFile).to_value();
    if let Some(object) = schema.as_object_mut() {
        object.insert("title".to_owned(), "psmrt scene".into());
    }
    schema
});

/// The schema, for editors that complete and check TOML.
pub fn schema() -> &'static Value {
    &SCHEMA
}

/// What may stand behind a key.
pub(crate) enum Kind<'a> {
    /// A section, its node.
    Section(&'a Value),
    /// Several sections, their node.
    Sections(&'a Value),
    /// One of some words.
    Word(Vec<&'a str>),
    /// A fixed count of numbers, whole or not.
    Numbers {
        /// How many.
        count: u64,
        /// Whether they are whole.
        whole: bool,
    },
    /// Any count of numbers.
    NumberList,
    /// A list of some words.
    Words(Vec<&'a str>),
    /// Rows of a fixed count of numbers.
    Rows(u64),
    /// A value, or a section that says how it changes in time, its node.
    InTime {
        /// The value.
        value: Box<Kind<'a>>,
        /// The section.
        section: &'a Value,
    },
    /// A number.
    Number,
    /// A whole number.
    Whole,
    /// `true` or `false`.
    Switch,
    /// Text.
    Text,
    /// None of these: left to serde.
    Other,
}

impl<'a> Kind<'a> {
    /// Of the node of a key.
    pub(crate) fn of(root: &'a Value, key: &'a Value) -> Self {
        let node = resolve(root, key).unwrap_or(key);
        if node.get("properties").is_some() {
            return Kind::Section(node);
        }
        if let Some(words) = words(node) {
            return Kind::Word(words);
        }
        if let Some(value) = plain_choice(node) {
            return match section_of(root, node) {
                Some(section) => Kind::InTime { value: Box::new(Kind::of(root, value)), section },
                None => Kind::of(root, value),
            };
        }
        let kind = match &node["type"] {
            Value::Array(kinds) => kinds.first().and_then(Value::as_str).unwrap_or(""),
            kind => kind.as_str().unwrap_or(""),
        };
        match kind {
            "array" => {
                let item = resolve(root, &node["items"]).unwrap_or(&node["items"]);
                if item.get("properties").is_some() {
                    return Kind::Sections(item);
                }
                let whole = item["type"] == "integer";
                if item["type"] == "array" {
                    return Kind::Rows(item["minItems"].as_u64().unwrap_or(0));
                }
                match (node.get("minItems").and_then(Value::as_u64), words(item)) {
                    (Some(count), _) => Kind::Numbers { count, whole },
                    (None, Some(words)) => Kind::Words(words),
                    (None, None) => Kind::NumberList,
                }
            }
            "integer" => Kind::Whole,
            "boolean" => Kind::Switch,
            "string" => Kind::Text,
            "number" => Kind::Number,
            _ => Kind::Other,
        }
    }

    /// That of a value that does not change in time.
    pub(crate) fn plain(self) -> Self {
        match self {
            Kind::InTime { value, .. } => *value,
            kind => kind,
        }
    }

    /// In words, for the reference.
    pub(crate) fn words(&self) -> String {
        match self {
            Kind::Section(_) => "section".to_owned(),
            Kind::Sections(_) => "sections".to_owned(),
            Kind::Word(words) => listed(words),
            Kind::Numbers { count, .. } => format!("{count} numbers"),
            Kind::NumberList => "list of numbers".to_owned(),
            Kind::Words(words) => format!("list of {}", listed(words)),
            Kind::Rows(count) => format!("rows of {count} numbers"),
            Kind::InTime { value, .. } => format!("{}, or section", value.words()),
            Kind::Number => "number".to_owned(),
            Kind::Whole => "whole number".to_owned(),
            Kind::Switch => "boolean".to_owned(),
            Kind::Text => "text".to_owned(),
            Kind::Other => String::new(),
        }
    }
}

/// Of a node that is one of several, that which is no section; `None` where a section or nothing is the only choice.
fn plain_choice(node: &Value) -> Option<&Value> {
    let choices = node.get("anyOf")?.as_array()?;
    choices.iter().find(|choice| choice.get("$ref").is_none() && choice["type"] != "null")
}

/// The section that a node leads to, by way of choices.
fn section_of<'a>(root: &'a Value, node: &'a Value) -> Option<&'a Value> {
    let next = resolve(root, node)?;
    match next.get("properties") {
        Some(_) => Some(next),
        None if std::ptr::eq(next, node) => None,
        None => section_of(root, next),
    }
}

/// The words that an enumeration allows.
fn words<'a>(node: &'a Value) -> Option<Vec<&'a str>> {
    let choices = node.get("oneOf").or_else(|| node.get("enum"))?.as_array()?;
    let word = |choice: &'a Value| choice.get("const").unwrap_or(choice).as_str();
    Some(choices.iter().filter_map(word).collect())
}

fn listed(words: &[&str]) -> String {
    words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ")
}

pub(crate) fn description(node: &Value) -> String {
    node["description"].as_str().unwrap_or("").replace('\n', " ")
}

/// The description of a key given by its dotted path, if there is such a key.
pub fn describe(key: &str) -> Option<String> {
    let root = schema();
    let mut at = root;
    for part in key.split('.') {
        let (name, indexed) = match part.split_once('[') {
            Some((name, _)) => (name, true),
            None => (part, false),
        };
        at = section_of(root, at)?.get("properties")?.get(name)?;
        if indexed {
            at = at.get("items")?;
        }
    }
    let description = at.get("description").or_else(|| resolve(root, at)?.get("description"))?;
    Some(description.as_str()?.replace('\n', " "))
}

/// Follows `$ref`, also inside the `anyOf` of an optional section.
pub(super) fn resolve<'a>(root: &'a Value, node: &'a Value) -> Option<&'a Value> {
    let reference = node
        .get("$ref")
        .or_else(|| node.get("anyOf")?.as_array()?.iter().find_map(|choice| choice.get("$ref")));
    match reference {
        Some(reference) => root.pointer(reference.as_str()?.trim_start_matches('#')),
        None => Some(node),
    }
}
