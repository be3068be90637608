//! What can be told about a scene before it runs: derived numbers, which models are on, what it
//! will cost, and what looks risky.
//!
//! | file | what it does |
//! |---|---|
//! | `numbers.rs`, `number.rs` | the derived numbers |
//! | `disk.rs` | how much it will write |
//! | `models.rs` | which models are on, each with the reason |
//! | `grains.rs` | both for free grains, and what their warnings rest on |
//! | `seepage.rs` | gradient, Re and time to steadiness of a bed that fluid seeps through |
//! | `contacts.rs` | how they touch, by either law |
//! | `velocity.rs`, `mapped.rs` | how fast it will be, and with which map of stability it compares |
//! | `speed.rs` | how long it takes, measured on its first steps |
//! | `warnings.rs`, `warnings/`, `warning.rs` | what looks risky, one topic a file |

mod contacts;
pub mod disk;
pub(crate) mod grains;
pub(crate) mod mapped;
pub mod memory;
mod models;
mod number;
mod numbers;
mod seepage;
pub mod speed;
pub(crate) mod velocity;
pub(crate) mod warning;
pub(crate) mod warnings;

pub use self::models::{models, operator};
pub use self::number::Number;
pub use self::numbers::numbers;
pub use self::speed::calibrate;
pub use self::warning::Warning;
pub(crate) use self::warnings::accuracy::{outlook, subject};
pub use self::warnings::warnings;
