//! The solids on the device.

use psmrt_reference::domain::Domain;
use psmrt_reference::setup::SolidPhase;
use wgpu::TextureFormat;

use super::buffers::Growing;
use super::compose::SolidData;
use super::coverage::Coverage;
use super::device::Gpu;
use super::error::KernelError;
use super::field::Field;
use super::layout::Layout;

/// Above this share of covered cells the solid part is worked out in every cell; below it, only in the
/// listed ones, a second time.
const DENSE: f64 = 0.15;

/// What the device holds of the solids.
#[derive(Debug)]
pub(super) struct Solids {
    pub(super) data: SolidData,
    pub(super) coverage: Coverage,
    /// Whether the step of all cells has the solids in it.
    pub(super) in_every_cell: bool,
    /// Weights of all cells (fixed) or numbers of their records (moving).
    pub(super) per_cell: Field,
    pub(super) records: Growing,
    pub(super) excess: Growing,
    pub(super) shares: Growing,
    pub(super) starts: Growing,
    pub(super) motions: Growing,
    pub(super) pushes: Growing,
    pub(super) loads: Growing,
    pub(super) share_count: u32,
    pub(super) solid_count: u32,
    /// Records in which several solids meet.
    pub(super) many: u32,
}

impl Solids {
    /// Uploads the solids where they are. `can_move`: whether they may be placed elsewhere later.
    pub(super) fn new(
        gpu: &Gpu,
        domain: &Domain,
        layout: Layout,
        phase: &SolidPhase,
        tau: f64,
        can_move: bool,
    ) -> Result<Self, KernelError> {
        let buffer = |label| Growing::new(gpu, label);
        let (data, format) = if can_move {
            (SolidData::Moving, TextureFormat::R32Uint)
        } else {
            (SolidData::Fixed, TextureFormat::R32Float)
        };
        let mut solids = Solids {
            data,
            coverage: Coverage::new(layout.count),
            in_every_cell: false,
            per_cell: Field::new(gpu, layout, "solids of cells", 1, format)?,
            records: buffer("records of covered cells")?,
            excess: buffer("records of cells in which solids meet")?,
            shares: buffer("shares of solids")?,
            starts: buffer("first shares of solids")?,
            motions: buffer("motion of solids")?,
            pushes: buffer("impulses")?,
            loads: buffer("loads")?,
            share_count: 0,
            solid_count: 0,
            many: 0,
        };
        solids.list(domain, phase);
        solids.upload(gpu, phase, tau)?;
        let covered = solids.coverage.cells().len() as f64 / domain.cell_count() as f64;
        solids.in_every_cell = covered > DENSE;
        Ok(solids)
    }

    /// Lists what the solids cover where they are now.
    pub(super) fn list(&mut self, domain: &Domain, phase: &SolidPhase) {
        self.coverage.update(domain, phase);
    }

    /// Uploads what was listed.
    pub(super) fn upload(
        &mut self,
        gpu: &Gpu,
        phase: &SolidPhase,
        tau: f64,
    ) -> Result<(), KernelError> {
        let tables = self.coverage.tables(phase, tau);
        match self.data {
            SolidData::Moving => {
                self.per_cell.write(gpu, 0, bytemuck::cast_slice(self.coverage.slots()));
                self.records.fill(gpu, &tables.records)?;
                self.excess.fill(gpu, &tables.excess)?;
            }
            SolidData::Fixed | SolidData::None => {
                let weights = self.coverage.weights(phase.weighting, tau);
                self.per_cell.write(gpu, 0, bytemuck::cast_slice(&weights));
            }
        }
        self.shares.fill(gpu, &tables.shares)?;
        self.starts.fill(gpu, &tables.starts)?;
        self.motions.fill(gpu, &tables.motions)?;
        self.pushes.reserve(gpu, 16 * tables.shares.len() as u64)?;
        self.loads.reserve(gpu, 32 * phase.solids.len() as u64)?;
        let count = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
        self.share_count = count(tables.shares.len());
        self.solid_count = count(phase.solids.len());
        self.many = count(self.coverage.many());
        Ok(())
    }

    /// The cells that must be listed since the step of all cells does not do them right.
    pub(super) fn listed_cells(&self) -> &[u32] {
        match (self.in_every_cell, self.data) {
            (false, _) => self.coverage.cells(),
            (true, SolidData::Moving) => &self.coverage.cells()[..self.coverage.many()],
            (true, _) => &[],
        }
    }
}
