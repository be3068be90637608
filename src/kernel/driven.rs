//! What drives the fluid, as the device knows it: one small uniform buffer, written when the drive changes.
//!
//! The populations are kept as they are after a collision, so that a step streams first: with the face values of the
//! step before it, whose streaming that is, and then collides with its own body force. A step after a change is
//! therefore made by itself, before those that have the new face values too.

use std::io;

use psmrt_reference::drive::{Drive, DriveError, FaceValue};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::Setup;
use wgpu::BufferUsages;

use super::device::Gpu;
use super::error::KernelError;
use super::fluid::Kernel;
use super::numbers::single;

/// Velocity and density less 1 of each face.
type FaceRows = [[f32; 4]; 6];

/// The drive on the device.
#[derive(Debug)]
pub(super) struct Driven {
    pub(super) buffer: wgpu::Buffer,
    /// The face values of the step that was made last.
    entered: FaceRows,
}

impl Driven {
    pub(super) fn new(gpu: &Gpu, setup: &Setup) -> Result<Self, KernelError> {
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let driven = Driven { buffer: gpu.buffer("drive", 112, usage)?, entered: face_rows(setup) };
        driven.write(gpu, setup);
        Ok(driven)
    }

    /// Uploads the body force of now and the face values that populations come in with next.
    fn write(&self, gpu: &Gpu, setup: &Setup) {
        let g = setup.body_force.unwrap_or_else(Vec3::zeros).map(single);
        let moves = self.entered.iter().any(|row| row[..3] != [0.0; 3]);
        let mut rows = vec![[g.x, g.y, g.z, f32::from(u8::from(moves))]];
        rows.extend(self.entered);
        gpu.queue.write_buffer(&self.buffer, 0, bytemuck::cast_slice(&rows));
    }
}

impl Kernel {
    /// Lets `drive` drive the fluid from now on. Errors, and changes nothing, as [`Setup::set_drive`].
    pub fn set_drive(&mut self, drive: &Drive) -> Result<(), DriveError> {
        self.setup.set_drive(drive)?;
        self.driven.write(&self.gpu, &self.setup);
        Ok(())
    }

    /// Whether the step made last had the face values of now.
    pub(super) fn has_entered(&self) -> bool {
        self.driven.entered == face_rows(&self.setup)
    }

    /// After a step with the drive of now.
    pub(super) fn enter(&mut self) {
        if !self.has_entered() {
            self.driven.entered = face_rows(&self.setup);
            self.driven.write(&self.gpu, &self.setup);
        }
    }

    /// The bits of the face values of the step made last, to be saved.
    pub(super) fn entered(&self) -> &[u8] {
        bytemuck::cast_slice(&self.driven.entered)
    }

    /// Goes on from what [`Self::entered`] gave, which `row` puts where it is told.
    pub(super) fn restore_entered(
        &mut self,
        row: impl FnOnce(&mut [u8]) -> io::Result<()>,
    ) -> io::Result<()> {
        row(bytemuck::cast_slice_mut(&mut self.driven.entered))?;
        self.driven.write(&self.gpu, &self.setup);
        Ok(())
    }
}

fn face_rows(setup: &Setup) -> FaceRows {
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

/// Whether any face of a set-up holds a value.
pub(super) fn has_face_values(setup: &Setup) -> bool {
    setup.drive().faces.as_flattened().iter().any(|value| *value != FaceValue::None)
}
