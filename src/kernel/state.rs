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

    /// Hands out the populations as the device holds them: for each direction the bits of all cells.
    pub fn save(&self, mut row: impl FnMut(&[u8]) -> io::Result<()>) -> io::Result<()> {
        for a in 0..Q {
            let (binding, start) = self.layout.direction(a);
            let bytes = u64::from(self.layout.places) * 4;
            let buffer = &self.copies[self.current][binding as usize];
            let read = self.gpu.read_from(buffer, u64::from(start) * 4, bytes);
            let placed = read.map_err(io::Error::other)?;
            let placed: &[u32] = bytemuck::cast_slice(&placed);
            row(bytemuck::cast_slice(&self.layout.gathered(placed)))?;
        }
        Ok(())
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
            let placed = self.layout.placed(&values);
            let (binding, start) = self.layout.direction(a);
            let buffer = &self.copies[self.current][binding as usize];
            self.gpu.queue.write_buffer(
                buffer,
                4 * u64::from(start),
                bytemuck::cast_slice(&placed),
            );
            // Uploads wait in host memory until they are submitted.
            self.gpu.queue.submit([]);
        }
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
