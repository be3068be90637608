//! How many grains, and of which sizes, a packing is made of.

use psmrt_reference::grains::grain::sphere_volume;
use psmrt_reference::grains::random::SplitMix64;

/// Sizes of grains: all alike, or evenly distributed by number between two diameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// Smallest and largest diameter; equal for grains that are all alike.
    pub diameters: [f64; 2],
    /// Seed of the sizes.
    pub seed: u64,
}

/// How many grains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// So many.
    Count(usize),
    /// As many as come closest to this volume of grains.
    Volume {
        /// Volume of all grains together.
        volume: f64,
        /// Give up beyond so many.
        most: usize,
    },
}

impl Sizes {
    /// Their radii; `None` if there would be none, or too many.
    pub fn radii(&self, amount: Amount) -> Option<Vec<f64>> {
        // Not the sequence of the places, which begin with the same seed.
        let mut random = SplitMix64::new(!self.seed);
        let [low, high] = self.diameters;
        let mut radius =
            || 0.5 * if low == high { low } else { low + (high - low) * random.unit() };
        let radii: Vec<f64> = match amount {
            Amount::Count(count) => (0..count).map(|_| radius()).collect(),
            Amount::Volume { volume, most } => {
                let (mut radii, mut sum) = (Vec::new(), 0.0);
                loop {
                    let next = radius();
                    let more = sum + sphere_volume(next);
                    if more - volume >= volume - sum {
                        break radii;
                    }
                    sum = more;
                    radii.push(next);
                    if radii.len() > most {
                        return None;
                    }
                }
            }
        };
        (!radii.is_empty()).then_some(radii)
    }
}
