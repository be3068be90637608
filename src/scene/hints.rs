//! What to write instead of a key, a word or a section that a scene cannot have.

use serde_json::Value as Node;
use toml_edit::{Item, TableLike, Value};

use super::schema::{Kind, describe, schema};
use super::synonyms::{key_of, words_of};
use crate::quote::shown;

/// Sections to paste.
const EXAMPLES: [(&str, &str); 16] = [
    ("domain", "[domain]\ndx = 1e-5            # m, the edge of a cell\ncells = [40, 20, 20]"),
    ("fluid", "[fluid]\ndensity = 998.0       # kg/m3\nkinematic_viscosity = 1e-6  # m2/s"),
    ("time", "[time]\ntau = 0.8             # relaxation time in time steps\n# or dt, in s"),
    ("stop", "[stop]\ntime = 0.01           # s\n# or steps = 10000"),
    (
        "stop.steady",
        "[stop.steady]\nrecord = \"box\"        # a record with `every` or `every_steps`\n\
         column = \"superficial_velocity_x\"\ntolerance = 1e-6",
    ),
    ("faces", "[faces]\ny_low.kind = \"wall\"\ny_high.kind = \"wall\""),
    ("body_force", "[body_force]\nacceleration = [0.01, 0.0, 0.0]  # m/s2"),
    ("gravity", "[gravity]\nacceleration = [0.0, 0.0, -9.81]  # m/s2"),
    ("initial", "[initial]\nvelocity = [1e-3, 0.0, 0.0]  # m/s"),
    (
        "grains",
        "[[grains]]\nkind = \"sphere\"\ncentre = [2e-4, 1e-4, 1e-4]  # m\ndiameter = 1e-4       # m",
    ),
    (
        "grains.columns",
        "[grains.columns]\nx = \"X [mm]\"         # the names in the first line of the file\ny = \"Y [mm]\"\n\
         z = \"Z [mm]\"\nradius = \"R [mm]\"\nlengths_in = 1e-3     # m",
    ),
    ("records", "[[records]]\nname = \"box\"\nkind = \"box\"\nevery_steps = 100"),
    ("checkpoint", "[checkpoint]\nevery_minutes = 10.0"),
    ("engine", "[engine]\nkind = \"reference\""),
    ("compare", "[compare]\nexact = \"plane_poiseuille\""),
    ("collision", "[collision]\nmodel = \"mrt\""),
];

/// Lines of a section to paste.
pub(super) fn example(key: &str) -> String {
    // `grains[2].columns` is `grains.columns` of the last `[[grains]]` above.
    let plain: String = key.split(['[', ']']).step_by(2).collect();
    match EXAMPLES.iter().find(|(name, _)| *name == plain) {
        Some((_, lines)) => (*lines).to_owned(),
        None => format!("[{key}]\n# its keys: psmrt schema --markdown"),
    }
}

/// What to add.
pub(super) fn missing(key: &str, name: &str) -> String {
    if EXAMPLES.iter().any(|(section, _)| *section == key) {
        return format!("add the section, for example\n{}", example(key));
    }
    match describe(key) {
        Some(description) => format!("add `{name}`: {description}"),
        None => format!("add `{name}`"),
    }
}

/// What to write instead of the key `name` of the section `node` at `path`.
pub(super) fn unknown_key(
    table: &dyn TableLike,
    node: &Node,
    path: &str,
    name: &str,
    found: &Item,
) -> String {
    let known: Vec<&str> =
        node["properties"].as_object().into_iter().flatten().map(|(k, _)| k.as_str()).collect();
    if let Some(remedy) = another_quantity(table, &known, name, found) {
        return remedy;
    }
    let all = known.join(", ");
    if let Some(key) = key_of(name, &known) {
        return format!("psmrt calls it `{key}` (known: {all})");
    }
    let elsewhere = places_of(name, path);
    if (1..=4).contains(&elsewhere.len()) {
        return format!("did you mean `{}`? (known here: {all})", elsewhere.join("` or `"));
    }
    suggestion(name, &known)
}

