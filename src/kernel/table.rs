//! Rows of numbers on the device that shaders pick at random: what is known of the cells that solids touch.
//!
//! A buffer of rows or, where the values of cells lie in textures (see `layout.rs` for why), a texture with
//! a plane for each column, in which the rows go on from line to line; what does not fit into these planes
//! goes on in more of them behind.

use bytemuck::Pod;
use wgpu::{BindingResource, Extent3d, Origin3d, TextureFormat, TextureUsages};

use super::bindings::Binding;
use super::buffers::Growing;
use super::device::Gpu;
use super::error::KernelError;
use super::layout::{MAX_TEXTURE_BYTES, Store, WORD};

/// Numbers in a row.
const COLUMNS: usize = 4;

/// Rows in a line of a texture.
const LINE: usize = 2048;

/// Lines in a plane of a texture: what every adapter allows.
const LINES: usize = 2048;

/// Rows of four numbers of 32 bits.
#[derive(Debug)]
pub(super) struct Table {
    label: &'static str,
    kept: Kept,
}

#[derive(Debug)]
enum Kept {
    Buffer(Growing),
    Texture { texture: wgpu::Texture, view: wgpu::TextureView },
}

impl Table {
    pub(super) fn new(gpu: &Gpu, store: Store, label: &'static str) -> Result<Self, KernelError> {
        let kept = match store {
            Store::Buffers => Kept::Buffer(Growing::new(gpu, label)?),
            Store::Textures => texture(gpu, label, 1)?,
        };
        Ok(Table { label, kept })
    }

    /// Makes room for `rows` rows. What it held is lost where it had fewer.
    pub(super) fn reserve(&mut self, gpu: &Gpu, rows: usize) -> Result<(), KernelError> {
        match &mut self.kept {
            Kept::Buffer(buffer) => buffer.reserve(gpu, WORD * (rows * COLUMNS) as u64),
            Kept::Texture { texture: old, .. } => {
                let lines = rows.div_ceil(LINE);
                let has = old.height() as usize * (old.depth_or_array_layers() as usize / COLUMNS);
                if lines <= has {
                    return Ok(());
                }
                let needed = WORD * (lines.next_multiple_of(LINES) * LINE * COLUMNS) as u64;
                if lines > LINES && needed > MAX_TEXTURE_BYTES {
                    return Err(KernelError::TooLarge {
                        what: self.label,
                        needed,
                        available: MAX_TEXTURE_BYTES,
                        adapter: gpu.facts().name.clone(),
                    });
                }
                self.kept = texture(gpu, self.label, lines)?;
                Ok(())
            }
        }
    }

    /// Puts rows at its start.
    pub(super) fn fill<T: Pod>(&mut self, gpu: &Gpu, rows: &[T]) -> Result<(), KernelError> {
        let numbers: &[u32] = bytemuck::cast_slice(rows);
        self.reserve(gpu, rows.len())?;
        match &mut self.kept {
            Kept::Buffer(buffer) => buffer.fill(gpu, numbers),
            Kept::Texture { texture, .. } => {
                for (layer, numbers) in numbers.chunks(LINE * LINES * COLUMNS).enumerate() {
                    let lines = (numbers.len() / COLUMNS).div_ceil(LINE);
                    let mut plane = vec![0_u32; lines * LINE];
                    for column in 0..COLUMNS {
                        let values = numbers.iter().skip(column).step_by(COLUMNS);
                        plane.iter_mut().zip(values).for_each(|(place, value)| *place = *value);
                        write_plane(gpu, texture, layer * COLUMNS + column, &plane);
                    }
                }
                Ok(())
            }
        }
    }

    /// What a shader is bound to.
    pub(super) fn resource(&self) -> BindingResource<'_> {
        match &self.kept {
            Kept::Buffer(buffer) => buffer.resource(),
            Kept::Texture { view, .. } => BindingResource::TextureView(view),
        }
    }
}

fn texture(gpu: &Gpu, label: &'static str, lines: usize) -> Result<Kept, KernelError> {
    let narrow = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
    gpu.checked(|| {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: Extent3d {
                width: narrow(LINE),
                height: narrow(lines.min(LINES)),
                depth_or_array_layers: narrow(COLUMNS * lines.div_ceil(LINES)),
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D3,
            format: TextureFormat::R32Uint,
            usage: TextureUsages::STORAGE_BINDING | TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let view = texture.create_view(&Default::default());
        Kept::Texture { texture, view }
    })
}

/// Uploads one plane, whole lines.
fn write_plane(gpu: &Gpu, texture: &wgpu::Texture, number: usize, plane: &[u32]) {
    let narrow = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
    let (width, height) = (narrow(LINE), narrow(plane.len() / LINE));
    if height == 0 {
        return;
    }
    gpu.queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            texture,
            mip_level: 0,
            origin: Origin3d { x: 0, y: 0, z: narrow(number) },
            aspect: wgpu::TextureAspect::All,
        },
        bytemuck::cast_slice(plane),
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * width),
            rows_per_image: Some(height),
        },
        Extent3d { width, height, depth_or_array_layers: 1 },
    );
}

/// WGSL: where the row is that has this number, in a texture of four columns.
const PLACE: &str = "    let x = row % 2048u;\n    let y = row / 2048u % 2048u;\n    \
                     let z = 4u * (row / 4194304u);\n";

/// WGSL: a table of four columns to be read, and the function `NAME_at` that gives a row.
pub(super) fn reader(store: Store, binding: Binding, name: &str) -> String {
    match store {
        Store::Buffers => format!(
            "@group(0) @binding(BIND_{binding:?}) var<storage, read> {name}: array<vec4<u32>>;\n\
             fn {name}_at(row: u32) -> vec4<u32> {{\n    return {name}[row];\n}}\n"
        ),
        Store::Textures => {
            let at = |column: u32| format!("textureLoad({name}, vec3<u32>(x, y, z + {column}u)).x");
            format!(
                "@group(0) @binding(BIND_{binding:?}) var {name}: texture_storage_3d<r32uint, read>;\n\
                 fn {name}_at(row: u32) -> vec4<u32> {{\n{PLACE}    \
                 return vec4<u32>({}, {}, {}, {});\n}}\n",
                at(0),
                at(1),
                at(2),
                at(3)
            )
        }
    }
}

/// WGSL: a table of four columns to be written, and the function `keep_NAME` that does it.
pub(super) fn writer(store: Store, binding: Binding, name: &str) -> String {
    let head = format!("fn keep_{name}(row: u32, values: vec4<u32>) {{\n");
    match store {
        Store::Buffers => format!(
            "@group(0) @binding(BIND_{binding:?}) var<storage, read_write> {name}: array<vec4<u32>>;\n\
             {head}    {name}[row] = values;\n}}\n"
        ),
        Store::Textures => {
            let mut text = format!(
                "@group(0) @binding(BIND_{binding:?}) var {name}: texture_storage_3d<r32uint, write>;\n\
                 {head}{PLACE}"
            );
            for (number, column) in ["x", "y", "z", "w"].iter().enumerate() {
                text += &format!(
                    "    textureStore({name}, vec3<u32>(x, y, z + {number}u), \
                     vec4<u32>(values.{column}, 0u, 0u, 0u));\n"
                );
            }
            text + "}\n"
        }
    }
}
