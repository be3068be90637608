//! Draws the figures of the README and of `reference/ERRATA.md` from the records under `golden/`:
//!
//! ```text
//! cargo run --release -p psmrt-report --example figures
//! ```

use psmrt_report::{Axis, Figure, PowerLaw, Series, write_svg};
use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};

type Rows = Vec<BTreeMap<String, String>>;

fn main() -> Result<(), Box<dyn Error>> {
    let figures = root().join("report/figures");
    std::fs::create_dir_all(&figures)?;
    let study = rows("golden/sphere_arrays/study.csv")?;
    write_svg(&drag_against_tau(&study)?, figures.join("sphere_arrays_tau.svg"))?;
    write_svg(&drag_against_grid(&study)?, figures.join("sphere_arrays_grid.svg"))?;
    let cost = rows("golden/coverage/cost.csv")?;
    write_svg(&coverage_cost(&cost)?, figures.join("coverage_cost.svg"))?;
    Ok(())
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The rows of a CSV file with `#` comments, by the names of its columns.
fn rows(file: &str) -> Result<Rows, Box<dyn Error>> {
    let path = root().join(file);
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(&path)?;
    Ok(reader.deserialize().collect::<Result<Rows, _>>()?)
}

fn number(row: &BTreeMap<String, String>, column: &str) -> Result<f64, Box<dyn Error>> {
    let text = row.get(column).ok_or_else(|| format!("no column {column}"))?;
    text.parse().map_err(|error| format!("{column} = {text}: {error}").into())
}

/// The points (`x`, `y`) of the rows that have all of `wanted`, sorted by x.
fn points(
    rows: &Rows,
    wanted: &[(&str, &str)],
    x: &str,
    y: impl Fn(f64) -> f64,
    y_column: &str,
) -> Result<Vec<(f64, f64)>, Box<dyn Error>> {
    let mut points = Vec::new();
    for row in rows.iter().filter(|row| wanted.iter().all(|(key, value)| row[*key] == *value)) {
        points.push((number(row, x)?, y(number(row, y_column)?)));
    }
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(points)
}

const SC: [(&str, &str); 3] =
    [("lattice", "SC"), ("solid_fraction", "0.06544984695"), ("shift", "quarter")];
const RULES: [(&str, &str); 3] =
    [("SRT", "SRT"), ("MRT_dHumieres", "MRT d'Humières"), ("TRT_3/16", "TRT 3/16")];
const WEIGHTS: [(&str, &str); 2] = [("NT", "B(ε, τ)"), ("eps", "B = ε")];

/// Error of the drag of a simple-cubic array at 8 cells per diameter against the relaxation time.
fn drag_against_tau(study: &Rows) -> Result<Figure, Box<dyn Error>> {
    let mut figure = Figure::new(
        "Stokes drag of a simple-cubic array: which weight B, which rates",
        Axis::linear("relaxation time τ (steps)"),
        Axis::linear("error of the drag (%)"),
    );
    for (weight, weight_label) in WEIGHTS {
        for (rule, rule_label) in RULES {
            let mut wanted = SC.to_vec();
            wanted.extend([
                ("cells_per_side", "16"),
                ("weight", weight),
                ("collision", rule),
                ("operator", "bounce_back"),
            ]);
            let errors = points(study, &wanted, "tau", |e| 100.0 * e, "relative_error")?;
            figure =
                figure.with(Series::line_points(format!("{weight_label}, {rule_label}"), errors));
        }
    }
    Ok(figure
        .note("8 cells per diameter, solid fraction 0.0654, Re = 0.005; exact drag: Zick & Homsy 1982")
        .note("B(ε, τ): Noble & Torczynski 1998; solid operator: bounce-back of the non-equilibrium part"))
}

/// Error of the drag against cells per diameter, MRT with d'Humières' rates.
fn drag_against_grid(study: &Rows) -> Result<Figure, Box<dyn Error>> {
    let mut figure = Figure::new(
        "Stokes drag of a simple-cubic array: convergence with the grid",
        Axis::log("cells per diameter").ticks(&[4.0, 6.0, 8.0, 12.0, 16.0]),
        Axis::log("error of the drag, absolute value (%)"),
    );
    let taus: [&[&str]; 2] = [&["0.55", "0.8", "1", "1.5"], &["0.55", "0.8"]];
    for ((weight, weight_label), taus) in WEIGHTS.into_iter().zip(taus) {
        for &tau in taus {
            let mut wanted = SC.to_vec();
            wanted.extend([
                ("tau", tau),
                ("weight", weight),
                ("collision", "MRT_dHumieres"),
                ("operator", "bounce_back"),
            ]);
            let column = "relative_error";
            let errors = points(study, &wanted, "cells_per_diameter", |e| 100.0 * e.abs(), column)?;
            let label = format!("{weight_label}, τ = {tau}");
            figure = figure.with(Series::line_points(label, errors));
        }
    }
    Ok(figure
        .with(Series::reference_slope("order 1", -1.0, (8.0, 30.0), (4.0, 16.0)))
        .with(Series::reference_slope("order 2", -2.0, (8.0, 2.0), (4.0, 16.0)))
        .note("MRT with d'Humières' rates, solid fraction 0.0654, Re = 0.005; exact drag: Zick & Homsy 1982"))
}

/// Error of sub-sampled solid fractions against their cost.
fn coverage_cost(cost: &Rows) -> Result<Figure, Box<dyn Error>> {
    let sampled = points(cost, &[("method", "sampled")], "n", |e| e, "rms_error")?;
    let worst = points(cost, &[("method", "sampled")], "n", |e| e, "max_error")?;
    let time = points(cost, &[("method", "sampled")], "n", |ns| ns / 1000.0, "ns_per_cell")?;
    let exact = cost.iter().find(|row| row["method"] == "exact").ok_or("no exact row")?;
    let exact_time = number(exact, "ns_per_cell")? / 1000.0;
    let ends = (2.0, 10.0);
    let fit = PowerLaw::fit(&sampled)?;
    Ok(Figure::new(
        "Solid fraction of a sphere in a cell: sub-sampling against the exact form",
        Axis::linear("sample points along each axis, n"),
        Axis::log("error of the solid fraction"),
    )
    .with(Series::line_points("largest", worst))
    .with(Series::points("root mean square", sampled))
    .with(fit.series(format!("fit: order {:.2}", -fit.order), ends))
    .with_panel(Axis::log("time per cell (µs)"))
    .with(Series::line_points("n × n × n samples", time))
    .with(Series::dashed("exact", vec![(ends.0, exact_time), (ends.1, exact_time)]))
    .note("2,000 random cells cut by a sphere of 16 cells diameter; error against the exact form"))
}
