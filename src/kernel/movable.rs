//! What movable solids cover, found on the device from where they are.
//!
//! Each solid has room for the touches (parts of cells that it covers) that it can have wherever it is;
//! touches are numbered from 1, solid by solid. Four shaders, each with work in proportion to the touches:
//! `uncover` empties the cells of the last place, `measure` counts along each row of cells, `touch` works
//! out the fractions and hangs each touch into its cell, `resolve` makes of them the record of each cell:
//! `(B, Σ B_s u_s)`. Where several solids meet in a cell the touches come in an order left to chance; they
//! are added up in that of their numbers, so that two runs give the same bits.

use psmrt_reference::setup::SolidPhase;
use psmrt_reference::solids::{Shape, Solid};
use wgpu::{BindingResource, BufferUsages};

use super::bindings::Binding;
use super::buffers::Growing;
use super::compose::Recipe;
use super::covering::{Covering, Stage};
use super::device::Gpu;
use super::error::KernelError;
use super::numbers::{count, single};
use super::pipeline::Pipeline;
use super::table::Table;
use super::touches::{Room, Touches};

/// Touches of one solid that one workgroup works out, about.
const SHARE: u32 = 512;

/// Storage buffers that `resolve.wgsl` works with.
const BINDINGS: u32 = 12;

/// Workgroups to one solid, at most.
const MOST_PARTS: u32 = 64;

/// A list of cells that the device makes.
#[derive(Debug)]
pub(super) struct DeviceList {
    pub(super) cells: Growing,
    /// Uniform buffer that says how many.
    pub(super) task: wgpu::Buffer,
    /// Where in `Movable::groups` the number of workgroups stands, bytes.
    pub(super) groups_at: u64,
}

/// What the device holds of solids that may move, besides their touches.
#[derive(Debug)]
pub(super) struct Movable {
    /// Per cell the number of its record, 0 for none.
    pub(super) slots: Growing,
    /// `(B, Σ B_s u_s)` of each covered cell.
    pub(super) records: Table,
    /// Of cells in which several solids meet.
    pub(super) excess: Growing,
    given: Growing,
    rows: Growing,
    fractions: Growing,
    found: Growing,
    pub(super) groups: wgpu::Buffer,
    /// Cells that one solid touches; listed where the step of all cells has no solids in it.
    pub(super) alone: DeviceList,
    /// Cells in which several solids meet.
    pub(super) meetings: DeviceList,
    pipelines: [Pipeline; 5],
    /// Workgroups to one solid.
    pub(super) parts: u32,
    solids: u32,
}

impl Movable {
    /// Room for the solids, which are still to be placed. `in_every_cell`: whether the step of all cells
    /// has the solids in it.
    pub(super) fn new(
        gpu: &Gpu,
        recipe: &Recipe<'_>,
        phase: &SolidPhase,
        touches: &mut Touches,
        in_every_cell: bool,
    ) -> Result<Self, KernelError> {
        use Binding::{
            Alone, Counts, Excess, Found, Given, Groups, Links, Meetings, Records, Rows, Shares,
            Slots, Solids, Touches, Weights,
        };
        let (needed, available) = (BINDINGS, gpu.facts().max_bindings);
        if available < needed {
            let adapter = gpu.facts().name.clone();
            return Err(KernelError::TooManyBindings { needed, available, adapter });
        }
        let (room, [all, rows]) = Room::of_all(&recipe.setup.domain, &phase.solids);
        let most = room.iter().map(|room| room.touches).max().unwrap_or(0);
        let parts = most.div_ceil(SHARE).clamp(1, MOST_PARTS);
        let stage = |stage| recipe.covering(Covering { stage, in_every_cell, parts });
        let (touch, resolve) = (stage(Stage::Touch), stage(Stage::Resolve));
        let mut of_cells = vec![Touches, Links, Weights, Excess, Found, Meetings, Records];
        of_cells.extend([Solids, Counts, Slots, Shares]);
        if !in_every_cell {
            of_cells.push(Alone);
        }
        let pipelines = [
            Pipeline::of(gpu, &resolve, "uncover", vec![Solids, Counts, Slots, Shares])?,
            Pipeline::of(gpu, &touch, "measure", vec![Solids, Rows, Counts])?,
            Pipeline::of(
                gpu,
                &touch,
                "touch",
                vec![Solids, Given, Rows, Counts, Slots, Touches, Links, Shares],
            )?,
            Pipeline::of(gpu, &resolve, "resolve", of_cells)?,
            Pipeline::of(gpu, &stage(Stage::Groups), "groups", vec![Found, Groups])?,
        ];
        let words = |label, words: u64| {
            let mut buffer = Growing::new(gpu, label)?;
            buffer.reserve(gpu, 4 * words)?;
            Ok(buffer)
        };
        let list = |label, length, groups_at| {
            let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
            let task = gpu.buffer("listed cells", 16, usage)?;
            Ok(DeviceList { cells: words(label, length)?, task, groups_at })
        };
        let all = u64::from(all) + 1;
        let cells = u64::from(recipe.layout.count);
        // A cell in which solids meet has two touches at least.
        let shared = (all / 2).min(cells);
        let mut movable = Movable {
            slots: words("records of cells", cells)?,
            records: Table::new(gpu, recipe.layout.store, "records of covered cells")?,
            excess: words("records of cells in which solids meet", 8 * shared)?,
            given: Growing::new(gpu, "given solid fractions")?,
            rows: words("rows of cells about solids", 2 * u64::from(rows))?,
            fractions: words("solid fractions of touches", 2 * all)?,
            found: words("numbers of covered cells", 2)?,
            groups: gpu.buffer(
                "listed cells",
                64,
                BufferUsages::STORAGE | BufferUsages::INDIRECT | BufferUsages::COPY_SRC,
            )?,
            alone: list("cells that solids touch", if in_every_cell { 1 } else { cells }, 0)?,
            meetings: list("cells in which solids meet", shared, 32)?,
            pipelines,
            parts,
            solids: count(room.len()),
        };
        let rows = usize::try_from(all).unwrap_or(usize::MAX);
        movable.records.reserve(gpu, rows)?;
        touches.reserve(gpu, rows, room)?;
        movable.give(gpu, &phase.solids, &touches.room)?;
        Ok(movable)
    }

