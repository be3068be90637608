//! The fluid of one box on a device: what it is made of and how it starts. Its steps are in `steps.rs`,
//! what can be seen of it in `observed.rs`, its saved state in `state.rs`.

use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use psmrt_reference::directions::Q;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::Solid;
use wgpu::{BufferUsages, TextureFormat};

use super::buffers::Growing;
use super::compose::{Recipe, SolidData, Work};
use super::device::Gpu;
use super::driven::Driven;
use super::error::KernelError;
use super::field::Field;
use super::layout::Layout;
use super::numbers::{count, single};
use super::outgoing::Outgoing;
use super::pipeline::Pipeline;
use super::solids::Solids;
use super::streaming::weight;
use super::watch::{KernelTimes, Watch};

/// The fluid of one box on a device. Lattice units throughout.
#[derive(Debug)]
pub struct Kernel {
    pub(super) gpu: Arc<Gpu>,
    pub(super) setup: Setup,
    pub(super) layout: Layout,
    /// Two copies of the populations; a step reads one and writes the other.
    pub(super) copies: [Vec<Field>; 2],
    /// The copy that holds the state.
    pub(super) current: usize,
    /// Whether the state is that after a collision (as from the first step on) or before it.
    pub(super) is_collided: bool,
    pub(super) solids: Option<Solids>,
    /// Cells at faces that are not periodic.
    pub(super) face_cells: Vec<u32>,
    /// Velocities at faces that let sound out, if there are such faces.
    pub(super) outgoing: Option<Outgoing>,
    /// The cells for which the step of all cells is not valid: they are computed again.
    pub(super) list: Growing,
    pub(super) list_count: u32,
    pub(super) tasks: Tasks,
    pub(super) driven: Driven,
    /// Those that have been needed so far.
    pub(super) pipelines: RefCell<HashMap<Work, Arc<Pipeline>>>,
    /// Populations and parts of sums on their way back.
    pub(super) seen: RefCell<Growing>,
    /// Where the time goes, if that is kept.
    pub(super) watch: Watch,
}

/// The uniform buffers that say which cells are worked on.
#[derive(Debug)]
pub(super) struct Tasks {
    pub(super) all: wgpu::Buffer,
    pub(super) listed: wgpu::Buffer,
    pub(super) observed: wgpu::Buffer,
}

impl Tasks {
    fn new(gpu: &Gpu) -> Result<Self, KernelError> {
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let task = |label| gpu.buffer(label, 16, usage);
        Ok(Tasks {
            all: task("all cells")?,
            listed: task("listed cells")?,
            observed: task("observed cells")?,
        })
    }
}

impl Kernel {
    /// A fluid of density 1 at rest. `can_move`: whether the solids may be placed elsewhere later; it is
    /// taken for true where one has a velocity or an angular velocity. The set-up must have passed its checks. Errors
    /// if the device cannot hold it.
    pub fn new(gpu: &Arc<Gpu>, setup: Setup, can_move: bool) -> Result<Self, KernelError> {
        let layout = Layout::new(&setup.domain, gpu.facts())?;
        super::memory::check(gpu.facts(), &layout)?;
        let still = Vec3::zeros();
        let driven = Driven::new(gpu, &setup)?;
        let mut recipe = Recipe {
            setup: &setup,
            layout,
            solids: SolidData::None,
            walls_move: driven.walls_move,
        };
        let solids = match &setup.solid_phase {
            Some(phase) if can_move || !phase.solids.is_empty() => {
                let moves = phase
                    .solids
                    .iter()
                    .any(|solid| solid.velocity != still || solid.angular_velocity != still);
                recipe.solids =
                    if can_move || moves { SolidData::Moving } else { SolidData::Fixed };
                Some(Solids::new(gpu, &recipe, phase)?)
            }
            _ => None,
        };
        let face_cells = recipe.face_cells();
        let copy = || {
            let make = |binding| {
                let directions = layout.directions(binding);
                Field::new(gpu, layout, "populations", directions, TextureFormat::R32Float)
            };
            (0..layout.bindings()).map(make).collect::<Result<Vec<_>, _>>()
        };
        let mut kernel = Kernel {
            copies: [copy()?, copy()?],
            current: 0,
            is_collided: false,
            solids,
            face_cells,
            outgoing: Outgoing::new(gpu, &setup.domain)?,
            list: Growing::new(gpu, "list of cells")?,
            list_count: 0,
            tasks: Tasks::new(gpu)?,
            driven,
            pipelines: RefCell::default(),
            seen: RefCell::new(Growing::new(gpu, "what is read back")?),
            watch: Watch::default(),
            gpu: Arc::clone(gpu),
            setup,
            layout,
        };
        kernel.list_cells()?;
        Ok(kernel)
    }

    /// The set-up, with the solids where they are now and the drive of now.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The device.
    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// Whether to keep the times of [`Self::times`], for which the device is waited for after each part
    /// of a step.
    pub fn keep_times(&mut self, keep: bool) {
        self.watch.is_on = keep;
    }

    /// Where the time has gone, if that is kept.
    pub fn times(&self) -> KernelTimes {
        self.watch.times.get()
    }

