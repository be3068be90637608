//! placeholder being written
use crate::lattice::Vec3;
/// exact
pub fn exact_fraction(centre: &Vec3, radius: f64) -> f64 {
    super::sampled_fraction(centre, radius, 10)
}
