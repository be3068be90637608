//! Random cells for tests of single collisions.

use psmrt_reference::directions::Q;
use psmrt_reference::equilibrium::equilibrium;
use psmrt_reference::lattice::{Populations, Vec3};

/// A small generator (SplitMix64; Steele, Lea & Flood, OOPSLA 2014) with a seed of its own, so that
/// a failing test fails again.
pub struct Random(pub u64);

impl Random {
    /// Evenly distributed in `low..high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^= bits >> 31;
        low + (high - low) * (bits >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A vector with components in `-largest..largest`.
    pub fn vector(&mut self, largest: f64) -> Vec3 {
        Vec3::from_fn(|_, _| self.between(-largest, largest))
    }

    /// Populations away from equilibrium: density 0.9 to 1.1, speed up to about 0.15, and a tenth of
    /// every population at random.
    pub fn populations(&mut self) -> Populations {
        let f = equilibrium(self.between(0.9, 1.1), &self.vector(0.1));
        std::array::from_fn(|a: usize| f[a] * self.between(0.9, 1.1))
    }
}

/// Largest difference between two sets of populations.
pub fn largest_difference(first: &Populations, second: &Populations) -> f64 {
    (0..Q).map(|a| (first[a] - second[a]).abs()).fold(0.0, f64::max)
}
