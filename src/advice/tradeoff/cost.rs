//! What a collision costs beside another, from the committed figures.

use psmrt_reference::collision::Preset;

use crate::table::{Table, TableError};

/// The committed figures, part of the program.
const COMMITTED: &str = include_str!("../../../golden/tradeoff/cost.csv");

/// Cost of many relaxation times over that of a single one, on an engine, in a bed: from the committed
/// figures.
pub fn mrt_over_srt(engine: &str) -> Result<f64, TableError> {
    let costs = Table::parse("golden/tradeoff/cost.csv", COMMITTED)?;
    let of = |collision: Preset| {
        let wanted = [("engine", engine), ("collision", collision.word()), ("scene", "bed")];
        costs.with(&wanted)?.number("ns_per_cell_update")
    };
    Ok(of(Preset::DHumieres)? / of(Preset::Srt)?)
}
