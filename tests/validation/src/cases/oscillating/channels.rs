//! Flow between plates and in a square duct under a force that oscillates.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Complex;

use super::harmonic::amplitude;
use super::womersley::Oscillation;
use crate::cases::{Bench, CaseError, Claim};
use psmrt::table::Table;

/// Half the width times the root of omega/nu.
pub const WOMERSLEY: [f64; 3] = [2.0, 5.0, 10.0];

/// The flows and how many axes walls stand across.
pub const FLOWS: [(&str, f64); 2] = [("plates", 1.0), ("duct", 2.0)];

/// Cells across.
pub const CELLS: [usize; 2] = [16, 32];

/// Width, m, and viscosity, m2/s, of the scenes.
const SI_WIDTH: f64 = 1e-3;
const SI_VISCOSITY: f64 = 1e-6;

/// Least length of a run in periods, of which the last is measured: of what the start from rest adds only the slowest wave is left
/// then, and fitted.
const PERIODS: f64 = 2.5;

pub(super) fn measure(bench: &mut Bench, table: &mut Table) -> Result<(), CaseError> {
    for (flow, _) in FLOWS {
        for womersley in WOMERSLEY {
            for cells in CELLS {
                for (place, velocity) in profile(bench, flow, womersley, cells)? {
                    table.add(vec![
                        bench.engine_name().word().to_owned(),
                        flow.to_owned(),
                        womersley.to_string(),
                        cells.to_string(),
                        format!("{place:.6}"),
                        format!("{:.6e}", velocity.re),
                        format!("{:.6e}", velocity.im),
                    ]);
                }
            }
        }
    }
    Ok(())
}

/// The amplitude of the velocity over `G/ω` at each node from a wall to the middle.
fn profile(
    bench: &mut Bench,
    flow: &str,
    womersley: f64,
    cells: usize,
) -> Result<Vec<(f64, Complex<f64>)>, CaseError> {
    let n = cells as f64;
    let si_omega = SI_VISCOSITY * (2.0 * womersley / SI_WIDTH).powi(2);
    let si_period = TAU / si_omega;
    let axes = if flow == "duct" { 2.0 } else { 1.0 };
    // Of the start, the slowest wave across: exp(-π² ν t/width²), twice as fast with walls along two axes.
    let si_decay = axes * SI_VISCOSITY * (PI / SI_WIDTH).powi(2);
    // So that velocities are alike, some 1e-3 m/s, which single precision resolves.
    let si_force = 2.5e-3 * womersley * womersley;
    let dx = SI_WIDTH / n;
    let steps = (si_period * SI_VISCOSITY / (0.1 * dx * dx)).max(32.0);
    let across = if flow == "duct" { cells } else { 1 };
    // At higher numbers the start has the more periods to decay in.
    let periods = PERIODS.max(0.25 * womersley * womersley);
    let changes = [
        format!("domain.dx={dx:e}"),
        format!("domain.cells=[1, {cells}, {across}]"),
        format!(
            "body_force.acceleration={{ amplitude = [{si_force:e}, 0.0, 0.0], period = {si_period:e}, phase = {FRAC_PI_2} }}"
        ),
        format!("records[0].every_steps={}", (steps / 32.0).floor()),
        format!("stop.time={:e}", periods * si_period),
    ];
    let (run, _) = bench.run(&format!("oscillating/{flow}.toml"), &changes)?;
    let record = run.record("profile")?;
    let [times, places, velocities] =
        ["time (s)", "position (m)", "velocity_x (m/s)"].map(|name| record.numbers(name));
    let (times, places, velocities) = (times?, places?, velocities?);
    (0..cells / 2)
        .map(|node| {
            let own = (node..times.len()).step_by(cells);
            let last = own.filter(|&row| times[row] > (periods - 1.0) * si_period);
            let samples = last.map(|row| (times[row], velocities[row]));
            let velocity = amplitude(samples, si_omega, Some(si_decay))? * (si_omega / si_force);
            Ok((places[node] / SI_WIDTH, velocity))
        })
        .collect()
}

/// The exact amplitude over `G/ω` at a distance from a wall, lengths over the width; in a duct half-way between the sides, or as far from
/// there as the two nearest nodes, `off`.
pub fn exact(flow: &str, womersley: f64, place: f64, off: f64) -> Complex<f64> {
    let flow_of = Oscillation { nu: 1.0, omega: (2.0 * womersley).powi(2) };
    let velocity = if flow == "duct" {
        flow_of.in_square_duct(1.0, 1.0, &[place, 0.5 - off])[2]
    } else {
        flow_of.between_plates(1.0, 1.0, place)
    };
    velocity * flow_of.omega
}

/// What was measured: distance from the wall over the width, and the amplitude.
pub fn measured(
    rows: &Table,
    engine: &str,
    flow: &str,
    womersley: f64,
    cells: usize,
) -> Result<Vec<(f64, Complex<f64>)>, CaseError> {
    let (womersley, cells) = (womersley.to_string(), cells.to_string());
    let own = rows.with(&[
        ("engine", engine),
        ("flow", flow),
        ("womersley", &womersley),
        ("cells", &cells),
    ])?;
    let [places, re, im] = ["y_over_width", "re", "im"].map(|name| own.numbers(name));
    let (places, re, im) = (places?, re?, im?);
    let amplitudes = re.into_iter().zip(im).map(|(re, im)| Complex::new(re, im));
    Ok(places.into_iter().zip(amplitudes).collect())
}

/// Largest error of the amplitude over the largest exact one.
pub fn error(
    rows: &Table,
    engine: &str,
    flow: &str,
    womersley: f64,
    cells: usize,
) -> Result<f64, CaseError> {
    let (mut error, mut largest) = (0.0_f64, 0.0_f64);
    for (place, amplitude) in measured(rows, engine, flow, womersley, cells)? {
        let exact = exact(flow, womersley, place, 0.5 / cells as f64);
        error = error.max((amplitude - exact).norm());
        largest = largest.max(exact.norm());
    }
    Ok(error / largest)
}

pub(super) fn claims(rows: &Table, engine: &str) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    for (flow, axes) in FLOWS {
        for womersley in WOMERSLEY {
            let [coarse, fine] = CELLS.map(|cells| error(rows, engine, flow, womersley, cells));
            let (coarse, fine) = (coarse?, fine?);
            // Root of omega/nu times the edge of a cell, and times what of the width the wave crosses before it is gone.
            let wave = 2.0 * womersley / CELLS[1] as f64;
            let crossed = (2.0 * womersley).min(4.0);
            claims.push(Claim {
                what: format!(
                    "{engine}: {flow}, Womersley's number {womersley}: largest error of the amplitude, {} cells across",
                    CELLS[1]
                ),
                measured: fine,
                allowed: 0.0..=(4.0 * axes * crossed * wave * wave / 24.0).min(0.02),
                why: "a second difference takes k (1 - (kh)²/24) for the wave number k; over the width, or the few 1/k in which the \
                      wave decays, that makes (kh)²/24 of the velocity for each 1/k and axis; three times as much for the \
                      collision's own terms of that order, as in tests/driven; 2 % at most, where that is coarse",
            });
            let (low, high) = if womersley > 5.0 { (1.5, 2.6) } else { (1.77, 2.23) };
            claims.push(Claim {
                what: format!("{engine}: {flow}, Womersley's number {womersley}: order of that error"),
                measured: (coarse / fine).log2(),
                allowed: low..=high,
                why: "second order, within a sixth of the ratio 4; at Womersley's number 10 the layer at the wall has 1.1 cells on the \
                      coarse grid, where the next order still counts",
            });
        }
    }
    Ok(claims)
}
