//! Loads averaged over the steps from one row of a record to the next.

use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Load;

use crate::engine::Coupled;

/// Loads summed over the steps since the last row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoadSums {
    steps: u64,
    sums: Vec<Load>,
}

/// Numbers in a load.
const NUMBERS: usize = 6;

impl LoadSums {
    /// Adds the loads of the step that has just been made.
    pub fn add(&mut self, engine: &Coupled) {
        let loads = engine.loads();
        let zero = Load { force: Vec3::zeros(), torque: Vec3::zeros() };
        self.sums.resize(loads.len(), zero);
        for (sum, load) in self.sums.iter_mut().zip(&loads) {
            sum.force += load.force;
            sum.torque += load.torque;
        }
        self.steps += 1;
    }

    /// The means, of which the next ones begin anew. None if no step has been added.
    pub fn take(&mut self) -> Option<Vec<Load>> {
        let LoadSums { steps, sums } = std::mem::take(self);
        let mean = |sum: &Load| Load {
            force: sum.force / steps as f64,
            torque: sum.torque / steps as f64,
        };
        (steps > 0).then(|| sums.iter().map(mean).collect())
    }

    /// All of it as whole numbers: how many steps, then the bits of each sum.
    pub fn save(&self) -> Vec<u64> {
        let of_load = |load: &Load| [load.force, load.torque].map(|v| [v.x, v.y, v.z]);
        let sums = self.sums.iter().flat_map(of_load).flatten().map(f64::to_bits);
        std::iter::once(self.steps).chain(sums).collect()
    }

    /// What [`Self::save`] has given.
    pub fn load(saved: &[u64]) -> Self {
        let Some((&steps, bits)) = saved.split_first() else { return LoadSums::default() };
        let numbers: Vec<f64> = bits.iter().map(|&bits| f64::from_bits(bits)).collect();
        let of = |six: &[f64]| Load {
            force: Vec3::new(six[0], six[1], six[2]),
            torque: Vec3::new(six[3], six[4], six[5]),
        };
        LoadSums { steps, sums: numbers.chunks_exact(NUMBERS).map(of).collect() }
    }
}
