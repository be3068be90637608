//! Which numbers go into which picture; the drawing itself is psmrt-report's.

use psmrt_report::{Axis, Figure, Series};

use crate::exact::{Comparison, PlanePoiseuille};
use crate::scene::columns::{BOX_COLUMNS, PERMEABILITY_COLUMNS};

/// The profile of a run over the exact one, with what is left below.
pub fn profile(title: &str, exact: &PlanePoiseuille, comparison: &Comparison) -> Figure {
    let mm = |metres: f64| metres * 1e3;
    let axis = ["x", "y", "z"];
    let curve = (0..=100)
        .map(|i| {
            let si_y = exact.si_gap * f64::from(i) / 100.0;
            (mm(si_y), mm(exact.si_velocity(si_y)))
        })
        .collect();
    let points = |value: fn(f64, f64) -> f64| -> Vec<(f64, f64)> {
        comparison.si_rows.iter().map(|&[y, u, exact]| (mm(y), value(u, exact))).collect()
    };
    let top = exact.si_top_velocity();
    let rest = comparison.si_rows.iter().map(|&[y, u, e]| (mm(y), (u - e) / top)).collect();
    // Zero belongs into the panel of what is left: else a constant rest fills it with its last digits.
    let most = comparison.relative_max * 1.1;
    let left = Axis::linear("(u - exact)/u_max");
    let left = if most > 0.0 { left.range(-most, most) } else { left };
    Figure::new(
        title,
        Axis::linear(format!("{} (mm)", axis[exact.across])),
        Axis::linear(format!("velocity u_{} (mm/s)", axis[exact.along])),
    )
    .with(Series::line("exact", curve))
    .with(Series::points("psmrt", points(|u, _| u * 1e3)))
    .with_panel(left)
    .with(Series::points("psmrt", rest))
    .note(format!(
        "relative L2 error {:.2e}; the wall's known slip alone would make {:.2e}",
        comparison.relative_l2, comparison.explained_l2
    ))
}

/// Rows with time first: the columns of a record of kind `box` over time.
pub fn box_record(title: &str, rows: &[Vec<f64>]) -> Figure {
    let over_time = |column: usize, factor: f64| -> Vec<(f64, f64)> {
        rows.iter().map(|row| (row[0], factor * row[column])).collect()
    };
    let mut figure = Figure::new(title, Axis::linear("time (s)"), Axis::linear("velocity (mm/s)"));
    // Time and step come before the columns.
    for (number, column) in BOX_COLUMNS.iter().enumerate().filter(|(_, c)| c.unit == "m/s") {
        figure =
            figure.with(Series::line(column.name.replace('_', " "), over_time(2 + number, 1e3)));
    }
    figure
}

/// Rows with time first: the permeability over time, with what laws give.
pub fn permeability_record(title: &str, rows: &[Vec<f64>]) -> Figure {
    let mut figure = Figure::new(title, Axis::linear("time (s)"), Axis::linear("k (um2)"));
    // Time and step come before the columns.
    for (number, column) in PERMEABILITY_COLUMNS.iter().enumerate().filter(|(_, c)| c.unit == "m2")
    {
        // There is none before anything drives the flow.
        let known = rows.iter().filter(|row| row[2 + number].is_finite());
        let points = known.map(|row| (row[0], 1e12 * row[2 + number])).collect();
        figure = figure.with(Series::line(column.name.replace('_', " "), points));
    }
    figure
}

/// Rows with time, step, position first: the last profile of a record.
pub fn line_record(title: &str, axis: usize, rows: &[Vec<f64>]) -> Figure {
    let last = rows.last().map_or(0.0, |row| row[1]);
    let along = |column: usize| -> Vec<(f64, f64)> {
        let now = rows.iter().filter(|row| row[1] == last);
        now.map(|row| (1e3 * row[2], 1e3 * row[column])).collect()
    };
    let position = format!("{} (mm)", ["x", "y", "z"][axis]);
    let mut figure = Figure::new(title, Axis::linear(position), Axis::linear("velocity (mm/s)"));
    for (number, name) in ["x", "y", "z"].into_iter().enumerate() {
        figure = figure.with(Series::line_points(format!("velocity {name}"), along(4 + number)));
    }
    // The place of the line comes after the velocities.
    let place = |other: usize| -> Option<String> {
        let si_place = rows.last()?.get(7 + other)?;
        Some(format!("{} = {:.4} mm", ["x", "y", "z"][other], 1e3 * si_place))
    };
    let place: Vec<_> = (0..3).filter(|&other| other != axis).filter_map(place).collect();
    figure.note(format!("along {}; after {last} steps", place.join(", ")))
}
