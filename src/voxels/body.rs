//! The part of an image that is used: cropped, mirrored, and told into pore and solid.

use super::image::Image;
use super::phase::Phase;

/// A solid as an image shows it.
#[derive(Clone, PartialEq)]
pub struct VoxelBody {
    /// The image.
    pub image: Image,
    /// The first voxel along x, y, z that is used.
    pub first: [usize; 3],
    /// Voxels along x, y, z that are used.
    pub used: [usize; 3],
    /// Along which axes the mirror image follows, so that the body fits to itself there: a periodic one is twice as long.
    pub is_mirrored: [bool; 3],
    /// What is solid.
    pub phase: Phase,
}

impl VoxelBody {
    /// Voxels along x, y, z, mirror images too.
    pub fn counts(&self) -> [usize; 3] {
        [0, 1, 2].map(|axis| self.used[axis] * (1 + usize::from(self.is_mirrored[axis])))
    }

    /// The first voxel that is used whose number is infinite, none, or a whole one too large to be told from its neighbours; from
    /// the first of the image.
    pub fn unusable(&self) -> Option<[usize; 3]> {
        let kind = self.image.number_type();
        if kind.is_exact() {
            return None;
        }
        let [nx, ny, nz] = self.used;
        let [i, j, k] = self.first;
        let places = (0..nx * ny * nz).map(|n| [i + n % nx, j + n / nx % ny, k + n / (nx * ny)]);
        places.into_iter().find(|&at| !kind.is_usable(self.image.number(at)))
    }

    /// The solid share of a voxel.
    pub fn share(&self, at: [usize; 3]) -> f64 {
        let place = |axis: usize| {
            let (n, used) = (at[axis], self.used[axis]);
            self.first[axis] + if n < used { n } else { 2 * used - 1 - n }
        };
        self.phase.share(self.image.number([place(0), place(1), place(2)]))
    }
}
