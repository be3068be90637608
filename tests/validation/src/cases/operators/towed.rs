//! How evenly a sphere moves through the cells: the force on one that is towed, the velocity of one that settles.

use std::f64::consts::PI;
use std::path::Path;

use psmrt::engine::EngineName;
use psmrt_reference::collision::Preset;
use psmrt_reference::lattice::viscosity;

use super::set::{Set, begin};
use super::{BOUNCE_BACK, FULL, OPERATORS, SI_VISCOSITY};
use crate::cases::{Bench, CaseError, Finished, Study};
use crate::tradeoff::parameters::{Flow, Parameters};
use crate::tradeoff::setting::{Literature, Setting};

/// Edge of a cell, m.
const SI_DX: f64 = 1e-5;

/// Reynolds number of what is towed, and of what settles by Stokes' law (walls divide it by 4.5).
const TOWED: f64 = 0.2;
const STOKES: f64 = 1.0;

/// Cells that are crossed while it is looked at, and rows in each crossing.
const CROSSINGS: usize = 4;
const ROWS: usize = 100;

/// Half the width of the shaft over the diameter, as the literature spells the inverse of twice that; its height.
const SHAFT: &str = "0.5";
const HEIGHT: u32 = 8;

pub(super) const SET: Set = Set {
    name: "towed",
    about: &[
        "How evenly a sphere goes through the cells. way axis: towed along the axis of a closed square shaft two diameters",
        "wide and 8 high (golden/operators/towed.toml, a quarter of it), Re = 0.2; diagonal: along x = y in a closed box of",
        "4 x 4 x 4 diameters (half of it), Re = 0.2 along each; free: it settles in that shaft (golden/tradeoff/settling.toml),",
        "Re = 1/K by Stokes' law and the walls. error: of the drag, against K = 4.53703 (golden/stokes_settling/literature.csv;",
        "of a free one the inverse of its velocity's), no exact value is known in the box. uneven: root mean square of the force",
        "(free: of the velocity) less its running mean over one cell's crossing, over that mean; 4 crossings. jump: the largest",
        "change from one row to the next, 100 rows a crossing, over the mean.",
    ],
    make,
};

const COLUMNS: [&str; 10] = [
    "way",
    "operator",
    "engine",
    "cells_per_diameter",
    "tau",
    "error",
    "uneven",
    "jump",
    "steps",
    "cell_updates",
];

fn make(golden: &Path, file: &Path, tell: &dyn Fn(&str)) -> Result<(), CaseError> {
    begin(&SET, file, &COLUMNS)?;
    let study = Study::new(file);
    let mut bench = Bench::new(golden, EngineName::Cpu, None, |_| {});
    let literature = Literature::of(&bench)?;
    for (way, operator, cells, tau) in runs() {
        let start = format!("{},{operator},{},{cells},{tau},", way.word(), EngineName::Cpu.word());
        if study.row(&start)?.is_some() {
            continue;
        }
        let before = bench.cell_updates();
        let (found, steps) = match way {
            Way::Free => settles(&mut bench, &literature, operator, cells, tau)?,
            Way::Axis | Way::Diagonal => {
                towed(&mut bench, &literature, (way, operator), cells, tau)?
            }
        };
        let made = bench.cell_updates() - before;
        let error = found.error.map_or_else(String::new, |error| format!("{error:.6}"));
        let (uneven, jump) = (found.uneven, found.jump);
        let row = format!("{start}{error},{uneven:.3e},{jump:.3e},{steps},{made}");
        study.add(&row)?;
        tell(&row);
    }
    Ok(())
}

/// Which way the sphere goes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    Axis,
    Diagonal,
    Free,
}

impl Way {
    fn word(self) -> &'static str {
        match self {
            Way::Axis => "axis",
            Way::Diagonal => "diagonal",
            Way::Free => "free",
        }
    }
}

fn runs() -> Vec<(Way, &'static str, u32, f64)> {
    let mut runs = Vec::new();
    let mut add = |way, operators: &[&'static str], all: &[u32], taus: &[f64]| {
        for &cells in all {
            for &tau in taus {
                runs.extend(operators.iter().map(|&operator| (way, operator, cells, tau)));
            }
        }
    };
    add(Way::Axis, &OPERATORS, &[6, 8, 12], &[0.55, 0.6, 0.8, 1.0, 1.5]);
    add(Way::Free, &[BOUNCE_BACK, FULL], &[4, 6, 8], &[0.55, 0.6, 0.8, 1.0]);
    add(Way::Diagonal, &OPERATORS, &[6], &[0.6, 0.8, 1.0]);
    runs
}

