//! The full form of permeability: three random beds of some 30 spheres in a cube of three diameters, porosity 0.36 to 0.45, along
//! three axes on three grids.
//!
//! Adds one row per run to `golden/permeability/study.csv` as it goes; runs that have a row are left out, so that it can
//! be cut off and started again.
//!
//! ```text
//! cargo run --release -p psmrt-validation --example permeability_study
//! ```

use std::error::Error;
use std::path::Path;

use psmrt::engine::EngineName;
use psmrt_validation::cases::{BedOfSpheres, Bench, PERMEABILITY_BED, Study};

/// A bed: seed, solid fraction that is asked for, edge of the cube in diameters, and cells along it: 8, 11 and 16 per
/// diameter. The densest bed has a second one, in a larger cube: in the small one the period orders so dense a bed.
const BEDS: [(u32, f64, f64, [u32; 3]); 4] = [
    (1, 0.64, 3.0, [24, 33, 48]),
    (2, 0.6, 3.0, [24, 33, 48]),
    (3, 0.55, 3.0, [24, 33, 48]),
    (5, 0.64, 4.0, [32, 44, 64]),
];

fn main() -> Result<(), Box<dyn Error>> {
    let engine = EngineName::Cpu;
    let mut bench = Bench::new(Path::new("golden"), engine, None, |_| {});
    let study = Study::new("golden/permeability/study.csv");
    for (seed, fraction, side, grids) in BEDS {
        for side_cells in grids {
            for axis in 0..3 {
                let bed = BedOfSpheres { seed, fraction, side_cells, side, ..PERMEABILITY_BED };
                let start = bed.start(engine.word(), axis).join(",");
                if study.row(&format!("{start},"))?.is_none() {
                    study.add(&bed.row(&mut bench, axis)?.join(","))?;
                    println!("{start}");
                }
            }
        }
    }
    Ok(())
}
