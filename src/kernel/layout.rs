//! Where the populations lie: all cells of one direction in a row, so many directions to a binding.
//!
//! On a software adapter four cells are worked on at once, as vectors of four (its loads cost as much for
//! four values as for one). So that a vector's neighbours along x are a vector too, it holds cells a
//! quarter of the row apart: with `n = ceil(nx/4)`, the vector `q` of a row holds `q, q + n, q + 2n,
//! q + 3n`. Where `nx` is no multiple of four the last quarter is filled up with places that are no cells.
//! Where the adapter knows whole numbers of 64 bits a vector is read as two of those: on processors
//! without AVX-512, Mesa 22 puts what each lane reads into its vector by way of memory, which costs some
//! 20 cycles a piece and is most of a step.

use psmrt_reference::domain::Domain;

use super::device::AdapterFacts;
use super::error::KernelError;

/// Bytes of one value.
const WORD: u64 = 4;

/// Number of directions.
const DIRECTIONS: u32 = 19;

/// Storage bindings of a shader besides the populations, at most.
const OTHER_BINDINGS: u32 = 4;

/// Values by which the rows of two directions are apart, modulo a page of 4096 bytes: rows that start at
/// the same place of a page compete for the same lines of a cache.
const ROW_SKEW: u64 = 7 * 16;
const PAGE: u64 = 1024;

/// Where the populations lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    /// Cells along x, y, z.
    pub(super) cells: [u32; 3],
    /// Cells that are worked on at once: 1 or 4.
    pub(super) width: u32,
    /// Whether vectors are read as two pairs of values, 64 bits each.
    pub(super) pairs: bool,
    /// Places for cells, those that are none included.
    pub(super) places: u32,
    /// Values from one direction to the next.
    stride: u32,
    /// Directions in one binding.
    per_binding: u32,
}

impl Layout {
    /// The layout for a box on an adapter. Errors if the adapter cannot hold it.
    /// `width` cells are worked on at once, 1 or 4.
    pub(super) fn new(
        domain: &Domain,
        adapter: &AdapterFacts,
        width: u64,
    ) -> Result<Self, KernelError> {
        let [nx, ny, nz] = domain.cells().map(|n| n as u64);
        let places = nx.div_ceil(width) * width * ny * nz;
        let stride = padded(places);
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
        let narrow = |value: u64| {
            u32::try_from(value)
                .map_err(|_| too_large("numbering the cells", value * WORD, u64::from(u32::MAX)))
        };
        let layout = Layout {
            cells: [narrow(nx)?, narrow(ny)?, narrow(nz)?],
            width: narrow(width)?,
            pairs: width == 4 && adapter.has_int64,
            places: narrow(places)?,
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

    /// Vectors in a row of cells along x.
    pub(super) fn vectors(&self) -> u32 {
        self.cells[0].div_ceil(self.width)
    }

    /// The place of cell number `cell`.
    pub(super) fn place(&self, cell: u32) -> u32 {
        let nx = self.cells[0];
        let (x, row, n) = (cell % nx, cell / nx, self.vectors());
        row * n * self.width + x % n * self.width + x / n
    }

    /// The number of the cell at a place; `None` if there is none.
    pub(super) fn cell(&self, place: u32) -> Option<u32> {
        let n = self.vectors();
        let (row, along) = (place / (n * self.width), place % (n * self.width));
        let x = along / self.width + along % self.width * n;
        (x < self.cells[0]).then(|| row * self.cells[0] + x)
    }

    /// Values of all cells in the order of their numbers, put at their places.
    pub(super) fn placed<T: Copy + Default>(&self, values: &[T]) -> Vec<T> {
        if self.width == 1 {
            return values.to_vec();
        }
        let mut placed = vec![T::default(); self.places as usize];
        for (cell, value) in (0..).zip(values) {
            placed[self.place(cell) as usize] = *value;
        }
        placed
    }

    /// The reverse of [`Self::placed`].
    pub(super) fn gathered<T: Copy + Default>(&self, placed: &[T]) -> Vec<T> {
        let [nx, ny, nz] = self.cells;
        (0..nx * ny * nz).map(|cell| placed[self.place(cell) as usize]).collect()
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
    pub(super) fn direction(&self, a: usize) -> (u32, u32) {
        let a = u32::try_from(a).unwrap_or(DIRECTIONS);
        (a / self.per_binding, a % self.per_binding * self.stride)
    }
}

/// The number of values for `count` places that keeps the rows apart in a cache.
fn padded(count: u64) -> u64 {
    let whole = count.next_multiple_of(16);
    if count < PAGE {
        return whole;
    }
    whole + (ROW_SKEW + PAGE - whole % PAGE) % PAGE
}
