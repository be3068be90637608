//! The engines by name, and the one place that opens them.

use std::sync::Arc;

use psmrt_reference::coupling::CouplingError;
use thiserror::Error;

use super::{Engine, KernelEngine, ReferenceEngine, StartError};
use crate::kernel::Gpu;
use crate::scene::Scene;

/// What computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EngineName {
    /// The oracle.
    Reference,
    /// The kernel.
    Wgpu,
}

impl EngineName {
    /// As tables and `--engine` spell it.
    pub fn word(self) -> &'static str {
        match self {
            EngineName::Reference => "reference",
            EngineName::Wgpu => "wgpu",
        }
    }
}

/// A scene that an engine cannot start.
#[derive(Debug, Error)]
pub enum OpenError {
    /// The oracle refuses it.
    #[error(transparent)]
    Oracle(#[from] CouplingError),
    /// The kernel refuses it, or its device fails.
    #[error(transparent)]
    Kernel(#[from] StartError),
}

/// A scene at its start: on the kernel of the device `gpu`, or on the oracle without one. With `profiled`
/// the kernel keeps where its time goes. Errors if the engine cannot take the scene.
pub fn open(
    scene: &Scene,
    gpu: Option<&Arc<Gpu>>,
    profiled: bool,
) -> Result<Box<dyn Engine>, OpenError> {
    Ok(match gpu {
        None => Box::new(ReferenceEngine::new(scene)?),
        Some(gpu) => Box::new(KernelEngine::new(scene, gpu, profiled)?),
    })
}
