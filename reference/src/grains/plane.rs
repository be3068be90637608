//! Planes: floors, walls, belts and pistons.

use crate::grains::law::LawError;
use crate::grains::laws::Law;
use crate::lattice::Vec3;
use thiserror::Error;

/// A plane with grains on one side of it, in any consistent units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// A point of the plane, length; it moves with the plane.
    pub point: Vec3,
    /// Unit normal, towards the grains.
    pub normal: Vec3,
    /// Velocity, length/time: in the plane it is a belt's, along the normal a piston's.
    pub velocity: Vec3,
    /// How grains touch it.
    pub law: Law,
}

/// A plane that cannot be used.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PlaneError {
    /// A component that is not finite.
    #[error("plane {plane} has {key} = {value}: it must be finite")]
    NotFinite {
        /// Number of the plane.
        plane: usize,
        /// Name of the value.
        key: &'static str,
        /// The value as given.
        value: f64,
    },
    /// A normal of no length, or not of length 1.
    #[error(
        "plane {plane} has a normal of length {length}: it must be 1, and point to the grains' side"
    )]
    Normal {
        /// Number of the plane.
        plane: usize,
        /// Length as given.
        length: f64,
    },
    /// A plane across a periodic axis.
    #[error(
        "plane {plane} cuts the periodic axis {axis}: a plane must lie along every periodic axis; \
         turn it, or make axis {axis} not periodic"
    )]
    AcrossPeriodic {
        /// Number of the plane.
        plane: usize,
        /// The axis, x, y or z.
        axis: char,
    },
    /// Its contact law.
    #[error("plane {plane}: {error}")]
    Law {
        /// Number of the plane.
        plane: usize,
        /// What is wrong with the law.
        error: LawError,
    },
}

impl Plane {
    /// A plane at rest through `point`, with the grains on the side to which `direction` (of any
    /// length) points.
    pub fn fixed(point: Vec3, direction: Vec3, law: impl Into<Law>) -> Self {
        let (normal, law) = (direction.normalize(), law.into());
        Plane { point, normal, velocity: Vec3::zeros(), law }
    }

    /// The same, moving.
    #[must_use]
    pub fn moving(self, velocity: Vec3) -> Self {
        Plane { velocity, ..self }
    }

    /// The walls at rest of a domain from `low` to `high`, two for each axis of `axes` (0, 1 or 2), in
    /// the order of the axes, the lower wall first.
    pub fn box_walls(low: Vec3, high: Vec3, axes: &[usize], law: impl Into<Law>) -> Vec<Self> {
        let law: Law = law.into();
        let wall = |axis: usize| {
            let inward = Vec3::from_fn(|i, _| if i == axis { 1.0 } else { 0.0 });
            [Plane::fixed(low, inward, law), Plane::fixed(high, -inward, law)]
        };
        axes.iter().flat_map(|&axis| wall(axis)).collect()
    }

    /// Distance of `position` from the plane, on the grains' side positive.
    pub fn height(&self, position: &Vec3) -> f64 {
        (position - self.point).dot(&self.normal)
    }

    /// Errors unless plane number `plane` can be used in a domain with these periodic axes.
    pub fn check(&self, plane: usize, periodic: [bool; 3]) -> Result<(), PlaneError> {
        for (key, vector) in
            [("point", self.point), ("normal", self.normal), ("velocity", self.velocity)]
        {
            if let Some(&value) = vector.iter().find(|component| !component.is_finite()) {
                return Err(PlaneError::NotFinite { plane, key, value });
            }
        }
        let length = self.normal.norm();
        if (length - 1.0).abs() > 1e-12 {
            return Err(PlaneError::Normal { plane, length });
        }
        if let Some(axis) = (0..3).find(|&axis| periodic[axis] && self.normal[axis] != 0.0) {
            return Err(PlaneError::AcrossPeriodic { plane, axis: ['x', 'y', 'z'][axis] });
        }
        self.law.checked().map(|_| ()).map_err(|error| PlaneError::Law { plane, error })
    }
}