    pub(super) fn recipe(&self) -> Recipe<'_> {
        let solids = self.solids.as_ref().map_or(SolidData::None, Solids::data);
        Recipe {
            setup: &self.setup,
            layout: self.layout,
            solids,
            walls_move: self.driven.walls_move,
        }
    }

    /// The pipeline for `work`, made when it is first asked for.
    pub(super) fn pipeline(&self, work: Work) -> Result<Arc<Pipeline>, KernelError> {
        if let Some(made) = self.pipelines.borrow().get(&work) {
            return Ok(Arc::clone(made));
        }
        let made = Arc::new(Pipeline::new(&self.gpu, &self.recipe(), work)?);
        self.pipelines.borrow_mut().insert(work, Arc::clone(&made));
        Ok(made)
    }

    /// Starts again from populations before a collision, one set per cell.
    ///
    /// # Panics
    /// If there are not as many sets as cells: a mistake in the calling code.
    pub fn set_populations(&mut self, f: &[[f64; Q]]) -> Result<(), KernelError> {
        assert_eq!(f.len(), self.setup.domain.cell_count(), "one set of populations per cell");
        self.start(|a| f.iter().map(|f| single(f[a] - weight(a))).collect())
    }

    /// Starts again from the equilibrium at density 1 and `velocity`; see [`Self::set_state`].
    pub fn set_velocity(&mut self, velocity: Vec3) -> Result<(), KernelError> {
        self.set_state(|_| (1.0, velocity))
    }

    /// Starts again from the equilibrium at the density and velocity `state(centre)` at each cell centre.
    /// What solids that may move cover of a cell starts with them.
    pub fn set_state(&mut self, state: impl Fn(Vec3) -> (f64, Vec3)) -> Result<(), KernelError> {
        let domain = &self.setup.domain;
        let half_force = 0.5 * self.setup.body_force.unwrap_or_else(Vec3::zeros);
        let mut states: Vec<(f64, Vec3)> = (0..domain.cell_count())
            .map(|cell| state(domain.centre(domain.coordinates(cell))))
            // With a body force the momentum before a collision is half a step behind.
            .map(|(rho, u)| (rho, u - half_force / rho))
            .collect();
        if let (Some(solids), Some(phase)) = (&self.solids, &self.setup.solid_phase) {
            for (cell, epsilon, motion) in solids.motions(domain, phase) {
                let u = &mut states[cell as usize].1;
                // By volume; where solids overlap they share the cell.
                *u = (1.0 - epsilon.min(1.0)) * *u + motion / epsilon.max(1.0);
            }
        }
        self.start(|a| {
            let c = Vec3::from(psmrt_reference::directions::C[a].map(f64::from));
            let row = states.iter().map(|(rho, u)| {
                let cu = c.dot(u);
                // f_eq - w = w [(ρ - 1) + ρ (3 c·u + 9/2 (c·u)² - 3/2 u²)]
                single(
                    weight(a) * ((rho - 1.0) + rho * (3.0 * cu + 4.5 * cu * cu - 1.5 * u.dot(u))),
                )
            });
            row.collect()
        })
    }

    /// Uploads `row(a)`, the values of all cells, for each direction.
    fn start(&mut self, row: impl Fn(usize) -> Vec<f32>) -> Result<(), KernelError> {
        for a in 0..Q {
            let (binding, start) = self.layout.direction(a);
            let field = &self.copies[self.current][binding as usize];
            field.write(&self.gpu, start, bytemuck::cast_slice(&row(a)));
        }
        if let Some(outgoing) = &mut self.outgoing {
            let rows: Vec<Vec<f32>> = (0..Q).map(row).collect();
            outgoing.start(&self.gpu, &self.setup.domain, |a, cell| rows[a][cell])?;
        }
        self.is_collided = false;
        self.gpu.wait()
    }

    /// Puts the solids where `solids` says, with the velocities there. They must be as many as before
    /// and of the same shapes, and must have been announced as movable.
    pub fn place_solids(&mut self, solids: Vec<Solid>) -> Result<(), KernelError> {
        let is_fixed = self.solids.as_ref().is_some_and(|on_device| on_device.movable().is_none());
        if let (Some(phase), true) = (&self.setup.solid_phase, is_fixed)
            && phase.solids.iter().zip(&solids).any(|(then, now)| now.covers_other_cells(then))
        {
            return self.place_fixed_solids(solids);
        }
        if let (Some(phase), Some(on_device)) = (&mut self.setup.solid_phase, &mut self.solids) {
            phase.solids = solids;
            let since = self.watch.begin();
            on_device.upload(&self.gpu, phase)?;
            self.watch.add(since, |times| &mut times.transfers);
            let since = self.watch.begin();
            on_device.find(&self.gpu)?;
            self.watch.wait(&self.gpu, since, |times| &mut times.coverage)?;
        }
        Ok(())
    }

    /// Puts solids that do not move where a saved state has them: they moved before they were given another motion.
    fn place_fixed_solids(&mut self, solids: Vec<Solid>) -> Result<(), KernelError> {
        let Some(phase) = &mut self.setup.solid_phase else { return Ok(()) };
        phase.solids = solids;
        let phase = phase.clone();
        let placed = Solids::new(&self.gpu, &self.recipe(), &phase)?;
        self.solids = Some(placed);
        self.list_cells()
    }

    /// Lists the cells for which the step of all cells is not valid.
    pub(super) fn list_cells(&mut self) -> Result<(), KernelError> {
        let listed = self.solids.as_ref().map_or(&[][..], |solids| &solids.listed);
        let mut cells = listed.to_vec();
        let known: HashSet<u32> = listed.iter().copied().collect();
        cells.extend(self.face_cells.iter().filter(|&cell| !known.contains(cell)));
        self.list_count = count(cells.len());
        self.list.fill(&self.gpu, &cells)?;
        let listed = [self.list_count, 1, 1, 0];
        self.gpu.queue.write_buffer(&self.tasks.listed, 0, bytemuck::bytes_of(&listed));
        let all = [self.layout.count, 0, u32::from(self.is_collided), 0];
        self.gpu.queue.write_buffer(&self.tasks.all, 0, bytemuck::bytes_of(&all));
        Ok(())
    }

    /// Waits until all steps are made. Errors if the device failed.
    pub fn wait(&self) -> Result<(), KernelError> {
        self.gpu.wait()
    }
}
