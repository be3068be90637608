//! The state of a fluid in a file.

use std::io::{self, Read, Write};

use psmrt_reference::solids::{Load, Solid};

use super::Fluid;
use super::observed::slices;
use crate::lanes::Real;

impl<T: Real> Fluid<T> {
    /// Writes what it needs to go on, bit for bit, besides its set-up, its solids, their loads and its drive.
    pub fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        let cells = self.setup.domain.cell_count();
        let rows = self.run / self.setup.domain.cells()[0];
        for run in 0..cells.div_ceil(self.run) {
            let mut copies = self.copies(run);
            let mut copies = slices(&mut copies);
            self.entering.now().put(run * rows, &mut copies);
            copies.iter().try_for_each(|values| out.write_all(bytemuck::cast_slice(values)))?;
        }
        self.entering.slow_means().try_for_each(|mean| out.write_all(&mean.to_le_bytes()))
    }

    /// Takes what [`Self::save`] wrote for the same scene, with the solids and the loads of then.
    pub fn load(
        &mut self,
        from: &mut dyn Read,
        solids: Vec<Solid>,
        loads: Vec<Load>,
    ) -> io::Result<()> {
        for values in self.grid.runs(self.run).iter_mut().flatten() {
            from.read_exact(bytemuck::cast_slice_mut(values))?;
        }
        self.entering.forget();
        self.is_put.fill(false);
        self.held = None;
        for mean in self.entering.slow_means_mut() {
            let mut bytes = [0; 8];
            from.read_exact(&mut bytes)?;
            *mean = f64::from_le_bytes(bytes);
        }
        self.place_solids(solids);
        self.loads = loads;
        Ok(())
    }
}
