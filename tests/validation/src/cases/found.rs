//! How figures show what the engines found: the oracle's points filled, the kernel's as wide circles round
//! them, because the two nearly always lie on each other.

use psmrt_report::{Marker, Series, Style};

use psmrt::engine::EngineName;
use psmrt::table::Table;

/// The palette's black.
const BLACK: usize = 6;

/// Points that `engine` found; `kind` says which of several, and may be empty. `colour` is that of the
/// oracle's; by its order where `None`.
pub fn found(kind: &str, engine: &str, points: Vec<(f64, f64)>, colour: Option<usize>) -> Series {
    if engine == EngineName::Reference.word() {
        let label = if kind.is_empty() { engine.to_owned() } else { format!("{kind}, {engine}") };
        return Series { colour, ..Series::points(label, points) };
    }
    let label = format!("{engine}, each");
    Series::new(label, Style::Points(Some(Marker::Halo)), points).with_colour(BLACK)
}

/// Whether the engine of this name computes in double precision.
pub fn is_double(engine: &str) -> bool {
    EngineName::from_word(engine).is_some_and(EngineName::is_double)
}

/// The rows that figures show: the oracle's and those of one engine in single precision, the kernel if it was there. All
/// engines would lie on each other.
pub fn drawn(rows: &Table) -> Table {
    let word = |row: &Vec<String>| row.first().and_then(|word| EngineName::from_word(word));
    let has_kernel = rows.rows.iter().any(|row| word(row) == Some(EngineName::Wgpu));
    let is_shown = |row: &&Vec<String>| match word(row) {
        Some(EngineName::Cpu) => false,
        Some(EngineName::CpuSingle) => !has_kernel,
        Some(EngineName::Reference | EngineName::Wgpu) | None => true,
    };
    Table {
        columns: rows.columns.clone(),
        rows: rows.rows.iter().filter(is_shown).cloned().collect(),
    }
}
