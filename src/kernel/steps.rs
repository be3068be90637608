//! Steps of the fluid.

use std::sync::Arc;

use super::bindings::Binding;
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
        // All cells, and again those in which several solids meet: what is more of them goes by the list.
        let task = [self.layout.count, 0, 0, 0];
        self.gpu.queue.write_buffer(&self.tasks.all, 0, bytemuck::bytes_of(&task));
        self.submit_steps(1, with_loads)?;
        self.is_collided = true;
        // The tasks say from now on that the populations are kept as they are after a collision.
        self.list_cells()
    }

    /// Encodes and submits `steps` steps, the first alone.
    fn submit_steps(&mut self, steps: u64, with_loads: bool) -> Result<(), KernelError> {
        let since = self.watch.begin();
        let with_loads = with_loads && self.has_solids();
        let before = steps - u64::from(with_loads);
        let parts =
            |is_needed: bool, with_loads| is_needed.then(|| self.parts(with_loads)).transpose();
        let kinds = [parts(before > 0, false)?, parts(with_loads, true)?];
        self.gpu.checked(|| {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            for number in 0..steps {
                for part in kinds[usize::from(number >= before)].iter().flatten() {
                    pass.set_pipeline(part.pipeline.raw());
                    pass.set_bind_group(0, &part.groups[usize::from(number % 2 == 1)], &[]);
                    match part.size {
                        Size::Known([x, y, z]) => pass.dispatch_workgroups(x, y, z),
                        Size::OnDevice(groups, at) => {
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

    /// The parts of a step in their order, those of listed cells over the one of all cells.
    fn parts(&self, with_loads: bool) -> Result<Vec<Part<'_>>, KernelError> {
        let (solids, is_first) = (self.solids.as_ref(), !self.is_collided);
        let in_every_cell = solids.is_some_and(|solids| solids.in_every_cell);
        let of_list = Work::StepListed { with_loads, is_first };
        let mut parts = Vec::new();
        if is_first {
            let size = Size::Known(groups_of(self.layout.count));
            parts.push(self.part(of_list, Some(&self.tasks.all), None, size)?);
        } else {
            let with_loads = with_loads && in_every_cell;
            let [nx, ny, nz] = self.layout.cells;
            let [along, across] = self.recipe().workgroup();
            let size = Size::Known([nx.div_ceil(along), ny.div_ceil(across), nz]);
            let work = Work::Step { with_solids: in_every_cell, with_loads };
            parts.push(self.part(work, None, None, size)?);
        }
        if !is_first && self.list_count > 0 {
            let size = Size::Known(groups_of(self.list_count));
            parts.push(self.part(of_list, Some(&self.tasks.listed), None, size)?);
        }
        // After those at faces, so that what several solids do in a cell there stands.
        if let Some(movable) = solids.and_then(Solids::movable) {
            let alone = (!is_first && !in_every_cell).then_some(&movable.alone);
            for DeviceList { cells, task, groups_at } in
                alone.into_iter().chain([&movable.meetings])
            {
                let size = Size::OnDevice(&movable.groups, *groups_at);
                parts.push(self.part(of_list, Some(task), Some(cells.buffer()), size)?);
            }
        }
        Ok(parts)
    }

    /// A part of a step, from either copy.
    fn part<'a>(
        &'a self,
        work: Work,
        task: Option<&wgpu::Buffer>,
        list: Option<&wgpu::Buffer>,
        size: Size<'a>,
    ) -> Result<Part<'a>, KernelError> {
        let pipeline = self.pipeline(work)?;
        let bind = |from| self.bind(from, &pipeline, task, list);
        let groups = [bind(self.current)?, bind(1 - self.current)?];
        Ok(Part { pipeline, groups, size })
    }

    /// The bindings of a pipeline that starts from copy `from`.
    pub(super) fn bind(
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

/// A part of a step.
struct Part<'a> {
    pipeline: Arc<Pipeline>,
    groups: [wgpu::BindGroup; 2],
    size: Size<'a>,
}

/// How many workgroups it takes.
enum Size<'a> {
    Known([u32; 3]),
    /// The numbers stand in a buffer, so many bytes from its start.
    OnDevice(&'a wgpu::Buffer, u64),
}

/// Workgroups of 64 with one invocation for each of `count` things.
pub(super) fn groups_of(count: u32) -> [u32; 3] {
    let (groups, row) = (count.div_ceil(64), ROW / 64);
    [groups.min(row), groups.div_ceil(row), 1]
}
