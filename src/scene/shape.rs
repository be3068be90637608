//! The shape of a scene: whether its sections, keys and types are those of the schema. Done before serde
//! reads it, whose errors know neither units nor sections, and which takes the first three of four values.

use std::ops::Range;

use serde_json::Value as Node;
use toml_edit::{Item, TableLike, Value};

use super::hints::{self, join};
use super::schema::{Kind, describe, schema};
use crate::quote::{quoted, shown};

/// What does not fit, and where.
pub(super) struct Misfit {
    pub key: String,
    pub span: Option<Range<usize>>,
    pub problem: String,
    pub remedy: String,
}

/// Errors at the first thing that is not as the schema has it.
pub(super) fn check(scene: &dyn TableLike) -> Result<(), Misfit> {
    section(scene, schema(), "")
}

fn section(table: &dyn TableLike, node: &Node, path: &str) -> Result<(), Misfit> {
    for (name, found) in table.iter() {
        let key = join(path, name);
        match node["properties"].get(name) {
            Some(wanted) => item(found, Kind::of(schema(), wanted), &key)?,
            None => {
                let span = table.get_key_value(name).and_then(|(key, _)| key.span());
                let section = match path {
                    "" => "a scene".to_owned(),
                    path => format!("section `{}`", shown(path)),
                };
                let problem = format!("{section} has no key `{}`", shown(name));
                let remedy = hints::unknown_key(table, node, path, name, found);
                return Err(Misfit { key, span, problem, remedy });
            }
        }
    }
    let needed = node["required"].as_array().map_or(&[] as &[Node], Vec::as_slice);
    match needed.iter().filter_map(Node::as_str).find(|name| !table.contains_key(name)) {
        None => Ok(()),
        Some(name) => {
            let key = join(path, name);
            let remedy = hints::missing(&key, name);
            Err(Misfit { key, span: None, problem: "it is missing".to_owned(), remedy })
        }
    }
}

fn item(found: &Item, wanted: Kind, key: &str) -> Result<(), Misfit> {
    match (wanted, found) {
        (Kind::Section(node), _) => match found.as_table_like() {
            Some(table) => section(table, node, key),
            None => Err(no_section(found, node, key)),
        },
        (Kind::Sections(node), Item::ArrayOfTables(tables)) => {
            let mut numbered = tables.iter().enumerate();
            numbered.try_for_each(|(i, table)| section(table, node, &format!("{key}[{i}]")))
        }
        (Kind::Sections(node), Item::Value(Value::Array(values))) => {
            for (i, value) in values.iter().enumerate() {
                let key = format!("{key}[{i}]");
                match value.as_inline_table() {
                    Some(table) => section(table, node, &key)?,
                    None => return Err(no_sections(value.span(), &key)),
                }
            }
            Ok(())
        }
        (Kind::Sections(_), _) => Err(no_sections(found.span(), key)),
        (Kind::InTime { value: plain, section: node }, _) => match found.as_table_like() {
            Some(table) => section(table, node, key),
            None => item(found, *plain, key),
        },
        (wanted, Item::Value(found)) => value(found, &wanted, key),
        (wanted, _) => {
            let problem = "it is a value, not a section".to_owned();
            let remedy = format!("write `{} = ...`: {}", last(key), meaning(key, &wanted));
            Err(Misfit { key: key.to_owned(), span: found.span(), problem, remedy })
        }
    }
}

/// A value where a section should be, or several sections where one should be.
fn no_section(found: &Item, node: &Node, key: &str) -> Misfit {
    let name = last(key);
    let (problem, remedy) = if matches!(found, Item::ArrayOfTables(_)) {
        ("there can be only one such section".to_owned(), format!("write [{key}]"))
    } else {
        let problem = "it is a section with keys of its own, not a value".to_owned();
        let remedy = match hints::key_for(found, node) {
            Some((inner, value)) => format!("write `{name}.{inner} = {value}`"),
            None => format!("write the section, for example\n{}", hints::example(key)),
        };
        (problem, remedy)
    };
    Misfit { key: key.to_owned(), span: found.span(), problem, remedy }
}

/// Something else where `[[sections]]` should be.
fn no_sections(span: Option<Range<usize>>, key: &str) -> Misfit {
    let name = key.split('[').next().unwrap_or(key);
    let problem = "there may be several of these sections: their name stands in double brackets";
    let remedy = format!("write [[{name}]], for example\n{}", hints::example(name));
    Misfit { key: key.to_owned(), span, problem: problem.to_owned(), remedy }
}

