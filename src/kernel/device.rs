//! Adapters and the device opened on one of them.

use std::sync::{Arc, Mutex, PoisonError};

use wgpu::{Backends, BufferUsages, DeviceType, ErrorFilter};

use super::error::KernelError;
use super::quiet::quietly;

/// What an adapter says about itself.
#[derive(Clone, Debug, PartialEq)]
pub struct AdapterFacts {
    /// Name, as `--adapter` takes it.
    pub name: String,
    /// `vulkan`, `metal` or `dx12`.
    pub backend: String,
    /// `discrete GPU`, `integrated GPU`, `virtual GPU`, `software` or `other`.
    pub kind: &'static str,
    /// Driver and its version, where known.
    pub driver: String,
    /// Largest buffer, bytes.
    pub max_buffer_bytes: u64,
    /// Largest part of a buffer that a shader can see through one binding, bytes.
    pub max_binding_bytes: u64,
    /// Storage bindings of one shader.
    pub max_bindings: u32,
    /// Storage textures of one shader.
    pub max_texture_bindings: u32,
    /// Cells along a side of a three-dimensional texture.
    pub max_texture_side: u32,
    /// Whether values of cells are kept in textures: shaders that run on the processor read those
    /// faster.
    pub prefers_textures: bool,
}

impl AdapterFacts {
    fn of(adapter: &wgpu::Adapter) -> Self {
        let (info, limits) = (adapter.get_info(), adapter.limits());
        AdapterFacts {
            name: info.name,
            backend: info.backend.to_string(),
            kind: match info.device_type {
                DeviceType::DiscreteGpu => "discrete GPU",
                DeviceType::IntegratedGpu => "integrated GPU",
                DeviceType::VirtualGpu => "virtual GPU",
                DeviceType::Cpu => "software",
                DeviceType::Other => "other",
            },
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
            max_buffer_bytes: limits.max_buffer_size,
            max_binding_bytes: limits.max_storage_buffer_binding_size,
            max_bindings: limits.max_storage_buffers_per_shader_stage,
            max_texture_bindings: limits.max_storage_textures_per_shader_stage,
            max_texture_side: limits.max_texture_dimension_3d,
            // Of Direct3D's software adapter nothing is known.
            prefers_textures: info.device_type == DeviceType::Cpu
                && info.backend == wgpu::Backend::Vulkan,
        }
    }

    /// Whether it computes on the processor.
    pub fn is_software(&self) -> bool {
        self.kind == "software"
    }
}

fn all_adapters() -> Vec<wgpu::Adapter> {
    let mut description = wgpu::InstanceDescriptor::new_without_display_handle();
    description.backends = Backends::VULKAN | Backends::METAL | Backends::DX12;
    let mut adapters = quietly(|| {
        let instance = wgpu::Instance::new(description);
        pollster::block_on(instance.enumerate_adapters(Backends::all()))
    });
    // The fastest kind first; the order of the driver among equals.
    adapters.sort_by_key(|adapter| match adapter.get_info().device_type {
        DeviceType::DiscreteGpu => 0,
        DeviceType::IntegratedGpu => 1,
        DeviceType::VirtualGpu => 2,
        DeviceType::Other => 3,
        DeviceType::Cpu => 4,
    });
    adapters
}

/// The adapters of this machine, the fastest kind first.
pub fn adapters() -> Vec<AdapterFacts> {
    all_adapters().iter().map(AdapterFacts::of).collect()
}

/// An opened device. One serves any number of kernels.
#[derive(Debug)]
pub struct Gpu {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    facts: AdapterFacts,
    /// What the driver reported outside of any call, the first only.
    failure: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// Opens the adapter whose name contains `name` (in any case), else the first. Errors if there is
    /// none or if it cannot be used.
    pub fn open(name: Option<&str>) -> Result<Arc<Self>, KernelError> {
        let adapters = all_adapters();
        let adapter = match name {
            None => adapters.first().ok_or(KernelError::NoAdapter)?,
            Some(_) if adapters.is_empty() => return Err(KernelError::NoAdapter),
            Some(wanted) => {
                let named = |adapter: &&wgpu::Adapter| {
                    adapter.get_info().name.to_lowercase().contains(&wanted.to_lowercase())
                };
                adapters.iter().find(named).ok_or_else(|| {
                    let known: Vec<String> =
                        adapters.iter().map(|adapter| adapter.get_info().name).collect();
                    KernelError::NoSuchAdapter {
                        wanted: wanted.to_owned(),
                        known: known.join(", "),
                    }
                })?
            }
        };
        Self::open_adapter(adapter)
    }

