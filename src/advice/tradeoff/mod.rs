//! Error models of scenes, by the numbers of `src/advice/coefficients.csv`. The sweep that these were fitted to, and the
//! fits, are in `tests/validation`.
//!
//! | file | what it does |
//! |---|---|
//! | `model.rs`, `model_eps.rs`, `model_low.rs`, `model_tight.rs` | error models |
//! | `models.rs` | all of them together |
//! | `runs.rs` | runs with known answers |
//! | `cost.rs` | what a collision costs |
//! | `support.rs` | what stands behind a prediction |

pub mod cost;
pub mod model;
pub mod model_eps;
pub mod model_low;
pub mod model_tight;
pub mod models;
pub mod runs;
pub mod support;
