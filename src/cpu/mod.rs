//! The CPU engine: as fast as memory allows, in single or double precision, on all cores.
//!
//! | file | what it does |
//! |---|---|
//! | `fluid/` | [`Fluid`]: the order of a step, and what may be asked |
//! | `grid.rs` | the populations in memory, updated in place |
//! | `collision/` | the collision of a vector of cells |
//! | `pass.rs` | one pass over a run of cells |
//! | `prefetch.rs` | memory that is asked for before it is needed |
//! | `faces/` | the populations that enter through the faces |
//! | `coverage.rs`, `fields.rs` | what solids cover, run by run |
//! | `rigid.rs`, `received.rs` | how they move, and what they receive |
//! | `grips.rs` | how free solids hold the fluid before a collision |
//! | `observe.rs` | density and momentum of cells, and what a guard sees of them |
//!
//! Results do not depend on the number of threads or the width of the vectors: a run of cells is always the same rows,
//! sums are taken in the order of cells and runs, and a cell is collided alike in every lane.

mod collision;
mod coverage;
mod faces;
mod fields;
mod fluid;
mod grid;
mod grips;
mod observe;
mod pass;
mod prefetch;
mod received;
mod rigid;

pub use fluid::Fluid;
