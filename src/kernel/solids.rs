//! The solids on the device.

use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::SolidPhase;
use psmrt_reference::solids::{Shape, Solid};
use wgpu::TextureFormat;

use super::bindings::Binding;
use super::buffers::Growing;
use super::compose::{Recipe, SolidData};
use super::coverage::Coverage;
use super::device::Gpu;
use super::error::KernelError;
use super::field::Field;
use super::movable::Movable;
use super::numbers::count;
use super::touches::Touches;

/// Above this share of covered cells the solid part is worked out in every cell; below it, only in the
/// listed ones, a second time.
const DENSE: f64 = 0.03;

/// What the device holds of the solids.
#[derive(Debug)]
pub(super) struct Solids {
    /// The cells that must be listed, since the step of all cells does not have the solids in it, in order. Those of
    /// movable solids the device lists itself.
    pub(super) listed: Vec<u32>,
    /// Whether the step of all cells has the solids in it.
    pub(super) in_every_cell: bool,
    kept: Kept,
    pub(super) touches: Touches,
    pub(super) loads: Growing,
    pub(super) solid_count: u32,
}

/// What is known of the solids in cells.
#[derive(Debug)]
enum Kept {
    /// Where they never move: the weight and the number of the record of each cell.
    Fixed(Box<[Field; 2]>),
    Movable(Box<Movable>),
}

impl Solids {
    /// Uploads the solids where they are. `recipe` says whether they may be placed elsewhere later.
    pub(super) fn new(
        gpu: &Gpu,
        recipe: &Recipe<'_>,
        phase: &SolidPhase,
    ) -> Result<Self, KernelError> {
        let (domain, layout) = (&recipe.setup.domain, recipe.layout);
        let tau = recipe.setup.collision.tau();
        let coverage = Coverage::of(domain, phase);
        let covered = coverage.cells().len() as f64 / domain.cell_count() as f64;
        let in_every_cell = covered > DENSE;
        let mut touches = Touches::new(gpu, layout.store)?;
        let mut loads = Growing::new(gpu, "loads")?;
        loads.reserve(gpu, 32 * phase.solids.len() as u64)?;
        let kept = if recipe.solids == SolidData::Moving {
            let movable = Movable::new(gpu, recipe, phase, &mut touches, in_every_cell)?;
            touches.place(gpu, &phase.solids)?;
            movable.find(gpu, &touches)?;
            Kept::Movable(Box::new(movable))
        } else {
            let field = |label, format| Field::new(gpu, layout, label, 1, format);
            let weights = field("solid weights of cells", TextureFormat::R32Float)?;
            let slots = field("records of cells", TextureFormat::R32Uint)?;
            weights.write(gpu, 0, bytemuck::cast_slice(&coverage.weights(phase.weighting, tau)));
            slots.write(gpu, 0, bytemuck::cast_slice(coverage.slots()));
            let tables = coverage.tables(phase, tau);
            touches.fill(gpu, &tables)?;
            touches.place(gpu, &phase.solids)?;
            Kept::Fixed(Box::new([weights, slots]))
        };
        let lists = !in_every_cell && recipe.solids != SolidData::Moving;
        Ok(Solids {
            listed: if lists { coverage.cells().to_vec() } else { Vec::new() },
            in_every_cell,
            kept,
            touches,
            loads,
            solid_count: count(phase.solids.len()),
        })
    }

    /// How they are kept.
    pub(super) fn data(&self) -> SolidData {
        match &self.kept {
            Kept::Fixed(_) => SolidData::Fixed,
            Kept::Movable(_) => SolidData::Moving,
        }
    }

    /// What of them may move.
    pub(super) fn movable(&self) -> Option<&Movable> {
        match &self.kept {
            Kept::Movable(movable) => Some(movable),
            Kept::Fixed(_) => None,
        }
    }

    /// Uploads where movable solids are now.
    pub(super) fn upload(&mut self, gpu: &Gpu, phase: &SolidPhase) -> Result<(), KernelError> {
        let Kept::Movable(movable) = &mut self.kept else { return Ok(()) };
        let is_placed = |solid: &Solid| matches!(solid.shape, Shape::Cells { place: Some(_), .. });
        if phase.solids.iter().any(is_placed) {
            movable.give(gpu, &phase.solids, &self.touches.room)?;
        }
        self.touches.place(gpu, &phase.solids)
    }

    /// Has the device find what they cover there.
    pub(super) fn find(&self, gpu: &Gpu) -> Result<(), KernelError> {
        self.movable().map_or(Ok(()), |movable| movable.find(gpu, &self.touches))
    }

    /// The covered cells, how much of them is solid, and `Σ ε_s u_s`, where solids may move.
    pub(super) fn motions(&self, domain: &Domain, phase: &SolidPhase) -> Vec<(u32, f64, Vec3)> {
        match self.kept {
            Kept::Movable(_) => Coverage::of(domain, phase).motions(phase),
            // Full cells keep what they start with.
            Kept::Fixed(_) if phase.operator.is_tight() => {
                Coverage::of(domain, phase).motions(phase)
            }
            Kept::Fixed(_) => Vec::new(),
        }
    }

    /// What a shader is bound to there; nothing if it is no table of the solids.
    pub(super) fn resource(&self, at: Binding) -> Option<wgpu::BindingResource<'_>> {
        Some(match (at, &self.kept) {
            (Binding::CellWeights, Kept::Fixed(fields)) => fields[0].resource(),
            (Binding::Slots, Kept::Fixed(fields)) => fields[1].resource(),
            (Binding::Loads, _) => self.loads.resource(),
            (_, Kept::Fixed(_)) => self.touches.resource(at)?,
            (_, Kept::Movable(movable)) => movable.resource(at, &self.touches)?,
        })
    }
}
