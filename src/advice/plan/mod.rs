//! The cheapest way to compute a scene to a given error, by the fitted models.
//!
//! | file | what it does |
//! |---|---|
//! | `facts.rs` | what a plan must know of a scene |
//! | `predict.rs`, `duct.rs` | the error at a grid, relaxation time and collision |
//! | `options.rs` | all ways within the evidence, with predicted error and time |
//! | `write.rs` | the scene with a way chosen |

pub(crate) mod drag;
pub mod duct;
pub mod facts;
pub mod options;
pub mod predict;
pub mod write;
