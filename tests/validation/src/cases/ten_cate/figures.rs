//! The figures of ten Cate's settling sphere.

use psmrt_report::{Axis, Figure, Marker, Series, Style};

use super::study::{WITHOUT_ORDER, order_and_limit};
use super::{EXPERIMENTS, OWN, differences, measured};
use crate::cases::found::found;
use crate::cases::{CaseError, Golden};
use psmrt::table::Table;

/// What the digitising is worth: of the largest velocity, and in diameters.
const VELOCITY_ERROR: f64 = 0.02;
const GAP_ERROR: f64 = 0.05;

/// What the bars of all of them are.
const BARS: &str = "bars: digitising (2 % of the largest velocity, 0.05 diameters), the experiment's own uncertainty is not known";

/// All of them; `rows` are the falls just made.
pub fn all(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let (curves, published) = (golden.table("curves.csv")?, golden.table("literature.csv")?);
    let (study, falls) = (golden.table("study.csv")?, golden.table("falls.csv")?);
    let largest = |case: &str| published.with(&[("case", case)])?.number("umax_exp_m_s");
    let velocity = Figure::new(
        "Velocity of ten Cate's sphere",
        Axis::linear("time since the release (s)").range(0.0, 4.5),
        Axis::linear("velocity downwards (m/s)").range(0.0, 0.14),
    );
    let residual = Axis::linear("computed - measured, over the largest").range(-0.8, 0.3);
    let velocity =
        courses(velocity, residual, ("velocity_m_s", &curves), (&study, &falls), |case| {
            let largest = largest(case)?;
            Ok((VELOCITY_ERROR * largest, largest))
        })?;
    let gap = Figure::new(
        "Gap below ten Cate's sphere",
        Axis::linear("time since the release (s)").range(0.0, 4.5),
        Axis::linear("gap over the diameter").range(0.0, 9.0),
    );
    let residual = Axis::linear("computed - measured (diameters)").range(-0.6, 0.2);
    let gap = courses(gap, residual, ("gap_over_d", &curves), (&study, &falls), |_| {
        Ok((GAP_ERROR, 1.0))
    })?;
    Ok(vec![
        velocity.note("finest grid of each; no shift in time: the measured spheres brake 0.03 to 0.2 s later").note(BARS),
        gap.note("finest grid of each; the first measured gaps are 8.13 to 8.18 where 8 was set").note(BARS),
        now_figure(&curves, rows, largest(OWN)?)?,
        grid_figure(&study, &published)?,
    ])
}

/// The courses of all experiments on their finest grids, and what they differ by; `scales` are the error of a
/// measured point and the unit of the differences.
fn courses(
    mut figure: Figure,
    residual: Axis,
    (quantity, curves): (&str, &Table),
    (study, falls): (&Table, &Table),
    scales: impl Fn(&str) -> Result<(f64, f64), CaseError>,
) -> Result<Figure, CaseError> {
    for (colour, (case, reynolds)) in EXPERIMENTS.into_iter().enumerate() {
        let points = measured(curves, case, quantity)?;
        let bars = vec![scales(case)?.0; points.len()];
        let series = Series::points(format!("Re {reynolds}, measured"), points);
        figure = figure.with(series.with_errors(bars).with_colour(colour));
    }
    let mut residuals = Vec::new();
    for (colour, (case, reynolds)) in EXPERIMENTS.into_iter().enumerate() {
        let own = falls.with(&[("case", case)])?;
        let finest = own.values("cells_per_diameter")?.pop().unwrap_or_default();
        let grid = [("case", case), ("cells_per_diameter", finest.as_str())];
        let engine = study.with(&grid)?.values("engine")?.join(", ");
        let own = own.with(&grid)?.points("time_s", quantity)?;
        let (error, unit) = scales(case)?;
        let off = differences(&own, &measured(curves, case, quantity)?);
        let off: Vec<_> = off.into_iter().map(|(time, off)| (time, off / unit)).collect();
        let bars = vec![error / unit; off.len()];
        let series = Series::points(format!("Re {reynolds}, measured"), off);
        residuals.push(series.with_errors(bars).with_colour(colour));
        let label = format!("Re {reynolds}, {engine}, {finest} cells");
        figure = figure.with(Series::line(label, own).with_colour(colour));
    }
    Ok(residuals.into_iter().fold(figure.with_panel(residual), Figure::with))
}

