//! The kernel as an engine: the fluid on a device in single precision, free grains on the processor in
//! double precision.

use std::cell::RefCell;
use std::io::{self, Read, Write};
use std::sync::Arc;

use psmrt_reference::coupling::{CoupledStop, FreeGrains, Gravity, with_displaced};
use psmrt_reference::directions::{C, Q};
use psmrt_reference::grains::setup::GrainError;
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::guard::{Evidence, Guard, Sight};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::{Setup, SetupError};
use psmrt_reference::solids::{Load, Solid};
use thiserror::Error;

use super::bytes::{expect, put_real, put_vector, put_whole, real, vector, whole};
use super::{BoxMeans, CellState, Engine, EngineStop, free_state};
use crate::kernel::{Beginning, Gpu, Kernel, KernelError, KernelTimes, Spent, Summary};
use crate::scene::{FreePart, Scene};

/// A scene that the kernel cannot start.
#[derive(Debug, Error)]
pub enum StartError {
    /// The set-up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The grains.
    #[error(transparent)]
    Grains(#[from] GrainError),
    /// The device.
    #[error(transparent)]
    Device(#[from] KernelError),
}

/// Where the time has gone.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Profile {
    /// Steps that it covers.
    pub steps: u64,
    /// On the device, and the lists of what solids cover.
    pub kernel: KernelTimes,
    /// Moving the free grains.
    pub grains: Spent,
}

/// The fluid on a device.
#[derive(Debug)]
pub struct KernelEngine {
    kernel: Kernel,
    grains: Option<(FreeGrains, FreePart)>,
    guard: Guard,
    steps: u64,
    /// The first failure while something was observed.
    failure: RefCell<Option<KernelError>>,
    profile: Option<Profile>,
}

/// A grain further off than cells can be numbered is as lost as one that is nowhere: between two looks of the
/// guard a load that has broken throws a light grain so far.
const FARTHEST: f64 = 2_147_483_648.0;

impl KernelEngine {
    /// The scene at its start. With `profiled` the device is waited for after each part of a step, so
    /// that each gets its own time. Errors if the device cannot hold the scene.
    pub fn new(scene: &Scene, gpu: &Arc<Gpu>, profiled: bool) -> Result<Self, StartError> {
        let velocity = scene.initial_velocity;
        let mut engine =
            Self::starting_from(&scene.setup, scene.free.as_ref(), gpu, |_| (1.0, velocity))?;
        engine.kernel.keep_times(profiled);
        engine.profile = profiled.then(Profile::default);
        Ok(engine)
    }

    /// A fluid whose density and velocity at each cell centre are `state(centre)`; `free` says how the
    /// grains of the set-up move, if some are free. Errors if the device cannot hold it.
    pub fn starting_from(
        setup: &Setup,
        free: Option<&FreePart>,
        gpu: &Arc<Gpu>,
        state: impl Fn(Vec3) -> (f64, Vec3),
    ) -> Result<Self, StartError> {
        setup.check()?;
        let grains = match free {
            Some(part) => Some((part.free_grains(&setup.domain)?, part.clone())),
            None => None,
        };
        let mut kernel = Kernel::new(gpu, setup.clone(), grains.is_some())?;
        kernel.set_state(state)?;
        Ok(KernelEngine {
            guard: Guard::new(setup.guard),
            kernel,
            grains,
            steps: 0,
            failure: RefCell::new(None),
            profile: None,
        })
    }

    /// A fluid with the given populations, one set per cell, and no free grains. Errors if the device
    /// cannot hold it.
    pub fn from_populations(
        setup: &Setup,
        gpu: &Arc<Gpu>,
        f: &[[f64; Q]],
    ) -> Result<Self, StartError> {
        let mut engine = Self::starting_from(setup, None, gpu, |_| (1.0, Vec3::zeros()))?;
        engine.kernel.set_populations(f)?;
        Ok(engine)
    }

