//! Volume and surface of solids of any shape, and the diameter of the grains that have the same ratio of both.

use psmrt_reference::setup::Setup;
use psmrt_reference::solids::Shape;

use super::spheres::{has_image, spheres_of};

/// Mean diameter `6 V/S`, cells: of spheres `Σd³/Σd²` (Sauter), and of an image that of the spheres that have its volume and
/// its surface. Not a number where there are no solids.
pub(crate) fn sauter(setup: &Setup) -> f64 {
    // V = π/6 Σ d³,  S = π Σ d²
    let sums = spheres_of(setup).iter().fold([0.0; 2], |[three, two], (_, radius, share)| {
        let d = 2.0 * radius;
        [three + share * d.powi(3), two + share * d * d]
    });
    if !has_image(setup) {
        return sums[0] / sums[1];
    }
    let pi = std::f64::consts::PI;
    let [volume, surface] = volume_and_surface_of_images(setup);
    6.0 * (volume + pi / 6.0 * sums[0]) / (surface + pi * sums[1])
}

/// The solid fraction of each cell that solids given cell by cell have.
pub(crate) fn filled(setup: &Setup) -> Vec<f32> {
    let mut filled = vec![0.0; setup.domain.cell_count()];
    for solid in setup.solid_phase.iter().flat_map(|phase| &phase.solids) {
        let Shape::Cells { fractions, .. } = &solid.shape else { continue };
        for &(cell, share) in fractions.iter() {
            #[expect(clippy::cast_possible_truncation, reason = "a share")]
            let share = share as f32;
            filled[cell] += share;
        }
    }
    filled
}

/// Volume and surface of what is given cell by cell, cells and cell faces. The surface by the points at which straight lines
/// cross it: a line meets `P` of them per length, along x, y and z in the mean, and `S/V = 2 P` (Saltykov; Underwood,
/// Quantitative Stereology, 1970), exact in the mean over all directions of a surface. The faces between cells, of which a ball
/// has half as many again, would not do.
fn volume_and_surface_of_images(setup: &Setup) -> [f64; 2] {
    let domain = &setup.domain;
    let filled = filled(setup);
    let [nx, ny, nz] = domain.cells();
    let mut crossings = 0.0;
    for axis in 0..3 {
        let count = [nx, ny, nz][axis];
        let step = [1, nx, nx * ny][axis];
        for (cell, &share) in filled.iter().enumerate() {
            let at = cell / step % count;
            let next = match at + 1 < count {
                true => cell + step,
                // Over the end of a periodic axis; a wall or a mirror is no surface of the solid.
                false if domain.is_periodic(axis) => cell - at * step,
                false => continue,
            };
            // Where a surface lies within a cell, its share goes over to that of the next one, or the one after it.
            crossings += f64::from((filled[next] - share).abs());
        }
    }
    let volume = filled.iter().map(|&share| f64::from(share)).sum();
    // P = crossings/(3 V),  S = 2 P V
    [volume, 2.0 / 3.0 * crossings]
}
