//! The kit's random numbers: the same everywhere and for ever.

use psmrt_reference::equilibrium::equilibrium;
use psmrt_reference::lattice::{Populations, Vec3};

/// SplitMix64 (Steele, Lea & Flood, OOPSLA 2014), from a seed of the problem's own.
pub(super) struct Random(pub u64);

impl Random {
    /// Evenly distributed in `low..high`.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^= bits >> 31;
        low + (high - low) * (bits >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A vector with components in `-largest..largest`.
    pub(super) fn vector(&mut self, largest: f64) -> Vec3 {
        Vec3::from_fn(|_, _| self.between(-largest, largest))
    }

    /// Populations away from equilibrium: density 0.8 to 1.2, speed up to about 0.15, and a tenth of
    /// every population at random.
    pub(super) fn populations(&mut self) -> Populations {
        let f = equilibrium(self.between(0.8, 1.2), &self.vector(0.1));
        f.map(|f| f * self.between(0.9, 1.1))
    }
}
