//! The engine of a scene: on the oracle, or on the kernel where a device is given.

use std::sync::Arc;

use psmrt_reference::lattice::{Populations, Vec3};
use psmrt_reference::setup::Setup;

use super::coupled::{Coupled, Grains};
use super::{FluidEngine, KernelEngine, ReferenceEngine, StartError};
use crate::kernel::Gpu;
use crate::scene::{FreePart, Scene};

/// A scene at its start. With `profiled` it keeps where its time goes, if it can. Errors if the engine cannot
/// take the scene.
pub fn open(scene: &Scene, gpu: Option<&Arc<Gpu>>, profiled: bool) -> Result<Coupled, StartError> {
    let velocity = scene.initial_velocity;
    let mut engine = starting_from(&scene.setup, scene.free.as_ref(), gpu, |_| (1.0, velocity))?;
    if profiled {
        engine.keep_profile();
    }
    Ok(engine)
}

/// A fluid whose density and velocity at each cell centre are `state(centre)`; `free` says how the grains
/// move, if some are free: they are the solids then. Errors if the engine cannot take it.
pub fn starting_from(
    setup: &Setup,
    free: Option<&FreePart>,
    gpu: Option<&Arc<Gpu>>,
    state: impl Fn(Vec3) -> (f64, Vec3),
) -> Result<Coupled, StartError> {
    setup.check()?;
    let mut setup = setup.clone();
    let grains = match free {
        Some(part) => {
            let moving = part.free_grains(&setup.domain)?;
            if let Some(phase) = &mut setup.solid_phase {
                phase.solids = moving.solids();
            }
            Some(Grains { moving, part: part.clone() })
        }
        None => None,
    };
    let is_free = grains.is_some();
    let fluid: Box<dyn FluidEngine> = match gpu {
        None => Box::new(ReferenceEngine::starting_from(setup, is_free, state)?),
        Some(gpu) => Box::new(KernelEngine::starting_from(setup, is_free, gpu, state)?),
    };
    Ok(Coupled::new(fluid, grains))
}

/// A fluid with the given populations, one set per cell, and no free grains. Errors if the engine cannot take
/// it.
///
/// # Panics
/// If there are not as many sets as cells: a mistake in the calling code.
pub fn from_populations(
    setup: &Setup,
    gpu: Option<&Arc<Gpu>>,
    f: Vec<Populations>,
) -> Result<Coupled, StartError> {
    setup.check()?;
    let fluid: Box<dyn FluidEngine> = match gpu {
        None => Box::new(ReferenceEngine::from_populations(setup.clone(), f)?),
        Some(gpu) => Box::new(KernelEngine::from_populations(setup.clone(), gpu, &f)?),
    };
    Ok(Coupled::of_fluid(fluid))
}
