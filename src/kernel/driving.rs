//! The drive of a kernel: taken from the caller, passed on to the device, saved.

use std::io;

use psmrt_reference::drive::{Drive, DriveError};

use super::driven::{FaceRows, any_moves, face_rows};
use super::fluid::Kernel;

impl Kernel {
    /// Lets `drive` drive the fluid from now on. Errors, and changes nothing, as [`psmrt_reference::setup::Setup::set_drive`].
    pub fn set_drive(&mut self, drive: &Drive) -> Result<(), DriveError> {
        self.setup.set_drive(drive)?;
        self.let_walls_move(&face_rows(&self.setup));
        self.driven.write(&self.gpu, &self.setup);
        Ok(())
    }

    /// Has shaders with face velocities in them made if one of these is the first.
    fn let_walls_move(&mut self, rows: &FaceRows) {
        if !self.driven.walls_move && any_moves(rows) {
            self.driven.walls_move = true;
            self.pipelines.borrow_mut().retain(|work, _| !work.has_faces());
        }
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
        self.let_walls_move(&self.driven.entered.clone());
        self.driven.write(&self.gpu, &self.setup);
        Ok(())
    }
}