    /// Moves the solids after a step, free or as prescribed.
    fn move_solids(&mut self) -> Result<(), EngineStop> {
        let solids = match &mut self.grains {
            Some((grains, _)) => {
                let (loads, displaced) = self.kernel.loads_with_displaced()?;
                let balance = grains.settings().gravity.zip(self.kernel.setup().body_force);
                let loads = match balance {
                    Some((Gravity::Balanced { .. }, g)) => with_displaced(&loads, &displaced, g),
                    _ => loads,
                };
                let since = self.profile.map(|_| Beginning::now());
                grains.step(&loads).map_err(CoupledStop::from)?;
                let solids = grains.solids();
                if let (Some(profile), Some(since)) = (&mut self.profile, since) {
                    profile.grains.add(since);
                }
                let lost = solids.iter().position(|solid| solid.centre.amax() > FARTHEST);
                if let Some(grain) = lost {
                    let position = solids[grain].centre.into();
                    return Err(
                        CoupledStop::Grains(GrainError::NotFinite { grain, position }).into()
                    );
                }
                solids
            }
            None => {
                let mut solids = self.solids();
                for solid in solids.iter_mut().filter(|solid| solid.moves()) {
                    solid.centre += solid.velocity;
                }
                solids
            }
        };
        Ok(self.kernel.place_solids(solids)?)
    }

    fn body_force(&self) -> Vec3 {
        self.kernel.setup().body_force.unwrap_or_else(Vec3::zeros)
    }

    /// What was observed; a failure is kept for [`Engine::still_works`].
    fn observed<T>(&self, found: Result<T, KernelError>) -> Option<T> {
        found.map_err(|error| self.failure.borrow_mut().get_or_insert(error).clone()).ok()
    }
}

impl Engine for KernelEngine {
    fn name(&self) -> &'static str {
        "wgpu"
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn adapter(&self) -> Option<String> {
        let facts = self.kernel.gpu().facts();
        Some(format!("{} ({}, {})", facts.name, facts.kind, facts.backend))
    }

    fn step(&mut self, count: u64) -> Result<(), EngineStop> {
        let end = self.steps + count;
        let is_free = self.grains.is_some();
        let moves = is_free || self.solids().iter().any(Solid::moves);
        let interval = self.kernel.setup().guard.interval.max(1);
        while self.steps < end {
            if self.guard.is_due(self.steps) {
                self.look()?;
            }
            let next_look = (self.steps / interval + 1) * interval;
            let now = if moves { 1 } else { end.min(next_look) - self.steps };
            let is_last = self.steps + now == end;
            self.kernel.advance(now, is_free || is_last)?;
            self.steps += now;
            if let Some(profile) = &mut self.profile {
                profile.steps += now;
            }
            if moves {
                self.move_solids()?;
            }
        }
        Ok(())
    }

    fn look(&mut self) -> Result<(), EngineStop> {
        let Summary { density, bare_speed, broken, .. } = self.kernel.summary()?;
        let broken = match broken {
            None => None,
            Some(cell) => {
                let f = self.kernel.populations(&[cell])?;
                f.first().and_then(|f| Some((cell, self.guard.symptom(f)?)))
            }
        };
        let sight = Sight { mean_density: density, max_speed: bare_speed, broken };
        let judged = self.guard.judge(self.kernel.setup(), self.steps, &sight);
        let explained = judged.map_err(|stopped| match &self.grains {
            Some((grains, _)) => grains.explain(stopped),
            None => stopped,
        });
        Ok(explained.map_err(CoupledStop::from)?)
    }

    fn still_works(&self) -> Result<(), EngineStop> {
        match self.failure.borrow().clone() {
            Some(error) => Err(error.into()),
            None => Ok(()),
        }
    }

    fn profile(&self) -> Option<Profile> {
        self.profile.map(|profile| Profile { kernel: self.kernel.times(), ..profile })
    }

    fn box_means(&self) -> BoxMeans {
        match self.observed(self.kernel.summary()) {
            Some(Summary { density, mass_flux, speed, .. }) => {
                BoxMeans { density, mass_flux, max_speed: speed }
            }
            None => BoxMeans {
                density: f64::NAN,
                mass_flux: Vec3::repeat(f64::NAN),
                max_speed: f64::NAN,
            },
        }
    }

