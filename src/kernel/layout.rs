//! Where the populations lie: the values of all cells of one direction in their order, so many
//! directions behind one another in a binding.

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

/// Where the populations lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    /// Cells along x, y, z.
    pub(super) cells: [u32; 3],
    /// Number of cells.
    pub(super) count: u32,
    /// From one direction to the next, values.
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
        let stride = padded(count);
        let largest = adapter.max_binding_bytes.min(adapter.max_buffer_bytes);
        let per_binding = largest / (stride * WORD);
        if per_binding == 0 {
            return Err(too_large("one direction of the populations", stride * WORD, largest));
        }
        let layout = Layout {
            cells,
            count: narrow(count)?,
            stride: narrow(stride)?,
            per_binding: narrow(per_binding.min(DIRECTIONS.into()))?,
        };
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

    /// Values that so many directions take.
    pub(super) fn extent(&self, directions: u32) -> u64 {
        u64::from(directions) * u64::from(self.stride)
    }

    /// Bytes of both copies.
    pub(super) fn bytes_of_both(&self) -> u64 {
        2 * self.extent(DIRECTIONS) * WORD
    }

    /// The binding of direction `a` and where it starts there, in values.
    pub(super) fn direction(&self, a: usize) -> (u32, u32) {
        let a = u32::try_from(a).unwrap_or(DIRECTIONS);
        (a / self.per_binding, a % self.per_binding * self.stride)
    }

    /// Values from a cell to the next along y and along z.
    pub(super) fn steps(&self) -> [u32; 2] {
        [self.cells[0], self.cells[0] * self.cells[1]]
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
