//! Changes of a scene on the command line: `--set key=value`.

use psmrt_reference::collision::Preset;
use toml_edit::{DocumentMut, Item, Table, TableLike, Value};

use super::path::{Path, Step};
use super::trouble::SceneError;
use crate::quote::{quoted, shown};

/// Errors if two of the changes, each `key=value`, set the same key.
pub fn differ(changes: &[String]) -> Result<(), Box<SceneError>> {
    let key = |change: &str| change.split_once('=').and_then(|(key, _)| Path::parse(key));
    for (number, second) in changes.iter().enumerate() {
        let same = |first: &&String| key(first).is_some() && key(first) == key(second);
        if let Some(first) = changes[..number].iter().find(same) {
            let (first, second) = (shown(first), shown(second));
            let problem = format!("the same key is set twice: {first} and {second}");
            let remedy = "give it once; --engine and --adapter set engine.kind and engine.adapter";
            return Err(SceneError::whole_file("--set", problem, remedy));
        }
    }
    Ok(())
}

/// The changes that choose a collision in a scene that has no section `collision`.
pub fn preset_changes(preset: Preset) -> Vec<String> {
    let changes: &[&str] = match preset {
        Preset::DHumieres => &[],
        Preset::Srt => &["collision.model=\"srt\""],
        Preset::Trt => &["collision.rates=\"magic\"", "collision.magic=0.1875"],
    };
    changes.iter().map(|&change| change.to_owned()).collect()
}

/// The text of a scene with all changes made. Errors if one of them cannot be made.
pub(super) fn applied(
    mut document: DocumentMut,
    changes: &[String],
) -> Result<String, Box<SceneError>> {
    for change in changes {
        let made = apply(&mut document, change);
        made.map_err(|(problem, remedy)| {
            SceneError::whole_file("--set", format!("{}: {problem}", shown(change)), remedy)
        })?;
    }
    Ok(document.to_string())
}

const REMEDY: &str = "write it as --set fluid.density=998 or --set collision.rates=magic";

/// Makes one change; else says what is wrong, and what to do.
fn apply(document: &mut DocumentMut, change: &str) -> Result<(), (String, String)> {
    let bad = |problem: &str| (problem.to_owned(), REMEDY.to_owned());
    let (key, value) = change.split_once('=').ok_or_else(|| bad("it has no `=`"))?;
    if key.trim().is_empty() {
        return Err(bad("it names no key"));
    }
    let path = Path::parse(key).ok_or_else(|| {
        (format!("{} is no key", quoted(key)), "write grains[0].diameter, say".to_owned())
    })?;
    // What is not a TOML value (a bare word) is taken for text.
    let value =
        value.trim().parse::<Value>().unwrap_or_else(|_| Value::from(value.trim().to_owned()));
    put(document.as_item_mut(), &path, value)?;
    // What the library cannot write where it was put, it leaves out.
    let written = document.to_string().parse::<DocumentMut>();
    let kept = written.as_ref().ok().and_then(|written| path.walk(written.as_item()));
    if kept.map(content) != path.walk(document.as_item()).map(content) {
        return Err(bad("it cannot be written there"));
    }
    Ok(())
}

/// What an item holds, however it is written.
fn content(item: &Item) -> String {
    let of_table = |table: &dyn TableLike| -> String {
        table.iter().map(|(key, item)| format!("{key}: {}, ", content(item))).collect()
    };
    match (item.as_table_like(), item.as_array_of_tables()) {
        (Some(table), _) => of_table(table),
        (None, Some(tables)) => tables.iter().map(|table| of_table(table) + "; ").collect(),
        (None, None) => item.to_string().trim().to_owned(),
    }
}

fn put(root: &mut Item, path: &Path, value: Value) -> Result<(), (String, String)> {
    let bad = |problem: &str, remedy: &str| (problem.to_owned(), remedy.to_owned());
    let sections = "`psmrt schema --markdown` lists the sections; the first is number 0";
    let Some((last, parents)) = path.0.split_last() else { return Ok(()) };
    let mut item = root;
    for step in parents {
        item = match step {
            Step::Name(name) => item
                .as_table_like_mut()
                .map(|table| table.entry(name).or_insert(Item::Table(Table::new()))),
            Step::Number(number) => item.get_mut(number),
        }
        .ok_or_else(|| bad("the scene has no such section", sections))?;
    }
    let in_sections = item.is_array_of_tables();
    let slot = match last {
        Step::Name(name) => {
            item.as_table_like_mut().map(|table| table.entry(name).or_insert(Item::None))
        }
        Step::Number(number) => item.get_mut(number),
    };
    let slot = slot.ok_or_else(|| bad("the scene has no such key", sections))?;
    *slot = match value {
        Value::InlineTable(table) if in_sections => Item::Table(table.into_table()),
        _ if in_sections => {
            let remedy =
                "set one of its keys, as in grains[0].diameter=1e-4, or write {key = value, ...}";
            return Err(bad("that is a section, not a value", remedy));
        }
        value => Item::Value(value),
    };
    Ok(())
}
