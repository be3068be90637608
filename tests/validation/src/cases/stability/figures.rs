//! The figures of stability at the extremes.

use psmrt_report::{Axis, Figure, Marker, Series, Style};

use super::{COLLISIONS, mrt_over_srt, points, single_and_double};
use crate::cases::{CaseError, Golden};
use psmrt::table::Table;

/// The figure with a series, if that has points.
fn with_points(figure: Figure, series: Series) -> Figure {
    if series.points.is_empty() { figure } else { figure.with(series) }
}

/// Axis of the relaxation times.
fn tau() -> Axis {
    Axis::log("τ - 1/2 (viscosity over 1/3)").ticks(&[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0])
}

/// All of them.
pub fn draw(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let mut figures = vec![fluid(rows, "shear_layer", "Shear layer in a periodic box")?];
    figures.push(fluid(rows, "taylor_green", "Taylor–Green vortex in three dimensions")?);
    figures.push(fluid(rows, "abc", "ABC flow (exact solution known)")?);
    figures.push(reynolds(rows)?);
    figures.push(ratio(rows)?);
    figures.push(movers(&golden.table("movers.csv")?)?);
    let both = single_and_double(rows)?;
    let ends: Vec<f64> = both.iter().flat_map(|p| [p.0, p.1]).collect();
    let low = ends.iter().copied().fold(f64::INFINITY, f64::min);
    let high = ends.iter().copied().fold(0.0, f64::max);
    figures.push(
        Figure::new(
            "Largest stable velocity: single against double precision",
            Axis::log("double precision (cells per step)"),
            Axis::log("single precision (cells per step)"),
        )
        .with(Series::points("a line of a map", both))
        .with(Series::new("the same", Style::Reference, vec![(low, low), (high, high)]))
        .note("points may lie on top of each other: only a few velocities are tried"),
    );
    Ok(figures)
}

fn fluid(rows: &Table, flow: &str, title: &str) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        format!("{title}: largest stable velocity"),
        tau(),
        Axis::log("largest velocity (cells per step)").range(2e-3, 0.8),
    );
    for (colour, (collision, label)) in COLLISIONS.into_iter().enumerate() {
        let own = [("flow", flow), ("engine", "reference"), ("collision", collision)];
        let lives = points(rows, &own, "survives_to")?;
        let right = points(rows, &own, "right_to")?;
        let lives = Series::line_points(format!("{label}: stable"), lives).with_colour(colour);
        let right = Series::dashed(format!("{label}: accurate"), right).with_colour(colour);
        figure = with_points(with_points(figure, lives), right);
    }
    Ok(figure.note(
        "double precision; 0.5 was the largest tried; a dashed line hidden by its solid one: all that is stable is \
         accurate; none at all: nothing tried was",
    ))
}

fn reynolds(rows: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "Packed bed: the largest stable Reynolds number",
        tau(),
        Axis::log("largest Re = U d/(ν (1 - porosity))"),
    );
    for (weight, word) in [("NT", "B(ε, τ)"), ("eps", "B = ε"), ("graded", "graded viscosity")] {
        for (collision, label) in COLLISIONS {
            let own = [
                ("flow", "bed_force"),
                ("engine", "reference"),
                ("weight", weight),
                ("collision", collision),
            ];
            let found = points(rows, &own, "reynolds")?;
            figure = with_points(figure, Series::line_points(format!("{label}, {word}"), found));
        }
    }
    let ends = (9e-6, 1.6);
    for (reynolds, label) in
        [(2.0, "the paper: SRT fails above Re = 2"), (30.0, "the paper: MRT reaches Re = 30")]
    {
        let line = vec![(ends.0, reynolds), (ends.1, reynolds)];
        figure = figure.with(Series::new(label, Style::Reference, line));
    }
    Ok(figure
        .note("body-centred array, porosity 0.4, 13.3 cells per diameter, driven by a body force; double precision")
        .note("the paper states no relaxation time"))
}

fn ratio(rows: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "Largest stable velocity of MRT over that of SRT",
        tau(),
        Axis::log("Re (shear layer: velocity) of MRT over that of SRT"),
    );
    let layer = mrt_over_srt(rows, &[("flow", "shear_layer"), ("engine", "reference")])?;
    figure = figure.with(Series::line_points("shear layer", layer));
    for (flow, variant, word) in [
        ("bed_force", "-", "bed, body force"),
        ("bed_inlet", "free", "bed, inlet and free outflow"),
        ("bed_inlet", "pressure", "bed, inlet and pressure"),
    ] {
        for (weight, b) in [("NT", "B(ε, τ)"), ("eps", "B = ε")] {
            let own =
                [("flow", flow), ("variant", variant), ("weight", weight), ("engine", "reference")];
            let found = mrt_over_srt(rows, &own)?;
            figure = with_points(figure, Series::line_points(format!("{word}, {b}"), found));
        }
    }
    let paper = vec![(9e-7, 15.0), (1.6, 15.0)];
    Ok(figure
        .with(Series::new("the paper: Re = 30 against Re = 2", Style::Reference, paper))
        .note("double precision; one tried velocity up or down is a factor of 1.25 to 2, below 1e-3 of 3 to 10"))
}

fn movers(map: &Table) -> Result<Figure, CaseError> {
    let y = || Axis::log("density of the grain over that of the fluid").range(0.03, 16.0);
    let mut figure =
        Figure::new("Free grain: which density ratios are stable and accurate", tau(), y());
    for (number, variant) in ["lagged", "kept"].into_iter().enumerate() {
        if number > 0 {
            figure = figure.with_panel(y());
        }
        for (outcome, marker) in
            [("right", Marker::Circle), ("wrong", Marker::Diamond), ("stopped", Marker::Cross)]
        {
            let own =
                map.with(&[("engine", "reference"), ("variant", variant), ("outcome", outcome)])?;
            let found =
                own.points("tau", "value")?.into_iter().map(|(tau, y)| (tau - 0.5, y)).collect();
            let label = format!("{variant}: {outcome}");
            figure = with_points(figure, Series::new(label, Style::Points(Some(marker)), found));
        }
    }
    Ok(figure
        .note("one grain of 6 cells, 600 steps; internal mass: added back with a lag of one step (lagged), retained (kept, below)")
        .note("right: momentum stays, never faster than at the start, final velocity within 2 %"))
}
