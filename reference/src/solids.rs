//! Solids in the fluid: vocabulary that every engine shares. What a shape is like: [`crate::shapes`].

use std::sync::Arc;

use crate::lattice::Vec3;
use nalgebra::Matrix3;
use thiserror::Error;

/// Where a solid is.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A sphere of `radius` about the solid's centre, in cells.
    Sphere {
        /// Radius in cells.
        radius: f64,
    },
    /// Solid fractions given cell by cell (`(cell index, epsilon in 0..=1)`): slabs, voxels, bodies of any form.
    Cells {
        /// Cell index and solid fraction.
        fractions: Arc<[(usize, f64)]>,
        /// If whoever moves the solid gives new fractions with each place: the number of the place that these are of.
        /// `None`: they stay where they are, also if the solid has a velocity (a belt).
        place: Option<u64>,
    },
}

/// A solid with its motion, in lattice units.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Its shape.
    pub shape: Shape,
    /// Its centre: centre of a sphere, and the point about which it rotates and torques are taken.
    pub centre: Vec3,
    /// Velocity of the centre.
    pub velocity: Vec3,
    /// Angular velocity in radians per step.
    pub angular_velocity: Vec3,
}

/// A solid that cannot be used.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SolidError {
    /// A radius, centre or velocity that is not a finite number, or a radius that is not positive.
    #[error("solid {solid} has {key} = {value}: {allowed}")]
    BadValue {
        /// Number of the solid.
        solid: usize,
        /// Name of the value.
        key: &'static str,
        /// The value as given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A cell index outside the domain.
    #[error("solid {solid} names cell {cell}, but the domain has {count} cells (0 to {count} - 1)")]
    NoSuchCell {
        /// Number of the solid.
        solid: usize,
        /// The cell as given.
        cell: usize,
        /// Number of cells in the domain.
        count: usize,
    },
}

impl Solid {
    /// A fixed sphere.
    pub fn fixed_sphere(centre: Vec3, radius: f64) -> Self {
        let still = Vec3::zeros();
        Solid { shape: Shape::Sphere { radius }, centre, velocity: still, angular_velocity: still }
    }

    /// Given solid fractions, fixed.
    pub fn fixed_cells(fractions: Vec<(usize, f64)>) -> Self {
        let still = Vec3::zeros();
        Solid {
            shape: Shape::Cells { fractions: fractions.into(), place: None },
            centre: still,
            velocity: still,
            angular_velocity: still,
        }
    }

    /// Velocity of the solid at distance `arm` from its centre, translation and rotation.
    pub fn velocity_at(&self, arm: &Vec3) -> Vec3 {
        // u_p = U + ω × r
        self.velocity + self.angular_velocity.cross(arm)
    }

    /// Whether it moves or spins.
    pub fn has_velocity(&self) -> bool {
        self.velocity != Vec3::zeros() || self.angular_velocity != Vec3::zeros()
    }

    /// Errors unless the numbers of solid number `solid` can be used in a domain of `cell_count` cells.
    pub fn check(&self, solid: usize, cell_count: usize) -> Result<(), SolidError> {
        let bad = |key, value, allowed| Err(SolidError::BadValue { solid, key, value, allowed });
        let finite = "it must be finite";
        for (key, vector) in
            [("centre", self.centre), ("velocity", self.velocity), ("spin", self.angular_velocity)]
        {
            if let Some(&value) = vector.iter().find(|component| !component.is_finite()) {
                return bad(key, value, finite);
            }
        }
        match &self.shape {
            Shape::Sphere { radius } if !(*radius > 0.0 && radius.is_finite()) => {
                bad("radius", *radius, "it must be positive and finite")
            }
            Shape::Sphere { .. } => Ok(()),
            Shape::Cells { fractions, .. } => {
                for &(cell, epsilon) in fractions.iter() {
                    if cell >= cell_count {
                        return Err(SolidError::NoSuchCell { solid, cell, count: cell_count });
                    }
                    if !(0.0..=1.0).contains(&epsilon) {
                        return bad("solid fraction", epsilon, "it must lie between 0 and 1");
                    }
                }
                Ok(())
            }
        }
    }
}

/// Force and torque of the fluid on a solid during one step, lattice units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    /// Force.
    pub force: Vec3,
    /// Torque about the solid's centre.
    pub torque: Vec3,
}

/// How a solid holds the fluid of its cells: what it would take from it in the next collision, linear in the velocity
/// that it has there (`coupling/implicit.rs`). With `b = g B_s` in each of its cells, `g` what the operator takes over
/// `B (j - ρ u_s)`, with `j` and `ρ` before the collision, and `r` from the solid's centre to the cell. Lattice units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Grip {
    /// `J = Σ b j`
    pub impulse: Vec3,
    /// `L = Σ r × b j`
    pub moment: Vec3,
    /// `m = Σ b ρ`
    pub mass: f64,
    /// `S = Σ b ρ r`
    pub mass_arm: Vec3,
    /// `Θ = Σ b ρ (r² I - r rᵀ)`
    pub inertia: Matrix3<f64>,
    /// `Σ B_s`
    pub displaced: f64,
}
