//! The share of each cell that is solid: that of the voxels in it, each with the volume that both have in common.

use rayon::prelude::*;

use super::body::VoxelBody;

/// An edge of a voxel that is so near to one of a cell, in cells, lies on it.
const SAME_EDGE: f64 = 1e-9;

/// A share so near to 0 or 1 is that: what rounding leaves of a sum.
const ROUNDING: f64 = 1e-12;

/// A body in a domain, in cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Its lowest corner.
    pub corner: [f64; 3],
    /// Edge of a voxel.
    pub voxel: f64,
    /// Cells of the domain along x, y, z.
    pub cells: [usize; 3],
}

/// Cells that are not empty, by number (x fastest), with their solid share in (0, 1]. The sums are taken in the order of the
/// voxels, whatever the number of threads.
pub fn solid_shares(body: &VoxelBody, placed: &Placed) -> Vec<(usize, f64)> {
    let counts = body.counts();
    let [along_x, along_y, along_z] = [0, 1, 2]
        .map(|axis| overlaps(placed.corner[axis], placed.voxel, counts[axis], placed.cells[axis]));
    let [nx, ny, _] = placed.cells;
    let planes = along_z.par_iter().enumerate().map(|(k, in_z)| {
        let mut plane = Vec::new();
        if in_z.is_empty() {
            return plane;
        }
        for (j, in_y) in along_y.iter().enumerate() {
            for (i, in_x) in along_x.iter().enumerate() {
                let share = share(body, [in_x, in_y, in_z]);
                if share > 0.0 {
                    plane.push((i + nx * (j + ny * k), share));
                }
            }
        }
        plane
    });
    planes.collect::<Vec<_>>().concat()
}

/// Voxels that share something with a cell along an axis, with how much of the cell.
type Overlaps = Vec<(usize, f64)>;

/// The solid share of a cell.
fn share(body: &VoxelBody, [in_x, in_y, in_z]: [&Overlaps; 3]) -> f64 {
    let mut share = 0.0;
    for &(z, of_z) in in_z {
        for &(y, of_y) in in_y {
            let row = in_x.iter().map(|&(x, of_x)| of_x * body.share([x, y, z])).sum::<f64>();
            share += of_z * of_y * row;
        }
    }
    match share {
        share if share < ROUNDING => 0.0,
        share if share > 1.0 - ROUNDING => 1.0,
        share => share,
    }
}

/// For each cell along an axis the voxels that overlap it; `count` voxels begin at `corner`.
fn overlaps(corner: f64, voxel: f64, count: usize, cells: usize) -> Vec<Overlaps> {
    let edge = |number: usize| {
        let edge = corner + number as f64 * voxel;
        if (edge - edge.round()).abs() < SAME_EDGE { edge.round() } else { edge }
    };
    let mut all = vec![Vec::new(); cells];
    for number in 0..count {
        let [low, high] = [edge(number), edge(number + 1)];
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let [from, to] = [low.floor().max(0.0) as usize, high.ceil().max(0.0) as usize];
        for cell in from..to.min(cells) {
            let overlap = high.min(cell as f64 + 1.0) - low.max(cell as f64);
            if overlap > 0.0 {
                all[cell].push((number, overlap));
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::overlaps;

    #[test]
    fn voxels_fill_each_cell_that_they_cover_whole() {
        for (corner, voxel, count, cells) in
            [(0.0, 0.25, 40, 10), (0.3, 0.37, 20, 8), (1.0, 2.5, 3, 9), (0.0, 1.0 / 3.0, 9, 3)]
        {
            let all = overlaps(corner, voxel, count, cells);
            let end = corner + voxel * count as f64;
            for (cell, inside) in all.iter().enumerate() {
                let (low, high) = (cell as f64, cell as f64 + 1.0);
                let covered = (high.min(end) - low.max(corner)).max(0.0);
                let sum: f64 = inside.iter().map(|(_, share)| share).sum();
                assert!(
                    (sum - covered).abs() < 1e-12,
                    "cell {cell} of voxels of {voxel} from {corner}: {sum} of it covered, {covered} expected"
                );
            }
        }
    }
}
