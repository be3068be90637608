//! The drag of a cylinder from an STL file, on two grids; some 10 minutes on two cores.
//!
//! Adds one row per run to `golden/images/cylinder.csv` as it goes; runs that have a row are left out, so that it can be cut off
//! and started again.
//!
//! ```text
//! cargo run --release -p psmrt-validation --example body_study
//! ```

use std::error::Error;
use std::path::Path;

use psmrt::engine::EngineName;
use psmrt_validation::cases::images::Cylinder;
use psmrt_validation::cases::{Bench, Study};

fn main() -> Result<(), Box<dyn Error>> {
    let mut bench = Bench::new(Path::new("golden"), EngineName::CpuSingle, None, |_| {});
    let study = Study::new("golden/images/cylinder.csv");
    for (is_stl, cells, reynolds) in
        [(true, 10, 20.0), (true, 10, 40.0), (false, 10, 20.0), (true, 20, 20.0), (true, 20, 40.0)]
    {
        let start = format!("{},{cells},{reynolds},", if is_stl { "stl" } else { "cylinder" });
        if study.row(&start)?.is_none() {
            let drag = Cylinder { cells, reynolds, is_stl }.run(&mut bench)?;
            study.add(&format!("{start}{drag:.5}"))?;
        }
    }
    Ok(())
}
