//! Solid fraction of a sphere in a unit cell by sub-sampling.
use crate::lattice::Vec3;
/// sampled
pub fn sampled_fraction(centre: &Vec3, radius: f64, n: usize) -> f64 {
    let mut inside = 0usize;
    let at = |i: usize| (i as f64 + 0.5) / n as f64 - 0.5;
    for i in 0..n {
        for j in 0..n {
            for k in 0..n {
                if (Vec3::new(at(i), at(j), at(k)) - centre).norm_squared() <= radius * radius {
                    inside += 1;
                }
            }
        }
    }
    inside as f64 / (n * n * n) as f64
}
