//! The oracle as an engine.

use std::io::{self, Read, Write};

use psmrt_reference::coupling::{CoupledSolver, CoupledStop, CouplingError};
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::forcing::forced_velocity;
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::guard::Evidence;
use psmrt_reference::lattice::{Populations, Vec3, density, momentum};
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::{Load, Solid};
use psmrt_reference::solver::{Memory, Solver};

use super::bytes::{expect, put_real, put_vector, put_whole, real, vector, whole};
use super::{BoxMeans, CellState, Engine, EngineStop, free_state};
use crate::scene::{FreePart, Scene};

/// Plain double precision on the CPU.
#[derive(Clone, Debug)]
pub struct ReferenceEngine {
    state: State,
}

/// The fluid, with free grains or without.
#[derive(Clone, Debug)]
enum State {
    Fluid(Box<Solver>),
    Coupled(Box<CoupledSolver>, Box<FreePart>),
}

impl ReferenceEngine {
    /// The scene at its start. Errors if the oracle refuses the set-up.
    pub fn new(scene: &Scene) -> Result<Self, CouplingError> {
        let velocity = scene.initial_velocity;
        Self::starting_from(&scene.setup, scene.free.as_ref(), |_| (1.0, velocity))
    }

    /// A fluid whose density and velocity at each cell centre are `state(centre)`; `free` says how the
    /// grains of the set-up move, if some are free. Errors if the oracle refuses the set-up.
    pub fn starting_from(
        setup: &Setup,
        free: Option<&FreePart>,
        state: impl Fn(Vec3) -> (f64, Vec3),
    ) -> Result<Self, CouplingError> {
        let state = match free {
            None => State::Fluid(Box::new(Solver::starting_from(setup.clone(), state)?)),
            Some(part) => {
                let FreePart { setup: grain_setup, grains, planes, settings } = part.clone();
                let fluid = without_solids(setup);
                let solver =
                    CoupledSolver::new(fluid, state, grain_setup, grains, planes, settings)?;
                State::Coupled(Box::new(solver), Box::new(part.clone()))
            }
        };
        Ok(ReferenceEngine { state })
    }

    /// A fluid with the given populations, one set per cell, and no free grains. Errors if the oracle
    /// refuses the set-up.
    pub fn from_populations(setup: &Setup, f: Vec<Populations>) -> Result<Self, CouplingError> {
        let solver = Solver::from_populations(setup.clone(), f)?;
        Ok(ReferenceEngine { state: State::Fluid(Box::new(solver)) })
    }

    fn fluid(&self) -> &Solver {
        match &self.state {
            State::Fluid(solver) => solver,
            State::Coupled(solver, _) => solver.fluid(),
        }
    }

    fn body_force(&self) -> Vec3 {
        self.fluid().setup().body_force.unwrap_or_else(Vec3::zeros)
    }
}

