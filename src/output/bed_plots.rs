//! Pictures of records of a bed: `layers` along an axis, `contact_means` over time.

use psmrt_report::{Axis, Figure, Series};

use crate::scene::columns::{CONTACT_MEAN_COLUMNS, Column, LAYER_COLUMNS};

/// The column of that name in a row that begins with time and step.
fn place(columns: &[Column], name: &str) -> usize {
    2 + columns.iter().position(|column| column.name == name).unwrap_or(0)
}

/// The last layers of a record, from its rows: porosity, pressure and effective stresses. `None` if there are no rows.
pub fn layers(title: &str, axis: usize, rows: &[Vec<f64>]) -> Option<Figure> {
    let last = rows.last()?[1];
    let [low, high] = ["low", "high"].map(|name| place(&LAYER_COLUMNS, name));
    let along = |name: &str| -> Vec<(f64, f64)> {
        let column = place(&LAYER_COLUMNS, name);
        let now = rows.iter().filter(|row| row[1] == last);
        now.map(|row| (500.0 * (row[low] + row[high]), row[column])).collect()
    };
    let name = ["x", "y", "z"][axis];
    let mut figure = Figure::new(
        title,
        Axis::linear(format!("{name} (mm), middle of the layer")),
        Axis::linear("porosity").range(0.0, 1.05),
    )
    .with(Series::line_points("porosity", along("porosity")))
    .with_panel(Axis::linear("pressure (Pa)"))
    .with(Series::line_points("pressure", along("pressure")));
    let stresses = ["x", "y", "z"].map(|axis| (axis, along(&format!("effective_stress_{axis}"))));
    if stresses.iter().any(|(_, points)| points.iter().any(|point| point.1 != 0.0)) {
        figure = figure.with_panel(Axis::linear("stress (Pa)"));
        for (axis, points) in stresses {
            figure = figure.with(Series::line_points(format!("effective stress {axis}"), points));
        }
    }
    Some(figure.note(format!("after {last} steps")))
}

/// Coordination number and stresses over time, from the rows of a record. `None` if there are fewer than two.
pub fn contacts(title: &str, rows: &[Vec<f64>]) -> Option<Figure> {
    if rows.len() < 2 {
        return None;
    }
    let over_time = |name: &str| -> Vec<(f64, f64)> {
        let column = place(&CONTACT_MEAN_COLUMNS, name);
        rows.iter().map(|row| (row[0], row[column])).collect()
    };
    let mut figure = Figure::new(title, Axis::linear("time (s)"), Axis::linear("contacts a grain"))
        .with(Series::line("coordination number", over_time("coordination_number")))
        .with_panel(Axis::linear("stress (Pa)"));
    for name in ["xx", "yy", "zz"] {
        let points = over_time(&format!("stress_{name}"));
        figure = figure.with(Series::line(format!("stress {name}"), points));
    }
    Some(figure)
}
