//! The full form of the images: three porous bodies on three grids with two operators, and an array of spheres as an image on
//! five; some minutes on two cores.
//!
//! Adds one row per run to `golden/images/study.csv` and `array.csv` as it goes; runs that have a row are left out, so that it can
//! be cut off and started again.
//!
//! ```text
//! cargo run --release -p psmrt-validation --example image_study
//! ```

use std::error::Error;
use std::path::Path;

use psmrt::engine::EngineName;
use psmrt_validation::cases::images::{BallImage, IMAGES, PorousImage};
use psmrt_validation::cases::{Bench, Study};

/// The diameter of the sphere over the edge of its cube: that of solid fraction 0.343.
const DIAMETER: f64 = 0.868_490_69;

fn main() -> Result<(), Box<dyn Error>> {
    let mut bench = Bench::new(Path::new("golden"), EngineName::Cpu, None, |_| {});
    let array = Study::new("golden/images/array.csv");
    for operator in ["graded_viscosity", "bounce_back"] {
        for cells in [8, 12, 16, 24, 48] {
            for is_binary in [false, true] {
                let start =
                    format!("{operator},{},{cells},", if is_binary { "binary" } else { "shares" });
                if array.row(&start)?.is_none() {
                    let k = BallImage { cells, is_binary, operator }.run(&mut bench)?;
                    array.add(&format!("{start}{:.4},{k:.6e}", f64::from(cells) * DIAMETER))?;
                }
            }
        }
    }
    let study = Study::new("golden/images/study.csv");
    for cells in [1, 2, 3] {
        for operator in ["graded_viscosity", "bounce_back"] {
            for image in IMAGES {
                let start = format!("{operator},{image},{cells},");
                if study.row(&start)?.is_none() {
                    let k = PorousImage { image, cells, operator, tau: 0.8 }.run(&mut bench)?;
                    study.add(&format!("{start}{k:.6}"))?;
                }
            }
        }
    }
    Ok(())
}
