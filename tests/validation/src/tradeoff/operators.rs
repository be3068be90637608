//! The operators of the solid in fixed beds, beside each other: error against tau, and against what a run costs.

use psmrt_reference::collision::Preset;
use psmrt_reference::coverage::CoverageRule;
use psmrt_report::{Axis, Figure, Marker, Series, Style};

use super::figures::title;
use super::sweep::{OF_FREE_GRAINS, OPERATORS};
use crate::tradeoff::parameters::Flow;
use crate::tradeoff::row::Row;

/// How figures and claims name them.
const NAMES: [&str; 4] = [
    "SC1, non-equilibrium bounce-back",
    "SC2, superposition",
    "SC3, full bounce-back",
    "graded viscosity",
];

const MARKERS: [Marker; 4] =
    [Marker::Circle, Marker::TriangleDown, Marker::Square, Marker::Diamond];

/// The beds that are drawn, with cells along the edge at which errors are drawn against tau.
const DRAWN: [(Flow, &str, u32); 3] =
    [(Flow::Sc, "0.343", 16), (Flow::Fcc, "0.6", 24), (Flow::Random, "0.45", 24)];

/// Largest relaxation time at which spreads are judged: beyond it nobody computes a bed who need not.
const MOST_TAU: f64 = 1.0;

/// Error of the drag: that of the velocity under a given force, turned round.
pub fn drag_error(row: &Row) -> Option<f64> {
    row.error.map(|error| 1.0 / (1.0 + error) - 1.0)
}

/// Tau and error of the drag of the runs with d'Humières' rates of one operator in one bed, tau rising.
pub fn against_tau(
    rows: &[Row],
    (flow, geometry, cells): (Flow, &str, u32),
    (operator, weight): (&str, &str),
) -> Vec<(f64, f64)> {
    let is_own = |row: &&Row| {
        let run = &row.parameters;
        run.flow == flow
            && run.geometry == geometry
            && run.cells == cells
            && run.collision == Preset::DHumieres
            && run.coverage == CoverageRule::Exact
            && run.operator == operator
            && run.weight == weight
    };
    let own = rows.iter().filter(is_own);
    let mut points: Vec<(f64, f64)> =
        own.filter_map(|row| Some((row.parameters.tau, drag_error(row)?))).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points
}

/// By how much the error of the drag changes between the smallest tau and 1, for an operator in a bed.
pub fn spread(rows: &[Row], bed: (Flow, &str, u32), operator: (&str, &str)) -> f64 {
    let points = against_tau(rows, bed, operator);
    let errors = || points.iter().filter(|(tau, _)| *tau <= MOST_TAU).map(|(_, error)| *error);
    errors().fold(f64::NEG_INFINITY, f64::max) - errors().fold(f64::INFINITY, f64::min)
}

/// The beds and grids of the rows, each once.
pub fn beds(rows: &[Row]) -> Vec<(Flow, String, u32)> {
    let mut found = Vec::new();
    for row in rows {
        let bed = (row.parameters.flow, row.parameters.geometry.clone(), row.parameters.cells);
        if !found.contains(&bed) {
            found.push(bed);
        }
    }
    found
}

/// All figures.
pub fn figures(rows: &[Row]) -> Vec<Figure> {
    let mut figures = Vec::new();
    for bed @ (flow, geometry, cells) in DRAWN {
        let title = title(&(flow, geometry.to_owned()));
        let mut figure = Figure::new(
            format!("{title}, {cells} cells along the edge: error of the drag, by operator"),
            Axis::log("relaxation time less 1/2"),
            Axis::linear("error of the drag"),
        )
        .size(800, 500);
        for (number, operator) in OPERATORS.into_iter().enumerate() {
            let points = against_tau(rows, bed, operator);
            let points = points.into_iter().map(|(tau, error)| (tau - 0.5, error)).collect();
            let style = Style::LinePoints(Some(MARKERS[number]));
            figure = figure.with(Series::new(NAMES[number], style, points).with_colour(number));
        }
        let exact = Series::new("exact", Style::Reference, vec![(0.05, 0.0), (1.0, 0.0)]);
        figures.push(figure.with(exact));
    }
    figures.push(settling(rows));
    for (flow, geometry, _) in &DRAWN[1..] {
        let title = title(&(*flow, (*geometry).to_owned()));
        let mut figure = Figure::new(
            format!("{title}: error of the drag against the cost, all tau from 0.55 to 1.5"),
            Axis::log("cell updates to the steady flow"),
            Axis::log("size of the error of the drag"),
        )
        .size(800, 500);
        for (number, (operator, weight)) in OPERATORS.into_iter().enumerate() {
            let own = rows.iter().filter(|row| {
                let run = &row.parameters;
                run.flow == *flow
                    && run.geometry == *geometry
                    && run.collision == Preset::DHumieres
                    && run.coverage == CoverageRule::Exact
                    && run.operator == operator
                    && run.weight == weight
            });
            let points: Vec<(f64, f64)> = own
                .filter_map(|row| Some((row.cell_updates() as f64, drag_error(row)?.abs())))
                .collect();
            let style = Style::Points(Some(MARKERS[number]));
            figure = figure.with(Series::new(NAMES[number], style, points).with_colour(number));
        }
        figures.push(figure.note("12 to 32 cells along the edge; where the error of SC3 passes through zero two errors cancel"));
    }
    figures
}

/// A free grain in a shaft.
fn settling(rows: &[Row]) -> Figure {
    let mut figure = Figure::new(
        "A free grain settles in a square shaft of four diameters: error of its drag, by operator",
        Axis::log("relaxation time less 1/2"),
        Axis::linear("error of the drag"),
    )
    .size(800, 500);
    for (cells, marker) in [4, 6, 8].into_iter().zip(MARKERS) {
        for operator in OF_FREE_GRAINS {
            let points = against_tau(rows, (Flow::Settling, "0.25", cells), operator);
            let points = points.into_iter().map(|(tau, error)| (tau - 0.5, error)).collect();
            let number = OPERATORS.iter().position(|one| *one == operator).unwrap_or(0);
            let label = format!("{cells} cells per diameter, {}", NAMES[number]);
            let style = Style::LinePoints(Some(marker));
            figure = figure.with(Series::new(label, style, points).with_colour(number));
        }
    }
    figure.with(Series::new("exact", Style::Reference, vec![(0.05, 0.0), (1.0, 0.0)]))
}