/// A quantity that psmrt takes in another form, with the value where it can be computed.
fn another_quantity(
    table: &dyn TableLike,
    known: &[&str],
    name: &str,
    found: &Item,
) -> Option<String> {
    let has = |key: &str| known.contains(&key);
    let given = found.as_value().and_then(number);
    let written = |key: &str, value: Option<f64>, unit: &str| match value {
        Some(value) if value > 0.0 && value.is_finite() => format!("write `{key} = {value:e}`"),
        _ => format!("write `{key} = ...` in {unit}"),
    };
    match name.to_lowercase().as_str() {
        "dynamic_viscosity" | "viscosity" | "mu" | "eta" if has("kinematic_viscosity") => {
            let density = table.get("density").and_then(Item::as_value).and_then(number);
            let kinematic = given.zip(density).map(|(dynamic, density)| dynamic / density);
            let write = written("kinematic_viscosity", kinematic, "m2/s");
            let doubt = if name == "viscosity" { "if it is the dynamic one (Pa s), " } else { "" };
            Some(format!("{doubt}divide by the density: kinematic = dynamic / density; {write}"))
        }
        "radius" if has("diameter") => {
            let write = written("diameter", given.map(|radius| 2.0 * radius), "m");
            Some(format!("give the diameter, twice the radius: {write}"))
        }
        "porosity" if has("solid_fraction") => {
            let write = written("solid_fraction", given.map(|porosity| 1.0 - porosity), "1");
            Some(format!("give the solid fraction, 1 - porosity: {write}"))
        }
        _ => None,
    }
}

fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

/// Other sections that have a key `name`, as `--set` takes them.
fn places_of(name: &str, here: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut sections = vec![(String::new(), schema())];
    let mut next = 0;
    while let Some((path, node)) = sections.get(next).cloned() {
        next += 1;
        for (key, inner) in node["properties"].as_object().into_iter().flatten() {
            let full = join(&path, key);
            let indexed = here.split('[').next() == Some(path.trim_end_matches("[0]"));
            if key == name && (!indexed || path.is_empty()) {
                found.push(full.clone());
            }
            let (full, inner) = match Kind::of(schema(), inner) {
                Kind::Section(inner) => (full, inner),
                Kind::Sections(inner) => (full + "[0]", inner),
                _ => continue,
            };
            // Faces are alike: the first stands for all.
            if !sections.iter().any(|(_, known)| std::ptr::eq(*known, inner)) {
                sections.push((full, inner));
            }
        }
    }
    found
}

/// What to write instead of a word that is not among the `known`.
pub(super) fn unknown_word(found: &str, known: &[&str]) -> String {
    let all = known.join(", ");
    if known.contains(&"pressure") && key_of(found, &["non_reflecting"]).is_some() {
        return "write `kind = \"pressure\"` and `non_reflecting = true`".to_owned();
    }
    match words_of(found, known).as_slice() {
        [] => suggestion(found, known),
        [word] => format!("psmrt calls it \"{word}\" (known: {all})"),
        several => {
            let several: Vec<String> = several.iter().map(|word| format!("\"{word}\"")).collect();
            format!("psmrt has {} (known: {all})", several.join(" and "))
        }
    }
}

/// "did you mean" if a known name is close, and all that are known.
fn suggestion(name: &str, known: &[&str]) -> String {
    let lower = name.to_lowercase();
    let all = known.join(", ");
    // Distances to long text take long, and mean nothing.
    let closest = known
        .iter()
        .filter(|candidate| lower.len() <= 3 * candidate.len())
        .map(|candidate| (strsim::damerau_levenshtein(&lower, candidate), candidate))
        .min_by_key(|(distance, _)| *distance);
    match closest {
        Some((distance, candidate)) if distance <= (name.len() / 3).max(1) => {
            format!("did you mean `{candidate}`? (known: {all})")
        }
        _ => format!("known are: {all}"),
    }
}

/// The key of the section `node` that a value was meant for, with the value as that key takes it; `None`
/// if no key or more than one takes it.
pub(super) fn key_for(found: &Item, node: &Node) -> Option<(String, String)> {
    let value = found.as_value()?;
    let takes = |inner: &Node| match (Kind::of(schema(), inner).plain(), value) {
        (Kind::Word(known), Value::String(text)) => {
            let word = text.value().as_str();
            let meant = if known.contains(&word) { vec![word] } else { words_of(word, &known) };
            meant.first().map(|word| format!("\"{word}\""))
        }
        (Kind::Numbers { count, .. }, Value::Array(list)) if list.len() as u64 == count => {
            Some(value.to_string().trim().to_owned())
        }
        (Kind::Number, Value::Integer(_) | Value::Float(_)) | (Kind::Whole, Value::Integer(_)) => {
            Some(value.to_string().trim().to_owned())
        }
        _ => None,
    };
    let keys = node["properties"].as_object()?;
    let mut fitting: Vec<(String, String)> =
        keys.iter().filter_map(|(key, inner)| Some((key.clone(), shown(&takes(inner)?)))).collect();
    let needed = |key: &str| {
        node["required"].as_array().is_some_and(|list| list.iter().any(|name| name == key))
    };
    match fitting.iter().position(|(key, _)| needed(key)) {
        Some(first) => Some(fitting.swap_remove(first)),
        None if fitting.len() == 1 => fitting.pop(),
        None => None,
    }
}

/// The full name of a key.
pub(super) fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
}
