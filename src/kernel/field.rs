//! Numbers of all cells on the device, one or several to a cell.

use wgpu::BindingResource;

use super::buffers::STORAGE;
use super::device::Gpu;
use super::error::KernelError;
use super::layout::{Layout, WORD};

/// One or several numbers of 32 bits for each cell.
#[derive(Debug)]
pub(super) struct Field {
    layout: Layout,
    buffer: wgpu::Buffer,
}

impl Field {
    /// `per_cell` numbers for each cell, all zero. Errors if the device has no room for them.
    pub(super) fn new(
        gpu: &Gpu,
        layout: Layout,
        label: &str,
        per_cell: u32,
    ) -> Result<Self, KernelError> {
        Ok(Field { layout, buffer: gpu.buffer(label, layout.extent(per_cell) * WORD, STORAGE)? })
    }

    /// Puts numbers there, for each cell that which starts at `start` ([`Layout::direction`]).
    pub(super) fn write(&self, gpu: &Gpu, start: u32, bytes: &[u8]) {
        gpu.queue.write_buffer(&self.buffer, WORD * u64::from(start), bytes);
        // Uploads wait in host memory until they are submitted.
        gpu.queue.submit([]);
    }

    /// The numbers that start at `start`, cell by cell.
    pub(super) fn read(&self, gpu: &Gpu, start: u32) -> Result<Vec<u8>, KernelError> {
        gpu.read_from(&self.buffer, u64::from(start) * WORD, u64::from(self.layout.count) * WORD)
    }

    /// What a shader is bound to.
    pub(super) fn resource(&self) -> BindingResource<'_> {
        self.buffer.as_entire_binding()
    }
}
