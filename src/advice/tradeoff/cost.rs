//! What a collision costs beside another.

use crate::advice::coefficients::numbers;
use crate::table::TableError;

/// Cost of many relaxation times over that of a single one, on an engine, in a bed.
pub fn mrt_over_srt(engine: &str) -> Result<f64, TableError> {
    let [ratio] = numbers("cost of MRT over SRT", engine)?;
    Ok(ratio)
}
