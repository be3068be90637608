//! Bodies that move as prescribed: where they are, how they are turned, and which cells they fill there.

use nalgebra::{Quaternion, UnitQuaternion};
use psmrt_reference::lattice::Vec3;
use thiserror::Error;

use super::mesh::Mesh;
use super::pose::Pose;
use super::shares::solid_shares;

/// The part of a body's volume that may get lost at faces or in other solids.
const MAY_MISS: f64 = 0.01;

/// A body that moves, in cells.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingBody {
    /// Its number among the solids.
    pub solid: usize,
    /// The number of its `[[grains]]` section.
    pub section: usize,
    /// Its surface about its centre, as it is turned at the start.
    mesh: Mesh,
    volume: f64,
    /// How it is turned against that.
    turn: UnitQuaternion<f64>,
}

/// The bodies that move, and what stands in their way.
#[derive(Clone, Debug)]
pub struct Bodies {
    /// The bodies.
    pub moving: Vec<MovingBody>,
    /// How much of each cell the solids fill that do not move.
    pub filled: Vec<f32>,
}

/// A body that cannot go on.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum BodyStop {
    /// It leaves the domain.
    #[error(
        "the body of grains[{section}] has left the domain with {:.1} % of its volume (1 % is the limit); stop the run before, \
         let it move another way, or make the domain larger",
        100.0 * .missing
    )]
    Outside {
        /// Its section.
        section: usize,
        /// Share of its volume outside.
        missing: f64,
    },
    /// It runs into another solid.
    #[error(
        "the body of grains[{section}] has run into another solid: they have {:.1} % of its volume in common (1 % is the limit); \
         stop the run before, or let it move another way",
        100.0 * .common
    )]
    Into {
        /// Its section.
        section: usize,
        /// Share of its volume that both fill.
        common: f64,
    },
}

impl MovingBody {
    /// A body as it starts.
    pub fn new(solid: usize, section: usize, mesh: Mesh) -> Self {
        let volume = mesh.volume();
        MovingBody { solid, section, mesh, volume, turn: UnitQuaternion::identity() }
    }

    /// Turns it on by a step with this angular velocity, radians per step.
    pub fn turn_on(&mut self, angular_velocity: &Vec3) {
        self.turn = UnitQuaternion::from_scaled_axis(*angular_velocity) * self.turn;
    }

    /// Its turn as four numbers; [`Self::set_turn`] takes them bit for bit.
    pub fn turn_numbers(&self) -> [f64; 4] {
        self.turn.coords.into()
    }

    /// Takes what [`Self::turn_numbers`] gave.
    pub fn set_turn(&mut self, numbers: [f64; 4]) {
        self.turn = UnitQuaternion::new_unchecked(Quaternion::from_vector(numbers.into()));
    }

    /// The cells that it fills with its centre there. Errors if it does not lie in the domain.
    pub fn shares(&self, centre: &Vec3, cells: [usize; 3]) -> Result<Vec<(usize, f64)>, BodyStop> {
        let shares =
            solid_shares(&Pose { centre: *centre, turn: self.turn }.place(&self.mesh), cells);
        let inside: f64 = shares.iter().map(|(_, share)| share).sum();
        let missing = 1.0 - inside / self.volume;
        let section = self.section;
        if missing > MAY_MISS { Err(BodyStop::Outside { section, missing }) } else { Ok(shares) }
    }

    /// Errors if too much of it lies in cells that others fill already; `filled`: their share of each cell.
    pub fn keeps_out_of(&self, filled: &[f32], shares: &[(usize, f64)]) -> Result<(), BodyStop> {
        let both = |&(cell, share): &(usize, f64)| (f64::from(filled[cell]) + share - 1.0).max(0.0);
        let common = shares.iter().map(both).sum::<f64>() / self.volume;
        let section = self.section;
        if common > MAY_MISS { Err(BodyStop::Into { section, common }) } else { Ok(()) }
    }
}
