//! How fast the kernel is, beside the oracle, and what a scene saves that leaves a model out.

use psmrt_report::{Axis, Figure, Series};

use super::{Bench, Case, CaseError, Claim, Golden};
use psmrt::table::Table;

/// The kernel's speed.
pub const CASE: Case = Case {
    name: "kernel_speed",
    title: "The speed of the kernel",
    about: &[
        "Million cell updates per second of the kernel on a software adapter, which computes on the \
         processor, and of the oracle in the same run: per second of processor time, times the number \
         of threads, which other work on the machine hardly changes. What is compared is the work of a cell update. \
         The column cost is the time \
         of a cell update over that of plain MRT: what a model costs that a scene can leave out. Cells inside \
         fixed solids are not skipped: the oracle collides them too, and leaving out a quarter of all cells, \
         deep inside spheres, saved but 5 %. The table is made by cargo run \
         --example kernel_speed.",
    ],
    scenes: &[],
    literature: &[],
    rows: "speed.csv",
    studies: &[],
    units: "cells along an edge; kernel and oracle in million cell updates a second; cost and ratio without units",
    full: "cargo run -p psmrt-validation --example kernel_speed made these rows; minutes",
    measure,
    judge,
    draw,
};

/// Times are never measured by a test: the committed table is shown.
fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    bench.literature(CASE.name, CASE.rows)
}

fn judge(_: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let beside: Vec<f64> = rows.with(&[("cells", BESIDE)])?.numbers_where_given("ratio")?;
    Ok(vec![Claim {
        what: format!("kernel over oracle at {BESIDE} cells a side, the least of all scenes"),
        measured: beside.into_iter().fold(f64::NAN, f64::min),
        allowed: 1.0..=f64::INFINITY,
        why: "a kernel slower than the oracle would be of no use; the aim is 6",
    }])
}

/// Where the oracle was measured beside the kernel.
const BESIDE: &str = "64";

fn draw(_: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let mut figure = Figure::new(
        "Cell updates of the kernel, scene by scene",
        Axis::linear("scene, in the order of the table below"),
        Axis::linear("million a second, all threads"),
    );
    for (colour, cells) in rows.values("cells")?.iter().enumerate() {
        let speeds = rows.with(&[("cells", cells)])?.numbers("kernel")?;
        let points = (1..).map(f64::from).zip(speeds).collect();
        figure = figure
            .with(Series::points(format!("{cells} cells a side"), points).with_colour(colour));
    }
    let oracle = rows.with(&[("cells", BESIDE)])?.numbers_where_given("oracle")?;
    let points = (1..).map(f64::from).zip(oracle).collect();
    let label = format!("oracle, {BESIDE} cells a side");
    Ok(vec![figure.with(Series::line_points(label, points).with_colour(5))])
}
