//! What drives the fluid during a step: the body force and the value of each face.
//!
//! A set-up says of which kinds the faces are and whether there is a body force; that stays. It also holds the values
//! of now, as it holds the solids where they are now, and a [`Drive`] puts others in their place.
//!
//! A step takes `f(t)` to `f(t + 1)`: the collision acts at `t`, with the body force; a link is turned back or let in
//! at a face half-way between nodes, at `t + 1/2`. So a flow driven by `G(t)` and by a wall of velocity `u_w(t)` is
//! of second order in time with `G(t)` and `u_w(t + 1/2)` in the drive of that step.

use thiserror::Error;

use crate::domain::{Domain, FACE_NAMES, Face, Faces};
use crate::lattice::Vec3;
use crate::setup::{Setup, SetupError, check_body_force};

/// What a face holds; lattice units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FaceValue {
    /// Nothing: it is periodic, free slip or free outflow.
    None,
    /// The velocity of a wall or of an inlet.
    Velocity(Vec3),
    /// The density of a face of given pressure.
    Density(f64),
}

/// The values of a step; lattice units.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Force per volume on the fluid; `None` if the set-up has none.
    pub body_force: Option<Vec3>,
    /// What the faces hold, `[axis][side]`, the low side first.
    pub faces: [[FaceValue; 2]; 3],
}

/// A drive that a set-up cannot take.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum DriveError {
    /// A body force for a set-up without one.
    #[error(
        "the drive has a body force and the set-up none: what is computed without one cannot take one later; give the \
         set-up one of zero"
    )]
    ForceAppears,
    /// No body force for a set-up that has one.
    #[error("the set-up has a body force and the drive none: give the drive one of zero")]
    ForceVanishes,
    /// A value of another kind than the face holds.
    #[error("face {face} holds {holds} and is given {given}: the kind of a face stays in a run")]
    OtherValue {
        /// The face.
        face: &'static str,
        /// What it holds.
        holds: &'static str,
        /// What it is given.
        given: &'static str,
    },
    /// A value that no such face, or no body force, can have.
    #[error(transparent)]
    Value(#[from] SetupError),
}

impl Face {
    /// What it holds.
    pub fn value(&self) -> FaceValue {
        match *self {
            Face::Periodic | Face::FreeSlip | Face::FreeOutflow => FaceValue::None,
            Face::Wall { velocity } | Face::VelocityInlet { velocity } => {
                FaceValue::Velocity(velocity)
            }
            Face::Pressure { density }
            | Face::DevelopedPressure { density }
            | Face::NonReflectingPressure { density, .. } => FaceValue::Density(density),
        }
    }

    /// The same kind of face with another value; `None` if it holds no such value.
    fn holding(self, value: FaceValue) -> Option<Face> {
        Some(match (self, value) {
            (Face::Periodic | Face::FreeSlip | Face::FreeOutflow, FaceValue::None) => self,
            (Face::Wall { .. }, FaceValue::Velocity(velocity)) => Face::Wall { velocity },
            (Face::VelocityInlet { .. }, FaceValue::Velocity(velocity)) => {
                Face::VelocityInlet { velocity }
            }
            (Face::Pressure { .. }, FaceValue::Density(density)) => Face::Pressure { density },
            (Face::DevelopedPressure { .. }, FaceValue::Density(density)) => {
                Face::DevelopedPressure { density }
            }
            (Face::NonReflectingPressure { memory, .. }, FaceValue::Density(density)) => {
                Face::NonReflectingPressure { density, memory }
            }
            _ => return None,
        })
    }
}

impl Setup {
    /// What drives the fluid now.
    pub fn drive(&self) -> Drive {
        let faces = std::array::from_fn(|axis| self.domain.faces().axis(axis).map(|f| f.value()));
        Drive { body_force: self.body_force, faces }
    }

    /// Lets `drive` drive the fluid from now on. Errors, and changes nothing, if it has a value of another kind than
    /// a face holds or that the face cannot have, or a body force where the set-up has none, or the reverse.
    pub fn set_drive(&mut self, drive: &Drive) -> Result<(), DriveError> {
        match (&self.body_force, &drive.body_force) {
            (None, None) => {}
            (Some(_), Some(g)) => check_body_force(g)?,
            (None, Some(_)) => return Err(DriveError::ForceAppears),
            (Some(_), None) => return Err(DriveError::ForceVanishes),
        }
        let mut faces = [[Face::Periodic; 2]; 3];
        for axis in 0..3 {
            for side in 0..2 {
                let (face, value) = (self.domain.faces().axis(axis)[side], drive.faces[axis][side]);
                faces[axis][side] = face.holding(value).ok_or(DriveError::OtherValue {
                    face: FACE_NAMES[axis][side],
                    holds: word(face.value()),
                    given: word(value),
                })?;
            }
        }
        let [x, y, z] = faces;
        self.domain =
            Domain::new(self.domain.cells(), Faces { x, y, z }).map_err(SetupError::from)?;
        self.body_force = drive.body_force;
        Ok(())
    }
}

/// What kind of value it is, in words.
fn word(value: FaceValue) -> &'static str {
    match value {
        FaceValue::None => "no value",
        FaceValue::Velocity(_) => "a velocity",
        FaceValue::Density(_) => "a density",
    }
}
