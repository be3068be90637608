//! The engine of a scene, by its name.

use std::collections::HashSet;
use std::sync::Arc;

use psmrt_reference::coupling::{CouplingError, FreeGrains, is_implicit};
use psmrt_reference::lattice::{Populations, Vec3};
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::Solid;

use super::coupled::{Coupled, Grains};
use super::{
    CpuEngine, DeviceError, EngineName, FluidEngine, KernelEngine, NoFluid, ReferenceEngine,
    StartError,
};
use crate::kernel::Gpu;
use crate::scene::{FreePart, Scene};

/// What a fluid starts from.
pub enum Start<'a> {
    /// Density and velocity at each cell centre, in equilibrium. Whether its solids are free to move, or will be moved:
    /// the cells that they cover then start with them even if all are at rest.
    State {
        /// Density and velocity at a cell centre.
        state: &'a dyn Fn(Vec3) -> (f64, Vec3),
        /// Whether the solids are free, or will be moved.
        is_free: bool,
    },
    /// Populations, one set per cell.
    Populations(&'a [Populations]),
}

/// The list of engines: each makes the fluid of a set-up that has passed its checks. `gpu`: a device that is open
/// already, which need not be opened again.
fn fluid(
    name: EngineName,
    setup: Setup,
    gpu: Option<&Arc<Gpu>>,
    start: &Start<'_>,
) -> Result<Box<dyn FluidEngine>, StartError> {
    Ok(match name {
        EngineName::Reference => Box::new(ReferenceEngine::start(setup, start)?),
        EngineName::Cpu => Box::new(CpuEngine::<f64>::start(setup, start)),
        EngineName::CpuSingle => Box::new(CpuEngine::<f32>::start(setup, start)),
        EngineName::Wgpu => Box::new(KernelEngine::start(setup, &device(gpu, None)?, start)?),
    })
}

/// The device, opened if it is not yet.
fn device(gpu: Option<&Arc<Gpu>>, adapter: Option<&str>) -> Result<Arc<Gpu>, DeviceError> {
    match gpu {
        Some(gpu) => Ok(Arc::clone(gpu)),
        None => Ok(Gpu::open(adapter)?),
    }
}

/// A scene at its start on the engine `name`. Where that computes on a device it is `gpu`, if given, else the scene's
/// adapter is opened; others leave it aside. With `profiled` it keeps where its time goes, if it can. Errors if the
/// engine cannot take the scene.
pub fn open(
    name: EngineName,
    scene: &Scene,
    gpu: Option<&Arc<Gpu>>,
    profiled: bool,
) -> Result<Coupled, StartError> {
    if let Some(part) = &scene.free {
        // Before a device is opened in vain.
        can_couple(&scene.setup, part)?;
    }
    let needs_device = name.needs_device() && !scene.is_dry;
    let gpu = if needs_device { Some(device(gpu, scene.adapter.as_deref())?) } else { None };
    let state = |centre| scene.initial.at(centre);
    let changes = scene.drives.as_ref().is_some_and(|drives| !drives.prescribed.is_empty());
    let is_prescribed = changes || !scene.moving_bodies.is_empty();
    let whole = (&scene.setup, scene.free.as_ref());
    let mut engine = match scene.is_dry {
        true => without_fluid(name, whole)?,
        false => begin(name, whole, gpu.as_ref(), state, is_prescribed)?,
    };
    engine.move_bodies(&scene.moving_bodies);
    if let Some(drives) = &scene.drives {
        engine.follow(drives.clone())?;
    }
    if profiled {
        engine.keep_profile();
    }
    Ok(engine)
}

/// Puts the solids that are grains where these are. Errors if they are no solids, each one of its own.
fn place_grains(
    part: &FreePart,
    moving: &FreeGrains,
    solids: &mut [Solid],
) -> Result<(), StartError> {
    let grains = moving.solids();
    let mut known = HashSet::new();
    for (grain, &solid) in part.solids.iter().enumerate() {
        if solid >= solids.len() || !known.insert(solid) || grain >= grains.len() {
            return Err(StartError::NoSolid { grain, solid, solids: solids.len() });
        }
    }
    if let Some(grain) = (part.solids.len()..grains.len()).next() {
        return Err(StartError::NoSolid { grain, solid: grain, solids: part.solids.len() });
    }
    part.solids.iter().zip(grains).for_each(|(&number, grain)| solids[number] = grain);
    Ok(())
}

/// Errors unless the grains can be coupled as the operator of the solids asks.
fn can_couple(setup: &Setup, part: &FreePart) -> Result<(), CouplingError> {
    let is_averaged = is_implicit(setup) && part.settings.average_loads;
    if is_averaged { Err(CouplingError::Averaged) } else { Ok(()) }
}

/// A fluid whose density and velocity at each cell centre are `state(centre)`; `free` says how the grains
/// move, if some are free, and which of the solids they are. `gpu` as for [`open`], but any adapter will do. Errors if the
/// engine cannot take it.
pub fn starting_from(
    name: EngineName,
    setup: &Setup,
    free: Option<&FreePart>,
    gpu: Option<&Arc<Gpu>>,
    state: impl Fn(Vec3) -> (f64, Vec3),
) -> Result<Coupled, StartError> {
    begin(name, (setup, free), gpu, state, false)
}

/// The same; `can_move`: whether solids may move that are at rest, and not free.
fn begin(
    name: EngineName,
    (setup, free): (&Setup, Option<&FreePart>),
    gpu: Option<&Arc<Gpu>>,
    state: impl Fn(Vec3) -> (f64, Vec3),
    can_move: bool,
) -> Result<Coupled, StartError> {
    let (setup, grains) = with_grains(setup, free)?;
    let start = Start::State { state: &state, is_free: can_move || grains.is_some() };
    Ok(Coupled::new(fluid(name, setup, gpu, &start)?, grains))
}

/// Free grains alone, whatever engine is to compute: they are the same above every one.
fn without_fluid(
    name: EngineName,
    (setup, free): (&Setup, Option<&FreePart>),
) -> Result<Coupled, StartError> {
    let (setup, grains) = with_grains(setup, free)?;
    Ok(Coupled::new(Box::new(NoFluid::new(name, setup)), grains))
}

/// A set-up that has passed its checks with the free grains as solids, and these.
fn with_grains(
    setup: &Setup,
    free: Option<&FreePart>,
) -> Result<(Setup, Option<Grains>), StartError> {
    setup.check()?;
    let mut setup = setup.clone();
    let Some(part) = free else { return Ok((setup, None)) };
    can_couple(&setup, part)?;
    let moving = part.free_grains(&setup.domain)?;
    let solids = setup.solid_phase.as_mut().map(|phase| &mut phase.solids);
    place_grains(part, &moving, solids.unwrap_or(&mut Vec::new()))?;
    Ok((setup, Some(Grains { moving, part: part.clone() })))
}

/// A fluid with the given populations, one set per cell, and no free grains. `gpu` as for [`starting_from`]. Errors if
/// the engine cannot take it.
///
/// # Panics
/// If there are not as many sets as cells: a mistake in the calling code.
pub fn from_populations(
    name: EngineName,
    setup: &Setup,
    gpu: Option<&Arc<Gpu>>,
    f: &[Populations],
) -> Result<Coupled, StartError> {
    setup.check()?;
    Ok(Coupled::of_fluid(fluid(name, setup.clone(), gpu, &Start::Populations(f))?))
}
