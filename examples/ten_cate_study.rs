//! The full form of ten Cate's settling sphere: four experiments at 8, 12 and 16 cells per diameter.
//!
//! Adds one row per fall to `golden/ten_cate/study.csv`, and its course to `golden/ten_cate/falls.csv`,
//! as it goes; falls that have a row are left out, so that it can be cut off and started again. Hours
//! on two cores, most of them for 16 cells.
//!
//! ```text
//! cargo run --release --example ten_cate_study
//! ```

#![allow(dead_code, reason = "the tests use more of the shared modules")]

#[path = "../tests/common/mod.rs"]
mod common;

use common::settling::{Experiment, Fall, Moment, compare};
use std::fs::{self, OpenOptions};
use std::io::{self, Write};

const STUDY: &str = "golden/ten_cate/study.csv";
const FALLS: &str = "golden/ten_cate/falls.csv";

/// Experiment and relaxation time, the same on all grids: so that the largest velocity at 8 cells is
/// between 0.02 and 0.07 cells per step, and the error of the drag by leaking stays small.
const CASES: [(&str, f64); 4] = [("E4", 0.55), ("E3", 0.58), ("E2", 0.65), ("E1", 0.8)];

/// Moments of a fall that are kept.
const KEPT: usize = 150;

fn main() -> io::Result<()> {
    for cells in [8, 12, 16] {
        for (name, tau) in CASES {
            let start = format!("{name},{cells},{tau},");
            if fs::read_to_string(STUDY)?.lines().any(|line| line.starts_with(&start)) {
                continue;
            }
            let experiment = Experiment::named(name);
            let mut fall = Fall::new(&experiment, f64::from(cells), tau);
            let path = until_it_touches(&mut fall)?;
            let kept: String = path
                .iter()
                .step_by(path.len().div_ceil(KEPT))
                .map(|m| format!("{start}{:.5},{:.5},{:.6}\n", m.si_time, m.gap, m.si_velocity))
                .collect();
            append(FALLS, &kept)?;
            let found = compare(&experiment, &path);
            let fluid = fall.solver.fluid();
            let row = format!(
                "{start}{},{},{:.5},{:.4},{:.4},{:.4},{:.4},{:.4},{:.4}\n",
                fluid.domain().cell_count(),
                fluid.steps(),
                experiment.si_largest * (1.0 + found.largest),
                found.largest,
                found.velocity,
                found.gap_offset,
                found.gap,
                found.si_delay,
                found.braking,
            );
            append(STUDY, &row)?;
            print!("{row}");
        }
    }
    Ok(())
}

/// The fall until the gap is 1/500 of the diameter.
fn until_it_touches(fall: &mut Fall) -> io::Result<Vec<Moment>> {
    let mut path = vec![fall.moment()];
    while path.last().is_none_or(|moment| moment.gap > 0.002) {
        fall.solver.step().map_err(io::Error::other)?;
        path.push(fall.moment());
    }
    Ok(path)
}

fn append(file: &str, text: &str) -> io::Result<()> {
    OpenOptions::new().append(true).open(file)?.write_all(text.as_bytes())
}
