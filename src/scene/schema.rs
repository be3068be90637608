//! The JSON schema of scene files, made from the comments in [`super::format`].

use std::sync::LazyLock;

use serde_json::Value;

use super::format::SceneFile;
use crate::advice::stability::limits::Measured;
use psmrt_reference::collision::Preset;
use psmrt_reference::partial_saturation::Weighting;

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

/// The reference: all sections and keys as Markdown, in the order of the schema.
pub fn reference() -> String {
    let root = schema();
    let mut text = String::from(REFERENCE_HEAD);
    let mut sections = vec![(String::new(), root)];
    let mut next = 0;
    while let Some((path, node)) = sections.get(next).cloned() {
        next += 1;
        let title = if path.is_empty() { "The top level".to_owned() } else { format!("`{path}`") };
        text.push_str(&format!("\n## {title}\n\n{}\n\n", description(node)));
        text.push_str("| key | value | needed | meaning |\n|---|---|---|---|\n");
        let needed: Vec<&str> = node["required"]
            .as_array()
            .map_or_else(Vec::new, |names| names.iter().filter_map(Value::as_str).collect());
        for (name, key) in node["properties"].as_object().into_iter().flatten() {
            let kind = Kind::of(root, key);
            if let Kind::Section(inner) | Kind::Sections(inner) = kind {
                let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
                // Faces are alike: one table is enough.
                if !sections.iter().any(|(_, known)| std::ptr::eq(*known, inner)) {
                    sections.push((path, inner));
                }
            }
            let value = kind.words();
            let needed = if needed.contains(&name.as_str()) { "yes" } else { "" };
            let meaning = description(key).replace('|', "\\|");
            text.push_str(&format!("| `{name}` | {value} | {needed} | {meaning} |\n"));
        }
    }
    text.push_str(RECORDS_HEAD);
    for (kind, columns) in crate::output::records::tables() {
        let titles: Vec<String> = columns.iter().map(|column| column.title()).collect();
        text.push_str(&format!("- `{kind}`: {}\n", titles.join(", ")));
    }
    text.push_str(LIMITS_HEAD);
    for tau in [0.501, 0.51, 0.55, 0.6, 1.0] {
        let mut cells = vec![format!("{tau}")];
        let nt = Measured::Bed(Weighting::NobleTorczynski);
        for (measured, model) in [Measured::Fluid, nt]
            .into_iter()
            .flat_map(|m| [(m, Preset::Srt), (m, Preset::DHumieres)])
        {
            let limit = measured.limit_of(model, tau);
            cells.push(limit.map_or_else(String::new, |limit| format!("{}", limit.lives)));
        }
        text.push_str(&format!("| {} |\n", cells.join(" | ")));
    }
    text
}

const LIMITS_HEAD: &str = "
## Up to what velocity a flow is stable

The largest velocity, in cells per time step, at which runs of the maps in `golden/stability` stayed stable: that of
a shear layer, and the superficial velocity through an ordered bed of porosity 0.4. `psmrt check` warns of scenes
beyond. Accuracy ends earlier: errors of compressibility are negligible below 0.05 only.

| tau | shear layer, SRT | shear layer, MRT | bed, SRT | bed, MRT |
|---|---|---|---|---|
";

const RECORDS_HEAD: &str = "
## Columns of the records

All tables begin with `time (s),step`. The superficial velocity is the mean mass flux, grains
included, over the density of the fluid. `spin` is the angular velocity. Force and torque are those of the fluid
(hydrodynamic: viscous stress and pressure) on the grain in the last step; of a grain whose centre lies on a mirror
plane, on the half that is computed. Under a body force G (per volume, [body_force] or from [gravity]) they leave out
the buoyancy in the pressure gradient that G stands for: in a cell in which grains have the weight `B`, G acts on the
share `1 - B` only. `displaced_force` is the rest, `G ΣB` over the cells of the grain at its present position (0
without a body force). Force and displaced force of all grains add up to the driving force of the whole domain, G V,
less the rate of change of the fluid's momentum and the force on walls; in a steady periodic domain the sum is G V to
round-off. Positions of moving grains are not wrapped at periodic faces. Pressure is that above the fluid
at its reference density.
`grain_means` are means and sums over the free grains; contacts are those between grains and with faces,
and the overlap is divided by the mean diameter of the two.

";

const REFERENCE_HEAD: &str = "# Scene files, key by key

Made by `psmrt schema --markdown` from the comments in the code; do not edit. TOML, SI units. What is
absent costs nothing. `psmrt check` says what a scene will be. Scenes to start from: `golden/`.
";

/// What may stand behind a key.
pub(super) enum Kind<'a> {
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
    /// A list of some words.
    Words(Vec<&'a str>),
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
    pub(super) fn of(root: &'a Value, key: &'a Value) -> Self {
        let node = resolve(root, key).unwrap_or(key);
        if node.get("properties").is_some() {
            return Kind::Section(node);
        }
        if let Some(words) = words(node) {
            return Kind::Word(words);
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
                match (node.get("minItems").and_then(Value::as_u64), words(item)) {
                    (Some(count), _) => Kind::Numbers { count, whole },
                    (None, words) => Kind::Words(words.unwrap_or_default()),
                }
            }
            "integer" => Kind::Whole,
            "boolean" => Kind::Switch,
            "string" => Kind::Text,
            "number" => Kind::Number,
            _ => Kind::Other,
        }
    }

    /// In words, for the reference.
    pub(super) fn words(&self) -> String {
        match self {
            Kind::Section(_) => "section".to_owned(),
            Kind::Sections(_) => "sections".to_owned(),
            Kind::Word(words) => listed(words),
            Kind::Numbers { count, .. } => format!("{count} numbers"),
            Kind::Words(words) => format!("list of {}", listed(words)),
            Kind::Number => "number".to_owned(),
            Kind::Whole => "whole number".to_owned(),
            Kind::Switch => "boolean".to_owned(),
            Kind::Text => "text".to_owned(),
            Kind::Other => String::new(),
        }
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

fn description(node: &Value) -> String {
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
        at = resolve(root, at)?.get("properties")?.get(name)?;
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
