//! One run through a bed of spheres: a scene of `golden/permeability/`, and the row that it makes.

use std::f64::consts::PI;

use crate::cases::{Bench, CaseError};
use psmrt::output::records::{box_row, seepage_now};
use psmrt::scene::What;
use psmrt::seepage::permeability::BESIDE;
use psmrt::table::Table;

/// The axes.
pub const NAMES: [&str; 3] = ["x", "y", "z"];

/// A periodic piece of a bed of equal spheres on a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BedOfSpheres {
    /// `SC`, `BCC`, `FCC` or `random`.
    pub packing: &'static str,
    /// Solid fraction that is asked for.
    pub fraction: f64,
    /// Edge of the cube of a random bed, diameters.
    pub side: f64,
    /// Seed of a random bed.
    pub seed: u32,
    /// Cells along the edge of the cube.
    pub side_cells: u32,
}

/// The unit cell of a simple cubic array.
pub const ARRAY: BedOfSpheres =
    BedOfSpheres { packing: "SC", fraction: 0.343, side: 0.0, seed: 0, side_cells: 12 };

/// Eight spheres at random in a cube of two diameters.
pub const RANDOM: BedOfSpheres =
    BedOfSpheres { packing: "random", fraction: 0.53, side: 2.0, seed: 1, side_cells: 16 };

/// Edge of the unit cell, and diameter of the spheres of a random bed, m; size of the body force of each, m/s2.
const SI_CELL: f64 = 240e-6;
const SI_DIAMETER: f64 = 2e-4;
const SI_FORCE: [f64; 2] = [0.1, 0.5];

impl BedOfSpheres {
    /// The columns of [`Self::row`].
    pub const COLUMNS: [&'static str; 17] = [
        "engine",
        "packing",
        "seed",
        "side_cells",
        "axis",
        "solid_fraction",
        "porosity",
        "cells_per_diameter",
        "kx",
        "ky",
        "kz",
        "Re",
        "kozeny_carman",
        "beetstra",
        "tang",
        "steps",
        "cell_updates",
    ];

    /// The start of its row, which tells it from all others.
    pub fn start(&self, engine: &str, axis: usize) -> Vec<String> {
        vec![
            engine.to_owned(),
            self.packing.to_owned(),
            self.seed.to_string(),
            self.side_cells.to_string(),
            NAMES[axis].to_owned(),
            self.fraction.to_string(),
        ]
    }

    fn is_random(&self) -> bool {
        self.packing == "random"
    }

    /// Runs it along an axis until k is steady. Errors if it does not become so.
    pub fn row(&self, bench: &mut Bench, axis: usize) -> Result<Vec<String>, CaseError> {
        let edge = if self.is_random() { self.side * SI_DIAMETER } else { SI_CELL };
        let size = SI_FORCE[usize::from(self.is_random())];
        let force = [0, 1, 2].map(|other| if other == axis { size } else { 0.0 });
        let n = self.side_cells;
        let mut changes = vec![
            format!("domain.dx={:e}", edge / f64::from(n)),
            format!("body_force.acceleration={force:?}"),
            format!("records[0].axis=\"{}\"", NAMES[axis]),
            format!("grains[0].solid_fraction={}", self.fraction),
        ];
        // In single precision the mean velocity carries noise of some 1e-6.
        if !bench.engine_name().is_double() {
            changes.push("stop.steady.tolerance=1e-4".to_owned());
        }
        let scene = if self.is_random() {
            changes.push(format!("domain.size=[{edge:e}, {edge:e}, {edge:e}]"));
            changes.push(format!("grains[0].seed={}", self.seed));
            "permeability/random.toml"
        } else {
            changes.push(format!("domain.cells=[{n}, {n}, {n}]"));
            changes.push(format!("grains[0].lattice=\"{}\"", self.packing.to_lowercase()));
            "permeability/scene.toml"
        };
        let run = bench.steady(scene, &changes)?;
        let What::Permeability { axis, si_gravity } = run.scene.records[0].what else {
            return Err(CaseError::table("the scene has no record of permeability".to_owned()));
        };
        let found = seepage_now(&run.scene, &run.engine, (axis, si_gravity));
        let [_, x, y, z, _] = box_row(&run.scene, &run.engine);
        let square = found.si_diameter * found.si_diameter;
        let unit = found.si_density * found.si_viscosity / found.si_gradient / square;
        let laws = BESIDE.map(|law| format!("{:.6e}", found.si_by(&law) / square));
        let k = [x, y, z].map(|u| format!("{:.9e}", u * unit));
        let steps = run.engine.steps();
        let rest = [
            format!("{:.6}", found.porosity),
            format!("{:.4}", found.si_diameter / run.scene.units.si_dx),
        ];
        let end = [steps.to_string(), (steps * u64::from(n).pow(3)).to_string()];
        let re = [format!("{:.3e}", found.reynolds())];
        let start = self.start(bench.engine_name().word(), axis);
        Ok([&start[..], &rest, &k, &re, &laws, &end].concat())
    }
}

/// k/d2 of an array at a solid fraction of 0.343, from its exact drag.
pub fn exact(literature: &Table, packing: &str) -> Result<f64, CaseError> {
    let fraction = "0.343";
    let row = literature.with(&[("lattice", packing), ("solid_fraction_c", fraction)])?;
    let c: f64 = row.number("solid_fraction_c")?;
    // F = K 6π μ a U = (dP/L) (4/3) π a³/c,  so that k/d² = 1/(18 c K)
    let sphere = 4.0 / 3.0 * PI / 8.0;
    Ok(sphere / c / (6.0 * PI * 0.5 * row.number("K_computed")?))
}