/// The fall that was just made.
fn now_figure(curves: &Table, rows: &Table, largest: f64) -> Result<Figure, CaseError> {
    let points = measured(curves, OWN, "velocity_m_s")?;
    let bars = vec![VELOCITY_ERROR * largest; points.len()];
    let cells = rows.values("cells_per_diameter")?.join(", ");
    let mut figure = Figure::new(
        format!("Re 31.9 on {cells} cells per diameter"),
        Axis::linear("time since the release (s)").range(0.0, 1.3),
        Axis::linear("velocity downwards (m/s)").range(0.0, 0.14),
    )
    .with(Series::points("measured", points.clone()).with_errors(bars).with_colour(6));
    let mut residuals = Vec::new();
    for engine in rows.values("engine")? {
        let own = rows.with(&[("engine", &engine)])?.points("time_s", "velocity_m_s")?;
        let off = differences(&own, &points);
        let off: Vec<_> = off.into_iter().map(|(time, off)| (time, off / largest)).collect();
        let bars = vec![VELOCITY_ERROR; off.len()];
        residuals.push(found("", &engine, off, Some(0)).with_errors(bars));
        figure = figure.with(found("", &engine, own, Some(0)));
    }
    figure =
        figure.with_panel(Axis::linear("computed - measured, over the largest").range(-0.4, 0.2));
    Ok(residuals.into_iter().fold(figure, Figure::with).note(BARS))
}

/// The largest velocity against resolution.
fn grid_figure(study: &Table, published: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "Largest velocity of ten Cate's sphere against resolution",
        Axis::linear("(cell size/diameter)²").range(-0.0005, 0.017),
        Axis::linear("computed over measured - 1 (%)").range(-7.0, 4.0),
    );
    for (colour, (case, reynolds)) in EXPERIMENTS.into_iter().enumerate() {
        let errors = study.with(&[("case", case)])?;
        let errors = errors.points("cells_per_diameter", "error_of_largest")?;
        let points = errors.iter().map(|&(d, e)| (d.powi(-2), 100.0 * e)).collect();
        figure = figure.with(Series::points(format!("Re {reynolds}"), points).with_colour(colour));
        let found = if case == WITHOUT_ORDER { None } else { order_and_limit(&errors) };
        if let Some((order, limit)) = found {
            let (cells, finest) = errors[errors.len() - 1];
            let size = (finest - limit) * cells.powf(order);
            let curve = (0..=64).map(|i| f64::from(i) / 64.0 / 64.0);
            let curve = curve
                .map(|square: f64| (square, 100.0 * (limit + size * square.powf(0.5 * order))));
            let label = format!("order {order:.1}, to {:.1} %", 100.0 * limit);
            figure = figure.with(Series::line(label, curve.collect()).with_colour(colour));
        }
    }
    for (colour, (case, _)) in EXPERIMENTS.into_iter().enumerate() {
        let own = published.with(&[("case", case)])?;
        let theirs = own.number("umax_LBM_over_uinf")? / own.number("umax_exp_over_uinf")? - 1.0;
        let label = if colour == 0 { "ten Cate's own computations" } else { "" };
        let point = vec![(0.0, 100.0 * theirs)];
        figure = figure.with(
            Series::new(label, Style::Points(Some(Marker::Cross)), point).with_colour(colour),
        );
    }
    Ok(figure.note(
        "8 cells per diameter are at 0.016, 12 at 0.007, 16 at 0.004; at Re 31.9 the grids differ by 0.5 % in all, too little for an order",
    ))
}