/// What a course shows.
struct Course {
    error: Option<f64>,
    uneven: f64,
    jump: f64,
    mean: f64,
}

impl Course {
    /// Of values with [`ROWS`] rows in a crossing, the last [`CROSSINGS`] of which count.
    fn of(values: &[f64]) -> Result<Self, CaseError> {
        // Half a crossing more on either side, for the running mean.
        let wanted = (CROSSINGS + 1) * ROWS + 1;
        let Some(first) = values.len().checked_sub(wanted) else {
            return Err(CaseError::table(format!("{} rows of {wanted}", values.len())));
        };
        let values = &values[first..];
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        // Both ends of a crossing are the same place: each counts by half.
        let running = values.windows(ROWS + 1).map(|crossing| {
            let ends = 0.5 * (crossing[0] + crossing[ROWS]);
            (crossing.iter().sum::<f64>() - ends) / ROWS as f64
        });
        let middle = &values[ROWS / 2..values.len() - ROWS / 2];
        let squares: f64 = middle.iter().zip(running).map(|(v, mean)| (v - mean).powi(2)).sum();
        let uneven = (squares / middle.len() as f64).sqrt() / mean.abs();
        let jump = middle.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
        Ok(Course { error: None, uneven, jump: jump / mean.abs(), mean })
    }
}

/// The steps for the flow to form: the slowest shear in a square of half width `half` dies to exp(-8), sound runs
/// to and fro six times.
fn start_up(half: f64, height: f64, nu: f64) -> f64 {
    // 2 (π/(2 b))² ν
    let shear = 8.0 * 2.0 * half * half / (PI * PI * nu);
    shear.max(12.0 * height * 3.0_f64.sqrt())
}

fn towed(
    bench: &mut Bench,
    literature: &Literature,
    (way, operator): (Way, &str),
    cells: u32,
    tau: f64,
) -> Result<(Course, u64), CaseError> {
    let (nu, d) = (viscosity(tau), f64::from(cells));
    // Whole rows in a crossing: V = 1/(every ROWS).
    let every = (d / (TOWED * nu * ROWS as f64)).round().max(1.0);
    let crossing = every * ROWS as f64;
    let (size, half, height) = match way {
        Way::Diagonal => ([4 * cells, 4 * cells, 2 * cells], 2.0 * d, 4.0 * d),
        Way::Axis | Way::Free => ([cells, cells, HEIGHT * cells], d, f64::from(HEIGHT) * d),
    };
    // In the box there is room for less; the running mean takes off what is left, exp(-3).
    let share = if way == Way::Diagonal { 0.4 } else { 1.0 };
    let wait = (share * start_up(half, height, nu) / crossing).ceil().max(1.0);
    let steps = crossing * (wait + (CROSSINGS + 1) as f64);
    // What counts is symmetric about the middle, but for the part of a cell that keeps it off the nodes.
    let back = wait + 0.5 * (CROSSINGS + 1) as f64 - 0.3;
    let velocity = SI_DX / (crossing * nu * SI_DX * SI_DX / SI_VISCOSITY);
    let (centre, velocity) = match way {
        Way::Diagonal => ([2.0 * d - back, 2.0 * d - back, 0.0], [velocity, velocity, 0.0]),
        Way::Axis | Way::Free => ([0.0, 0.0, 0.5 * height - back], [0.0, 0.0, velocity]),
    };
    let triple = |values: [f64; 3], scale: f64| {
        let [x, y, z] = values.map(|value| value * scale);
        format!("[{x:e}, {y:e}, {z:e}]")
    };
    let mut changes = vec![
        format!("domain.cells={size:?}"),
        format!("domain.dx={SI_DX:e}"),
        format!("time.tau={tau}"),
        format!("solid.operator=\"{operator}\""),
        format!("grains[0].centre={}", triple(centre, SI_DX)),
        format!("grains[0].diameter={:e}", d * SI_DX),
        format!("grains[0].velocity={}", triple(velocity, 1.0)),
        format!("records[0].every_steps={every}"),
        format!("stop.steps={steps}"),
    ];
    if way == Way::Diagonal {
        changes.extend(["x_low", "y_low"].map(|face| format!("faces.{face}.kind=\"wall\"")));
        changes.push("faces.z_low.kind=\"free_slip\"".to_owned());
    }
    let (run, _) = bench.run("operators/towed.toml", &changes)?;
    let column = if way == Way::Diagonal { "force_x (N)" } else { "force_z (N)" };
    let mut found = Course::of(&column_of(&run, column)?)?;
    if way == Way::Axis {
        let shaft = [("section", "square"), ("a_over_halfwidth", SHAFT)];
        let exact = literature.shafts.with(&shaft)?.number("K1_translating_in_still_fluid")?;
        // F = 6π μ a V K; a quarter of the sphere is there.
        let si_stokes = 3.0 * PI * 1000.0 * SI_VISCOSITY * d * SI_DX * velocity[2];
        found.error = Some(4.0 * -found.mean / (si_stokes * exact) - 1.0);
    }
    Ok((found, run.engine.steps()))
}

