//! The production kernel: the fluid, and the solids' part in it, on any GPU, in single precision.
//!
//! | file | what it does |
//! |---|---|
//! | `device.rs`, `quiet.rs` | adapters, and the device opened on one |
//! | `layout.rs`, `field.rs`, `table.rs`, `memory.rs`, `buffers.rs` | where the populations lie; whether they fit |
//! | `compose.rs`, `pipeline.rs` | shaders with what the scene names and nothing else |
//! | `bindings.rs` | the number of every binding |
//! | `wgsl/moments.wgsl` | collision, with one relaxation time or many, and the solid part |
//! | `driven.rs`, `driving.rs`, `wgsl/drive.wgsl` | the body force and the face values of a step |
//! | `streaming.rs` | streaming and faces, as WGSL |
//! | `solids.rs`, `touches.rs` | the solids on the device |
//! | `movable.rs`, `covering.rs`, `wgsl/{cover,fraction,resolve}.wgsl` | what movable solids cover, found on the device |
//! | `coverage.rs` | the same in double precision, where none can move and for the velocities that covered cells start with |
//! | `gathered.rs`, `wgsl/{gather,loads,grips}.wgsl`, `wgsl/moments_kept.wgsl` | force and torque on each solid, and how it holds the fluid, always added up in the same order |
//! | `fluid.rs`, `steps.rs`, `observed.rs`, `state.rs` | [`Kernel`]: how it starts, its steps, what can be seen, what is saved |
//!
//! The populations are kept as they are after a collision, less their weights, direction by direction,
//! in two copies. A step reads one copy and writes the other: 152 bytes per cell update. What is seen
//! from outside is the state before the next collision, as in the oracle.
//!
//! **Architecture invariant:** of the oracle this takes words for set-ups only (directions, domain,
//! solids, which models are on). Weights, equilibria, collision, faces and coverage are its own, so
//! that each checks the other. `tests/suite/tidy.rs` holds this.
//!
//! **Decisions.** Pulling from one copy and writing the other lets every face rule read what the oracle's reads. Cells at
//! faces and, where few cells are solid, solid cells are listed and computed again with the rules that they need. One
//! workgroup a solid adds up `B_s (j - ρ u_s)`, which is what a solid receives with either operator, in a fixed order.
//! Cells inside fixed solids are not skipped: the oracle collides them too, and skipping them would save 5 % only.

mod bindings;
mod buffers;
mod compose;
mod coverage;
mod covering;
mod device;
mod driven;
mod driving;
mod error;
mod field;
mod fluid;
mod fractions;
mod gathered;
mod layout;
mod memory;
mod movable;
mod numbers;
mod observed;
mod outgoing;
mod pipeline;
mod quiet;
mod solids;
mod state;
mod steps;
mod streaming;
mod table;
mod touches;
mod watch;

pub use device::{AdapterFacts, Gpu, adapters};
pub use error::KernelError;
pub use fluid::Kernel;
pub use fractions::solid_fractions_on_device;
pub use observed::Summary;
pub use watch::KernelTimes;
