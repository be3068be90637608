//! The CPU engine as a fluid engine.

use std::io::{self, Read, Write};

use psmrt_reference::directions::C;
use psmrt_reference::drive::Drive;
use psmrt_reference::guard::{Findings, Guard};
use psmrt_reference::lattice::{Populations, Vec3};
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::{Load, Solid};

use super::{Block, BoxMeans, CellState, DeviceError, EngineName, FluidEngine, Start, StartError};
use crate::cpu::Fluid;
use crate::lanes::Real;

/// The fluid on all cores, in single or double precision.
#[derive(Debug)]
pub struct CpuEngine<T: Real> {
    fluid: Fluid<T>,
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
        CpuEngine { fluid }
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
        self.fluid.place_solids(solids);
        Ok(())
    }

    fn advance(&mut self, steps: u64, with_loads: bool) -> Result<(), DeviceError> {
        self.fluid.advance(steps, with_loads);
        Ok(())
    }

    fn loads(&self) -> Result<Vec<Load>, DeviceError> {
        Ok(self.fluid.loads().to_vec())
    }

    fn displaced(&self) -> Result<Vec<f64>, DeviceError> {
        Ok(self.fluid.displaced())
    }

    fn means(&self) -> Result<BoxMeans, DeviceError> {
        let (density, mass_flux, max_speed) = self.fluid.means();
        Ok(BoxMeans { density, mass_flux, max_speed })
    }

    fn findings(&self, guard: &Guard) -> Result<Findings, DeviceError> {
        Ok(self.fluid.findings(guard))
    }

    fn cells(&self, block: Block) -> Result<Vec<CellState>, DeviceError> {
        let g = self.fluid.body_force();
        let numbers = block.numbers(&self.setup().domain);
        let fractions = self.fluid.solid_fractions(&numbers);
        let state = |(&cell, solid_fraction): (&usize, f64)| {
            let (mut density, mut j) = (0.0, Vec3::zeros());
            for (a, f) in self.fluid.populations(cell).into_iter().enumerate() {
                density += f;
                j += f * Vec3::from(C[a].map(f64::from));
            }
            // u = (j + G/2)/ρ
            CellState { density, velocity: (j + 0.5 * g) / density, solid_fraction }
        };
        Ok(numbers.iter().zip(fractions).map(state).collect())
    }

    fn populations(&self, block: Block) -> Result<Vec<Populations>, DeviceError> {
        let cells = block.numbers(&self.setup().domain);
        Ok(cells.into_iter().map(|cell| self.fluid.populations(cell)).collect())
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
