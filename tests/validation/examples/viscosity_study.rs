//! The full form of the viscosity of a sheared suspension: two operators of the solid, two relaxation times, three grids, two cubes; some
//! ten minutes on two cores.
//!
//! Adds one row per run to `golden/viscosity/study.csv` as it goes; runs that have a row are left out, so that it can be cut off
//! and started again.
//!
//! ```text
//! cargo run --release -p psmrt-validation --example viscosity_study
//! ```

use std::error::Error;
use std::path::Path;

use psmrt::engine::EngineName;
use psmrt_validation::cases::viscosity::ShearedSphere;
use psmrt_validation::cases::{Bench, Study};

fn main() -> Result<(), Box<dyn Error>> {
    let mut bench = Bench::new(Path::new("golden"), EngineName::Cpu, None, |_| {});
    let study = Study::new("golden/viscosity/study.csv");
    for diameter in [8, 12, 16] {
        // Near 1/2 the flow takes five times as many steps to settle: not on the finest grid.
        for &tau in if diameter < 16 { &[1.0, 0.6][..] } else { &[1.0] } {
            for operator in ["bounce_back", "full_bounce_back"] {
                // 2.5 and 3.5 diameters.
                for cells in [5 * diameter / 2, 7 * diameter / 2] {
                    let start = format!("{operator},{tau},{diameter},{cells},");
                    if study.row(&start)?.is_some() {
                        continue;
                    }
                    let found = ShearedSphere { operator, tau, diameter, cells }.run(&mut bench)?;
                    let row = format!(
                        "{start}{:.6},{:.5},{:.1e}",
                        found.solid_fraction, found.intrinsic_viscosity, found.imbalance
                    );
                    study.add(&row)?;
                    println!("{row}");
                }
            }
        }
    }
    Ok(())
}
