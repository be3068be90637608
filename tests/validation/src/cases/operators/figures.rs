//! The figures: errors of the operators beside each other.

use psmrt::table::Table;
use psmrt_reference::collision::Preset;
use psmrt_report::{Axis, Figure, Marker, Series, Style};

use super::beds::{BEDS, Bed, ORDERS};
use super::yardstick::{Level, levels, name, of_stream};
use super::{BOUNCE_BACK, FULL, OPERATORS, Tables};
use crate::cases::CaseError;
use crate::tradeoff::operators::drag_error;
use crate::tradeoff::parameters::Flow;
use crate::tradeoff::row::Row;

const MARKERS: [Marker; 3] = [Marker::Circle, Marker::Square, Marker::Diamond];

/// All of them.
pub fn all(tables: &Tables, known: &[(f64, f64, f64)]) -> Result<Vec<Figure>, CaseError> {
    let mut figures = vec![of_the_stream(&tables.stream, known)?];
    figures.extend(BEDS.iter().map(|bed| of_a_bed(&tables.beds, bed)));
    figures.push(of_arrays(&tables.arrays, 24));
    figures.push(of_orders(&tables.arrays));
    figures.push(of_torque(&tables.spinning)?);
    figures.push(of_motion(&tables.towed)?);
    figures.push(of_falls(&tables.ten_cate)?);
    Ok(figures)
}

/// Adds what an operator has, in its colour; `more` tells several of its series apart, by markers.
fn with(
    figure: Figure,
    operator: &str,
    more: &str,
    number: usize,
    points: Vec<(f64, f64)>,
) -> Figure {
    if points.is_empty() {
        return figure;
    }
    let colour = OPERATORS.iter().position(|one| *one == operator).unwrap_or(0);
    let style = Style::LinePoints(Some(MARKERS[number % MARKERS.len()]));
    let label = [name(operator), more].join(if more.is_empty() { "" } else { ", " });
    figure.with(Series::new(label, style, points).with_colour(colour))
}

fn zero(figure: Figure, from: f64, to: f64) -> Figure {
    figure.with(Series::new("", Style::Reference, vec![(from, 0.0), (to, 0.0)]))
}

fn of_the_stream(stream: &Table, known: &[(f64, f64, f64)]) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "A sphere in a stream: error of the drag, 6 and 8 cells per diameter",
        Axis::log("Re = U d/nu"),
        Axis::linear("C_D over the known one, less 1"),
    )
    .size(800, 500);
    for (number, cells) in ["6", "8"].into_iter().enumerate() {
        for operator in OPERATORS {
            let mut points = Vec::new();
            for &(reynolds, tau, known) in known {
                let own = of_stream(stream, operator, "cpu", (reynolds, tau))?;
                let own = own.with(&[("cells_per_diameter", cells)])?.numbers("CD")?;
                points.extend(own.into_iter().map(|cd| (reynolds, cd / known - 1.0)));
            }
            figure = with(figure, operator, &format!("{cells} cells"), number, points);
        }
    }
    Ok(zero(figure, 0.1, 100.0)
        .note("known: exact at Re 0.1, else 12 and 16 cells of the paper's operator extrapolated"))
}

fn of_a_bed(rows: &[Row], bed: &Bed) -> Figure {
    let (flow, geometry) = bed.problem;
    let what = match flow {
        Flow::Sc => "Simple cubic array",
        Flow::Fcc => "Face-centred cubic array",
        _ => "Random bed",
    };
    let mut figure = Figure::new(
        format!("{what}, solid fraction {geometry}: error of the drag under a given force"),
        Axis::log("Re = U d/nu, as reached"),
        Axis::linear("driving force over velocity, over what finer grids lead to, less 1"),
    )
    .size(800, 500);
    let own: Vec<Level> = levels().into_iter().filter(|level| level.bed == bed.problem).collect();
    for (number, &cells) in bed.grids[..2].iter().enumerate() {
        for operator in OPERATORS {
            let points: Vec<(f64, f64)> = own
                .iter()
                .filter_map(|level| {
                    let end = level.yardstick(rows)?.mean;
                    let grids = level.grids(rows, operator, level.taus[0]);
                    let at = grids.iter().find(|point| point.0 == f64::from(cells))?;
                    Some((level.force * end, end / at.1 - 1.0))
                })
                .collect();
            figure =
                with(figure, operator, &format!("{cells} cells along the edge"), number, points);
        }
    }
    let fastest = own.iter().map(|level| level.force).fold(1.0, f64::max);
    zero(figure, 1.0, fastest)
}

