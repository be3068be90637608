//! The populations in memory: one array for each direction, updated in place.
//!
//! A pass over the cells reads `f_a` and writes `f*_a`, where the population of the opposite direction has been read:
//! so each value is overwritten by the cell that has just read it, and by no other. Streaming is then a matter of where the
//! next pass looks (the AA pattern: Bailey, Myre, Walsh, Lilja & Saar, ICPP 2009, 550):
//!
//! ```text
//! streamed:   f_a(x)  in array a,  at x         the pass leaves  f*_a(x)  in array -a, at x
//! collided:   f_a(x)  in array -a, at x - c_a   the pass leaves  f*_a(x)  in array a,  at x + c_a
//! ```
//!
//! A step moves `2 · 19` numbers per cell between memory and processor, and no second copy is needed. In both states the
//! values that a run of cells reads in one direction lie one behind the other, so that runs can be given to
//! different threads as slices that do not overlap. (A ring for each direction whose start moves by `c_a` does the same
//! with one state instead of two, but the rings end in the middle of rows, at nineteen places that change.)
//!
//! Cells are numbered through, so what leaves a row at its end is found at the start of the next one: of the populations
//! that enter the domain none is where `before` looks for it, until `faces` has put it there.

use psmrt_reference::directions::{C, OPPOSITE, Q};

use crate::lanes::Real;

/// Extra distance between the arrays, in bytes: at whole pages from each other, all nineteen would compete for the
/// same lines of the cache.
const STAGGER: usize = 5 * 64;

/// The populations less their lattice weights.
#[derive(Clone, Debug)]
pub(super) struct Grid<T> {
    cells: usize,
    /// How far `x + c_a` is from `x`.
    strides: [isize; Q],
    arrays: [Vec<T>; Q],
    /// Where cell 0 is in each array.
    starts: [usize; Q],
    is_collided: bool,
}

impl<T: Real> Grid<T> {
    /// All populations 0 for `cells` along x, y, z.
    pub(super) fn new([nx, ny, nz]: [usize; 3]) -> Self {
        let cells = nx * ny * nz;
        let margin = nx * ny + nx + 1;
        let apart = STAGGER / size_of::<T>();
        let starts = std::array::from_fn(|a| margin + a * apart);
        let strides = C.map(|[x, y, z]| {
            let [x, y, z] = [x, y, z].map(|c| c as isize);
            x + nx as isize * (y + ny as isize * z)
        });
        let arrays = starts.map(|start| vec![T::default(); start + cells + margin]);
        Grid { cells, strides, arrays, starts, is_collided: false }
    }

    /// How far `x + c_a` is from `x`.
    pub(super) fn stride(&self, a: usize) -> isize {
        self.strides[a]
    }

    /// The array of `f_a` before the next collision, and where cell 0 is in it.
    fn place_before(&self, a: usize) -> (usize, usize) {
        if self.is_collided {
            let array = OPPOSITE[a];
            (array, self.starts[array].wrapping_add_signed(-self.strides[a]))
        } else {
            (a, self.starts[a])
        }
    }

    /// `f_a` of all cells before the next collision, but for those that enter the domain.
    pub(super) fn before(&self, a: usize) -> &[T] {
        let (array, start) = self.place_before(a);
        &self.arrays[array][start..start + self.cells]
    }

    /// The same, to be written.
    pub(super) fn before_mut(&mut self, a: usize) -> &mut [T] {
        let (array, start) = self.place_before(a);
        &mut self.arrays[array][start..start + self.cells]
    }

    /// `f*_a` of all cells after the last collision, before anything of the next step is put in.
    pub(super) fn after(&self, a: usize) -> &[T] {
        // f*_a(x) is what f_a(x + c_a) will be.
        let (array, start) = self.place_before(a);
        let start = start.wrapping_add_signed(self.strides[a]);
        &self.arrays[array][start..start + self.cells]
    }

    /// The populations before the collision, cut into runs of `run` cells (the last may be shorter). What the
    /// collision makes of `f_a` is to be left where that of the opposite direction was.
    pub(super) fn runs(&mut self, run: usize) -> Vec<[&mut [T]; Q]> {
        let places: [(usize, usize); Q] = std::array::from_fn(|a| self.place_before(a));
        let cells = self.cells;
        let mut arrays = self.arrays.each_mut().map(|array| Some(array.as_mut_slice()));
        let mut runs: [_; Q] = places.map(|(array, start)| {
            // Each array is that of one direction, so none is taken twice.
            let values = arrays[array].take().unwrap_or_default();
            values[start..start + cells].chunks_mut(run)
        });
        (0..cells.div_ceil(run))
            .map(|_| runs.each_mut().map(|run| run.next().unwrap_or_default()))
            .collect()
    }

    /// To be called when a pass has collided all runs.
    pub(super) fn passed(&mut self) {
        self.is_collided = !self.is_collided;
    }
}
