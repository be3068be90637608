//! The figures of Poiseuille flow.

use psmrt_reference::collision::Preset;
use psmrt_report::{Axis, Figure, PowerLaw, Series};

use super::{WALLS, by_grid, by_tau};
use crate::cases::CaseError;
use crate::cases::found::found;
use psmrt::engine::EngineName;
use psmrt::table::Table;

/// All of them; `walls` says where walls are known to stand.
pub fn all(walls: &Table, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    Ok(vec![profile_figure(walls, rows)?, error_figure(rows)?, wall_figure(walls, rows)?])
}

/// What figures call a set of rates.
fn word(rates: Preset) -> &'static str {
    match rates {
        Preset::Trt => "Lambda = 3/16",
        Preset::DHumieres => "d'Humieres",
        Preset::Srt => "SRT",
    }
}

/// Velocity over the largest exact one, `y` cells from a plate of 8 cells' distance.
fn parabola(y: f64) -> f64 {
    y * (8.0 - y) / 16.0
}

/// The profile on 8 cells at tau = 1.5, where the walls are furthest apart, and what it errs by.
fn profile_figure(walls: &Table, rows: &Table) -> Result<Figure, CaseError> {
    const TAU: &str = "1.5";
    let mut figure = Figure::new(
        "Poiseuille flow: the profile on 8 cells, tau = 1.5",
        Axis::linear("distance from the lower plate (cells)").range(-0.4, 8.4),
        Axis::linear("velocity over the largest exact one").range(0.0, 1.2),
    );
    let exact = (0..=80).map(|i| f64::from(i) / 10.0).map(|y| (y, parabola(y))).collect();
    let plate = |y: f64, high: [f64; 2]| high.map(|u| (y, u)).to_vec();
    figure = figure.with(Series::line("exact, plates half-way", exact));
    for y in [0.0, 8.0] {
        figure = figure.with(Series::dashed("plates", plate(y, [0.0, 1.2])).with_colour(6));
    }
    let mut errors = Vec::new();
    for (colour, (rates, name)) in (1..).zip(WALLS) {
        // Plates that stand δ outside: u = (y + δ)(8 + δ - y)/16 = y (8 - y)/16 + δ (8 + δ)/16.
        let known = walls.with(&[("tau", TAU), ("collision", name)])?;
        let out = known.number("wall_offset_outward_lattice_units_H8")?;
        let slip = out * (8.0 + out) / 16.0;
        let label = format!("{}, wall where it is known to be", word(rates));
        let shifted = (0..=80).map(|i| -out + f64::from(i) / 80.0 * (8.0 + 2.0 * out));
        let shifted = shifted.map(|y| (y, parabola(y) + slip)).collect();
        figure = figure.with(Series::dashed(label.clone(), shifted).with_colour(colour));
        let level = vec![(-out, 100.0 * slip), (8.0 + out, 100.0 * slip)];
        errors.push(Series::dashed(label, level).with_colour(colour));
        for engine in rows.values("engine")? {
            let own = rows.with(&[("engine", &engine), ("rates", rates.word()), ("tau", TAU)])?;
            let own = own.with(&[("cells_across", "8")])?;
            let points = (1..=8).map(|i| Ok((f64::from(i) - 0.5, own.number(&format!("u{i}"))?)));
            let points = points.collect::<Result<Vec<_>, CaseError>>()?;
            let off = points.iter().map(|&(y, u)| (y, 100.0 * (u - parabola(y)))).collect();
            figure = figure.with(found(word(rates), &engine, points, Some(colour)));
            errors.push(found(word(rates), &engine, off, Some(colour)));
        }
    }
    figure = figure.with_panel(Axis::linear("less the exact one (%)").range(-2.0, 8.0));
    Ok(errors.into_iter().fold(figure, Figure::with).note(
        "nodes stand half a cell from the plates; where a dashed parabola meets 0 its plates stand (SRT: 0.13 cells outside)",
    ))
}

/// The error against resolution.
fn error_figure(rows: &Table) -> Result<Figure, CaseError> {
    let slip = by_grid(rows, &rows.rows[0][0], Preset::DHumieres)?;
    let slip = slip.points("cells_across", "slip_l2")?;
    let grids: Vec<f64> = slip.iter().map(|point| point.0).collect();
    let mut figure = Figure::new(
        "Poiseuille flow: error against resolution",
        Axis::log("cells from plate to plate").ticks(&grids),
        Axis::log("relative L2 error of the velocity"),
    );
    for engine in rows.values("engine")? {
        for (rates, name) in [(Preset::Trt, "magic"), (Preset::DHumieres, "d'Humieres")] {
            let points = by_grid(rows, &engine, rates)?.points("cells_across", "relative_l2")?;
            // With magic rates the error is rounding, which has no order.
            if rates == Preset::DHumieres && engine == EngineName::Reference.word() {
                let fit = PowerLaw::fit(&points)?;
                let label = format!("{name}, {engine}: fit of order {:.2}", -fit.order);
                figure = figure.with(fit.series(label, (grids[0], grids[grids.len() - 1])));
            }
            figure = figure.with(found(name, &engine, points, None));
        }
    }
    Ok(figure.with(Series::line("the wall's known slip", slip)))
}

/// Where the wall stands against the relaxation time.
fn wall_figure(walls: &Table, rows: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "Where the wall stands, 8 cells from plate to plate",
        Axis::linear("tau").range(0.5, 2.05),
        Axis::linear("cells outside the half-way place"),
    );
    for (colour, (rates, name)) in WALLS.into_iter().enumerate() {
        let known = walls.with(&[("collision", name)])?;
        let known = known.points("tau", "wall_offset_outward_lattice_units_H8")?;
        let line = Series::line(format!("{}, known", word(rates)), known);
        figure = figure.with(line.with_colour(colour));
        for engine in rows.values("engine")? {
            let walls = by_tau(rows, &engine, (rates, name), walls)?;
            let points = walls.into_iter().map(|(tau, found, _)| (tau, found)).collect();
            figure = figure.with(found(word(rates), &engine, points, Some(colour)));
        }
    }
    Ok(figure)
}
