//! Steps of the fluid, and the loads on the solids.

use super::bindings::Binding;
use super::buffers::Growing;
use super::compose::{ROW, Work};
use super::error::KernelError;
use super::field::Field;
use super::fluid::Kernel;
use super::movable::DeviceList;
use super::pipeline::Pipeline;
use super::solids::Solids;

/// Cell updates of one submission, at most: a tenth of a second of a large device, which the systems
/// that watch over screens allow, a few seconds of a processor.
const SUBMISSION: u64 = 1 << 27;

impl Kernel {
    /// Makes `steps` steps, the solids staying where they are; `with_loads`: and works out the loads of
    /// the last. Does not wait for the device.
    pub fn advance(&mut self, steps: u64, with_loads: bool) -> Result<(), KernelError> {
        let mut left = steps;
        if left > 0 && !self.is_collided {
            left -= 1;
            self.first_step(with_loads && left == 0)?;
            self.enter();
        }
        let per_submission = (SUBMISSION / u64::from(self.layout.count)).max(1);
        while left > 0 {
            let now = if self.has_entered() { left.min(per_submission) } else { 1 };
            left -= now;
            self.submit_steps(now, with_loads && left == 0)?;
            self.enter();
            if left > 0 {
                self.gpu.wait()?;
            }
        }
        Ok(())
    }

    /// The first step: the populations are there before their collision.
    fn first_step(&mut self, with_loads: bool) -> Result<(), KernelError> {
        let since = self.watch.begin();
        // All cells, and again those in which several solids meet: what is more of them goes by the list.
        let task = [self.layout.count, 0, 0, 0];
        self.gpu.queue.write_buffer(&self.tasks.all, 0, bytemuck::bytes_of(&task));
        let with_loads = with_loads && self.has_solids();
        let listed = self.listed_pipeline(with_loads, true)?;
        let all = self.bind(listed, &self.tasks.all, None)?;
        let movable = self.solids.as_ref().and_then(Solids::movable);
        let meetings = match movable {
            Some(movable) => {
                let DeviceList { cells, task, groups_at } = &movable.meetings;
                let group = self.bind(listed, task, Some(cells.buffer()))?;
                Some((group, &movable.groups, *groups_at))
            }
            None => None,
        };
        self.gpu.checked(|| {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(listed.raw());
            pass.set_bind_group(0, &all, &[]);
            dispatch(&mut pass, self.layout.count);
            if let Some((group, groups, groups_at)) = &meetings {
                pass.set_bind_group(0, group, &[]);
                pass.dispatch_workgroups_indirect(groups, *groups_at);
            }
            drop(pass);
            self.gpu.queue.submit([encoder.finish()]);
        })?;
        self.watch.wait(&self.gpu, since, |times| &mut times.fluid)?;
        if with_loads {
            self.submit_loads()?;
        }
        self.current = 1 - self.current;
        self.is_collided = true;
        // The tasks say from now on that the populations are kept as they are after a collision.
        self.list_cells()
    }

    /// Encodes and submits `steps` steps.
    fn submit_steps(&mut self, steps: u64, with_loads: bool) -> Result<(), KernelError> {
        let since = self.watch.begin();
        let with_loads = with_loads && self.has_solids();
        let before = steps - u64::from(with_loads);
        let [nx, ny, nz] = self.layout.cells;
        let [along, across] = self.recipe().workgroup();
        let kinds = [self.passes(false)?, self.passes(with_loads)?];
        self.gpu.checked(|| {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            for number in 0..steps {
                let passes = &kinds[usize::from(number >= before)];
                let parity = usize::from(number % 2 == 1);
                pass.set_pipeline(passes.all.raw());
                pass.set_bind_group(0, &passes.all_groups[parity], &[]);
                pass.dispatch_workgroups(nx.div_ceil(along), ny.div_ceil(across), nz);
                for list in &passes.lists {
                    pass.set_pipeline(list.pipeline.raw());
                    pass.set_bind_group(0, &list.groups[parity], &[]);
                    match list.length {
                        Length::Known(count) => dispatch(&mut pass, count),
                        Length::OnDevice(groups, at) => {
                            pass.dispatch_workgroups_indirect(groups, at);
                        }
                    }
                }
            }
            drop(pass);
            self.gpu.queue.submit([encoder.finish()]);
        })?;
        drop(kinds);
        self.watch.wait(&self.gpu, since, |times| &mut times.fluid)?;
        if with_loads {
            self.submit_loads()?;
        }
        if steps % 2 == 1 {
            self.current = 1 - self.current;
        }
        Ok(())
    }

    fn has_solids(&self) -> bool {
        self.solids.as_ref().is_some_and(|solids| solids.solid_count > 0)
    }

