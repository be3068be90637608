//! The figures: amplitude and phase across plates and a duct, their errors, and the force on a sphere.

use psmrt_report::{Axis, Figure, PowerLaw, Series, Style};

use super::channels::{CELLS, FLOWS, WOMERSLEY, error, exact, measured};
use super::sphere::{BOXES, GRIDS, OPERATORS, OscillatingSphere, parts_by};
use crate::cases::found::{drawn, found};
use crate::cases::{CaseError, Golden};
use psmrt::engine::EngineName;
use psmrt::table::Table;

pub(super) fn all(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let rows = drawn(rows);
    let (study, shells) = (golden.table("study.csv")?, golden.table("literature.csv")?);
    let mut figures = Vec::new();
    for (flow, _) in FLOWS {
        figures.push(profiles(&rows, flow)?);
    }
    figures.extend([errors(&rows)?, grids(&study)?, boxes(&study, &shells)?]);
    Ok(figures)
}

/// Phase behind the force, degrees.
fn lag(amplitude: nalgebra::Complex<f64>) -> f64 {
    -amplitude.arg().to_degrees()
}

fn profiles(rows: &Table, flow: &str) -> Result<Figure, CaseError> {
    let where_of =
        if flow == "duct" { "Square duct, on the middle line" } else { "Between plates" };
    let mut figure = Figure::new(
        format!("{where_of}: a force that oscillates"),
        Axis::linear("distance from a wall over the width").range(0.0, 0.5),
        Axis::linear("amplitude of the velocity over G/omega"),
    );
    let curve = |womersley: f64| -> Vec<_> {
        let places = (1..=100).map(|i| 0.005 * f64::from(i));
        places.map(|place| (place, exact(flow, womersley, place, 0.0))).collect()
    };
    let engines = rows.values("engine")?;
    for (colour, womersley) in WOMERSLEY.into_iter().enumerate() {
        let points = curve(womersley).into_iter().map(|(place, u)| (place, u.norm())).collect();
        let line = Series::line(format!("exact, Womersley's number {womersley}"), points);
        figure = figure.with(line.with_colour(colour));
        for engine in &engines {
            let points = measured(rows, engine, flow, womersley, CELLS[1])?;
            let points = points.into_iter().map(|(place, u)| (place, u.norm())).collect();
            figure = figure.with(found(&womersley.to_string(), engine, points, Some(colour)));
        }
    }
    figure = figure.with_panel(Axis::linear("lag behind the force (degrees)").range(0.0, 100.0));
    for (colour, womersley) in WOMERSLEY.into_iter().enumerate() {
        let points = curve(womersley).into_iter().map(|(place, u)| (place, lag(u))).collect();
        let line = Series::line(format!("exact, Womersley's number {womersley}"), points);
        figure = figure.with(line.with_colour(colour));
        for engine in &engines {
            let points = measured(rows, engine, flow, womersley, CELLS[1])?;
            let points = points.into_iter().map(|(place, u)| (place, lag(u))).collect();
            figure = figure.with(found(&womersley.to_string(), engine, points, Some(colour)));
        }
    }
    Ok(figure.note(format!("{} cells across, tau = 0.8, Lambda = 3/16", CELLS[1])))
}

fn errors(rows: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "Oscillating flows: error against resolution",
        Axis::log("cells across").ticks(&CELLS.map(|cells| cells as f64)),
        Axis::log("largest error of the amplitude over the largest"),
    );
    let mut colour = 0;
    for (flow, _) in FLOWS {
        for womersley in WOMERSLEY {
            for engine in rows.values("engine")? {
                let mut points = Vec::new();
                for cells in CELLS {
                    points.push((cells as f64, error(rows, &engine, flow, womersley, cells)?));
                }
                let name = format!("{flow}, {womersley}");
                if engine == EngineName::Reference.word() {
                    let fit = PowerLaw::fit(&points)?;
                    let label = format!("{name}: order {:.2}", -fit.order);
                    let line = fit.series(label, (CELLS[0] as f64, CELLS[1] as f64));
                    figure = figure.with(line.with_colour(colour));
                }
                figure = figure.with(found(&name, &engine, points, Some(colour)));
            }
            colour += 1;
        }
    }
    Ok(figure)
}

fn grids(study: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "A sphere that oscillates: force against resolution",
        Axis::linear("cells per radius"),
        Axis::linear("part with the velocity over the exact one"),
    );
    let each = |number: usize| -> Result<Vec<Series>, CaseError> {
        let mut all = Vec::new();
        for (colour, operator) in OPERATORS.into_iter().enumerate() {
            let rows =
                parts_by(study, &OscillatingSphere { operator, ..GRIDS }, "cells_per_radius")?;
            let points = rows.iter().map(|row| (row[0], row[number])).collect();
            all.push(Series::line_points(operator, points).with_colour(colour));
        }
        all.push(Series::new("exact, unbounded", Style::Reference, vec![(4.0, 1.0), (8.0, 1.0)]));
        Ok(all)
    };
    figure = each(1)?.into_iter().fold(figure, Figure::with);
    figure = figure.with_panel(Axis::linear("part with the acceleration over the exact one"));
    figure = each(2)?.into_iter().fold(figure, Figure::with);
    Ok(figure
        .note("tau = 0.6, layer of half a radius, box of 12 radii; the fluid inside taken off"))
}

fn boxes(study: &Table, shells: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "A sphere that oscillates: what the walls of the box do",
        Axis::linear("edge of the box over the radius"),
        Axis::linear("part with the velocity over the exact one"),
    );
    let layer = BOXES.layer.to_string();
    let each = |number: usize, column: &str| -> Result<Vec<Series>, CaseError> {
        let rows = parts_by(study, &BOXES, "box_radii")?;
        let points = rows.iter().map(|row| (row[0], row[number])).collect();
        let mut all = vec![Series::line_points("psmrt, 4 cells per radius", points)];
        for shell in ["inscribed", "equal_volume", "circumscribed"] {
            let own = shells.with(&[("layer_radii", &layer), ("shell", shell)])?;
            let label = format!("exact, spherical shell: {}", shell.replace('_', " "));
            all.push(Series::dashed(label, own.points("box_radii", column)?));
        }
        Ok(all)
    };
    figure = each(1, "velocity_part")?.into_iter().fold(figure, Figure::with);
    figure = figure.with_panel(Axis::linear("part with the acceleration over the exact one"));
    figure = each(2, "acceleration_part")?.into_iter().fold(figure, Figure::with);
    Ok(figure.note("bounce_back, tau = 0.6, layer as thick as the radius"))
}
