//! Speed for accuracy, measured: what each knob of a scene does to the error and to the cost, on flows
//! with known answers.
//!
//! | file | what it does |
//! |---|---|
//! | `knobs.rs`, `sweep.rs` | the knobs, and which of their settings are run |
//! | `setting.rs`, `measure.rs` | knobs become a scene; a run becomes a row |
//! | `storage.rs` | the oracle with populations kept in fewer digits |
//! | `record.rs` | rows in a file that grows and can be gone on with |
//! | `front.rs` | runs that no other beats in cost and error |
//! | `evidence.rs`, `evidence_low.rs`, `fit.rs` | the committed rows that models are fitted to, and how |
//! | `model.rs`, `model_eps.rs`, `model_low.rs` | error models, fitted to them |
//! | `cost.rs`, `effects.rs` | what a cell update costs; what one knob alone does |
//! | `figures.rs`, `tables.rs` | what is shown |
//! | `trial.rs`, `support.rs` | what was held back from the fits, and what stands behind a prediction |

pub mod cost;
pub mod effects;
pub mod evidence;
pub mod evidence_low;
pub mod figures;
pub mod fit;
pub mod front;
pub mod knobs;
pub mod measure;
pub mod model;
pub mod model_eps;
pub mod model_low;
pub mod record;
pub mod setting;
pub mod storage;
pub mod support;
pub mod sweep;
pub mod tables;
pub mod trial;

/// Processor and threads, for a column of a table.
pub fn machine_words() -> String {
    let processor = crate::machine::processor().unwrap_or_else(|| "unknown processor".to_owned());
    format!("{} x {}", crate::machine::threads(), processor.replace(',', " "))
}
