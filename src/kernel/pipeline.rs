//! Pipelines: a shader made ready, and what it is bound to.

use super::compose::{Recipe, SolidData, Work};
use super::device::Gpu;
use super::error::KernelError;
use super::outgoing;
use super::solids::SolidTable;

/// A group of bindings that a shader may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slot {
    /// The populations that are read.
    Old,
    /// The populations that are written.
    New,
    /// What is known of the solids in cells.
    Solid(SolidTable),
    /// Which cells are worked on.
    Task,
    /// Their list.
    List,
    /// What is read back.
    Seen,
    /// Velocities at faces that let sound out, those that are read.
    Outgoing,
    /// Those that are written.
    NewOutgoing,
}

/// A shader made ready.
#[derive(Debug)]
pub(super) struct Pipeline {
    raw: wgpu::ComputePipeline,
    slots: Vec<Slot>,
}

impl Pipeline {
    /// The pipeline for `work`. Errors if the driver refuses the shader.
    pub(super) fn new(gpu: &Gpu, recipe: &Recipe<'_>, work: Work) -> Result<Self, KernelError> {
        let mut slots = vec![Slot::Old];
        match work {
            Work::Step { .. } => slots.push(Slot::New),
            Work::StepListed { .. } => slots.extend([Slot::New, Slot::Task, Slot::List]),
            Work::Observe => slots.extend([Slot::Task, Slot::List, Slot::Seen]),
            Work::Summary => slots.extend([Slot::Task, Slot::Seen]),
        }
        if outgoing::has_any(&recipe.setup.domain) {
            match work {
                Work::Step { .. } | Work::StepListed { is_first: true, .. } => {}
                Work::StepListed { .. } => slots.extend([Slot::Outgoing, Slot::NewOutgoing]),
                Work::Observe | Work::Summary => slots.push(Slot::Outgoing),
            }
        }
        let (solids, with_loads) = recipe.solids_in(work);
        let listed = matches!(work, Work::StepListed { .. });
        let tables = [
            (SolidTable::CellWeights, solids == SolidData::Fixed),
            (SolidTable::Slots, solids == SolidData::Moving || with_loads),
            (SolidTable::Records, solids == SolidData::Moving),
            (SolidTable::Excess, solids == SolidData::Moving && listed),
            (SolidTable::Moments, with_loads),
        ];
        let needed = tables.into_iter().filter(|&(_, is_needed)| is_needed);
        slots.extend(needed.map(|(table, _)| Slot::Solid(table)));
        let raw = compiled(gpu, &recipe.shader(work), work.entry())?;
        Ok(Pipeline { raw, slots })
    }

    /// The pipeline of a shader that does not work on the populations.
    pub(super) fn of(gpu: &Gpu, shader: &str, entry: &str) -> Result<Self, KernelError> {
        Ok(Pipeline { raw: compiled(gpu, shader, entry)?, slots: Vec::new() })
    }

    pub(super) fn raw(&self) -> &wgpu::ComputePipeline {
        &self.raw
    }

    pub(super) fn slots(&self) -> &[Slot] {
        &self.slots
    }

    /// Binds buffers and textures, whole, by the numbers of their bindings.
    pub(super) fn bind(
        &self,
        gpu: &Gpu,
        resources: Vec<(u32, wgpu::BindingResource<'_>)>,
    ) -> Result<wgpu::BindGroup, KernelError> {
        let entries: Vec<wgpu::BindGroupEntry<'_>> = resources
            .into_iter()
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
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
            source: wgpu::ShaderSource::Wgsl(text.into()),
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
