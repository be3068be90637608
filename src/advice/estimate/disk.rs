//! How much a run will write: rows and pictures times their sizes, and the checkpoints. What is compressible or
//! depends on the flow is taken at its largest, so that a run writes no more than this.

use std::path::Path;

use super::warning::Warning;
use crate::engine::EngineName;
use crate::machine::free_bytes;
use crate::output::records::columns;
use crate::scene::format_run::FieldFormat;
use crate::scene::{OutputInterval, Record, Scene, What};

/// Nobody writes more than this without having thought of it.
const MUCH: f64 = 1e12;

/// A number in a table, `-1.2345678901234567e-10`, and its comma.
const TEXT_NUMBER: f64 = 24.0;

/// A cell of a picture, where each neighbour has another colour.
const PICTURE_CELL: f64 = 110.0;

/// The frame of a picture, and an outline.
const PICTURE: f64 = 15e3;
const OUTLINE: f64 = 1500.0;

/// What stands before the numbers in the files of a record, each time.
const HEADS: f64 = 3e3;

/// A grain in a file for ParaView: 23 numbers in double precision, and two of the lists of points.
const GRAIN_POINT: f64 = 25.0 * 8.0;

/// A contact in such a file: 13 numbers, and three of the lists of lines. In the densest packing each of two grains has
/// twelve contacts.
const CONTACT_LINE: f64 = 16.0 * 8.0;
const CONTACTS_OF_GRAIN: f64 = 6.0;

/// Faces of a domain.
const FACES: f64 = 6.0;

/// A grain in a checkpoint: its motion, its load and a few contacts.
const GRAIN_STATE: f64 = 1000.0;

/// Checkpoints that may be there at a time: two are kept, one is being written.
const CHECKPOINTS: f64 = 3.0;

/// A picture of curves: its frame; then all its curves at a time, or all marks and lines of a profile in a cell.
const CHART: f64 = 30e3;
const CHART_ROW: f64 = 8.0 * 24.0;
const CHART_CELL: f64 = 3.0 * 200.0;

/// What a run says about itself, and its locks.
const FACTS: f64 = 8e3;

/// Bytes that the run writes at most, if no limit but its steps ends it.
pub fn bytes(scene: &Scene) -> f64 {
    let records: f64 = scene.records.iter().map(|record| of_record(scene, record)).sum();
    let lists: usize = scene.attachments.iter().map(|list| list.bytes.len()).sum();
    let copies = (scene.text.len() + lists) as f64;
    // A table and a picture; a point for each cell and for the exact curve.
    let cells = scene.setup.domain.cells().into_iter().max().unwrap_or(0) as f64;
    let compared = match scene.exact {
        Some(_) => 4.0 * TEXT_NUMBER * cells + CHART + CHART_CELL * cells,
        None => 0.0,
    };
    records + checkpoints(scene) + compared + copies + FACTS
}

fn of_record(scene: &Scene, record: &Record) -> f64 {
    let times = match record.interval {
        OutputInterval::Every(interval) => (scene.stop.steps / interval) as f64 + 1.0,
        OutputInterval::AtEnd => 1.0,
    };
    let columns = columns(record).map_or(0, |columns| columns.len());
    let picture = match record.what {
        What::Profile { axis, .. } => CHART + CHART_CELL * scene.setup.domain.cells()[axis] as f64,
        _ if columns > 0 => CHART + CHART_ROW * times,
        _ => 0.0,
    };
    HEADS + times * at_a_time(scene, &record.what, columns) + picture
}

/// Bytes of a record each time.
fn at_a_time(scene: &Scene, what: &What, columns: usize) -> f64 {
    let cells = scene.setup.domain.cells().map(|n| n as f64);
    let all = cells.iter().product::<f64>();
    let solids = scene.setup.solid_phase.as_ref().map_or(0, |phase| phase.solids.len()) as f64;
    let row = columns as f64 * TEXT_NUMBER;
    match what {
        What::Box | What::GrainMeans | What::ContactMeans | What::Permeability { .. } => row,
        What::Layers { count, .. } => row * *count as f64,
        What::Walls => row * FACES,
        What::Contacts => HEADS + CONTACT_LINE * CONTACTS_OF_GRAIN * solids,
        What::Profile { axis, .. } => row * cells[*axis],
        What::Loads => row * solids,
        What::Grains => HEADS + GRAIN_POINT * solids,
        What::Slice { normal, .. } => {
            PICTURE + PICTURE_CELL * all / cells[*normal] + OUTLINE * solids
        }
        What::Fields { formats } => {
            // Pressure, velocity, and the solid fraction where there are solids.
            let values = if scene.setup.solid_phase.is_some() { 5.0 } else { 4.0 };
            let size = |format: &FieldFormat| match format {
                FieldFormat::Vti => 4.0,
                FieldFormat::Npy => 8.0,
            };
            HEADS + formats.iter().map(size).sum::<f64>() * values * all
        }
    }
}

fn checkpoints(scene: &Scene) -> f64 {
    let engine = EngineName::of(scene).unwrap_or(EngineName::cpu(scene.precision));
    let population = f64::from(engine.bytes_of_number());
    let solids = scene.setup.solid_phase.as_ref().map_or(0, |phase| phase.solids.len()) as f64;
    let cells = if scene.is_dry { 0.0 } else { scene.setup.domain.cell_count() as f64 };
    CHECKPOINTS * (19.0 * population * cells + GRAIN_STATE * solids)
}

/// Whether that is more than fits where `folder` is, or will be; or very much.
pub fn warnings(scene: &Scene, folder: &Path) -> Vec<Warning> {
    let needed = bytes(scene);
    let most =
        scene.records.iter().max_by(|a, b| of_record(scene, a).total_cmp(&of_record(scene, b)));
    let most = most.map_or(String::new(), |record| {
        format!(", {} of it by the record {}", words(of_record(scene, record)), record.name)
    });
    let reason = match free_bytes(folder) {
        Some(free) if needed > free as f64 => {
            format!(
                "the run may write {}{most}; {} are free there",
                words(needed),
                words(free as f64)
            )
        }
        _ if needed > MUCH => format!("the run may write {}{most}", words(needed)),
        _ => return Vec::new(),
    };
    let remedy =
        "take records less often (`every`), shorten the run, or write to a larger disk (`--out`)";
    vec![Warning { reason, remedy: remedy.to_owned() }]
}

/// Bytes in words.
pub fn words(bytes: f64) -> String {
    const UNITS: [&str; 5] = ["bytes", "kB", "MB", "GB", "TB"];
    let mut scaled = (bytes, 0);
    while scaled.0 >= 1000.0 && scaled.1 + 1 < UNITS.len() {
        scaled = (scaled.0 / 1000.0, scaled.1 + 1);
    }
    match scaled.1 {
        0 => format!("{bytes:.0} bytes"),
        unit => format!("{:.1} {}", scaled.0, UNITS[unit]),
    }
}
