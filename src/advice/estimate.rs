//! What can be told about a scene before it runs: derived numbers, which models are on, what it
//! will cost, and what looks risky.
//!
//! | file | what it does |
//! |---|---|
//! | `numbers.rs` | the derived numbers |
//! | `disk.rs` | how much it will write |
//! | `models.rs` | which models are on, each with the reason |
//! | `grains.rs` | both for free grains, and what their warnings rest on |
//! | `spheres.rs` | the spheres of a scene, and how much of each the domain holds |
//! | `bed.rs` | where they lie densest |
//! | `velocity.rs` | how fast it will be |
//! | `speed.rs` | how long it takes, measured on its first steps |
//! | `warnings.rs`, `warnings/` | what looks risky, one topic a file |

pub(crate) mod bed;
pub mod disk;
pub(crate) mod grains;
pub mod memory;
mod models;
mod numbers;
pub mod speed;
pub(crate) mod spheres;
pub(crate) mod velocity;
pub(crate) mod warnings;

use psmrt_reference::solids::Solid;
use serde::Serialize;

pub use self::models::models;
pub use self::numbers::numbers;
pub use self::speed::calibrate;
pub(crate) use self::velocity::si_velocity;
pub(crate) use self::warnings::accuracy::subject;
pub use self::warnings::warnings;
use crate::scene::Scene;

/// A derived number.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Number {
    /// What it is.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// Its unit; empty for a bare number.
    pub unit: &'static str,
    /// What it is taken from, or what is good.
    pub note: String,
}

/// Something that may go wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Warning {
    /// What and why.
    pub reason: String,
    /// What to do about it.
    pub remedy: String,
}

fn number(name: &'static str, value: f64, unit: &'static str, note: impl Into<String>) -> Number {
    Number { name, value, unit, note: note.into() }
}

/// Diameters in cells, smallest and largest, if there are grains.
fn diameters(scene: &Scene) -> Option<(f64, f64)> {
    let solids = &scene.setup.solid_phase.as_ref()?.solids;
    let all = solids.iter().map(Solid::diameter);
    let (low, high) = all.fold((f64::INFINITY, 0.0_f64), |(l, h), d| (l.min(d), h.max(d)));
    (high > 0.0).then_some((low, high))
}
