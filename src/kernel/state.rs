//! The state of the fluid, to be saved and gone on from.

use std::io;

use psmrt_reference::directions::Q;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Load;

use super::fluid::Kernel;
use super::numbers::single;

impl Kernel {
    /// Whether the state on the device is that after a collision, as from the first step on.
    pub fn is_collided(&self) -> bool {
        self.is_collided
    }

    /// Hands out the populations as the device holds them, for each direction the bits of all cells, and then those
    /// of the velocities at faces that let sound out and those of the face values of the step made last.
    pub fn save(&self, mut row: impl FnMut(&[u8]) -> io::Result<()>) -> io::Result<()> {
        for a in 0..Q {
            let (binding, start) = self.layout.direction(a);
            let field = &self.copies[self.current][binding as usize];
            row(&field.read(&self.gpu, start).map_err(io::Error::other)?)?;
        }
        if let Some(outgoing) = &self.outgoing {
            row(&outgoing.read(&self.gpu, self.current).map_err(io::Error::other)?)?;
        }
        row(self.entered())
    }

    /// Goes on from what [`Self::save`] and [`Self::is_collided`] gave, and the loads of the last step.
    pub fn load(
        &mut self,
        is_collided: bool,
        loads: &[Load],
        mut row: impl FnMut(&mut [u8]) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut values = vec![0_u32; self.setup.domain.cell_count()];
        for a in 0..Q {
            row(bytemuck::cast_slice_mut(&mut values))?;
            let (binding, start) = self.layout.direction(a);
            let field = &self.copies[self.current][binding as usize];
            field.write(&self.gpu, start, bytemuck::cast_slice(&values));
        }
        if let Some(outgoing) = &mut self.outgoing {
            outgoing.restore(&self.gpu, &mut row)?;
        }
        self.restore_entered(row)?;
        self.is_collided = is_collided;
        if let Some(solids) = &mut self.solids {
            let vector = |v: &Vec3| [single(v.x), single(v.y), single(v.z), 0.0];
            let rows: Vec<[f32; 4]> =
                loads.iter().flat_map(|load| [vector(&load.force), vector(&load.torque)]).collect();
            solids.loads.fill(&self.gpu, &rows).map_err(io::Error::other)?;
        }
        self.list_cells().map_err(io::Error::other)?;
        self.gpu.wait().map_err(io::Error::other)
    }
}
