//! What a run says at its end: the last values of its records, and whether its flow is steady.

use serde_json::{Map, Value as Json, json};

use crate::engine::Coupled;
use crate::output::records::{box_row, force_row, profile_rows, seepage_now};
use crate::output::walls::{self, FaceForces};
use crate::output::{contacts, grain_means};
use crate::run::End;
use crate::run::steady::value_of;
use crate::scene::columns::{
    BOX_COLUMNS, CONTACT_MEAN_COLUMNS, Column, FORCE_COLUMNS, GRAIN_MEAN_COLUMNS,
    PERMEABILITY_COLUMNS,
};
use crate::scene::{Scene, What};

/// The values of the records that are numbers, as they are now: by the name of the record, then by its column.
/// Of `loads` the forces, summed over the grains; of a profile its largest speed.
pub(super) fn results(scene: &Scene, engine: &Coupled) -> Json {
    let mut all = Map::new();
    for record in &scene.records {
        let values: Vec<(Column, f64)> = match &record.what {
            What::Box => pairs(&BOX_COLUMNS, &box_row(scene, engine)),
            What::GrainMeans => pairs(&GRAIN_MEAN_COLUMNS, &grain_means::row(scene, engine)),
            What::ContactMeans => pairs(&CONTACT_MEAN_COLUMNS, &contacts::row(scene, engine)),
            What::Loads => pairs(&FORCE_COLUMNS, &force_row(scene, engine)),
            What::Permeability { axis, si_gravity } => {
                let found = seepage_now(scene, engine, (*axis, *si_gravity));
                pairs(&PERMEABILITY_COLUMNS, &found.row())
            }
            What::Profile { axis, through } => {
                let rows = profile_rows(scene, engine, *axis, *through);
                let speed = rows.iter().map(|row| row[2].hypot(row[3]).hypot(row[4]));
                vec![(Column::new("max_speed", "m/s"), speed.fold(0.0, f64::max))]
            }
            What::Layers { .. }
            | What::Walls
            | What::Fields { .. }
            | What::Slice { .. }
            | What::Grains
            | What::Contacts => continue,
        };
        let values = values.into_iter().map(|(column, value)| (column.title(), json!(value)));
        all.insert(record.name.clone(), Json::Object(values.collect()));
    }
    Json::Object(all)
}

fn pairs(columns: &[Column], values: &[f64]) -> Vec<(Column, f64)> {
    columns.iter().copied().zip(values.iter().copied()).collect()
}

/// The same in words, a line a record; empty if there is none.
pub(super) fn to_text(scene: &Scene, engine: &Coupled) -> String {
    let width = scene.records.iter().map(|record| record.name.len()).max().unwrap_or(0);
    let mut lines = Vec::new();
    for record in &scene.records {
        let words = match &record.what {
            What::Box => {
                let [density, x, y, z, most] = box_row(scene, engine);
                format!(
                    "superficial velocity {} m/s, at most {most:.4e} m/s in a cell, density {density:.3} kg/m3",
                    vector([x, y, z])
                )
            }
            What::GrainMeans => {
                let row = grain_means::row(scene, engine);
                let [.., contacts, overlap] = row;
                format!(
                    "mean velocity of the free grains {} m/s, {contacts} contacts, largest overlap {overlap:.1e} diameters",
                    vector([row[3], row[4], row[5]])
                )
            }
            What::Permeability { axis, si_gravity } => {
                let found = seepage_now(scene, engine, (*axis, *si_gravity));
                format!(
                    "superficial velocity {:.4e} m/s, hydraulic gradient {:.4e}",
                    found.si_velocity,
                    found.hydraulic_gradient()
                )
            }
            What::Loads => format!("force on all grains {} N", vector(force_row(scene, engine))),
            What::Walls => {
                let of_grains = |forces: &FaceForces| {
                    let size = forces.grains.iter().map(|f| f * f).sum::<f64>().sqrt();
                    (size > 0.0).then(|| format!("{} {}", forces.face, vector(forces.grains)))
                };
                let forces = walls::forces(scene, engine);
                let all: Vec<String> = forces.iter().filter_map(of_grains).collect();
                if all.is_empty() {
                    continue;
                }
                format!("forces of grains on faces: {} N", all.join(", "))
            }
            What::ContactMeans => {
                let [contacts, coordination, ..] = contacts::row(scene, engine);
                format!("{contacts} contacts between grains, {coordination:.2} contacts a grain")
            }
            What::Profile { .. }
            | What::Layers { .. }
            | What::Fields { .. }
            | What::Slice { .. }
            | What::Grains
            | What::Contacts => continue,
        };
        lines.push(format!("  {:<width$}  {words}", record.name));
    }
    lines.join("\n")
}

/// Components of which those that are rounding beside the largest are 0.
fn vector(components: [f64; 3]) -> String {
    let most = components.into_iter().map(f64::abs).fold(0.0, f64::max);
    let word = |value: f64| match value.abs() > 1e-9 * most {
        true => format!("{value:.4e}"),
        false => "0".to_owned(),
    };
    format!("({})", components.map(word).join(", "))
}

/// How the criterion of the scene has ended, if it has one. What is still to go is null where it is not known,
/// or where the changes do not slow down.
pub(super) fn steady(scene: &Scene, engine: &Coupled, end: End) -> Json {
    let Some(steady) = &scene.stop.steady else { return Json::Null };
    let left = if let End::Steady { left } | End::NotSteady { left } = end { left } else { None };
    json!({
        "met": matches!(end, End::Steady { .. }),
        "record": scene.records[steady.record].name,
        "column": steady.column(&scene.records).title(),
        "value": value_of(scene, engine, steady),
        "tolerance": steady.tolerance,
        "left": left.filter(|left| left.is_finite()),
        "slows_down": left.map(f64::is_finite),
    })
}

/// What is wrong with a run that its limit has ended before it was steady, and what helps; `None` of others.
pub(super) fn not_steady(scene: &Scene, engine: &Coupled, end: End) -> Option<String> {
    let (End::NotSteady { left }, Some(steady)) = (end, &scene.stop.steady) else { return None };
    let record = &scene.records[steady.record].name;
    let column = steady.column(&scene.records);
    let (value, tolerance) = (value_of(scene, engine, steady), steady.tolerance);
    let what = format!("NOT steady: {} of {record} is {value:.4e} {}", column.name, column.unit);
    let longer = "let it run longer (stop.time, stop.steps), or allow more (stop.steady.tolerance)";
    Some(match left {
        Some(left) if left.is_finite() => format!(
            "{what} and has {left:.1e} of itself still to go, {:.2} times the tolerance of {tolerance:.1e}; {longer}",
            left / tolerance
        ),
        Some(_) => format!("{what} and changes without slowing down; {longer}"),
        None if value == 0.0 => {
            format!("{what}, of which no share is a tolerance; watch a column that does not vanish")
        }
        None => {
            format!(
                "{what}, and its rows are too few to tell more; {longer}, or take rows more often"
            )
        }
    })
}
