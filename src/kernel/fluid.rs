//! The fluid of one box on a device: steps, and what can be seen of it.

use std::cell::{OnceCell, RefCell};
use std::io;
use std::sync::Arc;
use std::time::Instant;

use psmrt_reference::directions::Q;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::{Load, Solid};
use wgpu::BufferUsages;

use super::buffers::{Growing, STORAGE};
use super::compose::{ROW, Recipe, SolidData, Work};
use super::device::Gpu;
use super::error::KernelError;
use super::layout::Layout;
use super::numbers::single;
use super::pipeline::{Pipeline, Slot};
use super::solids::Solids;
use super::streaming::weight;
use super::watch::{KernelTimes, Watch};

/// Cell updates of one submission, at most: a tenth of a second of a large device, which the systems
/// that watch over screens allow, a few seconds of a processor.
const SUBMISSION: u64 = 1 << 27;

/// Cells whose populations are read at once.
const SLICE: usize = 1 << 18;

/// The fluid of one box on a device. Lattice units throughout.
#[derive(Debug)]
pub struct Kernel {
    pub(super) gpu: Arc<Gpu>,
    setup: Setup,
    layout: Layout,
    /// Two copies of the populations; a step reads one and writes the other.
    copies: [Vec<wgpu::Buffer>; 2],
    /// The copy that holds the state.
    current: usize,
    /// Whether the state is that after a collision (as from the first step on) or before it.
    is_collided: bool,
    solids: Option<Solids>,
    /// Cells at faces that are not periodic.
    face_cells: Vec<u32>,
    /// The cells that the step of all cells does not do right.
    list: Growing,
    list_count: u32,
    tasks: Tasks,
    step: Pipeline,
    step_listed: OnceCell<Pipeline>,
    observe: OnceCell<Pipeline>,
    summary: OnceCell<Pipeline>,
    impulses: OnceCell<Pipeline>,
    gather: OnceCell<Pipeline>,
    /// Populations and parts of sums on their way back.
    seen: RefCell<Growing>,
    /// Where the time goes, if that is kept.
    watch: Watch,
}

/// The uniform buffers that say which cells are worked on.
#[derive(Debug)]
struct Tasks {
    all: wgpu::Buffer,
    listed: wgpu::Buffer,
    shares: wgpu::Buffer,
    observed: wgpu::Buffer,
}

impl Tasks {
    fn new(gpu: &Gpu) -> Result<Self, KernelError> {
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let task = |label| gpu.buffer(label, 16, usage);
        Ok(Tasks {
            all: task("all cells")?,
            listed: task("listed cells")?,
            shares: task("shares")?,
            observed: task("observed cells")?,
        })
    }
}

impl Kernel {
    /// A fluid of density 1 at rest. `can_move`: whether the solids may be placed elsewhere later; it is
    /// taken for true where one has a velocity or a spin. The set-up must have passed its checks. Errors
    /// if the device cannot hold it.
    pub fn new(gpu: &Arc<Gpu>, setup: Setup, can_move: bool) -> Result<Self, KernelError> {
        let layout = Layout::new(&setup.domain, gpu.facts(), gpu.width())?;
        super::memory::check(gpu.facts(), &layout)?;
        let still = Vec3::zeros();
        let solids = match &setup.solid_phase {
            Some(phase) if can_move || !phase.solids.is_empty() => {
                let moves =
                    phase.solids.iter().any(|solid| solid.velocity != still || solid.spin != still);
                let tau = setup.collision.tau();
                Some(Solids::new(gpu, &setup.domain, layout, phase, tau, can_move || moves)?)
            }
            _ => None,
        };
        let data = solids.as_ref().map_or(SolidData::None, |solids| solids.data);
        let recipe = Recipe { setup: &setup, layout, solids: data };
        let with_solids = solids.as_ref().is_some_and(|solids| solids.in_every_cell);
        let step = Pipeline::new(gpu, &recipe, Work::Step { with_solids })?;
        let face_cells = recipe.face_cells();
        let copy = || {
            let make = |binding| gpu.buffer("populations", layout.bytes(binding), STORAGE);
            (0..layout.bindings()).map(make).collect::<Result<Vec<_>, _>>()
        };
        let mut kernel = Kernel {
            copies: [copy()?, copy()?],
            current: 0,
            is_collided: false,
            solids,
            face_cells,
            list: Growing::new(gpu, "list of cells")?,
            list_count: 0,
            tasks: Tasks::new(gpu)?,
            step,
            step_listed: OnceCell::new(),
            observe: OnceCell::new(),
            summary: OnceCell::new(),
            impulses: OnceCell::new(),
            gather: OnceCell::new(),
            seen: RefCell::new(Growing::new(gpu, "what is read back")?),
            watch: Watch::default(),
            gpu: Arc::clone(gpu),
            setup,
            layout,
        };
        kernel.list_cells()?;
        Ok(kernel)
    }

