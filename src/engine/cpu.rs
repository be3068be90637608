//! The CPU engine as a fluid engine.

use std::io::{self, Read, Write};

use psmrt_reference::drive::Drive;
use psmrt_reference::guard::{Findings, Guard};
use psmrt_reference::lattice::Populations;
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::{Grip, Load, Solid};
use rayon::prelude::*;

use super::{Block, BoxMeans, CellState, DeviceError, EngineName, FluidEngine, Start, StartError};
use crate::cpu::Fluid;
use crate::lanes::Real;
use crate::machine::{Beginning, Spent};

/// The fluid on all cores, in single or double precision.
#[derive(Debug)]
pub struct CpuEngine<T: Real> {
    fluid: Fluid<T>,
    times: Option<Times>,
}

/// Where the time has gone.
#[derive(Clone, Copy, Debug, Default)]
struct Times {
    /// Steps: what each cell is made of, collision, streaming, faces and loads, which one pass over memory does.
    fluid: Spent,
    /// Which cells the solids cover, and how much of them.
    coverage: Spent,
}

impl<T: Real> CpuEngine<T> {
    /// A fluid at its start, in a set-up that has passed its checks.
    ///
    /// # Panics
    /// If there are not as many sets of populations as cells: a mistake in the calling code.
    pub fn start(setup: Setup, start: &Start<'_>) -> Self {
        let fluid = match *start {
            Start::State { state, is_free } => Fluid::starting_from(setup, state, is_free),
            Start::Populations(f) => Fluid::from_populations(setup, f),
        };
        CpuEngine { fluid, times: None }
    }

    /// The fluid itself.
    pub fn fluid_mut(&mut self) -> &mut Fluid<T> {
        &mut self.fluid
    }
}

impl<T: Real> FluidEngine for CpuEngine<T> {
    fn name(&self) -> &'static str {
        let is_single = size_of::<T>() == size_of::<f32>();
        if is_single { EngineName::CpuSingle.word() } else { EngineName::Cpu.word() }
    }

    fn setup(&self) -> &Setup {
        self.fluid.setup()
    }

    fn set_drive(&mut self, drive: &Drive) -> Result<(), StartError> {
        Ok(self.fluid.set_drive(drive)?)
    }

    fn place_solids(&mut self, solids: Vec<Solid>) -> Result<(), DeviceError> {
        let since = self.times.is_some().then(Beginning::now);
        self.fluid.place_solids(solids);
        if let (Some(times), Some(since)) = (&mut self.times, since) {
            times.coverage.add(since);
        }
        Ok(())
    }

    fn advance(&mut self, steps: u64, with_loads: bool) -> Result<(), DeviceError> {
        let since = self.times.is_some().then(Beginning::now);
        self.fluid.advance(steps, with_loads);
        if let (Some(times), Some(since)) = (&mut self.times, since) {
            times.fluid.add(since);
        }
        Ok(())
    }

    fn loads(&self) -> Result<Vec<Load>, DeviceError> {
        Ok(self.fluid.loads().to_vec())
    }

    fn displaced(&self) -> Result<Vec<f64>, DeviceError> {
        Ok(self.fluid.displaced())
    }

    fn grips(&mut self, wanted: &[usize]) -> Result<Vec<Grip>, DeviceError> {
        let since = self.times.is_some().then(Beginning::now);
        let grips = self.fluid.grips(wanted);
        if let (Some(times), Some(since)) = (&mut self.times, since) {
            times.fluid.add(since);
        }
        Ok(grips)
    }

    fn means(&self) -> Result<BoxMeans, DeviceError> {
        let (density, mass_flux, max_speed) = self.fluid.means();
        Ok(BoxMeans { density, mass_flux, max_speed })
    }

    fn findings(&mut self, guard: &Guard) -> Result<Findings, DeviceError> {
        Ok(self.fluid.findings(guard))
    }

    fn cells(&self, block: Block) -> Result<Vec<CellState>, DeviceError> {
        let g = self.fluid.body_force();
        let numbers = block.numbers(&self.setup().domain);
        let fractions = self.fluid.solid_fractions(&numbers);
        let state = |(&cell, solid_fraction): (&usize, f64)| {
            CellState::new(&self.fluid.populations(cell), &g, solid_fraction)
        };
        Ok(numbers.par_iter().zip(fractions).map(state).collect())
    }

    fn populations(&self, block: Block) -> Result<Vec<Populations>, DeviceError> {
        let cells = block.numbers(&self.setup().domain);
        Ok(cells.into_iter().map(|cell| self.fluid.populations(cell)).collect())
    }

    fn keep_times(&mut self) {
        self.times = Some(Times::default());
    }

    fn times(&self) -> Vec<(&'static str, Spent)> {
        let Some(Times { fluid, coverage }) = self.times else { return Vec::new() };
        vec![("fluid", fluid), ("coverage", coverage)]
    }

    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.fluid.save(out)
    }

    fn load(
        &mut self,
        from: &mut dyn Read,
        solids: Vec<Solid>,
        loads: Vec<Load>,
    ) -> io::Result<()> {
        self.fluid.load(from, solids, loads)
    }
}
