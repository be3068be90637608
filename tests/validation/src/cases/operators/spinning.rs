//! A sphere that spins in place in a periodic box: its torque.

use std::f64::consts::PI;
use std::path::Path;

use psmrt::engine::EngineName;
use psmrt::scene::preset_changes;
use psmrt_reference::collision::Preset;
use psmrt_reference::lattice::viscosity;

use super::set::{Set, begin};
use super::{OPERATORS, SI_VISCOSITY};
use crate::cases::{Bench, CaseError, Study};

/// Edge of a cell, m.
const SI_DX: f64 = 1e-5;

/// Reynolds number of the surface, `omega a²/nu`: inertia enters as its square.
const REYNOLDS: f64 = 0.01;

/// Where the sphere stands off the symmetry of the grid, cells.
const OFF: [f64; 3] = [0.31, 0.23, 0.11];

pub(super) const SET: Set = Set {
    name: "spinning",
    about: &[
        "Torque on a sphere that spins about z in a periodic cube two diameters wide (golden/operators/spinning.toml),",
        "omega a^2/nu = 0.01, its centre off the symmetry of the grid by (0.31, 0.23, 0.11) cells. error: of the torque",
        "against -8 pi mu a^3 omega/(1 - phi), phi = pi/48, the theory of a simple cubic array, exact to 1e-4",
        "(tests/oracle/torque.rs); across: the largest torque about another axis, over that; 12 times as many steps as the",
        "slowest shear takes to fall to 1/e.",
    ],
    make,
};

const COLUMNS: [&str; 9] = [
    "operator",
    "engine",
    "collision",
    "cells_per_diameter",
    "tau",
    "error",
    "across",
    "steps",
    "cell_updates",
];

fn make(golden: &Path, file: &Path, tell: &dyn Fn(&str)) -> Result<(), CaseError> {
    begin(&SET, file, &COLUMNS)?;
    let study = Study::new(file);
    let mut bench = Bench::new(golden, EngineName::Cpu, None, |_| {});
    for cells in [8_u32, 12, 16] {
        for (collision, tau) in [0.55, 0.6, 0.8, 1.0, 1.5]
            .map(|tau| (Preset::DHumieres, tau))
            .into_iter()
            .chain([0.6, 1.0].map(|tau| (Preset::Srt, tau)))
        {
            for operator in OPERATORS {
                let engine = EngineName::Cpu.word();
                let start = format!("{operator},{engine},{},{cells},{tau},", collision.word());
                if study.row(&start)?.is_some() {
                    continue;
                }
                let row = start + &row(&mut bench, operator, collision, cells, tau)?;
                study.add(&row)?;
                tell(&row);
            }
        }
    }
    Ok(())
}

/// The columns after the first five.
fn row(
    bench: &mut Bench,
    operator: &str,
    collision: Preset,
    cells: u32,
    tau: f64,
) -> Result<String, CaseError> {
    let (nu, a, side) = (viscosity(tau), 0.5 * f64::from(cells), 2 * cells);
    let omega = REYNOLDS * nu / (a * a);
    let si_dt = nu * SI_DX * SI_DX / SI_VISCOSITY;
    // The slowest shear falls to 1/e in (L/2π)²/ν.
    let steps = (12.0 * (f64::from(side) / (2.0 * PI)).powi(2) / nu).ceil();
    let [x, y, z] = OFF.map(|off| (f64::from(cells) + off) * SI_DX);
    let mut changes = vec![
        format!("domain.cells=[{side}, {side}, {side}]"),
        format!("domain.dx={SI_DX:e}"),
        format!("time.tau={tau}"),
        format!("solid.operator=\"{operator}\""),
        format!("grains[0].centre=[{x:e}, {y:e}, {z:e}]"),
        format!("grains[0].diameter={:e}", f64::from(cells) * SI_DX),
        format!("grains[0].spin=[0.0, 0.0, {:e}]", omega / si_dt),
        format!("stop.steps={steps}"),
    ];
    changes.extend(preset_changes(collision));
    let before = bench.cell_updates();
    let (run, _) = bench.run("operators/spinning.toml", &changes)?;
    let torque = run.engine.loads()[0].torque;
    let phi = PI / 48.0;
    let theory = -8.0 * PI * nu * a.powi(3) * omega / (1.0 - phi);
    let across = torque.x.abs().max(torque.y.abs()) / theory.abs();
    let (made, steps) = (bench.cell_updates() - before, run.engine.steps());
    Ok(format!("{:.6},{across:.2e},{steps},{made}", torque.z / theory - 1.0))
}
