//! Solid fraction of a sphere in a unit cell by counting sample points: the cheap alternative.

use super::sphere::{fold, uncut_fraction};
use crate::lattice::Vec3;

/// Solid fraction of a sphere of `radius` cells whose centre lies at `centre` from the centre of the
/// cell: the share of `n × n × n` points, the midpoints of sub-cells, that it contains. `n` is at
/// least 1.
///
/// The points lie alike along all three axes, so the 48 symmetries of the cube hold to the last bit.
pub fn sampled_fraction(centre: &Vec3, radius: f64, n: usize) -> f64 {
    let centre = fold(centre);
    if let Some(fraction) = uncut_fraction(&centre, radius) {
        return fraction;
    }
    // x_i = (i + 1/2) / n - 1/2
    let x = |i: usize| ((2 * i + 1) as f64 - n as f64) / (2 * n) as f64;
    let mut inside = 0_usize;
    for i in 0..n {
        for j in 0..n {
            for k in 0..n {
                let point = Vec3::new(x(i), x(j), x(k));
                inside += usize::from((point - centre).norm_squared() <= radius * radius);
            }
        }
    }
    // ε = N_inside / n³
    inside as f64 / (n * n * n) as f64
}