    /// The set-up, with the solids where they are now.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The device.
    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// Bytes of memory on the device that the populations take.
    pub fn population_bytes(&self) -> u64 {
        self.layout.bytes_of_both()
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

    fn recipe(&self) -> Recipe<'_> {
        let solids = self.solids.as_ref().map_or(SolidData::None, |solids| solids.data);
        Recipe { setup: &self.setup, layout: self.layout, solids }
    }

    fn pipeline<'a>(
        &'a self,
        cell: &'a OnceCell<Pipeline>,
        work: Work,
    ) -> Result<&'a Pipeline, KernelError> {
        if cell.get().is_none() {
            let made = Pipeline::new(&self.gpu, &self.recipe(), work)?;
            let _ = cell.set(made);
        }
        cell.get().ok_or_else(|| self.gpu.failed("a pipeline was not kept".to_owned()))
    }

    /// Starts again from populations before a collision, one set per cell.
    ///
    /// # Panics
    /// If there are not as many sets as cells: a mistake in the calling code.
    pub fn set_populations(&mut self, f: &[[f64; Q]]) -> Result<(), KernelError> {
        assert_eq!(f.len(), self.setup.domain.cell_count(), "one set of populations per cell");
        self.start(|a| f.iter().map(|f| single(f[a] - weight(a))).collect())
    }

    /// Starts again from the equilibrium at density 1 and `velocity` everywhere.
    pub fn set_velocity(&mut self, velocity: Vec3) -> Result<(), KernelError> {
        let count = self.setup.domain.cell_count();
        // With a body force the momentum before a collision is half a step behind.
        let u = velocity - 0.5 * self.setup.body_force.unwrap_or_else(Vec3::zeros);
        self.start(|a| {
            let c = Vec3::from(psmrt_reference::directions::C[a].map(f64::from));
            let cu = c.dot(&u);
            // f_eq - w = w [3 c·u + 9/2 (c·u)² - 3/2 u²]
            vec![single(weight(a) * (3.0 * cu + 4.5 * cu * cu - 1.5 * u.dot(&u))); count]
        })
    }

    /// Uploads `row(a)`, the values of all cells, for each direction.
    fn start(&mut self, row: impl Fn(usize) -> Vec<f32>) -> Result<(), KernelError> {
        for a in 0..Q {
            let (binding, start) = self.layout.direction(a);
            let buffer = &self.copies[self.current][binding as usize];
            let row = self.layout.placed(&row(a));
            self.gpu.queue.write_buffer(buffer, 4 * u64::from(start), bytemuck::cast_slice(&row));
            // Uploads wait in host memory until they are submitted.
            self.gpu.queue.submit([]);
        }
        self.is_collided = false;
        self.gpu.wait()
    }

    /// Puts the solids where `solids` says, with the velocities there. They must be as many as before
    /// and of the same shapes, and must have been announced as movable.
    pub fn place_solids(&mut self, solids: Vec<Solid>) -> Result<(), KernelError> {
        let tau = self.setup.collision.tau();
        if let (Some(phase), Some(on_device)) = (&mut self.setup.solid_phase, &mut self.solids) {
            phase.solids = solids;
            let start = Instant::now();
            on_device.list(&self.setup.domain, phase);
            self.watch.add(start, |times| &mut times.coverage);
            let start = Instant::now();
            on_device.upload(&self.gpu, phase, tau)?;
            self.watch.add(start, |times| &mut times.transfers);
        }
        self.list_cells()
    }

    /// Lists the cells that the step of all cells does not do right.
    fn list_cells(&mut self) -> Result<(), KernelError> {
        let mut cells = self.face_cells.clone();
        let mut many = 0;
        if let Some(solids) = &self.solids {
            many = solids.many;
            let listed = solids.listed_places().iter();
            if self.face_cells.is_empty() {
                cells.extend(listed);
            } else {
                // Face cells come in order.
                cells.extend(listed.filter(|cell| self.face_cells.binary_search(cell).is_err()));
            }
            let task = [solids.share_count, 1, 1, many];
            self.gpu.queue.write_buffer(&self.tasks.shares, 0, bytemuck::bytes_of(&task));
        }
        self.list_count = number(cells.len());
        self.list.fill(&self.gpu, &cells)?;
        let listed = [self.list_count, 1, 1, many];
        self.gpu.queue.write_buffer(&self.tasks.listed, 0, bytemuck::bytes_of(&listed));
        let all = [self.layout.places, 0, u32::from(self.is_collided), many];
        self.gpu.queue.write_buffer(&self.tasks.all, 0, bytemuck::bytes_of(&all));
        Ok(())
    }

    /// Makes `steps` steps, the solids staying where they are; `with_loads`: and works out the loads of
    /// the last. Does not wait for the device.
    pub fn advance(&mut self, steps: u64, with_loads: bool) -> Result<(), KernelError> {
        let mut left = steps;
        if left > 0 && !self.is_collided {
            left -= 1;
            self.first_step(with_loads && left == 0)?;
        }
        let per_submission = (SUBMISSION / u64::from(self.layout.places)).max(1);
        while left > 0 {
            let now = left.min(per_submission);
            left -= now;
            self.submit_steps(now, with_loads && left == 0)?;
            if left > 0 {
                self.gpu.wait()?;
            }
        }
        Ok(())
    }

    /// The first step: the populations are there before their collision.
    fn first_step(&mut self, with_loads: bool) -> Result<(), KernelError> {
        let task = [self.layout.places, 0, 0, self.solids.as_ref().map_or(0, |solids| solids.many)];
        self.gpu.queue.write_buffer(&self.tasks.all, 0, bytemuck::bytes_of(&task));
        if let Some(solids) = &self.solids {
            let task = [solids.share_count, 1, 0, solids.many];
            self.gpu.queue.write_buffer(&self.tasks.shares, 0, bytemuck::bytes_of(&task));
        }
        let listed = self.pipeline(&self.step_listed, Work::StepListed)?;
        let group = self.bind(listed, &self.tasks.all, None)?;
        self.gpu.checked(|| {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(listed.raw());
            pass.set_bind_group(0, &group, &[]);
            dispatch(&mut pass, self.layout.places);
            drop(pass);
            self.gpu.queue.submit([encoder.finish()]);
        })?;
        self.watch.wait(&self.gpu, |times| &mut times.fluid)?;
        if with_loads {
            self.submit_loads(self.current)?;
        }
        self.current = 1 - self.current;
        self.is_collided = true;
        // The tasks say from now on that the populations are kept as they are after a collision.
        self.list_cells()
    }

    /// Encodes and submits `steps` steps.
    fn submit_steps(&mut self, steps: u64, with_loads: bool) -> Result<(), KernelError> {
        let here = self.current;
        let mut all = Vec::new();
        let mut listed = Vec::new();
        let list_pipeline = if self.list_count > 0 {
            Some(self.pipeline(&self.step_listed, Work::StepListed)?)
        } else {
            None
        };
        for from in [here, 1 - here] {
            all.push(self.bind_from(from, &self.step, None, None)?);
            if let Some(pipeline) = list_pipeline {
                listed.push(self.bind_from(from, pipeline, Some(&self.tasks.listed), None)?);
            }
        }
        let (vectors, [_, ny, nz]) = (self.layout.vectors(), self.layout.cells);
        let [along, across] = self.recipe().workgroup();
        self.gpu.checked(|| {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            let mut parity = 0;
            for _ in 0..steps {
                pass.set_pipeline(self.step.raw());
                pass.set_bind_group(0, &all[parity], &[]);
                pass.dispatch_workgroups(vectors.div_ceil(along), ny.div_ceil(across), nz);
                if let Some(pipeline) = list_pipeline {
                    pass.set_pipeline(pipeline.raw());
                    pass.set_bind_group(0, &listed[parity], &[]);
                    dispatch(&mut pass, self.list_count);
                }
                parity = 1 - parity;
            }
            drop(pass);
            self.gpu.queue.submit([encoder.finish()]);
        })?;
        self.watch.wait(&self.gpu, |times| &mut times.fluid)?;
        let swaps = usize::from(steps % 2 == 1);
        let last_from = if swaps == 1 { here } else { 1 - here };
        if with_loads {
            self.submit_loads(last_from)?;
        }
        self.current = 1 - last_from;
        Ok(())
    }

    /// Works out the loads of a step that started from copy `from`.
    fn submit_loads(&self, from: usize) -> Result<(), KernelError> {
        let Some(solids) = self.solids.as_ref().filter(|solids| solids.solid_count > 0) else {
            return Ok(());
        };
        let impulses = self.pipeline(&self.impulses, Work::Impulses)?;
        if self.gather.get().is_none() {
            let _ = self.gather.set(Pipeline::gather(&self.gpu)?);
        }
        let Some(gather) = self.gather.get() else { return Ok(()) };
        let first = self.bind_from(from, impulses, Some(&self.tasks.shares), None)?;
        let second = gather.bind(
            &self.gpu,
            &[
                (0, solids.shares.buffer()),
                (1, solids.pushes.buffer()),
                (2, solids.starts.buffer()),
                (3, solids.loads.buffer()),
            ],
        )?;
        self.gpu.checked(|| {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(impulses.raw());
            pass.set_bind_group(0, &first, &[]);
            dispatch(&mut pass, solids.share_count);
            pass.set_pipeline(gather.raw());
            pass.set_bind_group(0, &second, &[]);
            let groups = solids.solid_count;
            pass.dispatch_workgroups(groups.min(65_535), groups.div_ceil(65_535), 1);
            drop(pass);
            self.gpu.queue.submit([encoder.finish()]);
        })?;
        self.watch.wait(&self.gpu, |times| &mut times.forces)
    }

    /// Force and torque on each solid during the last step.
    pub fn loads(&self) -> Result<Vec<Load>, KernelError> {
        let Some(solids) = &self.solids else { return Ok(Vec::new()) };
        let start = Instant::now();
        let bytes = self.gpu.read(solids.loads.buffer(), 32 * u64::from(solids.solid_count))?;
        self.watch.add(start, |times| &mut times.transfers);
        let rows: &[[f32; 4]] = bytemuck::cast_slice(&bytes);
        let vector = |row: &[f32; 4]| Vec3::new(row[0].into(), row[1].into(), row[2].into());
        Ok(rows
            .chunks_exact(2)
            .map(|load| Load { force: vector(&load[0]), torque: vector(&load[1]) })
            .collect())
    }

    /// Populations of the cells of the given numbers before their next collision, in their order.
    pub fn populations(&self, cells: &[usize]) -> Result<Vec<[f64; Q]>, KernelError> {
        let observe = self.pipeline(&self.observe, Work::Observe)?;
        let mut found = Vec::with_capacity(cells.len());
        let most = usize::try_from(self.gpu.facts().max_binding_bytes).unwrap_or(usize::MAX);
        for slice in cells.chunks(SLICE.min(most / (4 * Q)).max(1)) {
            let numbers: Vec<u32> =
                slice.iter().map(|&cell| self.layout.place(number(cell))).collect();
            let mut list = Growing::new(&self.gpu, "list of cells")?;
            list.fill(&self.gpu, &numbers)?;
            let bytes = (slice.len() * Q * 4) as u64;
            self.seen.borrow_mut().reserve(&self.gpu, bytes)?;
            let count = number(slice.len());
            self.look(observe, &list, [count, 1, u32::from(self.is_collided), 0], count)?;
            let bytes = self.gpu.read(self.seen.borrow().buffer(), bytes)?;
            let values: &[f32] = bytemuck::cast_slice(&bytes);
            found.extend(
                values
                    .chunks_exact(Q)
                    .map(|h| std::array::from_fn(|a| f64::from(h[a]) + weight(a))),
            );
        }
        Ok(found)
    }

    /// Runs a pipeline that reads the state into `seen`.
    fn look(
        &self,
        pipeline: &Pipeline,
        list: &Growing,
        task: [u32; 4],
        count: u32,
    ) -> Result<(), KernelError> {
        self.gpu.queue.write_buffer(&self.tasks.observed, 0, bytemuck::bytes_of(&task));
        let group = self.bind(pipeline, &self.tasks.observed, Some(list.buffer()))?;
        self.gpu.checked(|| {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(pipeline.raw());
            pass.set_bind_group(0, &group, &[]);
            dispatch(&mut pass, count);
            drop(pass);
            self.gpu.queue.submit([encoder.finish()]);
        })
    }

    /// Sums and extremes over the box.
    pub fn summary(&self) -> Result<Summary, KernelError> {
        let summary = self.pipeline(&self.summary, Work::Summary)?;
        let strands = self.recipe().strands();
        let bytes = u64::from(strands) * 32;
        self.seen.borrow_mut().reserve(&self.gpu, bytes)?;
        let many = self.solids.as_ref().map_or(0, |solids| solids.many);
        let task = [self.layout.places, 0, u32::from(self.is_collided), many];
        self.look(summary, &self.list, task, strands)?;
        let bytes = self.gpu.read(self.seen.borrow().buffer(), bytes)?;
        Ok(Summary::of(bytemuck::cast_slice(&bytes), &self.layout))
    }

    /// Total solid fraction of a cell, at most 1.
    pub fn solid_fraction(&self, cell: usize) -> f64 {
        self.solids.as_ref().map_or(0.0, |solids| solids.coverage.solid_fraction(number(cell)))
    }

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

    /// Waits until all steps are made. Errors if the device failed.
    pub fn wait(&self) -> Result<(), KernelError> {
        self.gpu.wait()
    }

    fn bind(
        &self,
        pipeline: &Pipeline,
        task: &wgpu::Buffer,
        list: Option<&wgpu::Buffer>,
    ) -> Result<wgpu::BindGroup, KernelError> {
        self.bind_from(self.current, pipeline, Some(task), list)
    }

    /// The bindings of a pipeline that starts from copy `from`.
    fn bind_from(
        &self,
        from: usize,
        pipeline: &Pipeline,
        task: Option<&wgpu::Buffer>,
        list: Option<&wgpu::Buffer>,
    ) -> Result<wgpu::BindGroup, KernelError> {
        let mut bindings: Vec<(u32, &wgpu::Buffer)> = Vec::new();
        let seen = self.seen.borrow();
        for slot in pipeline.slots() {
            match slot {
                Slot::Old => bindings.extend((0..).zip(&self.copies[from])),
                Slot::New => bindings.extend((20..).zip(&self.copies[1 - from])),
                Slot::Task => bindings.extend(task.map(|task| (50, task))),
                Slot::List => bindings.push((51, list.unwrap_or_else(|| self.list.buffer()))),
                Slot::Seen => bindings.push((60, seen.buffer())),
                Slot::Solids => {
                    let Some(solids) = &self.solids else { continue };
                    bindings.push((40, solids.per_cell.buffer()));
                    if solids.data == SolidData::Moving {
                        bindings.push((41, solids.records.buffer()));
                    }
                }
                Slot::Excess => {
                    let Some(solids) = &self.solids else { continue };
                    if solids.data == SolidData::Moving {
                        bindings.push((42, solids.excess.buffer()));
                    }
                }
                Slot::Shares => {
                    let Some(solids) = &self.solids else { continue };
                    bindings.push((60, solids.shares.buffer()));
                    bindings.push((61, solids.pushes.buffer()));
                    bindings.push((62, solids.motions.buffer()));
                }
            }
        }
        pipeline.bind(&self.gpu, &bindings)
    }
}

