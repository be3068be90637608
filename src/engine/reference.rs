//! The oracle as a fluid engine: plain double precision on the CPU.

use std::io::{self, Read, Write};

use psmrt_reference::coupling;
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::drive::Drive;
use psmrt_reference::forcing::forced_velocity;
use psmrt_reference::guard::{Findings, Guard};
use psmrt_reference::lattice::{Populations, Vec3, density, momentum};
use psmrt_reference::setup::{Setup, SetupError};
use psmrt_reference::solids::{Grip, Load, Solid};
use psmrt_reference::solver::{Memory, Solver};

use super::bytes::{put_real, real};
use super::{Block, BoxMeans, CellState, DeviceError, FluidEngine, Start, StartError};
use crate::scene::Scene;

/// Plain double precision on the CPU.
#[derive(Clone, Debug)]
pub struct ReferenceEngine {
    solver: Solver,
}

impl ReferenceEngine {
    /// The fluid of a scene at its start, with solids that are not free. Errors if the oracle refuses the
    /// set-up.
    pub fn new(scene: &Scene) -> Result<Self, SetupError> {
        let state = |centre| scene.initial.at(centre);
        Self::start(scene.setup.clone(), &Start::State { state: &state, is_free: false })
    }

    /// A fluid at its start. Errors if the oracle refuses the set-up.
    ///
    /// # Panics
    /// If there are not as many sets of populations as cells: a mistake in the calling code.
    pub fn start(setup: Setup, start: &Start<'_>) -> Result<Self, SetupError> {
        let solver = match *start {
            Start::State { state, is_free: true } => {
                Solver::starting_with_free_solids(setup, state)?
            }
            Start::State { state, is_free: false } => Solver::starting_from(setup, state)?,
            Start::Populations(f) => Solver::from_populations(setup, f.to_vec())?,
        };
        Ok(ReferenceEngine { solver })
    }

    /// Replaces every population, that of direction `a` by `change(f, a)`. Errors if the oracle refuses the
    /// set-up.
    pub fn change_populations(
        &mut self,
        change: impl Fn(f64, usize) -> f64,
    ) -> Result<(), SetupError> {
        let mut f = self.solver.populations().to_vec();
        for populations in &mut f {
            for (a, population) in populations.iter_mut().enumerate() {
                *population = change(*population, a);
            }
        }
        let (setup, memory) = (self.solver.setup().clone(), self.solver.memory());
        self.solver = Solver::going_on_from(setup, f, memory)?;
        Ok(())
    }

    fn body_force(&self) -> Vec3 {
        self.solver.setup().body_force.unwrap_or_else(Vec3::zeros)
    }
}

impl FluidEngine for ReferenceEngine {
    fn name(&self) -> &'static str {
        "reference"
    }

    fn setup(&self) -> &Setup {
        self.solver.setup()
    }

    fn set_drive(&mut self, drive: &Drive) -> Result<(), StartError> {
        Ok(self.solver.set_drive(drive)?)
    }

    fn place_solids(&mut self, solids: Vec<Solid>) -> Result<(), DeviceError> {
        self.solver.place_solids(|number, solid| solid.clone_from(&solids[number]));
        Ok(())
    }

    fn advance(&mut self, steps: u64, _: bool) -> Result<(), DeviceError> {
        (0..steps).for_each(|_| self.solver.advance_unguarded());
        Ok(())
    }

    fn loads(&self) -> Result<Vec<Load>, DeviceError> {
        Ok(self.solver.loads().to_vec())
    }

    fn displaced(&self) -> Result<Vec<f64>, DeviceError> {
        Ok(self.solver.displaced())
    }

    fn grips(&mut self, _: &[usize]) -> Result<Vec<Grip>, DeviceError> {
        Ok(coupling::grips(&self.solver))
    }

    fn means(&self) -> Result<BoxMeans, DeviceError> {
        let (f, g) = (self.solver.populations(), self.body_force());
        let n = f.len() as f64;
        let speed = |f| forced_velocity(density(f), &momentum(f), &g).norm();
        Ok(BoxMeans {
            density: f.iter().map(density).sum::<f64>() / n,
            mass_flux: self.solver.mass_flux_field().iter().sum::<Vec3>() / n,
            max_speed: f.iter().map(speed).fold(0.0, f64::max),
        })
    }

    fn findings(&mut self, guard: &Guard) -> Result<Findings, DeviceError> {
        Ok(guard.findings(self.solver.populations()))
    }

    fn cells(&self, block: Block) -> Result<Vec<CellState>, DeviceError> {
        let g = self.body_force();
        let coverage = self.solver.coverage();
        let state = |cell: usize| {
            let f = &self.solver.populations()[cell];
            let rho = density(f);
            CellState {
                density: rho,
                velocity: forced_velocity(rho, &momentum(f), &g),
                solid_fraction: coverage.map_or(0.0, |coverage| coverage.solid_fraction(cell)),
            }
        };
        Ok(block.numbers(self.solver.domain()).into_iter().map(state).collect())
    }

    fn populations(&self, block: Block) -> Result<Vec<Populations>, DeviceError> {
        let f = self.solver.populations();
        Ok(block.numbers(self.solver.domain()).into_iter().map(|cell| f[cell]).collect())
    }

    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.solver.populations().iter().flatten().try_for_each(|&f| put_real(out, f))?;
        self.solver.memory().slow_means.iter().try_for_each(|&mean| put_real(out, mean))
    }

    fn load(
        &mut self,
        from: &mut dyn Read,
        solids: Vec<Solid>,
        loads: Vec<Load>,
    ) -> io::Result<()> {
        let mut setup = self.solver.setup().clone();
        if let Some(phase) = &mut setup.solid_phase {
            phase.solids = solids;
        }
        // The scene that the checkpoint is bound to says how many slow means there are. The guard of the
        // solver and its count of steps are not used: an engine has its own above it.
        let mut memory = Memory { loads, ..self.solver.memory() };
        // The old state makes room: with both a run would need twice the memory to be resumed.
        self.solver = single_cell(&setup)?;
        let mut f: Vec<Populations> = vec![[0.0; 19]; setup.domain.cell_count()];
        for population in f.iter_mut().flatten() {
            *population = real(from)?;
        }
        for mean in &mut memory.slow_means {
            *mean = real(from)?;
        }
        self.solver = Solver::going_on_from(setup, f, memory).map_err(io::Error::other)?;
        Ok(())
    }
}

/// The same fluid, as little of it as there can be.
fn single_cell(setup: &Setup) -> io::Result<Solver> {
    let domain = Domain::new([1, 1, 1], Faces::PERIODIC).map_err(io::Error::other)?;
    Solver::new(Setup::fluid(domain, setup.collision)).map_err(io::Error::other)
}
