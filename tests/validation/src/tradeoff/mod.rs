//! Speed for accuracy, measured: what each parameter of a scene does to the error and to the cost, on flows
//! with known answers. The error models that rest on it are the product's, `psmrt::advice::tradeoff`.
//!
//! | file | what it does |
//! |---|---|
//! | `parameters.rs`, `row.rs` | the parameters of a run, and the run as a row of a table |
//! | `sweep.rs` | which settings of the parameters are run |
//! | `setting.rs`, `measure.rs` | parameters become a scene; a run becomes a row |
//! | `storage.rs` | the oracle with populations kept in fewer digits |
//! | `record.rs` | rows in a file that grows and can be gone on with |
//! | `front.rs` | runs that no other beats in cost and error |
//! | `cost.rs`, `effects.rs` | what a cell update costs; what one parameter alone does |
//! | `evidence.rs`, `evidence_low.rs`, `evidence_tight.rs` | the runs that error models are fitted to |
//! | `fit.rs`, `fitting.rs`, `trial.rs` | the fits, and what was held back from them |
//! | `operators.rs` | the operators of the solid beside each other |
//! | `coefficients.rs` | what the product predicts by, made from all this |
//! | `figures.rs`, `tables.rs` | what is shown |

pub mod coefficients;
pub mod cost;
pub mod effects;
pub mod evidence;
pub mod evidence_low;
pub mod evidence_tight;
pub mod figures;
pub mod fit;
pub mod fitting;
pub mod measure;
pub mod operators;
pub mod parameters;
pub mod pareto;
pub mod record;
pub mod row;
pub mod setting;
pub mod storage;
pub mod sweep;
pub mod tables;
pub mod trial;

/// Processor and threads, for a column of a table.
pub fn machine_words() -> String {
    let processor = psmrt::machine::processor().unwrap_or_else(|| "unknown processor".to_owned());
    format!("{} x {}", psmrt::machine::threads(), processor.replace(',', " "))
}
