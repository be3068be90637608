//! Bodies that move as prescribed: where they are, how they are turned, and which cells they fill there.

use nalgebra::{Quaternion, UnitQuaternion};
use psmrt_reference::lattice::Vec3;
use thiserror::Error;

use super::filled::Filled;
use super::mesh::Mesh;
use super::pose::Pose;
use super::shares::{WrongShare, solid_shares};

/// The part of a body's volume that may get lost at faces.
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
    /// What the solids fill that do not move.
    pub filled: Filled,
}

/// A body that cannot go on.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum BodyStop {
    /// It leaves the domain.
    #[error(
        "the body of grains[{section}] has left the domain with {:.1} % of its volume (1 % is the limit; bodies do not come in again \
         at periodic faces); stop the run before, let it move another way, or make the domain larger",
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
        "the body of grains[{section}] has run into solid {other} (from 0): they have {:.1} % of the volume of the smaller one in common \
         (1 % is the limit); stop the run before, or let it move another way",
        100.0 * .common
    )]
    Into {
        /// Its section.
        section: usize,
        /// The number of the other.
        other: usize,
        /// What both fill, over the volume of the smaller one.
        common: f64,
    },
    /// Its surface is none.
    #[error("the body of grains[{section}]: {wrong}")]
    Surface {
        /// Its section.
        section: usize,
        /// What is wrong.
        wrong: WrongShare,
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
        let section = self.section;
        let placed = Pose { centre: *centre, turn: self.turn }.place(&self.mesh);
        let shares =
            solid_shares(&placed, cells).map_err(|wrong| BodyStop::Surface { section, wrong })?;
        let inside: f64 = shares.iter().map(|(_, share)| share).sum();
        let missing = 1.0 - inside / self.volume;
        if missing > MAY_MISS { Err(BodyStop::Outside { section, missing }) } else { Ok(shares) }
    }
}