fn value(found: &Value, wanted: &Kind, key: &str) -> Result<(), Misfit> {
    let misfit = |problem: String, remedy: String| {
        Err(Misfit { key: key.to_owned(), span: found.span(), problem, remedy })
    };
    let meaning = || meaning(key, wanted);
    match wanted {
        Kind::Word(known) => match found.as_str() {
            Some(word) => self::word(word, known, key, found.span()),
            None => misfit("it is a word in quotation marks".to_owned(), words(known)),
        },
        Kind::Words(known) => match found.as_array() {
            Some(list) => list.iter().try_for_each(|value| match value.as_str() {
                Some(word) => self::word(word, known, key, value.span()),
                None => misfit("its entries are words in quotation marks".to_owned(), words(known)),
            }),
            None => {
                let remedy = match found.as_str() {
                    Some(word) if known.contains(&word) => format!("write [\"{word}\"]"),
                    _ => words(known),
                };
                misfit("it is a list of words in brackets".to_owned(), remedy)
            }
        },
        Kind::Numbers { count, whole } => {
            let (size, shape) = match count {
                2 => ("two values", "[low, high]"),
                3 => ("three values", "[x, y, z]"),
                _ => ("a list of values", "[...]"),
            };
            let Some(list) = found.as_array() else {
                return misfit(format!("it needs {size} {shape}, and is one value"), meaning());
            };
            if list.len() as u64 != *count {
                let given = list.len();
                let problem = format!("it needs {size} {shape}; {given} are given");
                return misfit(problem, meaning());
            }
            list.iter().try_for_each(|value| match number(value, *whole) {
                Ok(()) => Ok(()),
                Err((problem, remedy)) => Err(Misfit {
                    key: key.to_owned(),
                    span: value.span(),
                    problem: format!("each of its {size} is a number: this {problem}"),
                    remedy: remedy.unwrap_or_else(meaning),
                }),
            })
        }
        Kind::NumberList => {
            let Some(list) = found.as_array() else {
                return misfit("it is a list of numbers in brackets".to_owned(), meaning());
            };
            list.iter().try_for_each(|value| {
                number(value, false).map_err(|(problem, remedy)| Misfit {
                    key: key.to_owned(),
                    span: value.span(),
                    problem: format!("each of its entries is a number: this {problem}"),
                    remedy: remedy.unwrap_or_else(meaning),
                })
            })
        }
        Kind::Rows(count) => {
            let is_row = |row: &Value| {
                let list = row.as_array().filter(|list| list.len() as u64 == *count);
                list.is_some_and(|list| list.iter().all(|value| number(value, false).is_ok()))
            };
            let rows = found.as_array();
            match rows.map(|rows| rows.iter().find(|row| !is_row(row))) {
                Some(None) => Ok(()),
                Some(Some(row)) => Err(Misfit {
                    key: key.to_owned(),
                    span: row.span(),
                    problem: format!(
                        "each of its rows has {count} numbers in brackets: this has not"
                    ),
                    remedy: meaning(),
                }),
                None => misfit(format!("it is a list of rows of {count} numbers"), meaning()),
            }
        }
        Kind::Number | Kind::Whole => match number(found, matches!(wanted, Kind::Whole)) {
            Ok(()) => Ok(()),
            Err((problem, remedy)) => {
                misfit(format!("it {problem}"), remedy.unwrap_or_else(meaning))
            }
        },
        Kind::Switch if !found.is_bool() => {
            misfit("it must be true or false".to_owned(), meaning())
        }
        Kind::Text if !found.is_str() => {
            misfit("it must be text in quotation marks".to_owned(), meaning())
        }
        _ => Ok(()),
    }
}

/// Errors unless a value is a number: what it must be, and a remedy if one is plain.
fn number(found: &Value, whole: bool) -> Result<(), (String, Option<String>)> {
    let must = |what: &str| format!("must be {what}");
    match found {
        Value::Integer(_) => Ok(()),
        Value::Float(_) if !whole => Ok(()),
        Value::Float(value) => {
            let near = value.value().round();
            let remedy = (near.abs() < 1e15).then(|| format!("write {near}"));
            Err((must("a whole number"), remedy))
        }
        Value::String(text) => {
            let bare = text.value().trim();
            let is_number = if whole { bare.parse::<i64>().is_ok() } else { is_toml_number(bare) };
            let remedy = is_number.then(|| format!("leave out the quotation marks: {bare}"));
            Err((must(if whole { "a whole number" } else { "a number" }), remedy))
        }
        _ => Err((must(if whole { "a whole number" } else { "a number" }), None)),
    }
}

fn is_toml_number(text: &str) -> bool {
    matches!(text.parse::<Value>(), Ok(Value::Integer(_) | Value::Float(_)))
}

fn word(found: &str, known: &[&str], key: &str, span: Option<Range<usize>>) -> Result<(), Misfit> {
    if known.contains(&found) {
        return Ok(());
    }
    let problem = format!("{} is not known here", quoted(found));
    let remedy = hints::unknown_word(found, known);
    Err(Misfit { key: key.to_owned(), span, problem, remedy })
}

fn words(known: &[&str]) -> String {
    let quoted: Vec<String> = known.iter().map(|word| format!("\"{word}\"")).collect();
    format!("write one of {}", quoted.join(", "))
}

/// What the key is, from the schema.
fn meaning(key: &str, wanted: &Kind) -> String {
    match describe(key) {
        Some(description) => format!("`{}` is: {description}", last(key)),
        None => format!("give a {}", wanted.words()),
    }
}

fn last(key: &str) -> &str {
    key.rsplit('.').next().unwrap_or(key)
}
