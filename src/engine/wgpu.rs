//! The kernel as a fluid engine: the fluid on a device, in single precision.

use std::io::{self, Read, Write};
use std::sync::Arc;

use psmrt_reference::drive::Drive;
use psmrt_reference::guard::{Findings, Guard};
use psmrt_reference::lattice::{Populations, Vec3};
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::{Grip, Load, Solid};

use super::bytes::{put_whole, whole};
use super::{Block, BoxMeans, CellState, DeviceError, FluidEngine, Start, StartError};
use crate::kernel::{Gpu, Kernel, KernelError, KernelTimes, Summary};
use crate::machine::Spent;

impl From<KernelError> for DeviceError {
    fn from(error: KernelError) -> Self {
        DeviceError::new(error)
    }
}

/// The fluid on a device.
#[derive(Debug)]
pub struct KernelEngine {
    kernel: Kernel,
    keeps_times: bool,
}

impl KernelEngine {
    /// A fluid at its start, in a set-up that has passed its checks. Errors if the device cannot hold it.
    ///
    /// # Panics
    /// If there are not as many sets of populations as cells: a mistake in the calling code.
    pub fn start(setup: Setup, gpu: &Arc<Gpu>, start: &Start<'_>) -> Result<Self, DeviceError> {
        let is_free = matches!(start, Start::State { is_free: true, .. });
        let mut kernel = Kernel::new(gpu, setup, is_free)?;
        match *start {
            Start::State { state, .. } => kernel.set_state(state)?,
            Start::Populations(f) => kernel.set_populations(f)?,
        }
        Ok(KernelEngine { kernel, keeps_times: false })
    }
}

impl FluidEngine for KernelEngine {
    fn name(&self) -> &'static str {
        "wgpu"
    }

    fn adapter(&self) -> Option<String> {
        let facts = self.kernel.gpu().facts();
        Some(format!("{} ({}, {})", facts.name, facts.kind, facts.backend))
    }

    fn setup(&self) -> &Setup {
        self.kernel.setup()
    }

    fn set_drive(&mut self, drive: &Drive) -> Result<(), StartError> {
        Ok(self.kernel.set_drive(drive)?)
    }

    fn place_solids(&mut self, solids: Vec<Solid>) -> Result<(), DeviceError> {
        Ok(self.kernel.place_solids(solids)?)
    }

    fn advance(&mut self, steps: u64, with_loads: bool) -> Result<(), DeviceError> {
        Ok(self.kernel.advance(steps, with_loads)?)
    }

    fn loads(&self) -> Result<Vec<Load>, DeviceError> {
        Ok(self.kernel.loads()?)
    }

    fn displaced(&self) -> Result<Vec<f64>, DeviceError> {
        Ok(self.kernel.displaced()?)
    }

    fn loads_with_displaced(&self) -> Result<(Vec<Load>, Vec<f64>), DeviceError> {
        Ok(self.kernel.loads_with_displaced()?)
    }

    fn grips(&mut self, wanted: &[usize]) -> Result<Vec<Grip>, DeviceError> {
        Ok(self.kernel.grips(wanted)?)
    }

    fn means(&self) -> Result<BoxMeans, DeviceError> {
        let Summary { density, mass_flux, speed, .. } = self.kernel.summary()?;
        Ok(BoxMeans { density, mass_flux, max_speed: speed })
    }

    fn findings(&mut self, guard: &Guard) -> Result<Findings, DeviceError> {
        let Summary { density, bare_speed, broken, .. } = self.kernel.summary()?;
        let broken = match broken {
            None => None,
            Some(cell) => {
                let f = self.kernel.populations(&[cell])?;
                f.first().and_then(|f| Some((cell, guard.failure(f)?)))
            }
        };
        Ok(Findings { mean_density: density, max_speed: bare_speed, broken })
    }

    fn cells(&self, block: Block) -> Result<Vec<CellState>, DeviceError> {
        let g = self.kernel.setup().body_force.unwrap_or_else(Vec3::zeros);
        let found = self.kernel.states(&block.numbers(&self.setup().domain))?;
        Ok(found.iter().map(|(f, solid_fraction)| CellState::new(f, &g, *solid_fraction)).collect())
    }

    fn populations(&self, block: Block) -> Result<Vec<Populations>, DeviceError> {
        Ok(self.kernel.populations(&block.numbers(&self.setup().domain))?)
    }

    fn keep_times(&mut self) {
        self.kernel.keep_times(true);
        self.keeps_times = true;
    }

    fn times(&self) -> Vec<(&'static str, Spent)> {
        if !self.keeps_times {
            return Vec::new();
        }
        let KernelTimes { fluid, coverage, forces, grips, transfers } = self.kernel.times();
        let mut parts = vec![("fluid", fluid), ("forces", forces)];
        if grips != Spent::default() {
            parts.push(("grips", grips));
        }
        parts.extend([("coverage", coverage), ("transfers", transfers)]);
        parts
    }

    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        put_whole(out, u64::from(self.kernel.is_collided()))?;
        self.kernel.save(|row| out.write_all(row))
    }

    fn load(
        &mut self,
        from: &mut dyn Read,
        solids: Vec<Solid>,
        loads: Vec<Load>,
    ) -> io::Result<()> {
        let is_collided = whole(from)? == 1;
        self.kernel.place_solids(solids).map_err(io::Error::other)?;
        self.kernel.load(is_collided, &loads, |row| from.read_exact(row))
    }
}
