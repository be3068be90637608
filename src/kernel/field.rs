//! Numbers of all cells on the device, one or several to a cell, in a buffer or in a texture.

use wgpu::{
    BindingResource, BufferUsages, Extent3d, Origin3d, TexelCopyBufferInfo, TexelCopyBufferLayout,
    TexelCopyTextureInfo, TextureAspect, TextureDescriptor, TextureDimension, TextureFormat,
    TextureUsages,
};

use super::buffers::STORAGE;
use super::device::Gpu;
use super::error::KernelError;
use super::layout::{Layout, Store, WORD};

/// Rows of a texture start at multiples of so many bytes where they are copied to a buffer.
const ROW_BYTES: u32 = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;

/// One or several numbers of 32 bits for each cell.
#[derive(Debug)]
pub(super) struct Field {
    layout: Layout,
    kept: Kept,
}

#[derive(Debug)]
enum Kept {
    Buffer(wgpu::Buffer),
    Texture { texture: wgpu::Texture, view: wgpu::TextureView },
}

impl Field {
    /// `per_cell` numbers for each cell, all zero. Errors if the device has no room for them.
    pub(super) fn new(
        gpu: &Gpu,
        layout: Layout,
        label: &str,
        per_cell: u32,
        format: TextureFormat,
    ) -> Result<Self, KernelError> {
        let kept = match layout.store {
            Store::Buffers => {
                Kept::Buffer(gpu.buffer(label, layout.extent(per_cell) * WORD, STORAGE)?)
            }
            Store::Textures => gpu.checked(|| {
                let texture = gpu.device.create_texture(&TextureDescriptor {
                    label: Some(label),
                    size: size(&layout, per_cell),
                    mip_level_count: 1,
                    sample_count: 1,
                    dimension: TextureDimension::D3,
                    format,
                    usage: TextureUsages::STORAGE_BINDING
                        | TextureUsages::COPY_DST
                        | TextureUsages::COPY_SRC,
                    view_formats: &[],
                });
                let view = texture.create_view(&Default::default());
                Kept::Texture { texture, view }
            })?,
        };
        Ok(Field { layout, kept })
    }

    /// Puts numbers there, for each cell that which starts at `start` ([`Layout::direction`]).
    pub(super) fn write(&self, gpu: &Gpu, start: u32, bytes: &[u8]) {
        match &self.kept {
            Kept::Buffer(buffer) => gpu.queue.write_buffer(buffer, WORD * u64::from(start), bytes),
            Kept::Texture { texture, .. } => {
                let [nx, ny, _] = self.layout.cells;
                let rows = TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(4 * nx),
                    rows_per_image: Some(ny),
                };
                gpu.queue.write_texture(
                    at_plane(texture, start),
                    bytes,
                    rows,
                    size(&self.layout, 1),
                );
            }
        }
        // Uploads wait in host memory until they are submitted.
        gpu.queue.submit([]);
    }

    /// The numbers that start at `start`, cell by cell.
    pub(super) fn read(&self, gpu: &Gpu, start: u32) -> Result<Vec<u8>, KernelError> {
        match &self.kept {
            Kept::Buffer(buffer) => {
                let bytes = u64::from(self.layout.count) * WORD;
                gpu.read_from(buffer, u64::from(start) * WORD, bytes)
            }
            Kept::Texture { texture, .. } => {
                let [nx, ny, nz] = self.layout.cells;
                let row = (4 * nx).next_multiple_of(ROW_BYTES);
                let bytes = u64::from(row) * u64::from(ny) * u64::from(nz);
                let usage = BufferUsages::COPY_DST | BufferUsages::COPY_SRC;
                let landing = gpu.buffer("rows of a texture", bytes, usage)?;
                gpu.checked(|| {
                    let mut encoder = gpu.device.create_command_encoder(&Default::default());
                    let layout = TexelCopyBufferLayout {
                        offset: 0,
                        bytes_per_row: Some(row),
                        rows_per_image: Some(ny),
                    };
                    encoder.copy_texture_to_buffer(
                        at_plane(texture, start),
                        TexelCopyBufferInfo { buffer: &landing, layout },
                        size(&self.layout, 1),
                    );
                    gpu.queue.submit([encoder.finish()]);
                })?;
                let rows = gpu.read(&landing, bytes)?;
                let (row, used) = (row as usize, 4 * nx as usize);
                Ok(rows.chunks_exact(row).flat_map(|row| &row[..used]).copied().collect())
            }
        }
    }

    /// What a shader is bound to.
    pub(super) fn resource(&self) -> BindingResource<'_> {
        match &self.kept {
            Kept::Buffer(buffer) => buffer.as_entire_binding(),
            Kept::Texture { view, .. } => BindingResource::TextureView(view),
        }
    }
}

fn size(layout: &Layout, per_cell: u32) -> Extent3d {
    let [width, height, nz] = layout.cells;
    Extent3d { width, height, depth_or_array_layers: nz * per_cell }
}

fn at_plane(texture: &wgpu::Texture, z: u32) -> TexelCopyTextureInfo<'_> {
    TexelCopyTextureInfo {
        texture,
        mip_level: 0,
        origin: Origin3d { x: 0, y: 0, z },
        aspect: TextureAspect::All,
    }
}
