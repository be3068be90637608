//! What an engine can do. Every engine is asked for what is wanted, cell by cell or summed up: none
//! is assumed to keep its fields where the caller could look at them.

mod bytes;
pub mod free_state;
mod name;
mod reference;
mod wgpu;

use std::io::{self, Read, Write};

use psmrt_reference::coupling::CoupledStop;
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Load, Solid};
use thiserror::Error;

use crate::kernel::KernelError;

pub use name::{EngineName, OpenError, open};
pub use reference::ReferenceEngine;
pub use wgpu::{KernelEngine, Profile, StartError};

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

/// Means and extremes over the box, lattice units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxMeans {
    /// Mean density.
    pub density: f64,
    /// Mean mass flux, solid cells included: the mean of the momentum before and after a collision.
    pub mass_flux: Vec3,
    /// Largest speed in any cell.
    pub max_speed: f64,
}

/// Why an engine cannot go on.
#[derive(Debug, Error)]
pub enum EngineStop {
    /// The guard of the fluid has stopped it, or the grains cannot be moved.
    #[error(transparent)]
    Broken(#[from] CoupledStop),
    /// The device has failed.
    #[error(transparent)]
    Device(#[from] KernelError),
}

/// Something that computes a scene step by step.
pub trait Engine {
    /// Its name, as `--engine` spells it.
    fn name(&self) -> &'static str;

    /// Steps made so far.
    fn steps(&self) -> u64;

    /// What it computes on besides the processor, if it does.
    fn adapter(&self) -> Option<String> {
        None
    }

    /// Makes `count` steps. Errors when the guard finds the state broken, a free grain cannot be moved,
    /// or the device fails.
    fn step(&mut self, count: u64) -> Result<(), EngineStop>;

    /// Looks for a broken state now, whatever the step. Errors as [`Engine::step`].
    fn look(&mut self) -> Result<(), EngineStop>;

    /// Errors if the device has failed while something was observed: what was seen then is not a
    /// number.
    fn still_works(&self) -> Result<(), EngineStop> {
        Ok(())
    }

    /// Where the time has gone, if that is kept.
    fn profile(&self) -> Option<Profile> {
        None
    }

    /// Means over the box.
    fn box_means(&self) -> BoxMeans;

    /// The state of the cells of the given numbers, in their order.
    fn cells(&self, numbers: &[usize]) -> Vec<CellState>;

    /// The solids, where they are now.
    fn solids(&self) -> Vec<Solid>;

    /// All grains with their contacts, if some are free; grain number `i` is solid number `i`.
    fn free_grains(&self) -> Option<&GrainSystem>;

    /// Force and torque of the fluid on each solid during the last step.
    fn loads(&self) -> Vec<Load>;

    /// `Σ B_s` over the cells of each solid, where it is now, in cells: the body force does not act on the
    /// fluid there, and is no part of the loads.
    fn displaced(&self) -> Vec<f64>;

    /// Writes all that it needs to go on from here, bit for bit.
    fn save(&self, out: &mut dyn Write) -> io::Result<()>;

    /// Takes the state that [`Engine::save`] wrote for the same scene. After an error it is of no use.
    fn load(&mut self, from: &mut dyn Read) -> io::Result<()>;
}
