//! Steps of the fluid, and the loads on the solids.

use super::compose::{ROW, SolidData, Work};
use super::error::KernelError;
use super::field::Field;
use super::fluid::Kernel;
use super::pipeline::{Pipeline, Slot};

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
        }
        let per_submission = (SUBMISSION / u64::from(self.layout.count)).max(1);
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
        let task = [self.layout.count, 0, 0, self.solids.as_ref().map_or(0, |solids| solids.many)];
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
            dispatch(&mut pass, self.layout.count);
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
        let [nx, ny, nz] = self.layout.cells;
        let [along, across] = self.recipe().workgroup();
        self.gpu.checked(|| {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            let mut parity = 0;
            for _ in 0..steps {
                pass.set_pipeline(self.step.raw());
                pass.set_bind_group(0, &all[parity], &[]);
                pass.dispatch_workgroups(nx.div_ceil(along), ny.div_ceil(across), nz);
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
            vec![
                (0, solids.shares.resource()),
                (1, solids.pushes.resource()),
                (2, solids.starts.resource()),
                (3, solids.loads.resource()),
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
        let mut bindings: Vec<(u32, wgpu::BindingResource<'_>)> = Vec::new();
        let seen = self.seen.borrow();
        let fields = |copy: usize| self.copies[copy].iter().map(Field::resource);
        for slot in pipeline.slots() {
            match slot {
                Slot::Old => bindings.extend((0..).zip(fields(from))),
                Slot::New => bindings.extend((20..).zip(fields(1 - from))),
                Slot::Task => bindings.extend(task.map(|task| (50, task.as_entire_binding()))),
                Slot::List => {
                    let list = list.unwrap_or_else(|| self.list.buffer());
                    bindings.push((51, list.as_entire_binding()));
                }
                Slot::Seen => bindings.push((60, seen.resource())),
                Slot::Solids => {
                    let Some(solids) = &self.solids else { continue };
                    bindings.push((40, solids.per_cell.resource()));
                    if solids.data == SolidData::Moving {
                        bindings.push((41, solids.records.resource()));
                    }
                }
                Slot::Excess => {
                    let Some(solids) = &self.solids else { continue };
                    if solids.data == SolidData::Moving {
                        bindings.push((42, solids.excess.resource()));
                    }
                }
                Slot::Shares => {
                    let Some(solids) = &self.solids else { continue };
                    bindings.push((60, solids.shares.resource()));
                    bindings.push((61, solids.pushes.resource()));
                    bindings.push((62, solids.motions.resource()));
                }
            }
        }
        pipeline.bind(&self.gpu, bindings)
    }
}

/// One invocation for each of `count` things, in workgroups of 64.
pub(super) fn dispatch(pass: &mut wgpu::ComputePass<'_>, count: u32) {
    if count > 0 {
        let groups = count.div_ceil(64);
        let row = ROW / 64;
        pass.dispatch_workgroups(groups.min(row), groups.div_ceil(row), 1);
    }
}