impl Engine for ReferenceEngine {
    fn name(&self) -> &'static str {
        "reference"
    }

    fn steps(&self) -> u64 {
        self.fluid().steps()
    }

    fn step(&mut self, count: u64) -> Result<(), EngineStop> {
        match &mut self.state {
            State::Fluid(solver) => solver.run(count).map_err(CoupledStop::from)?,
            State::Coupled(solver, _) => solver.run(count)?,
        }
        Ok(())
    }

    fn look(&mut self) -> Result<(), EngineStop> {
        match &mut self.state {
            State::Fluid(solver) => solver.check_now().map_err(CoupledStop::from)?,
            State::Coupled(solver, _) => solver.check_now()?,
        }
        Ok(())
    }

    fn box_means(&self) -> BoxMeans {
        let (f, g) = (self.fluid().populations(), self.body_force());
        let n = f.len() as f64;
        let speed = |f| forced_velocity(density(f), &momentum(f), &g).norm();
        BoxMeans {
            density: f.iter().map(density).sum::<f64>() / n,
            mass_flux: self.fluid().mass_flux_field().iter().sum::<Vec3>() / n,
            max_speed: f.iter().map(speed).fold(0.0, f64::max),
        }
    }

    fn cells(&self, numbers: &[usize]) -> Vec<CellState> {
        let g = self.body_force();
        let coverage = self.fluid().coverage();
        let state = |&cell: &usize| {
            let f = &self.fluid().populations()[cell];
            let rho = density(f);
            CellState {
                density: rho,
                velocity: forced_velocity(rho, &momentum(f), &g),
                solid_fraction: coverage.map_or(0.0, |coverage| coverage.solid_fraction(cell)),
            }
        };
        numbers.iter().map(state).collect()
    }

    fn solids(&self) -> Vec<Solid> {
        self.fluid()
            .setup()
            .solid_phase
            .as_ref()
            .map_or_else(Vec::new, |phase| phase.solids.clone())
    }

    fn free_grains(&self) -> Option<&GrainSystem> {
        match &self.state {
            State::Fluid(_) => None,
            State::Coupled(solver, _) => Some(solver.grains()),
        }
    }

    fn loads(&self) -> Vec<Load> {
        self.fluid().loads().to_vec()
    }

    fn displaced(&self) -> Vec<f64> {
        self.fluid().displaced()
    }

    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        let Memory { steps, loads, evidence, slow_means } = self.fluid().memory();
        put_whole(out, steps)?;
        put_vector(out, &self.body_force())?;
        put_whole(out, loads.len() as u64)?;
        for (solid, load) in self.solids().iter().zip(&loads) {
            let vectors = [&solid.centre, &solid.velocity, &solid.spin, &load.force, &load.torque];
            vectors.into_iter().try_for_each(|vector| put_vector(out, vector))?;
        }
        // NaN stands for "no look yet": the guard never keeps one.
        put_real(out, evidence.first_mean_density.unwrap_or(f64::NAN))?;
        put_real(out, evidence.last_mean_density)?;
        put_real(out, evidence.last_max_speed)?;
        put_whole(out, self.fluid().populations().len() as u64)?;
        self.fluid().populations().iter().flatten().try_for_each(|&f| put_real(out, f))?;
        slow_means.iter().try_for_each(|&mean| put_real(out, mean))?;
        match &self.state {
            State::Fluid(_) => Ok(()),
            State::Coupled(solver, _) => {
                free_state::save(out, &solver.grains().state(), solver.last_steps())
            }
        }
    }

    fn load(&mut self, from: &mut dyn Read) -> io::Result<()> {
        let mut setup = self.fluid().setup().clone();
        let steps = whole(from)?;
        let body_force = vector(from)?;
        if let Some(force) = &mut setup.body_force {
            *force = body_force;
        }
        let mut loads = Vec::new();
        let solids = setup.solid_phase.as_mut().map_or(&mut [][..], |phase| &mut phase.solids[..]);
        expect(whole(from)?, solids.len(), "grains")?;
        for solid in solids {
            (solid.centre, solid.velocity, solid.spin) =
                (vector(from)?, vector(from)?, vector(from)?);
            loads.push(Load { force: vector(from)?, torque: vector(from)? });
        }
        let evidence = Evidence {
            first_mean_density: Some(real(from)?).filter(|density| !density.is_nan()),
            last_mean_density: real(from)?,
            last_max_speed: real(from)?,
        };
        expect(whole(from)?, setup.domain.cell_count(), "cells")?;
        let part = match &self.state {
            State::Fluid(_) => None,
            State::Coupled(_, part) => Some(part.clone()),
        };
        // The scene that the checkpoint is bound to says how many there are.
        let mut slow_means = self.fluid().memory().slow_means;
        // The old state makes room: with both a run would need twice the memory to be resumed.
        self.state = State::Fluid(Box::new(single_cell(&setup)?));
        let mut f: Vec<Populations> = vec![[0.0; 19]; setup.domain.cell_count()];
        for population in f.iter_mut().flatten() {
            *population = real(from)?;
        }
        for mean in &mut slow_means {
            *mean = real(from)?;
        }
        let memory = Memory { steps, loads, evidence, slow_means };
        self.state = match part {
            None => {
                let solver = Solver::going_on_from(setup, f, memory).map_err(io::Error::other)?;
                State::Fluid(Box::new(solver))
            }
            Some(part) => {
                let (grains, last) = free_state::load(from, &part)?;
                let (fluid, grains) = ((setup, f, memory), (part.setup, grains));
                let solver = CoupledSolver::going_on_from(fluid, grains, part.settings, last);
                State::Coupled(Box::new(solver.map_err(io::Error::other)?), part)
            }
        };
        Ok(())
    }
}

/// The same fluid, as little of it as there can be.
fn single_cell(setup: &Setup) -> io::Result<Solver> {
    let domain = Domain::new([1, 1, 1], Faces::PERIODIC).map_err(io::Error::other)?;
    Solver::new(Setup::fluid(domain, setup.collision)).map_err(io::Error::other)
}

/// The set-up with a solid phase that waits for its grains.
fn without_solids(setup: &Setup) -> Setup {
    let mut setup = setup.clone();
    if let Some(phase) = &mut setup.solid_phase {
        phase.solids.clear();
    }
    setup
}
