//! The cheapest way to compute a scene to a given error, by the fitted models.
//!
//! | file | what it does |
//! |---|---|
//! | `facts.rs` | what a plan must know of a scene |
//! | `options.rs` | all ways within the evidence, with predicted error and time |
//! | `write.rs` | the scene with a way chosen |

pub mod facts;
pub mod options;
pub mod write;
