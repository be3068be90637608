//! What is asked of whatever computes the fluid of a domain: a step, the load on each solid, sums over the
//! domain and the state of the cells of a block. None is assumed to keep its fields where the caller could look at
//! them, or to hold all planes of cells: sums are taken, and blocks put together, in the order of the planes.

use std::fmt;
use std::io::{self, Read, Write};

use psmrt_reference::directions::{C, Q};
use psmrt_reference::drive::Drive;
use psmrt_reference::guard::{Findings, Guard};
use psmrt_reference::lattice::{Populations, Vec3};
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::{Grip, Load, Solid};

use super::{Block, DeviceError, StartError};
use crate::machine::Spent;

/// The state of one cell, lattice units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellState {
    /// Density.
    pub density: f64,
    /// Velocity half-way through a collision that sees the body force alone: `(j + G/2)/rho`.
    pub velocity: Vec3,
    /// How much of the cell grains cover, 0 to 1.
    pub solid_fraction: f64,
}

impl CellState {
    /// That of populations before a collision, with the body force `g` per volume, in a cell of this solid fraction.
    pub(super) fn new(f: &Populations, g: &Vec3, solid_fraction: f64) -> Self {
        let density: f64 = f.iter().sum();
        let j: Vec3 = (0..Q).map(|a| f[a] * Vec3::from(C[a].map(f64::from))).sum();
        // u = (j + G/2)/ρ
        CellState { density, velocity: (j + 0.5 * g) / density, solid_fraction }
    }
}

/// Means and extremes over the domain, lattice units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxMeans {
    /// Mean density.
    pub density: f64,
    /// Mean mass flux, solid cells included: the mean of the momentum before and after a collision.
    pub mass_flux: Vec3,
    /// Largest speed in any cell.
    pub max_speed: f64,
}

/// Something that computes the fluid of a domain step by step, with solids that others move. Lattice units
/// throughout; it errors where its device fails.
pub trait FluidEngine: fmt::Debug + Send {
    /// Its name, as `--engine` spells it.
    fn name(&self) -> &'static str;

    /// The device that it computes on, if it is not the processor.
    fn adapter(&self) -> Option<String> {
        None
    }

    /// The set-up, with the solids where they are now and the drive of now.
    fn setup(&self) -> &Setup;

    /// Lets `drive` drive the fluid from now on. A step takes its body force in the collision and its face values in
    /// the streaming after it; what is observed has the body force of now, and populations that came in with the face
    /// values of the step before. Errors, and changes nothing, as [`Setup::set_drive`].
    fn set_drive(&mut self, drive: &Drive) -> Result<(), StartError>;

    /// Puts the solids elsewhere. They are as many as before, and of the same shapes.
    fn place_solids(&mut self, solids: Vec<Solid>) -> Result<(), DeviceError>;

    /// Makes `steps` steps, the solids staying where they are. Those loads that [`Self::loads`] should give
    /// afterwards need be worked out only if `with_loads`.
    fn advance(&mut self, steps: u64, with_loads: bool) -> Result<(), DeviceError>;

    /// Force and torque of the fluid on each solid during the last step.
    fn loads(&self) -> Result<Vec<Load>, DeviceError>;

    /// `Σ B_s` over the cells of each solid, where it is now, in cells: the body force does not act on the
    /// fluid there, and is no part of the loads.
    fn displaced(&self) -> Result<Vec<f64>, DeviceError>;

    /// Loads and `Σ B_s` of the last step, asked before the solids are placed elsewhere.
    fn loads_with_displaced(&self) -> Result<(Vec<Load>, Vec<f64>), DeviceError> {
        Ok((self.loads()?, self.displaced()?))
    }

    /// How each solid holds the fluid before its next collision, for the operators that ask for it
    /// (`SolidOperator::asks_for_implicit_coupling`); of solids that are not `wanted` nothing need be right. It says the
    /// same however often it is asked.
    fn grips(&mut self, wanted: &[usize]) -> Result<Vec<Grip>, DeviceError>;

    /// Means over the domain.
    fn means(&self) -> Result<BoxMeans, DeviceError>;

    /// What `guard` wants to know of all cells.
    fn findings(&mut self, guard: &Guard) -> Result<Findings, DeviceError>;

    /// The state of the cells of a block, x fastest, z slowest.
    fn cells(&self, block: Block) -> Result<Vec<CellState>, DeviceError>;

    /// The populations of the cells of a block before their next collision, in the same order: what engines are
    /// compared by.
    fn populations(&self, block: Block) -> Result<Vec<Populations>, DeviceError>;

    /// Keeps from now on where the time goes, which may cost some, if it can.
    fn keep_times(&mut self) {}

    /// Where the time has gone, part by part, if that is kept.
    fn times(&self) -> Vec<(&'static str, Spent)> {
        Vec::new()
    }

    /// Writes what it needs to go on, bit for bit, besides its set-up, its solids, their loads and its drive.
    fn save(&self, out: &mut dyn Write) -> io::Result<()>;

    /// Takes what [`Self::save`] wrote for the same scene, with the solids and the loads of then; the drive of then
    /// has been set. After an error it is of no use.
    fn load(&mut self, from: &mut dyn Read, solids: Vec<Solid>, loads: Vec<Load>)
    -> io::Result<()>;
}
