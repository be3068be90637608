//! Buffers that grow with what is put into them.

use bytemuck::Pod;
use wgpu::BufferUsages;

use super::device::Gpu;
use super::error::KernelError;

/// A storage buffer that is made anew, larger, when its contents outgrow it: bindings to it are then stale.
#[derive(Debug)]
pub(super) struct Growing {
    label: &'static str,
    buffer: wgpu::Buffer,
}

impl Growing {
    pub(super) fn new(gpu: &Gpu, label: &'static str) -> Result<Self, KernelError> {
        Ok(Growing { label, buffer: gpu.buffer(label, 64, STORAGE)? })
    }

    /// Makes room for `bytes` bytes. What it held is lost where it had less.
    pub(super) fn reserve(&mut self, gpu: &Gpu, bytes: u64) -> Result<(), KernelError> {
        if bytes > self.buffer.size() {
            let limit = gpu.facts().max_binding_bytes.min(gpu.facts().max_buffer_bytes);
            if bytes > limit {
                return Err(KernelError::TooLarge {
                    what: self.label,
                    needed: bytes,
                    available: limit,
                    adapter: gpu.facts().name.clone(),
                });
            }
            // A quarter more, so that grains on the move seldom ask for more.
            self.buffer = gpu.buffer(self.label, (bytes + bytes / 4).min(limit), STORAGE)?;
        }
        Ok(())
    }

    /// Puts `values` at its start.
    pub(super) fn fill<T: Pod>(&mut self, gpu: &Gpu, values: &[T]) -> Result<(), KernelError> {
        let bytes: &[u8] = bytemuck::cast_slice(values);
        self.reserve(gpu, bytes.len() as u64)?;
        if !bytes.is_empty() {
            gpu.queue.write_buffer(&self.buffer, 0, bytes);
        }
        Ok(())
    }

    /// What a shader is bound to.
    pub(super) fn resource(&self) -> wgpu::BindingResource<'_> {
        self.buffer.as_entire_binding()
    }

    pub(super) fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }
}

pub(super) const STORAGE: BufferUsages =
    BufferUsages::STORAGE.union(BufferUsages::COPY_DST).union(BufferUsages::COPY_SRC);
