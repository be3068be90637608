//! The full form of hindered settling: random suspensions of solid fractions 0.02 to 0.3.
//!
//! Adds one row per suspension of `golden/suspension/far_field.csv` to `golden/suspension/study.csv` as
//! it goes; suspensions that have a row are left out, so that it can be cut off and started again. Half
//! an hour on two cores, most of it for the smallest solid fraction.
//!
//! ```text
//! cargo run --release -p psmrt-validation --example suspension_study
//! ```

#![allow(dead_code, reason = "the tests use more of the shared modules")]

#[path = "../../common/mod.rs"]
mod common;

use common::golden_rows;
use common::suspension::Suspension;
use psmrt_validation::cases::Study;
use std::io;

const STUDY: &str = "golden/suspension/study.csv";

fn main() -> io::Result<()> {
    let mut rows: Vec<_> = golden_rows("suspension/far_field.csv").into_iter().skip(1).collect();
    // The smallest boxes first, the largest solid fractions with them.
    rows.sort_by_key(|row| row[3].parse::<u64>().unwrap_or(0));
    let study = Study::new(STUDY);
    for tau in [0.55, 0.7] {
        for row in &rows {
            let wanted: f64 = row[0].parse().map_err(io::Error::other)?;
            let start = format!("{wanted},{},{},{tau},", &row[1], &row[2]);
            // Near 1/2 only where the dependence on tau is largest.
            let wants = tau > 0.6 || wanted >= 0.2;
            if study.row(&start)?.is_some() || !wants {
                continue;
            }
            let suspension = Suspension {
                solid_fraction: wanted,
                grains: row[1].parse().map_err(io::Error::other)?,
                cells: 6.0,
                tau,
                reynolds: 0.05,
                seed: row[2].parse().map_err(io::Error::other)?,
            };
            let mut settling = suspension.at_rest();
            let steps = settling.steps_to_steady();
            settling.solver.run(steps).map_err(io::Error::other)?;
            let text = format!(
                "{start}{:.6},{steps},{:.5},{},{}",
                settling.solid_fraction,
                settling.velocity(),
                &row[5],
                &row[6]
            );
            study.add(&text)?;
            println!("{text}");
        }
    }
    Ok(())
}
