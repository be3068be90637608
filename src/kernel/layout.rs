//! Where the populations lie: the values of all cells of one direction in their order, so many
//! directions behind one another in a binding.
//!
//! On hardware they lie in buffers. On a software adapter they lie in three-dimensional textures of one
//! number a cell, the directions behind one another along z: Mesa's llvmpipe reads what eight
//! invocations want of a texture with one instruction, but of a buffer one after the other by way of
//! memory, which more than halved the speed; and such shaders take it several times longer to translate: without the
//! textures the device trials took 412 s where they take 130.

use psmrt_reference::domain::Domain;

use super::device::AdapterFacts;
use super::error::KernelError;
use super::outgoing;

/// Bytes of one value.
pub(super) const WORD: u64 = 4;

/// Number of directions.
const DIRECTIONS: u32 = 19;

/// Storage bindings of a shader besides the populations, at most.
const OTHER_BINDINGS: u32 = 5;

/// Values by which the rows of two directions are apart in a buffer, modulo a page of 4096 bytes: rows
/// that start at the same place of a page compete for the same lines of a cache.
const ROW_SKEW: u64 = 7 * 16;
const PAGE: u64 = 1024;

/// Largest texture, bytes: what Mesa's llvmpipe 22 allocates and does not tell.
pub(super) const MAX_TEXTURE_BYTES: u64 = 1 << 31;

/// What the values of cells are kept in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Store {
    Buffers,
    Textures,
}

/// Where the populations lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    /// Cells along x, y, z.
    pub(super) cells: [u32; 3],
    /// Number of cells.
    pub(super) count: u32,
    pub(super) store: Store,
    /// From one direction to the next: values of a buffer, or planes of a texture.
    stride: u32,
    /// Directions in one binding.
    per_binding: u32,
}

impl Layout {
    /// The layout for a box on an adapter. Errors if the adapter cannot hold it.
    pub(super) fn new(domain: &Domain, adapter: &AdapterFacts) -> Result<Self, KernelError> {
        let [nx, ny, nz] = domain.cells().map(|n| n as u64);
        let count = nx * ny * nz;
        let too_large = |what, needed, available| KernelError::TooLarge {
            what,
            needed,
            available,
            adapter: adapter.name.clone(),
        };
        let narrow = |value: u64| {
            u32::try_from(value)
                .map_err(|_| too_large("numbering the cells", value * WORD, u64::from(u32::MAX)))
        };
        let cells = [narrow(nx)?, narrow(ny)?, narrow(nz)?];
        let longest = u64::from(adapter.max_texture_side);
        let layout = |store, stride, per_binding: u64| -> Result<Layout, KernelError> {
            let per_binding = per_binding.min(DIRECTIONS.into());
            let stride = narrow(stride)?;
            Ok(Layout {
                cells,
                count: narrow(count)?,
                store,
                stride,
                per_binding: narrow(per_binding)?,
            })
        };
        if adapter.prefers_textures && nx.max(ny) <= longest {
            let per_binding = (longest / nz).min(MAX_TEXTURE_BYTES / (count * WORD));
            // Both copies, and what is known of each cell's solids.
            let bindings = 2 * u64::from(DIRECTIONS).div_ceil(per_binding.max(1)) + 2;
            if per_binding > 0 && bindings <= u64::from(adapter.max_texture_bindings) {
                return layout(Store::Textures, nz, per_binding);
            }
        }
        let stride = padded(count);
        let largest = adapter.max_binding_bytes.min(adapter.max_buffer_bytes);
        let per_binding = largest / (stride * WORD);
        if per_binding == 0 {
            return Err(too_large("one direction of the populations", stride * WORD, largest));
        }
        let layout = layout(Store::Buffers, stride, per_binding)?;
        let at_faces = if outgoing::has_any(domain) { outgoing::BINDINGS } else { 0 };
        let needed = 2 * layout.bindings() + OTHER_BINDINGS + at_faces;
        if needed > adapter.max_bindings {
            let (available, adapter) = (adapter.max_bindings, adapter.name.clone());
            return Err(KernelError::TooManyBindings { needed, available, adapter });
        }
        Ok(layout)
    }

    /// Bindings that one copy of the populations takes.
    pub(super) fn bindings(&self) -> u32 {
        DIRECTIONS.div_ceil(self.per_binding)
    }

    /// Directions in binding number `binding`.
    pub(super) fn directions(&self, binding: u32) -> u32 {
        self.per_binding.min(DIRECTIONS - binding * self.per_binding)
    }

    /// Values, or planes of a texture, that so many directions take.
    pub(super) fn extent(&self, directions: u32) -> u64 {
        u64::from(directions) * u64::from(self.stride)
    }

    /// Bytes of both copies.
    pub(super) fn bytes_of_both(&self) -> u64 {
        let values = match self.store {
            Store::Buffers => self.extent(DIRECTIONS),
            Store::Textures => u64::from(DIRECTIONS) * u64::from(self.count),
        };
        2 * values * WORD
    }

    /// The binding of direction `a` and where it starts there, in values or planes.
    pub(super) fn direction(&self, a: usize) -> (u32, u32) {
        let a = u32::try_from(a).unwrap_or(DIRECTIONS);
        (a / self.per_binding, a % self.per_binding * self.stride)
    }

    /// Values from a cell to the next along y and along z, as an array of the shader counts them: in a
    /// texture each axis counts by itself.
    pub(super) fn steps(&self) -> [u32; 2] {
        match self.store {
            Store::Buffers => [self.cells[0], self.cells[0] * self.cells[1]],
            Store::Textures => [1, 1],
        }
    }
}

/// The number of values for `count` cells that keeps the rows apart in a cache.
fn padded(count: u64) -> u64 {
    let whole = count.next_multiple_of(16);
    if count < PAGE {
        return whole;
    }
    whole + (ROW_SKEW + PAGE - whole % PAGE) % PAGE
}
