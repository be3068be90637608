//! What a collision costs beside another.

use crate::advice::coefficients::numbers;
use crate::engine::EngineName;
use crate::table::TableError;

/// Cost of many relaxation times over that of a single one, on an engine, in a bed.
pub fn mrt_over_srt(engine: EngineName) -> Result<f64, TableError> {
    match engine {
        EngineName::Reference | EngineName::Wgpu => {
            let [ratio] = numbers("cost of MRT over SRT", engine.word())?;
            Ok(ratio)
        }
        // To it SRT is MRT with equal rates.
        EngineName::Cpu | EngineName::CpuSingle => Ok(1.0),
    }
}
