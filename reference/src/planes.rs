//! Work shared out plane by plane: each plane is worked on by one thread, in the order of its cells,
//! so that results do not depend on the number of threads.

use rayon::prelude::*;

/// Below this many cells a step is over before a second thread has woken up.
const SERIAL_CELLS: usize = 4096;

/// Calls `work(z, plane)` for each plane of `plane_cells` cells.
pub fn for_each_plane<T: Send>(
    cells: &mut [T],
    plane_cells: usize,
    work: impl Fn(usize, &mut [T]) + Sync,
) {
    if cells.len() < SERIAL_CELLS {
        cells.chunks_mut(plane_cells).enumerate().for_each(|(z, plane)| work(z, plane));
    } else {
        cells.par_chunks_mut(plane_cells).enumerate().for_each(|(z, plane)| work(z, plane));
    }
}

/// The same, with a result for each plane, in the order of the planes.
pub fn map_planes<T: Send, R: Send>(
    cells: &mut [T],
    plane_cells: usize,
    work: impl Fn(usize, &mut [T]) -> R + Sync,
) -> Vec<R> {
    if cells.len() < SERIAL_CELLS {
        cells.chunks_mut(plane_cells).enumerate().map(|(z, plane)| work(z, plane)).collect()
    } else {
        cells.par_chunks_mut(plane_cells).enumerate().map(|(z, plane)| work(z, plane)).collect()
    }
}
