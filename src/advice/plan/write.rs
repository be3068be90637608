//! The text of a scene with a way of computing it put in.

use psmrt_reference::collision::Preset;
use std::path::Path;

use toml_edit::{DocumentMut, Item, Table, value};

use super::options::PlanOption;
use crate::advice::tradeoff::model::SolidMethod;
use crate::engine::EngineName;
use crate::scene::Scene;

/// The text of `scene` computed in this way, with `comment` above it; files that it names are looked for
/// in `folder`, in which the scene stood. Errors if the text cannot be read again, which a scene that was
/// loaded can.
pub fn text(
    scene: &Scene,
    folder: &Path,
    option: &PlanOption,
    comment: &str,
) -> Result<String, toml_edit::TomlError> {
    let mut document = scene.text.parse::<DocumentMut>()?;
    domain(&mut document, option);
    let time = section(&mut document, "time");
    for key in ["dt", "lattice_velocity", "reference_velocity"] {
        time.remove(key);
    }
    time.insert("tau", value(option.tau));
    document.remove("collision");
    match option.collision {
        Preset::DHumieres => {}
        Preset::Srt => {
            section(&mut document, "collision").insert("model", value("srt"));
        }
        Preset::Trt => {
            let collision = section(&mut document, "collision");
            collision.insert("rates", value("magic"));
            collision.insert("magic", value(3.0 / 16.0));
        }
    }
    if scene.setup.solid_phase.is_some() {
        // Named, so that the plan stays what it is whatever is chosen where no operator is named.
        let solid = section(&mut document, "solid");
        solid.insert("operator", value(option.solid.operator().word()));
        if option.solid == SolidMethod::Graded {
            solid.remove("weighting");
        }
    }
    let engine = section(&mut document, "engine");
    engine.insert("kind", value(option.engine.kind().word()));
    match option.engine {
        EngineName::CpuSingle => engine.insert("precision", value("single")),
        EngineName::Reference | EngineName::Cpu | EngineName::Wgpu => engine.remove("precision"),
    };
    // What is given in steps stays the same in seconds.
    let si_dt = (option.tau - 0.5) / 3.0 * option.si_dx * option.si_dx
        / (psmrt_reference::lattice::viscosity(scene.setup.collision.tau())
            * scene.units.si_viscosity());
    let steps = |item: &mut Item| {
        if let Some(number) = item.as_integer() {
            let scaled = (number as f64 * scene.units.si_dt / si_dt).round().max(1.0);
            #[expect(clippy::cast_possible_truncation, reason = "numbers of steps")]
            let scaled = scaled as i64;
            *item = value(scaled);
        }
    };
    if let Some(item) = document.get_mut("stop").and_then(|stop| stop.get_mut("steps")) {
        steps(item);
    }
    for table in tables(&mut document, "records") {
        if let Some(item) = table.get_mut("every_steps") {
            steps(item);
        }
    }
    for copy in &scene.attachments {
        let Some(item) = crate::scene::find_mut(document.as_item_mut(), &copy.key) else {
            continue;
        };
        let file = folder.join(item.as_str().unwrap_or_default());
        let file = std::path::absolute(&file).unwrap_or(file);
        *item = value(file.display().to_string());
    }
    let comment: String = comment.lines().map(|line| format!("# {line}\n")).collect();
    Ok(format!("{comment}\n{document}"))
}

fn domain(document: &mut DocumentMut, option: &PlanOption) {
    let domain = section(document, "domain");
    domain.insert("dx", value(option.si_dx));
    if domain.contains_key("cells") {
        let cells = option.cells.iter().map(|&n| i64::try_from(n).unwrap_or(i64::MAX));
        domain.insert("cells", value(cells.collect::<toml_edit::Array>()));
    } else {
        let lengths = option.cells.iter().map(|&n| n as f64 * option.si_dx);
        domain.insert("size", value(lengths.collect::<toml_edit::Array>()));
    }
}

/// A section, made where it is absent.
fn section<'a>(document: &'a mut DocumentMut, name: &str) -> &'a mut dyn toml_edit::TableLike {
    let item = document.entry(name).or_insert(Item::Table(Table::new()));
    if item.as_table_like().is_none() {
        *item = Item::Table(Table::new());
    }
    match item.as_table_like_mut() {
        Some(table) => table,
        None => unreachable!("it was made a table above"),
    }
}

/// The tables of an array of tables; none where it is absent.
fn tables<'a>(document: &'a mut DocumentMut, name: &str) -> Vec<&'a mut Table> {
    let item = document.get_mut(name).and_then(Item::as_array_of_tables_mut);
    item.map_or_else(Vec::new, |array| array.iter_mut().collect())
}