fn settles(
    bench: &mut Bench,
    literature: &Literature,
    operator: &str,
    cells: u32,
    tau: f64,
) -> Result<(Course, u64), CaseError> {
    let (nu, d) = (viscosity(tau), f64::from(cells));
    let mut parameters = Parameters::new(Flow::Settling, SHAFT, cells, tau, Preset::DHumieres);
    operator.clone_into(&mut parameters.operator);
    parameters.lattice_velocity = STOKES * nu / d;
    let Setting { scene, mut changes, drag } = Setting::new(&parameters, literature)?;
    let velocity = parameters.lattice_velocity / drag;
    let every = (1.0 / (velocity * ROWS as f64)).round().max(1.0);
    let wait = start_up(d, f64::from(HEIGHT) * d, nu);
    let rows = (wait / every).ceil() + ((CROSSINGS + 1) * ROWS) as f64;
    let own = ["records[0].every_steps=", "stop.steps=", "grains[0].centre="];
    changes.retain(|change| !own.iter().any(|key| change.starts_with(key)));
    // Two diameters below the lid: what is fastest, on the coarsest grid, needs 5 of the 8 diameters.
    let si_dx = changes.iter().find_map(|change| change.strip_prefix("domain.dx="));
    let si_dx: f64 = si_dx.and_then(|text| text.parse().ok()).unwrap_or(f64::NAN);
    let z = (f64::from(HEIGHT - 2) * d + 0.3) * si_dx;
    changes.push(format!("grains[0].centre=[0.0, 0.0, {z:e}]"));
    changes.push(format!("records[0].every_steps={every}"));
    changes.push(format!("stop.steps={}", every * rows));
    let (run, _) = bench.run(&scene, &changes)?;
    let mut found = Course::of(&column_of(&run, "velocity_z (m/s)")?)?;
    let si_exact = velocity * run.scene.units.si_dx / run.scene.units.si_dt;
    found.error = Some(si_exact / -found.mean - 1.0);
    Ok((found, run.engine.steps()))
}

/// A column of the record of loads, or of the grain, whichever the scene has.
fn column_of(run: &Finished, column: &str) -> Result<Vec<f64>, CaseError> {
    Ok(run.record(&run.scene.records[0].name)?.numbers(column)?)
}

#[cfg(test)]
mod tests {
    use super::{CROSSINGS, Course, ROWS};
    use std::f64::consts::PI;

    #[test]
    fn a_wave_with_the_period_of_the_cells_is_found_and_a_drift_is_not() {
        let value = |i: usize| {
            let cells = i as f64 / ROWS as f64;
            -2.0 - 0.1 * cells + 0.02 * (2.0 * PI * cells).sin()
        };
        let values: Vec<f64> = (0..(CROSSINGS + 3) * ROWS).map(value).collect();
        let found = Course::of(&values).unwrap();
        // 0.02/√2 over the mean, which lies in the middle of what counts: at 4.5 cells, -2.45.
        let expected = 0.02 / 2.0_f64.sqrt() / 2.45;
        assert!(
            (found.uneven / expected - 1.0).abs() < 0.01,
            "{} instead of {expected}",
            found.uneven
        );
        assert!(Course::of(&values[..100]).is_err(), "too few rows");
    }
}
