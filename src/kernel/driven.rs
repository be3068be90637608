//! What drives the fluid, as the device knows it: one small uniform buffer, written when the drive changes.
//!
//! The populations are kept as they are after a collision, so that a step streams first: with the face values of the
//! step before it, whose streaming that is, and then collides with its own body force. A step after a change is
//! therefore made by itself, before those that have the new face values too.
//!
//! Shaders of a scene whose walls are at rest have no face velocities in them; when one first moves, they are made anew.
//! (A condition on a uniform would do as well on hardware; Mesa's lavapipe takes it for a reason to translate the shader anew
//! at each dispatch.)

use psmrt_reference::drive::FaceValue;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::Setup;
use wgpu::BufferUsages;

use super::device::Gpu;
use super::error::KernelError;
use super::numbers::single;

/// Velocity and density less 1 of each face.
pub(super) type FaceRows = [[f32; 4]; 6];

/// The drive on the device.
#[derive(Debug)]
pub(super) struct Driven {
    pub(super) buffer: wgpu::Buffer,
    /// The face values of the step that was made last.
    pub(super) entered: FaceRows,
    /// Whether any wall or inlet has had a velocity.
    pub(super) walls_move: bool,
}

impl Driven {
    pub(super) fn new(gpu: &Gpu, setup: &Setup) -> Result<Self, KernelError> {
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let entered = face_rows(setup);
        let walls_move = any_moves(&entered);
        let driven = Driven { buffer: gpu.buffer("drive", 112, usage)?, entered, walls_move };
        driven.write(gpu, setup);
        Ok(driven)
    }

    /// Uploads the body force of now and the face values that populations come in with next.
    pub(super) fn write(&self, gpu: &Gpu, setup: &Setup) {
        let g = setup.body_force.unwrap_or_else(Vec3::zeros).map(single);
        let mut rows = vec![[g.x, g.y, g.z, 0.0]];
        rows.extend(self.entered);
        gpu.queue.write_buffer(&self.buffer, 0, bytemuck::cast_slice(&rows));
    }
}

/// What the faces of a set-up hold.
pub(super) fn face_rows(setup: &Setup) -> FaceRows {
    let mut rows = [[0.0; 4]; 6];
    for (row, value) in rows.iter_mut().zip(setup.drive().faces.as_flattened()) {
        *row = match value {
            FaceValue::None => [0.0; 4],
            FaceValue::Velocity(u) => [single(u.x), single(u.y), single(u.z), 0.0],
            FaceValue::Density(density) => [0.0, 0.0, 0.0, single(density - 1.0)],
        };
    }
    rows
}

/// WGSL: velocity and density less 1 of a face.
pub(super) fn face(axis: usize, is_high: bool) -> String {
    format!("drive.faces[{}]", 2 * axis + usize::from(is_high))
}

/// Whether any face of a set-up holds a density.
pub(super) fn has_densities(setup: &Setup) -> bool {
    setup.drive().faces.as_flattened().iter().any(|value| matches!(value, FaceValue::Density(_)))
}

/// Whether a wall or an inlet has a velocity.
pub(super) fn any_moves(rows: &FaceRows) -> bool {
    rows.iter().any(|row| row[..3] != [0.0; 3])
}
