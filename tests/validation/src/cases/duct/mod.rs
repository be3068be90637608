//! Flow in a square duct, against its series.

use psmrt_reference::collision::Preset;
use psmrt_report::{Axis, Figure, PowerLaw};

use super::found::{found, is_double};
use super::{Bench, Case, CaseError, Claim, Golden};
use psmrt::engine::EngineName;
use psmrt::scene::preset_changes;
use psmrt::table::Table;

/// Flow in a square duct.
pub const CASE: Case = Case {
    name: "duct",
    title: "Poiseuille flow in a square duct",
    about: &[
        "A body force drives water through a square duct. Its mean velocity is known from a series to twelve \
         digits: 0.140577 G h²/nu, with h half the width and G the force per mass. Half-way bounce-back walls meet \
         in corners here, so that no rates make the flow exact; its error falls with the square of the cell \
         size for each collision. Mean velocity by mass flux, on the whole section; tau = 0.8. Steady: the mean \
         velocity changes by less than 1e-9 of itself (kernel: 1e-6) in 200 steps, in three consecutive samples.",
    ],
    scenes: &["scene.toml"],
    literature: &["literature.csv"],
    rows: "expected.csv",
    studies: &[],
    units: "error_of_mean relative",
    full: "the quick form is the full one",
    measure,
    judge,
    draw,
};

const CELLS: [u32; 3] = [8, 12, 16];

const RATES: [Preset; 3] = [Preset::Trt, Preset::DHumieres, Preset::Srt];

/// Width, m, acceleration, m/s2, and viscosity, m2/s, of the scene.
const SI_WIDTH: f64 = 1e-3;
const SI_ACCELERATION: f64 = 0.02;
const SI_VISCOSITY: f64 = 1e-6;

fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    let exact = bench.literature("duct", "literature.csv")?;
    let exact = exact.with(&[("aspect_short_over_long", "1")])?;
    let half = 0.5 * SI_WIDTH;
    let unit = SI_ACCELERATION * half * half / SI_VISCOSITY;
    let si_mean = unit * exact.number("umean_mu_over_G_halfshort2")?;
    // Single precision leaves the mean velocity noise of some 1e-7.
    let tolerance = if bench.engine_name().is_double() { 1e-9 } else { 1e-6 };
    let mut table = Table::new(&["engine", "rates", "cells_across", "error_of_mean"]);
    for rates in RATES {
        for cells in CELLS {
            let dx = SI_WIDTH / f64::from(cells);
            let mut changes = vec![
                format!("domain.dx={dx:e}"),
                format!("domain.size=[{dx:e}, {SI_WIDTH:e}, {SI_WIDTH:e}]"),
                format!("stop.steady.tolerance={tolerance:e}"),
            ];
            changes.extend(preset_changes(rates));
            let run = bench.steady("duct/scene.toml", &changes)?;
            let means = run.engine.box_means();
            let mean = means.mass_flux.x / means.density * run.scene.units.si_velocity();
            table.add(vec![
                bench.engine_name().word().to_owned(),
                rates.word().to_owned(),
                cells.to_string(),
                format!("{:.6e}", mean / si_mean - 1.0),
            ]);
        }
    }
    Ok(table)
}

fn judge(_: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    for engine in rows.values("engine")? {
        let is_double = is_double(&engine);
        for rates in rows.values("rates")? {
            let own = rows.with(&[("engine", &engine), ("rates", &rates)])?;
            let errors = own.points("cells_across", "error_of_mean")?;
            let sizes: Vec<_> = errors.iter().map(|&(n, error)| (n, error.abs())).collect();
            claims.push(Claim {
                what: format!("{engine}: order of the error of the mean velocity, {rates}"),
                measured: -PowerLaw::fit(&sizes)?.order,
                allowed: 1.8..=2.1,
                why: "second order; at 8 cells the fourth-order term turns the slope by up to 0.15 (tests/oracle/duct.rs, whose \
                      finer grids come within 0.06)",
            });
            let [.., coarse, fine] = errors[..] else {
                return Err(CaseError::table("the duct needs two grids".to_owned()));
            };
            let ratio = (fine.0 / coarse.0).powi(2);
            claims.push(Claim {
                what: format!("{engine}: error of the mean velocity, extrapolated, {rates}"),
                measured: (ratio * fine.1 - coarse.1) / (ratio - 1.0),
                allowed: if is_double { -2e-4..=2e-4 } else { -4e-4..=4e-4 },
                why: "exact series; extrapolation leaves the next order, a few times 1/(12 x 16)^2 = 3e-5, and single \
                      precision 1e-4 of the velocity (the case poiseuille)",
            });
        }
    }
    Ok(claims)
}

fn draw(_: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let mut figure = Figure::new(
        "Square duct: error of the mean velocity against resolution",
        Axis::log("cells across").ticks(&CELLS.map(f64::from)),
        Axis::log("|relative error of the mean velocity|"),
    );
    for engine in rows.values("engine")? {
        for (colour, rates) in RATES.into_iter().enumerate() {
            let own = rows.with(&[("engine", &engine), ("rates", rates.word())])?;
            let errors = own.points("cells_across", "error_of_mean")?;
            let errors: Vec<_> = errors.into_iter().map(|(n, error)| (n, error.abs())).collect();
            let name = match rates {
                Preset::Trt => "Lambda = 3/16",
                Preset::DHumieres => "d'Humieres",
                Preset::Srt => "SRT",
            };
            if engine == EngineName::Reference.word() {
                let fit = PowerLaw::fit(&errors)?;
                let label = format!("{name}, {engine}: fit of order {:.2}", -fit.order);
                figure = figure.with(fit.series(label, (8.0, 16.0)).with_colour(colour));
            }
            figure = figure.with(found(name, &engine, errors, Some(colour)));
        }
    }
    Ok(vec![figure])
}
