//! The full form of the wet rebound: Stokes numbers, and what the rebound depends on.
//!
//! Adds one row per fall to `golden/wet_rebound/study.csv`, and its course to `courses.csv`, as it goes; falls that have a row
//! are left out, so that it can be cut off and started again. Half an hour on two cores.
//!
//! ```text
//! cargo run --release -p psmrt-validation --example wet_rebound_study
//! ```

use std::error::Error;
use std::path::Path;

use psmrt::engine::EngineName;
use psmrt_validation::cases::{Bench, Study, wet_rebounds};

fn main() -> Result<(), Box<dyn Error>> {
    let mut bench = Bench::new(Path::new("golden"), EngineName::CpuSingle, None, |_| {});
    let study = Study::new("golden/wet_rebound/study.csv");
    let courses = Study::new("golden/wet_rebound/courses.csv");
    for fall in wet_rebounds() {
        let start = fall.start();
        if study.row(&format!("{start},"))?.is_none() {
            let [row, course] = fall.rows(&mut bench)?;
            courses.add(&course)?;
            study.add(&row)?;
            println!("{row}");
        }
    }
    Ok(())
}