    /// The same for testing what hardware runs: populations in buffers, also on a software adapter, and
    /// at most so many bytes in a binding.
    pub fn open_like_hardware(max_binding_bytes: u64) -> Result<Arc<Self>, KernelError> {
        let gpu = Self::open(None)?;
        match Arc::try_unwrap(gpu) {
            Ok(mut gpu) => {
                gpu.facts.prefers_textures = false;
                gpu.facts.max_binding_bytes = gpu.facts.max_binding_bytes.min(max_binding_bytes);
                Ok(Arc::new(gpu))
            }
            Err(gpu) => Ok(gpu),
        }
    }

    fn open_adapter(adapter: &wgpu::Adapter) -> Result<Arc<Self>, KernelError> {
        let facts = AdapterFacts::of(adapter);
        let description = wgpu::DeviceDescriptor {
            label: Some("psmrt"),
            // All that the adapter has: the defaults are those of a telephone.
            required_limits: adapter.limits(),
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            ..Default::default()
        };
        let (device, queue) =
            pollster::block_on(adapter.request_device(&description)).map_err(|error| {
                KernelError::Refused { adapter: facts.name.clone(), reason: error.to_string() }
            })?;
        let failure = Arc::new(Mutex::new(None));
        let note = |failure: &Arc<Mutex<Option<String>>>| {
            let failure = Arc::clone(failure);
            move |reason: String| {
                failure.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(reason);
            }
        };
        let note_error = note(&failure);
        device
            .on_uncaptured_error(Arc::new(move |error: wgpu::Error| note_error(one_line(&error))));
        let note_loss = note(&failure);
        device.set_device_lost_callback(move |reason, message| {
            // The device is also given up, in good order, when it is dropped.
            if reason != wgpu::DeviceLostReason::Destroyed {
                note_loss(format!("the device was lost: {message}"));
            }
        });
        Ok(Arc::new(Gpu { device, queue, facts, failure }))
    }

    /// What the adapter says about itself.
    pub fn facts(&self) -> &AdapterFacts {
        &self.facts
    }

    /// Does `work` and errors if the driver objects to any of it.
    pub(super) fn checked<T>(&self, work: impl FnOnce() -> T) -> Result<T, KernelError> {
        let scopes = [ErrorFilter::Internal, ErrorFilter::OutOfMemory, ErrorFilter::Validation]
            .map(|filter| self.device.push_error_scope(filter));
        let done = work();
        let mut found = None;
        for scope in scopes.into_iter().rev() {
            let error = pollster::block_on(scope.pop());
            found = found.or(error);
        }
        match found {
            Some(error) => Err(self.failed(one_line(&error))),
            None => self.still_works().map(|()| done),
        }
    }

    /// Errors if the driver has reported a failure.
    pub(super) fn still_works(&self) -> Result<(), KernelError> {
        match self.failure.lock().unwrap_or_else(PoisonError::into_inner).clone() {
            Some(reason) => Err(self.failed(reason)),
            None => Ok(()),
        }
    }

    /// Waits until all that was submitted is done.
    pub(super) fn wait(&self) -> Result<(), KernelError> {
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| self.failed(error.to_string()))?;
        self.still_works()
    }

    pub(super) fn failed(&self, reason: String) -> KernelError {
        KernelError::Failed { adapter: self.facts.name.clone(), reason }
    }

    /// A buffer of `bytes` bytes (at least 16), filled with zeros.
    pub(super) fn buffer(
        &self,
        label: &str,
        bytes: u64,
        usage: BufferUsages,
    ) -> Result<wgpu::Buffer, KernelError> {
        let size = bytes.max(16).next_multiple_of(4);
        self.checked(|| {
            let descriptor = wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            };
            self.device.create_buffer(&descriptor)
        })
    }

    /// The first `bytes` bytes of `buffer`, which must allow copies out of it.
    pub(super) fn read(&self, buffer: &wgpu::Buffer, bytes: u64) -> Result<Vec<u8>, KernelError> {
        self.read_from(buffer, 0, bytes)
    }

    /// The same from byte `start`.
    pub(super) fn read_from(
        &self,
        buffer: &wgpu::Buffer,
        start: u64,
        bytes: u64,
    ) -> Result<Vec<u8>, KernelError> {
        if bytes == 0 {
            return Ok(Vec::new());
        }
        let usage = BufferUsages::COPY_DST | BufferUsages::MAP_READ;
        let landing = self.buffer("landing", bytes, usage)?;
        self.checked(|| {
            let mut encoder = self.device.create_command_encoder(&Default::default());
            encoder.copy_buffer_to_buffer(buffer, start, &landing, 0, bytes);
            self.queue.submit([encoder.finish()]);
        })?;
        let slice = landing.slice(..bytes);
        slice.map_async(wgpu::MapMode::Read, |_| {});
        self.wait()?;
        let view = slice.get_mapped_range().map_err(|error| self.failed(error.to_string()))?;
        let copy = view.to_vec();
        drop(view);
        landing.unmap();
        Ok(copy)
    }
}

/// A driver's error on one line.
fn one_line(error: &wgpu::Error) -> String {
    let text = error.to_string();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
