//! Where the populations lie: all cells of one direction in a row, so many directions to a binding.

use psmrt_reference::domain::Domain;

use super::device::AdapterFacts;
use super::error::KernelError;

/// Bytes of one value.
const WORD: u64 = 4;

/// Number of directions.
const DIRECTIONS: u32 = 19;

/// Storage bindings of a shader besides the populations, at most.
const OTHER_BINDINGS: u32 = 4;

/// Cells of 4 bytes by which the rows of two directions are apart, modulo a page of 4096 bytes: rows
/// that start at the same place of a page compete for the same lines of a cache, which costs a third of
/// the speed in boxes of 128³ cells on a processor.
const ROW_SKEW: u64 = 7 * 16;
const PAGE: u64 = 1024;

/// Where the populations lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    /// Cells along x, y, z.
    pub(super) cells: [u32; 3],
    /// Number of cells.
    pub(super) count: u32,
    /// Values from one direction to the next.
    pub(super) stride: u32,
    /// Directions in one binding.
    pub(super) per_binding: u32,
}

impl Layout {
    /// The layout for a box on an adapter. Errors if the adapter cannot hold it.
    pub(super) fn new(domain: &Domain, adapter: &AdapterFacts) -> Result<Self, KernelError> {
        let count = domain.cell_count() as u64;
        let stride = padded(count);
        let largest = adapter.max_binding_bytes.min(adapter.max_buffer_bytes);
        let per_binding = (largest / (stride * WORD)).min(DIRECTIONS.into());
        let too_large = |what, needed, available| KernelError::TooLarge {
            what,
            needed,
            available,
            adapter: adapter.name.clone(),
        };
        if per_binding == 0 {
            return Err(too_large("one direction of the populations", stride * WORD, largest));
        }
        // `Domain` holds fewer than 2^32 - 1 cells, and a binding fewer than 2^32 bytes.
        let narrow = |value: u64| {
            u32::try_from(value)
                .map_err(|_| too_large("numbering the cells", value * WORD, u64::from(u32::MAX)))
        };
        let [nx, ny, nz] = domain.cells().map(|n| n as u64);
        let layout = Layout {
            cells: [narrow(nx)?, narrow(ny)?, narrow(nz)?],
            count: narrow(count)?,
            stride: narrow(stride)?,
            per_binding: narrow(per_binding)?,
        };
        let needed = 2 * layout.bindings() + OTHER_BINDINGS;
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

    /// Bytes of binding number `binding`.
    pub(super) fn bytes(&self, binding: u32) -> u64 {
        let before = binding * self.per_binding;
        let directions = self.per_binding.min(DIRECTIONS - before);
        u64::from(directions) * u64::from(self.stride) * WORD
    }

    /// Bytes of both copies.
    pub(super) fn bytes_of_both(&self) -> u64 {
        2 * (0..self.bindings()).map(|binding| self.bytes(binding)).sum::<u64>()
    }

    /// The binding of direction `a` and where it starts there, in values.
    pub(super) fn place(&self, a: usize) -> (u32, u32) {
        let a = u32::try_from(a).unwrap_or(DIRECTIONS);
        (a / self.per_binding, a % self.per_binding * self.stride)
    }
}

/// The number of values for `count` cells that keeps the rows apart in a cache.
fn padded(count: u64) -> u64 {
    if count < PAGE {
        return count.next_multiple_of(16);
    }
    let over = count.next_multiple_of(16) % PAGE;
    count.next_multiple_of(16) + (ROW_SKEW + PAGE - over) % PAGE
}
