//! What computes a scene.
//!
//! | file | what it does |
//! |---|---|
//! | `fluid.rs` | [`FluidEngine`]: what is asked of whatever computes the fluid |
//! | `coupled.rs`, `state.rs` | [`Coupled`]: a fluid engine with what is the same above every one: free grains, prescribed motion, guard, profile, saved state |
//! | `bodies.rs` | bodies of any shape that move as prescribed |
//! | `name.rs`, `open.rs` | [`EngineName`]; [`open`]: the engine of a scene by its name; the list of engines |
//! | `reference.rs`, `cpu.rs`, `wgpu.rs` | the oracle, the CPU engine and the kernel as fluid engines |
//! | `no_fluid.rs` | what stands there in a scene without fluid |
//! | `free_state.rs`, `bytes.rs` | free grains, and numbers, as bytes |

mod block;
mod bodies;
mod bytes;
mod coupled;
mod cpu;
mod driven;
mod fluid;
pub mod free_state;
mod name;
mod no_fluid;
mod open;
mod reference;
mod state;
mod wgpu;

use std::error::Error;
use std::sync::Arc;

use psmrt_reference::coupling::CouplingError;
use psmrt_reference::drive::DriveError;
use psmrt_reference::grains::setup::GrainError;
use psmrt_reference::setup::SetupError;
use thiserror::Error;

use crate::bodies::moving::BodyStop;
use crate::diagnosis::ExplainedStop;

pub use block::Block;
pub use coupled::{Coupled, Profile};
pub use cpu::CpuEngine;
pub use fluid::{BoxMeans, CellState, FluidEngine};
pub use name::EngineName;
pub use no_fluid::{NoFluid, WithoutFluid};
pub use open::{Start, from_populations, open, starting_from};
pub use reference::ReferenceEngine;
pub use wgpu::KernelEngine;

/// What a fluid engine computes on has failed, or cannot hold the scene.
#[derive(Clone, Debug, Error)]
#[error(transparent)]
pub struct DeviceError(Arc<dyn Error + Send + Sync>);

impl DeviceError {
    /// From the error of whatever kind of device it is.
    pub fn new(error: impl Error + Send + Sync + 'static) -> Self {
        DeviceError(Arc::new(error))
    }
}

/// What an engine cannot take: a scene to start from, or a drive.
#[derive(Debug, Error)]
pub enum StartError {
    /// The set-up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The grains.
    #[error(transparent)]
    Grains(#[from] GrainError),
    /// A grain that is none of the solids.
    #[error(
        "grain {grain} is to be solid {solid} of {solids} (counted from 0): each grain must be a solid of its own"
    )]
    NoSolid {
        /// Number of the grain.
        grain: usize,
        /// The solid that it is to be.
        solid: usize,
        /// How many solids there are.
        solids: usize,
    },
    /// Averaged loads of free grains that are coupled implicitly.
    #[error(transparent)]
    Coupling(#[from] CouplingError),
    /// The drive.
    #[error(transparent)]
    Drive(#[from] DriveError),
    /// The device.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

/// Why an engine cannot go on.
#[derive(Debug, Error)]
pub enum EngineStop {
    /// The guard of the fluid has stopped it.
    #[error(transparent)]
    Broken(#[from] Box<ExplainedStop>),
    /// A body that moves as prescribed has run into something.
    #[error(transparent)]
    Body(#[from] BodyStop),
    /// The free grains cannot be moved.
    #[error(transparent)]
    Grains(#[from] GrainError),
    /// The device has failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
}
