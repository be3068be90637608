//! Error models of scenes, and the runs that they rest on. The sweep that made these runs is in
//! `tests/validation`.
//!
//! | file | what it does |
//! |---|---|
//! | `parameters.rs`, `row.rs` | the parameters of a run, and the run as a row of a table |
//! | `evidence.rs`, `evidence_low.rs`, `fit.rs` | the committed rows that models are fitted to, and how |
//! | `model.rs`, `model_eps.rs`, `model_low.rs` | error models, fitted to them |
//! | `cost.rs` | what a collision costs |
//! | `trial.rs`, `support.rs` | what was held back from the fits, and what stands behind a prediction |

pub mod cost;
pub mod evidence;
pub mod evidence_low;
pub mod fit;
pub mod model;
pub mod model_eps;
pub mod model_low;
pub mod parameters;
pub mod row;
pub mod support;
pub mod trial;