/// A number of cells, of which there are fewer than 2^32.
fn number(of: usize) -> u32 {
    u32::try_from(of).unwrap_or(u32::MAX)
}

/// One invocation for each of `count` things, in workgroups of 64.
fn dispatch(pass: &mut wgpu::ComputePass<'_>, count: u32) {
    if count > 0 {
        let groups = count.div_ceil(64);
        let row = ROW / 64;
        pass.dispatch_workgroups(groups.min(row), groups.div_ceil(row), 1);
    }
}

/// Sums and extremes over the box, lattice units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// Mean density.
    pub density: f64,
    /// Mean of the momentum before and after the next collision.
    pub mass_flux: Vec3,
    /// Largest `|j|/ρ`.
    pub bare_speed: f64,
    /// Largest `|j + G/2|/ρ`.
    pub speed: f64,
    /// The first cell that is broken: not finite, without density, or faster than the guard allows.
    pub broken: Option<usize>,
}

impl Summary {
    fn of(parts: &[[u32; 8]], layout: &Layout) -> Self {
        let real = |bits: u32| f64::from(f32::from_bits(bits));
        let n = layout.cells.iter().map(|&n| f64::from(n)).product::<f64>();
        let sum = |column: usize| parts.iter().map(|part| real(part[column])).sum::<f64>();
        let most = |column: usize| parts.iter().map(|part| real(part[column])).fold(0.0, f64::max);
        let broken = parts.iter().map(|part| part[6]).min().filter(|&cell| cell != u32::MAX);
        Summary {
            density: 1.0 + sum(0) / n,
            mass_flux: Vec3::new(sum(1), sum(2), sum(3)) / n,
            bare_speed: most(4).sqrt(),
            speed: most(5).sqrt(),
            broken: broken.and_then(|place| layout.cell(place)).map(|cell| cell as usize),
        }
    }
}