    /// The pipelines of a step with their bindings, from either copy.
    fn passes(&self, with_loads: bool) -> Result<Passes<'_>, KernelError> {
        let in_every_cell = self.solids.as_ref().is_some_and(|solids| solids.in_every_cell);
        let all = if with_loads && in_every_cell {
            let work = Work::Step { with_solids: true, with_loads: true };
            self.pipeline(&self.step_with_loads, work)?
        } else {
            &self.step
        };
        let copies = [self.current, 1 - self.current];
        let [first, second] = copies.map(|from| self.bind_from(from, all, None, None));
        let all_groups = [first?, second?];
        let mut lists = Vec::new();
        let mut add = |task, cells: &Growing, length| -> Result<(), KernelError> {
            let pipeline = self.listed_pipeline(with_loads, false)?;
            let bind = |from| self.bind_from(from, pipeline, Some(task), Some(cells.buffer()));
            let [first, second] = copies.map(bind);
            lists.push(List { pipeline, groups: [first?, second?], length });
            Ok(())
        };
        if self.list_count > 0 {
            add(&self.tasks.listed, &self.list, Length::Known(self.list_count))?;
        }
        // After those at faces, so that what several solids do in a cell there stands.
        if let Some(movable) = self.solids.as_ref().and_then(Solids::movable) {
            let alone = (!in_every_cell).then_some(&movable.alone);
            for list in alone.into_iter().chain([&movable.meetings]) {
                let length = Length::OnDevice(&movable.groups, list.groups_at);
                add(&list.task, &list.cells, length)?;
            }
        }
        Ok(Passes { all, all_groups, lists })
    }

    fn listed_pipeline(&self, with_loads: bool, is_first: bool) -> Result<&Pipeline, KernelError> {
        let work = Work::StepListed { with_loads, is_first };
        let cell = match (is_first, with_loads) {
            (true, false) => &self.first_step,
            (true, true) => &self.first_step_with_loads,
            (false, false) => &self.step_listed,
            (false, true) => &self.step_listed_with_loads,
        };
        self.pipeline(cell, work)
    }

    /// Adds up the loads of the step that was submitted last.
    fn submit_loads(&self) -> Result<(), KernelError> {
        let since = self.watch.begin();
        let Some(solids) = &self.solids else { return Ok(()) };
        if self.gather.get().is_none() {
            let bindings = vec![
                Binding::Shares,
                Binding::Weights,
                Binding::Solids,
                Binding::Counts,
                Binding::Moments,
                Binding::Loads,
                Binding::Links,
            ];
            let shader = self.recipe().gather();
            let gather = Pipeline::of(&self.gpu, &shader, "gather", bindings)?;
            let _ = self.gather.set(gather);
        }
        let Some(gather) = self.gather.get() else { return Ok(()) };
        let resources = |at| solids.resource(at).into_iter().collect();
        let group = gather.bind(&self.gpu, resources)?;
        self.gpu.checked(|| {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(gather.raw());
            pass.set_bind_group(0, &group, &[]);
            let groups = solids.solid_count;
            pass.dispatch_workgroups(groups.min(65_535), groups.div_ceil(65_535), 1);
            drop(pass);
            self.gpu.queue.submit([encoder.finish()]);
        })?;
        self.watch.wait(&self.gpu, since, |times| &mut times.forces)
    }

    pub(super) fn bind(
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
        let seen = self.seen.borrow();
        let fields = |copy: usize| self.copies[copy].iter().map(Field::resource).collect();
        let outgoing = |copy: usize| self.outgoing.as_ref().map(|kept| kept.resource(copy));
        pipeline.bind(&self.gpu, |at| {
            let one = match at {
                Binding::Old => return fields(from),
                Binding::New => return fields(1 - from),
                Binding::Drive => Some(self.driven.buffer.as_entire_binding()),
                Binding::Task => task.map(wgpu::Buffer::as_entire_binding),
                Binding::CellList => {
                    Some(list.unwrap_or_else(|| self.list.buffer()).as_entire_binding())
                }
                Binding::Seen => Some(seen.resource()),
                Binding::Outgoing => outgoing(from),
                Binding::NewOutgoing => outgoing(1 - from),
                _ => self.solids.as_ref().and_then(|solids| solids.resource(at)),
            };
            one.into_iter().collect()
        })
    }
}

/// The pipelines of one step.
struct Passes<'a> {
    /// Of all cells.
    all: &'a Pipeline,
    all_groups: [wgpu::BindGroup; 2],
    /// Of listed cells.
    lists: Vec<List<'a>>,
}

/// Work on listed cells.
struct List<'a> {
    pipeline: &'a Pipeline,
    groups: [wgpu::BindGroup; 2],
    length: Length<'a>,
}

/// How many cells are listed.
#[derive(Clone, Copy)]
enum Length<'a> {
    Known(u32),
    /// The numbers of workgroups stand in a buffer, so many bytes from its start.
    OnDevice(&'a wgpu::Buffer, u64),
}

/// One invocation for each of `count` things, in workgroups of 64.
pub(super) fn dispatch(pass: &mut wgpu::ComputePass<'_>, count: u32) {
    if count > 0 {
        let groups = count.div_ceil(64);
        let row = ROW / 64;
        pass.dispatch_workgroups(groups.min(row), groups.div_ceil(row), 1);
    }
}
