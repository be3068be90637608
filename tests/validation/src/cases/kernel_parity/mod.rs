//! The kernel against the oracle: how far apart are they, over what single precision explains?

use psmrt_report::{Axis, Figure, Series};

use super::{Bench, Case, CaseError, Claim, Golden};
use psmrt::table::Table;

/// The kernel beside the oracle.
pub const CASE: Case = Case {
    name: "kernel_parity",
    title: "The kernel beside the oracle",
    about: &[
        "The production kernel computes in single precision what the oracle computes in double precision; \
         they share no physics code. After one step from random states the error of a population is \
         divided by single precision's epsilon and by the sum of the absolute populations less their \
         weights; after 100 and 1,000 steps errors of populations, forces and torques are divided by what \
         rounding adds up to (the bound is derived in tests/device/kernel_runs.rs). The table is made by cargo \
         run --example kernel_parity; `cargo test` holds both to the same bounds anew.",
    ],
    scenes: &[],
    literature: &[],
    rows: "parity.csv",
    studies: &[],
    units: "error and allowed in what the column quantity names",
    full: "cargo run -p psmrt-validation --example kernel_parity made these rows; minutes",
    measure,
    judge,
    draw,
};

/// Errors after so many steps.
const STEPS: [(&str, f64, &str); 3] = [
    ("1", 16.0, "a few tens of operations, each rounded to half an epsilon, add up to less"),
    ("100", 1.0, "the bound that rounding gives, see tests/device/kernel_runs.rs"),
    ("1000", 1.0, "the bound that rounding gives, see tests/device/kernel_runs.rs"),
];

/// Making the table takes a device and both engines: `tests/device/kernel_parity.rs` and `tests/device/kernel_runs.rs`.
fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    bench.literature(CASE.name, CASE.rows)
}

fn judge(_: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let claim = |(steps, allowed, why): (&str, f64, &'static str)| {
        let errors = rows.with(&[("steps", steps)])?.numbers("error")?;
        Ok(Claim {
            what: format!("largest error after {steps} steps, over its measure"),
            measured: errors.iter().copied().fold(f64::NAN, f64::max),
            allowed: 0.0..=allowed,
            why,
        })
    };
    STEPS.into_iter().map(claim).collect()
}

fn draw(_: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let mut figure = Figure::new(
        "Errors of the kernel over what is allowed",
        Axis::linear("row of the table below"),
        Axis::log("error / allowed").range(1e-6, 1.0),
    );
    for (colour, (steps, ..)) in STEPS.into_iter().enumerate() {
        let (all, errors, allowed) =
            (rows.words("steps", "quantity")?, rows.numbers("error")?, rows.numbers("allowed")?);
        let points = (1..)
            .map(f64::from)
            .zip(all.iter().zip(errors.iter().zip(&allowed)))
            .filter(|(_, ((row, _), (error, _)))| *row == steps && **error > 0.0)
            .map(|(number, (_, (error, allowed)))| (number, error / allowed))
            .collect();
        let label = if steps == "1" { "1 step".to_owned() } else { format!("{steps} steps") };
        figure = figure.with(Series::points(label, points).with_colour(colour));
    }
    Ok(vec![figure.note("1 is what rounding to single precision explains")])
}