    fn cells(&self, numbers: &[usize]) -> Vec<CellState> {
        let g = self.body_force();
        let found = self.observed(self.kernel.populations(numbers));
        let found = found.unwrap_or_else(|| vec![[f64::NAN; Q]; numbers.len()]);
        let state = |(f, &cell): (&[f64; Q], &usize)| {
            let density: f64 = f.iter().sum();
            let j: Vec3 = (0..Q).map(|a| f[a] * Vec3::from(C[a].map(f64::from))).sum();
            // u = (j + G/2)/ρ
            let velocity = (j + 0.5 * g) / density;
            CellState { density, velocity, solid_fraction: self.kernel.solid_fraction(cell) }
        };
        found.iter().zip(numbers).map(state).collect()
    }

    fn solids(&self) -> Vec<Solid> {
        let phase = self.kernel.setup().solid_phase.as_ref();
        phase.map_or_else(Vec::new, |phase| phase.solids.clone())
    }

    fn free_grains(&self) -> Option<&GrainSystem> {
        self.grains.as_ref().map(|(grains, _)| grains.system())
    }

    fn loads(&self) -> Vec<Load> {
        let broken = Load { force: Vec3::repeat(f64::NAN), torque: Vec3::repeat(f64::NAN) };
        self.observed(self.kernel.loads()).unwrap_or_else(|| vec![broken; self.solids().len()])
    }

    fn displaced(&self) -> Vec<f64> {
        self.kernel.displaced()
    }

    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        put_whole(out, self.steps)?;
        let (solids, loads) = (self.solids(), self.kernel.loads().map_err(io::Error::other)?);
        put_whole(out, solids.len() as u64)?;
        for (solid, load) in solids.iter().zip(&loads) {
            let vectors = [&solid.centre, &solid.velocity, &solid.spin, &load.force, &load.torque];
            vectors.into_iter().try_for_each(|vector| put_vector(out, vector))?;
        }
        let evidence = self.guard.evidence();
        // NaN stands for "no look yet": the guard never keeps one.
        put_real(out, evidence.first_mean_density.unwrap_or(f64::NAN))?;
        put_real(out, evidence.last_mean_density)?;
        put_real(out, evidence.last_max_speed)?;
        put_whole(out, self.kernel.setup().domain.cell_count() as u64)?;
        put_whole(out, u64::from(self.kernel.is_collided()))?;
        self.kernel.save(|row| out.write_all(row))?;
        match &self.grains {
            Some((grains, _)) => {
                free_state::save(out, &grains.system().state(), grains.last_steps())
            }
            None => Ok(()),
        }
    }

    fn load(&mut self, from: &mut dyn Read) -> io::Result<()> {
        let steps = whole(from)?;
        let mut solids = self.solids();
        expect(whole(from)?, solids.len(), "grains")?;
        let mut loads = Vec::new();
        for solid in &mut solids {
            (solid.centre, solid.velocity, solid.spin) =
                (vector(from)?, vector(from)?, vector(from)?);
            loads.push(Load { force: vector(from)?, torque: vector(from)? });
        }
        let evidence = Evidence {
            first_mean_density: Some(real(from)?).filter(|density| !density.is_nan()),
            last_mean_density: real(from)?,
            last_max_speed: real(from)?,
        };
        expect(whole(from)?, self.kernel.setup().domain.cell_count(), "cells")?;
        let is_collided = whole(from)? == 1;
        self.kernel.place_solids(solids).map_err(io::Error::other)?;
        self.kernel.load(is_collided, &loads, |row| from.read_exact(row))?;
        if let Some((grains, part)) = &mut self.grains {
            let (state, last) = free_state::load(from, part)?;
            let domain = &self.kernel.setup().domain;
            *grains = FreeGrains::going_on_from(domain, (part.setup, state), part.settings, last)
                .map_err(io::Error::other)?;
        }
        self.guard = Guard::going_on_from(self.kernel.setup().guard, evidence);
        self.steps = steps;
        Ok(())
    }
}