/// Drag error of the creeping rows of an operator, by what `key` says of a row.
fn creeping(rows: &[Row], operator: &str, key: impl Fn(&Row) -> Option<f64>) -> Vec<(f64, f64)> {
    let own = rows.iter().filter(|row| {
        row.parameters.operator == operator && row.parameters.collision == Preset::DHumieres
    });
    let mut points: Vec<(f64, f64)> =
        own.filter_map(|row| Some((key(row)?, drag_error(row)?))).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points
}

fn of_arrays(rows: &[Row], cells: u32) -> Figure {
    let mut figure = Figure::new(
        format!(
            "Creeping flow through arrays, {cells} cells along the edge, tau 0.6: error of the drag"
        ),
        Axis::linear("solid fraction"),
        Axis::linear("error of the drag"),
    )
    .size(800, 500);
    for (number, (flow, lattice)) in
        [(Flow::Sc, "SC"), (Flow::Bcc, "BCC"), (Flow::Fcc, "FCC")].into_iter().enumerate()
    {
        for operator in OPERATORS {
            let points = creeping(rows, operator, |row| {
                let run = &row.parameters;
                let is_own = run.flow == flow && run.cells == cells && run.tau == 0.6;
                // The arrays of the orders lie between the tenths.
                let own = is_own && run.geometry.len() == 3;
                own.then(|| run.geometry.parse().ok()).flatten()
            });
            figure = with(figure, operator, lattice, number, points);
        }
    }
    zero(figure, 0.1, 0.7)
}

fn of_orders(rows: &[Row]) -> Figure {
    let mut figure = Figure::new(
        "Creeping flow: error of the drag against the grid, tau 1",
        Axis::log("cells per diameter"),
        Axis::log("size of the error of the drag"),
    )
    .size(800, 500);
    for (number, (flow, geometry)) in ORDERS.into_iter().enumerate() {
        for operator in OPERATORS {
            let points = creeping(rows, operator, |row| {
                let run = &row.parameters;
                let is_own = run.flow == flow && run.geometry == geometry && run.tau == 1.0;
                is_own.then(|| run.cells_per_diameter()).flatten()
            });
            let points = points.into_iter().map(|(d, error)| (d, error.abs())).collect();
            figure = with(
                figure,
                operator,
                &format!("{} {geometry}", flow.word().to_uppercase()),
                number,
                points,
            );
        }
    }
    let slope = |order: i32| vec![(10.0, 0.1), (40.0, 0.1 * 4.0_f64.powi(-order))];
    figure
        .with(Series::new("first and second order", Style::Reference, slope(1)))
        .with(Series::new("", Style::Reference, slope(2)))
}

fn of_torque(spinning: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "A sphere that spins: error of the torque",
        Axis::log("relaxation time less 1/2"),
        Axis::linear("error of the torque"),
    )
    .size(800, 500);
    for (number, cells) in ["8", "12"].into_iter().enumerate() {
        for operator in OPERATORS {
            let own = spinning.with(&[
                ("operator", operator),
                ("cells_per_diameter", cells),
                ("collision", Preset::DHumieres.word()),
            ])?;
            let points = own.points("tau", "error")?;
            let points = points.into_iter().map(|(tau, error)| (tau - 0.5, error)).collect();
            figure = with(figure, operator, &format!("{cells} cells"), number, points);
        }
    }
    Ok(zero(figure, 0.05, 1.0))
}

fn of_motion(towed: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "How evenly a sphere of 8 cells goes through the grid",
        Axis::log("relaxation time less 1/2"),
        Axis::log("root mean square over the mean"),
    )
    .size(800, 500);
    for (number, (way, what)) in
        [("axis", "force, along an axis"), ("free", "velocity, free")].into_iter().enumerate()
    {
        for operator in OPERATORS {
            let own =
                towed.with(&[("way", way), ("operator", operator), ("cells_per_diameter", "8")])?;
            let points = own.points("tau", "uneven")?;
            let points = points.into_iter().map(|(tau, uneven)| (tau - 0.5, uneven)).collect();
            figure = with(figure, operator, what, number, points);
        }
    }
    Ok(figure)
}

fn of_falls(falls: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "Ten Cate's settling sphere: error of the largest velocity",
        Axis::linear("cells per diameter"),
        Axis::linear("over the measured one, less 1"),
    )
    .size(800, 500);
    for (number, (case, tau)) in [("E1", "0.8"), ("E4", "0.55")].into_iter().enumerate() {
        for operator in [BOUNCE_BACK, FULL] {
            let own = falls.with(&[("case", case), ("operator", operator), ("tau", tau)])?;
            let points = own.points("cells_per_diameter", "error_of_largest")?;
            figure = with(figure, operator, &format!("{case}, tau {tau}"), number, points);
        }
    }
    Ok(zero(figure, 6.0, 8.0))
}
