//! Where a body is and how it is turned.

use nalgebra::UnitQuaternion;
use psmrt_reference::lattice::Vec3;

use super::mesh::Mesh;

/// A place and a turn about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Where the origin of the body is.
    pub centre: Vec3,
    /// How it is turned about its origin.
    pub turn: UnitQuaternion<f64>,
}

impl Pose {
    /// A body there: its corners turned about the origin, then moved.
    pub fn place(&self, body: &Mesh) -> Mesh {
        let turn = self.turn.to_rotation_matrix();
        body.mapped(|vertex| self.centre + turn * vertex)
    }

    /// The turn that takes `z` into a direction, the shortest one.
    pub fn from_z_to(direction: &Vec3) -> UnitQuaternion<f64> {
        // Onto its opposite any half turn leads.
        let half = || UnitQuaternion::from_axis_angle(&Vec3::x_axis(), std::f64::consts::PI);
        UnitQuaternion::rotation_between(&Vec3::z(), direction).unwrap_or_else(half)
    }
}
