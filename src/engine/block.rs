//! Which cells an engine is asked for.

use psmrt_reference::domain::Domain;

/// The cells from `low` on, `size` along each axis: a cell, a line, a plane or the whole domain. An engine that holds
/// some planes of cells along z only answers for its own; put behind one another in the order of the planes, the
/// answers are that for the block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// Its first cell.
    pub low: [usize; 3],
    /// Cells along x, y, z.
    pub size: [usize; 3],
}

impl Block {
    /// All cells.
    pub fn whole(domain: &Domain) -> Self {
        Block { low: [0; 3], size: domain.cells() }
    }

    /// The plane of cells number `z`.
    pub fn plane(domain: &Domain, z: usize) -> Self {
        let [nx, ny, _] = domain.cells();
        Block { low: [0, 0, z], size: [nx, ny, 1] }
    }

    /// One cell.
    pub fn cell(at: [usize; 3]) -> Self {
        Block { low: at, size: [1; 3] }
    }

    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.size.iter().product()
    }

    /// The numbers of its cells, x fastest.
    pub fn numbers(&self, domain: &Domain) -> Vec<usize> {
        let along = |axis: usize| self.low[axis]..self.low[axis] + self.size[axis];
        let rows = along(2).flat_map(|z| along(1).map(move |y| (y, z)));
        rows.flat_map(|(y, z)| along(0).map(move |x| domain.index([x, y, z]))).collect()
    }
}
