//! The memory that a scene needs, array by array, against what there is.

use psmrt_reference::solids::Solid;

use crate::engine::EngineName;
use crate::machine::{self, Available};
use crate::output::snapshots::BYTES_OF_FIELDS;
use crate::scene::{Scene, What};

/// A share in a covered cell: the list that holds it, room for the four that a list begins with, and the
/// number of the cell (`reference/src/coverage`).
const BYTES_PER_COVERED_CELL: u64 = 24 + 4 * 40 + 8;

/// Contacts, neighbours and motion of a free grain.
const BYTES_PER_FREE_GRAIN: u64 = 2048;

/// What the program needs besides: buffers of files and pictures, and for each thread a stack and what it has
/// at hand.
const BYTES_BESIDES: u64 = 16 << 20;
const BYTES_PER_THREAD: u64 = 4 << 20;

/// A kind of array.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// What it holds.
    pub what: &'static str,
    /// Its size.
    pub bytes: u64,
}

/// The arrays of a scene, at the most at any time of a run.
pub fn parts(scene: &Scene) -> Vec<Part> {
    let cells = scene.setup.domain.cell_count() as u64;
    let engine = EngineName::of(scene).unwrap_or(EngineName::cpu(scene.precision));
    let real = u64::from(engine.bytes_of_number());
    let copies = u64::from(engine.copies());
    let mut parts = Vec::new();
    if !scene.is_dry {
        parts.push(Part { what: "populations", bytes: copies * 19 * real * cells });
    }
    if let Some(phase) = scene.setup.solid_phase.as_ref().filter(|_| !scene.is_dry) {
        let touched: f64 = phase.solids.iter().map(Solid::most_cells).sum();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let touched = (touched as u64).min(2 * cells);
        let bytes = 4 * cells + BYTES_PER_COVERED_CELL * touched;
        parts.push(Part { what: "what grains cover", bytes });
    }
    if let Some(free) = &scene.free {
        let bytes = BYTES_PER_FREE_GRAIN * free.grains.len() as u64;
        parts.push(Part { what: "free grains", bytes });
    }
    let bytes = scene.records.iter().map(|record| of_record(scene, &record.what)).max();
    if let Some(bytes) = bytes.filter(|&bytes| bytes > 0) {
        parts.push(Part { what: "records", bytes });
    }
    parts
}

/// What is needed while one record is taken.
fn of_record(scene: &Scene, what: &What) -> u64 {
    let [nx, ny, nz] = scene.setup.domain.cells().map(|n| n as u64);
    let state = size_of::<crate::engine::CellState>() as u64;
    match *what {
        // The momentum of each cell.
        What::Box => 24 * nx * ny * nz,
        // And the cells of a plane.
        What::Permeability { axis, .. } => {
            24 * nx * ny * nz + (state + 8) * nx * ny * nz / [nx, ny, nz][axis]
        }
        // All values, and of a plane at a time the cells and their numbers.
        What::Fields { .. } => BYTES_OF_FIELDS * nx * ny * nz + (state + 8) * nx * ny,
        // Cells, values, and the picture as text.
        What::Slice { normal, .. } => (state + 128) * nx * ny * nz / [nx, ny, nz][normal],
        What::Profile { axis, .. } => (state + 48) * [nx, ny, nz][axis],
        // Cells of a plane at a time.
        What::Layers { .. } => (state + 8) * nx * ny,
        What::Walls if scene.is_dry => 0,
        What::Walls => (19 * 8 + 8) * (nx * ny).max(nx * nz).max(ny * nz),
        What::Loads | What::Grains | What::GrainMeans | What::ContactMeans | What::Contacts => {
            let grains = scene.setup.solid_phase.as_ref().map_or(0, |phase| phase.solids.len());
            512 * grains as u64
        }
    }
}

/// The sum.
pub fn needed(scene: &Scene) -> u64 {
    parts(scene).iter().map(|part| part.bytes).sum()
}

/// What is wrong and what to do, if the arrays of a scene that the processor computes cannot be had.
pub fn shortage(scene: &Scene) -> Option<(String, &'static str)> {
    let besides = BYTES_BESIDES + BYTES_PER_THREAD * machine::threads() as u64;
    let needed = needed(scene) + besides;
    let (left, limit) = match machine::available() {
        Some(Available { bytes, limit }) if bytes < needed => (mib(bytes), limit),
        // Where the system says nothing beforehand it may still refuse.
        _ if can_be_had(needed) => return None,
        _ => ("less".to_owned(), "the system refuses more".to_owned()),
    };
    let list: Vec<_> =
        parts(scene).iter().map(|part| format!("{} {}", part.what, mib(part.bytes))).collect();
    let [nx, ny, nz] = scene.setup.domain.cells();
    let problem = format!(
        "the domain of {nx} x {ny} x {nz} cells needs {} of memory ({}; {} besides), and {left} can be had \
         ({limit})",
        mib(needed),
        list.join(", "),
        mib(besides)
    );
    let remedy = "end other programs or raise that limit; use a larger `domain.dx` or a smaller box; mirror \
                  planes (`free_slip`) halve it; single precision (engine.precision) needs half as much";
    Some((problem, remedy))
}

/// Whether the system gives so much. Nothing of it is touched, and all of it given back.
fn can_be_had(bytes: u64) -> bool {
    usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok())
}

fn mib(bytes: u64) -> String {
    format!("{:.1} MiB", bytes as f64 / f64::from(1 << 20))
}
