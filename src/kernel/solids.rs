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
use super::numbers::count;
use super::table::Table;

/// Above this share of covered cells the solid part is worked out in every cell; below it, only in the
/// listed ones, a second time.
const DENSE: f64 = 0.03;

/// A table that a step may need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SolidTable {
    CellWeights,
    Slots,
    Records,
    Excess,
    Moments,
}

/// What the device holds of the solids.
#[derive(Debug)]
pub(super) struct Solids {
    pub(super) data: SolidData,
    pub(super) coverage: Coverage,
    /// Whether the step of all cells has the solids in it.
    pub(super) in_every_cell: bool,
    /// Weights of all cells, where no solid moves.
    pub(super) cell_weights: Option<Field>,
    /// Numbers of the records of all cells.
    pub(super) slots: Field,
    pub(super) records: Table,
    pub(super) excess: Growing,
    /// Momentum and density of each covered cell before its collision.
    pub(super) moments: Table,
    pub(super) shares: Table,
    pub(super) weights: Growing,
    pub(super) starts: Growing,
    pub(super) motions: Growing,
    pub(super) loads: Growing,
    pub(super) solid_count: u32,
    /// Cells in which several solids meet.
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
        let table = |label| Table::new(gpu, layout.store, label, 4);
        let data = if can_move { SolidData::Moving } else { SolidData::Fixed };
        let weights =
            || Field::new(gpu, layout, "solid weights of cells", 1, TextureFormat::R32Float);
        let mut solids = Solids {
            data,
            coverage: Coverage::new(layout.count),
            in_every_cell: false,
            cell_weights: if can_move { None } else { Some(weights()?) },
            slots: Field::new(gpu, layout, "records of cells", 1, TextureFormat::R32Uint)?,
            records: table("records of covered cells")?,
            excess: buffer("records of cells in which solids meet")?,
            moments: table("moments of covered cells")?,
            shares: table("shares of solids")?,
            weights: buffer("weights of shares")?,
            starts: buffer("first shares of solids")?,
            motions: buffer("motion of solids")?,
            loads: buffer("loads")?,
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
        self.slots.write(gpu, 0, bytemuck::cast_slice(self.coverage.slots()));
        if let Some(field) = &self.cell_weights {
            let weights = self.coverage.weights(phase.weighting, tau);
            field.write(gpu, 0, bytemuck::cast_slice(&weights));
        } else {
            self.records.fill(gpu, &tables.records)?;
            self.excess.fill(gpu, &tables.excess)?;
        }
        self.moments.reserve(gpu, tables.records.len())?;
        self.shares.fill(gpu, &tables.shares)?;
        self.weights.fill(gpu, &tables.weights)?;
        self.starts.fill(gpu, self.coverage.starts())?;
        self.motions.fill(gpu, &tables.motions)?;
        self.loads.reserve(gpu, 32 * phase.solids.len() as u64)?;
        self.solid_count = count(phase.solids.len());
        self.many = count(tables.excess.len() / 2);
        Ok(())
    }

    /// The number of the binding of a table, and the table.
    pub(super) fn resource(&self, table: SolidTable) -> Option<(u32, wgpu::BindingResource<'_>)> {
        Some(match table {
            SolidTable::CellWeights => (40, self.cell_weights.as_ref()?.resource()),
            SolidTable::Slots => (41, self.slots.resource()),
            SolidTable::Records => (42, self.records.resource()),
            SolidTable::Excess => (43, self.excess.resource()),
            SolidTable::Moments => (44, self.moments.resource()),
        })
    }

    /// The cells that must be listed since the step of all cells does not do them right; those in which
    /// several solids meet come first.
    pub(super) fn listed_cells(&self) -> Vec<u32> {
        if self.in_every_cell && self.data == SolidData::Fixed {
            return Vec::new();
        }
        let mut cells: Vec<u32> = self.coverage.meeting_cells().collect();
        if !self.in_every_cell {
            let all = self.coverage.cells().iter();
            cells.extend(all.filter(|&&cell| !self.coverage.is_meeting(cell)));
        }
        cells
    }

    /// Whether a cell is among them.
    pub(super) fn lists(&self, cell: u32) -> bool {
        match (self.in_every_cell, self.data) {
            (false, _) => self.coverage.slots()[cell as usize] > 0,
            (true, SolidData::Moving) => self.coverage.is_meeting(cell),
            (true, _) => false,
        }
    }
}
