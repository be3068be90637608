//! No fluid: what stands below free grains in a scene that has none. It has no cells, so that a domain of any size costs nothing;
//! what only a fluid could answer is an error.

use std::io::{self, Read, Write};

use psmrt_reference::drive::Drive;
use psmrt_reference::guard::{Findings, Guard};
use psmrt_reference::lattice::{Populations, Vec3};
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::{Grip, Load, Solid};
use thiserror::Error;

use super::{Block, BoxMeans, CellState, DeviceError, EngineName, FluidEngine, StartError};

/// Something of the fluid was asked for where there is none.
#[derive(Clone, Copy, Debug, Error)]
#[error("the scene has no fluid")]
pub struct WithoutFluid;

/// The solids, where others put them, and no load on any.
#[derive(Clone, Debug)]
pub struct NoFluid {
    name: EngineName,
    setup: Setup,
}

impl NoFluid {
    /// In the place of the engine `name`, with the domain and the solids of a set-up.
    pub fn new(name: EngineName, setup: Setup) -> Self {
        NoFluid { name, setup }
    }

    fn count(&self) -> usize {
        self.setup.solid_phase.as_ref().map_or(0, |phase| phase.solids.len())
    }
}

impl FluidEngine for NoFluid {
    fn name(&self) -> &'static str {
        self.name.word()
    }

    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn set_drive(&mut self, drive: &Drive) -> Result<(), StartError> {
        Ok(self.setup.set_drive(drive)?)
    }

    fn place_solids(&mut self, solids: Vec<Solid>) -> Result<(), DeviceError> {
        if let Some(phase) = &mut self.setup.solid_phase {
            phase.solids = solids;
        }
        Ok(())
    }

    fn advance(&mut self, _: u64, _: bool) -> Result<(), DeviceError> {
        Ok(())
    }

    fn loads(&self) -> Result<Vec<Load>, DeviceError> {
        Ok(vec![Load { force: Vec3::zeros(), torque: Vec3::zeros() }; self.count()])
    }

    fn displaced(&self) -> Result<Vec<f64>, DeviceError> {
        Ok(vec![0.0; self.count()])
    }

    fn grips(&mut self, _: &[usize]) -> Result<Vec<Grip>, DeviceError> {
        Err(DeviceError::new(WithoutFluid))
    }

    fn means(&self) -> Result<BoxMeans, DeviceError> {
        Err(DeviceError::new(WithoutFluid))
    }

    /// Nothing is broken: grains are looked after where they are moved.
    fn findings(&mut self, _: &Guard) -> Result<Findings, DeviceError> {
        Ok(Findings { mean_density: 1.0, max_speed: 0.0, broken: None })
    }

    fn cells(&self, _: Block) -> Result<Vec<CellState>, DeviceError> {
        Err(DeviceError::new(WithoutFluid))
    }

    fn populations(&self, _: Block) -> Result<Vec<Populations>, DeviceError> {
        Err(DeviceError::new(WithoutFluid))
    }

    fn save(&self, _: &mut dyn Write) -> io::Result<()> {
        Ok(())
    }

    fn load(&mut self, _: &mut dyn Read, solids: Vec<Solid>, _: Vec<Load>) -> io::Result<()> {
        self.place_solids(solids).map_err(io::Error::other)
    }
}
