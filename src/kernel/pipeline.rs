//! Pipelines: a shader made ready, and what it is bound to.

use super::bindings::Binding;
use super::compose::{Recipe, SolidData, Work};
use super::device::Gpu;
use super::error::KernelError;
use super::outgoing;

/// A shader made ready.
#[derive(Debug)]
pub(super) struct Pipeline {
    raw: wgpu::ComputePipeline,
    bindings: Vec<Binding>,
}

impl Pipeline {
    /// The pipeline for `work`. Errors if the driver refuses the shader.
    pub(super) fn new(gpu: &Gpu, recipe: &Recipe<'_>, work: Work) -> Result<Self, KernelError> {
        let mut bindings = vec![Binding::Old];
        let of_touches = [Binding::Shares, Binding::Weights, Binding::Solids, Binding::Counts];
        match work {
            Work::Step { .. } => bindings.push(Binding::New),
            Work::StepListed { .. } => {
                bindings.extend([Binding::New, Binding::Task, Binding::CellList]);
            }
            Work::Observe => bindings.extend([Binding::Task, Binding::CellList, Binding::Seen]),
            Work::Summary => bindings.extend([Binding::Task, Binding::Seen]),
            Work::Loads => {
                bindings = vec![Binding::Moments, Binding::Links, Binding::Loads];
                bindings.extend(of_touches);
            }
            Work::Grips { .. } => {
                bindings.extend(of_touches);
                bindings.extend([Binding::CellList, Binding::Seen]);
            }
        }
        if recipe.takes_drive(work) {
            bindings.push(Binding::Drive);
        }
        if work.has_faces() && outgoing::has_any(&recipe.setup.domain) {
            bindings.push(Binding::Outgoing);
            if matches!(work, Work::StepListed { .. }) {
                bindings.push(Binding::NewOutgoing);
            }
        }
        let (solids, with_loads) = recipe.solids_in(work);
        let is_moving = solids == SolidData::Moving;
        let of_solids = [
            (Binding::CellWeights, solids == SolidData::Fixed),
            (Binding::Slots, is_moving || with_loads),
            (Binding::Records, is_moving),
            (Binding::Excess, is_moving && matches!(work, Work::StepListed { .. })),
            (Binding::Moments, with_loads),
        ];
        bindings.extend(of_solids.into_iter().filter(|&(_, is_in)| is_in).map(|(at, _)| at));
        Self::of(gpu, &recipe.shader(work), work.entry(), bindings)
    }

    /// The pipeline of a shader with these bindings. Errors if the driver refuses it.
    pub(super) fn of(
        gpu: &Gpu,
        shader: &str,
        entry: &str,
        bindings: Vec<Binding>,
    ) -> Result<Self, KernelError> {
        Ok(Pipeline { raw: compiled(gpu, shader, entry)?, bindings })
    }

    pub(super) fn raw(&self) -> &wgpu::ComputePipeline {
        &self.raw
    }

    /// Has it run by itself. Does not wait for the device.
    pub(super) fn run(
        &self,
        gpu: &Gpu,
        group: &wgpu::BindGroup,
        [x, y, z]: [u32; 3],
    ) -> Result<(), KernelError> {
        gpu.checked(|| {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&self.raw);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(x, y, z);
            drop(pass);
            gpu.queue.submit([encoder.finish()]);
        })
    }

    /// Binds what `resources` has for each binding, whole: of the populations several.
    pub(super) fn bind<'a>(
        &self,
        gpu: &Gpu,
        resources: impl Fn(Binding) -> Vec<wgpu::BindingResource<'a>>,
    ) -> Result<wgpu::BindGroup, KernelError> {
        let mut entries = Vec::new();
        for &at in &self.bindings {
            let numbered = (at.number()..).zip(resources(at));
            entries.extend(
                numbered.map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }),
            );
        }
        gpu.checked(|| {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &self.raw.get_bind_group_layout(0),
                entries: &entries,
            })
        })
    }
}

fn compiled(gpu: &Gpu, text: &str, entry: &str) -> Result<wgpu::ComputePipeline, KernelError> {
    gpu.checked(|| {
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(entry),
            source: wgpu::ShaderSource::Wgsl((Binding::constants() + text).into()),
        });
        gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: None,
            module: &module,
            entry_point: Some(entry),
            compilation_options: Default::default(),
            cache: None,
        })
    })
}