    /// Uploads the cells of solids that are given cell by cell.
    pub(super) fn give(
        &mut self,
        gpu: &Gpu,
        solids: &[Solid],
        room: &[Room],
    ) -> Result<(), KernelError> {
        self.given.fill(gpu, &given(solids, room))
    }

    /// Has the device find what they cover there. Does not wait for it.
    pub(super) fn find(&self, gpu: &Gpu, touches: &Touches) -> Result<(), KernelError> {
        let solids = self.solids;
        if solids == 0 {
            return Ok(());
        }
        let of_each = [solids.min(65_535), self.parts, solids.div_ceil(65_535)];
        let groups = solids.div_ceil(64);
        let sizes = [of_each, [groups, 1, 1], of_each, of_each, [1, 1, 1]];
        let resources = |at| self.resource(at, touches).into_iter().collect();
        let bind = |pipeline: &Pipeline| pipeline.bind(gpu, resources);
        let bound = self.pipelines.iter().map(bind).collect::<Result<Vec<_>, _>>()?;
        gpu.checked(|| {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            encoder.clear_buffer(self.found.buffer(), 0, None);
            let mut pass = encoder.begin_compute_pass(&Default::default());
            for ((pipeline, group), [x, y, z]) in self.pipelines.iter().zip(&bound).zip(sizes) {
                pass.set_pipeline(pipeline.raw());
                pass.set_bind_group(0, group, &[]);
                pass.dispatch_workgroups(x, y, z);
            }
            drop(pass);
            for list in [&self.alone, &self.meetings] {
                encoder.copy_buffer_to_buffer(&self.groups, list.groups_at + 16, &list.task, 0, 16);
            }
            gpu.queue.submit([encoder.finish()]);
        })
    }

    /// What a shader is bound to there; nothing if it is no table of the solids.
    pub(super) fn resource<'a>(
        &'a self,
        at: Binding,
        touches: &'a Touches,
    ) -> Option<BindingResource<'a>> {
        Some(match at {
            Binding::Given => self.given.resource(),
            Binding::Rows => self.rows.resource(),
            Binding::Slots => self.slots.resource(),
            Binding::Touches => self.fractions.resource(),
            Binding::Excess => self.excess.resource(),
            Binding::Found => self.found.resource(),
            Binding::Alone => self.alone.cells.resource(),
            Binding::Meetings => self.meetings.cells.resource(),
            Binding::Records => self.records.resource(),
            Binding::Groups => self.groups.as_entire_binding(),
            _ => touches.resource(at)?,
        })
    }
}

/// Cell and bits of the solid fraction of each given touch, each solid's where it has room for them.
fn given(solids: &[Solid], room: &[Room]) -> Vec<[u32; 2]> {
    let mut all = Vec::new();
    for (solid, room) in solids.iter().zip(room) {
        let Shape::Cells { fractions, .. } = &solid.shape else { continue };
        let row = |&(cell, epsilon): &(usize, f64)| [count(cell), single(epsilon).to_bits()];
        all.extend(fractions.iter().map(row));
        all.resize((room.rows + room.touches) as usize, [0; 2]);
    }
    all
}
