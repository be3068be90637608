//! What a scene will cost, whether it survives and how wrong it will be, before it runs: what `psmrt check` and
//! `psmrt plan` say. It reads scenes and never runs one.

pub mod coefficients;
pub mod estimate;
pub mod plan;
pub mod stability;
pub mod tradeoff;
