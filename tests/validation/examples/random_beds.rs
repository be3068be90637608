//! The drag of the random beds of the trade-off study: `cargo run -p psmrt-validation --example random_beds`.
//!
//! No exact answer is known for spheres at random places. Their drag is taken from our own finest grids, where
//! the method errs by a percent or two, less what the errors' own form says of it: the velocity under a given
//! force is `U [1 + A (τ - 1/2)/d² + B/d^p]` with d cells per diameter (`src/advice/tradeoff/model.rs`), in which U, A
//! and B are free, and p = 2.85 as ordered arrays have it. Exponents 2 and 4 say how much hangs on that.
//! Writes `golden/tradeoff/random_drag.csv` anew; some minutes on a core.

use psmrt_reference::collision::Preset;
use std::error::Error;
use std::fmt::Write;
use std::path::Path;

use nalgebra::{DMatrix, DVector};
use psmrt_validation::tradeoff::measure::Runner;
use psmrt_validation::tradeoff::parameters::{Flow, Parameters};

const FILE: &str = "golden/tradeoff/random_drag.csv";
const GRIDS: [u32; 3] = [24, 32, 40];
const TAUS: [f64; 2] = [0.75, 1.0];

fn main() -> Result<(), Box<dyn Error>> {
    let mut text = "# Drag of eight spheres at random places (random.csv) over Stokes' drag, total force and superficial velocity:\n\
                    # cargo run -p psmrt-validation --example random_beds. By our own grids of 24, 32 and 40 cells at tau 0.75 and 1, the errors' own form\n\
                    # taken off; with exponents from 2 to 4 for the part that is not the leak K lies between low and high. law: van\n\
                    # der Hoef, Beetstra & Kuipers, J. Fluid Mech. 528, 233 (2005), for many spheres: eight in a box scatter about it.\n\
                    # left: what the fit leaves, root mean square.\n\
                    solid_fraction,K,low,high,left,law\n"
        .to_owned();
    let mut runner = Runner::new(Path::new("golden"), None)?;
    for fraction in ["0.2", "0.35", "0.45"] {
        let mut runs = Vec::new();
        for cells in GRIDS {
            for tau in TAUS {
                let parameters =
                    Parameters::new(Flow::Random, fraction, cells, tau, Preset::DHumieres);
                let row = runner.measure(&parameters)?;
                let d = parameters.cells_per_diameter().ok_or("spheres have a diameter")?;
                // Under a given force U goes with 1/K; the error is that against the drag of the file.
                let velocity = (1.0 + row.error.ok_or("it did not become steady")?) / row.drag;
                println!(
                    "{fraction} {cells} {tau}: K = {:.5}, {} steps",
                    1.0 / velocity,
                    row.steps
                );
                runs.push((d, tau, velocity));
            }
        }
        let (drag, left) = fitted(&runs, 2.85)?;
        let others = [fitted(&runs, 2.0)?.0, fitted(&runs, 4.0)?.0];
        let (low, high) = (others[0].min(others[1]).min(drag), others[0].max(others[1]).max(drag));
        writeln!(
            text,
            "{fraction},{drag:.5},{low:.5},{high:.5},{left:.1e},{:.3}",
            law(fraction.parse()?)
        )?;
    }
    std::fs::write(FILE, &text)?;
    println!("{text}");
    Ok(())
}

/// `K = 1/U` for endless resolution, and what the fit leaves of the velocities.
fn fitted(runs: &[(f64, f64, f64)], power: f64) -> Result<(f64, f64), Box<dyn Error>> {
    // U [1, (τ - 1/2)/d², 1/d^p] against what was measured: linear.
    let rows = DMatrix::from_fn(runs.len(), 3, |i, j| {
        let (d, tau, _) = runs[i];
        [1.0, (tau - 0.5) / (d * d), d.powf(-power)][j]
    });
    let measured = DVector::from_fn(runs.len(), |i, _| runs[i].2);
    let normal = rows.transpose() * &rows;
    let found =
        normal.lu().solve(&(rows.transpose() * &measured)).ok_or("the grids are too alike")?;
    let left = (rows * &found - measured).norm() / (runs.len() as f64).sqrt();
    Ok((1.0 / found[0], left / found[0]))
}

/// `K = [10 φ/(1 - φ)² + (1 - φ)² (1 + 1.5 √φ)]/(1 - φ)`
fn law(fraction: f64) -> f64 {
    let void = 1.0 - fraction;
    (10.0 * fraction / void.powi(2) + void.powi(2) * (1.0 + 1.5 * fraction.sqrt())) / void
}
