//! Which way the solid fraction of a cell is found.

use super::linear::linear_fraction;
use super::sampled::sampled_fraction;
use super::sphere::exact_fraction;
use crate::lattice::Vec3;

/// How the solid fraction of a sphere in a cell is found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum CoverageRule {
    /// Exactly, in closed form.
    #[default]
    Exact,
    /// By `n × n × n` sample points.
    Sampled {
        /// Points along each axis, at least 1.
        n: usize,
    },
    /// Linear in the distance between the centres.
    Linear,
}

impl CoverageRule {
    /// Solid fraction of a sphere whose centre lies at `centre` from the centre of the cell.
    pub fn fraction(self, centre: &Vec3, radius: f64) -> f64 {
        match self {
            CoverageRule::Exact => exact_fraction(centre, radius),
            CoverageRule::Sampled { n } => sampled_fraction(centre, radius, n),
            CoverageRule::Linear => linear_fraction(centre, radius),
        }
    }
}
