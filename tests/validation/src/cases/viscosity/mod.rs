//! The viscosity of water with a sphere in it, by the shear stress on two walls that move against each other.

use std::f64::consts::PI;

use psmrt_report::{Axis, Figure, Series};

use super::found::found;
use super::{Bench, Case, CaseError, Claim, Golden};
use psmrt::table::{Table, TableError};

/// A sheared suspension.
pub const CASE: Case = Case {
    name: "viscosity",
    title: "A sphere thickens sheared water as Einstein derived",
    about: &[
        "A neutrally buoyant sphere, free to move and to turn, half-way between two walls that move against each other, in a periodic \
         cube. The shear stress on the walls over the shear rate is the viscosity eta of the mixture; that of water alone is eta_0. The \
         intrinsic viscosity (eta/eta_0 - 1)/c, c the solid fraction, is 5/2 for a sphere alone (Einstein 1906, 1911).",
        "Walls and images of the sphere add a part that falls with the volume of the cube, so the value for a sphere alone is that of a \
         straight line through two cubes at c = 0. Re = (shear rate) d2/nu = 0.05, at which inertia adds less than 1 %.",
        "With full bounce-back the value does not come closer to 5/2 on finer grids (+0.3, +1.3 and +1.5 % on 8, 12 and 16 cells at tau = 1, \
         +3.2 % at tau = 0.6 on 8 and 12): what is left may be the next order of the images' influence, which two cubes do not show, or the \
         size of the sphere that the operator makes.",
        "What the sphere adds to the stress is its stresslet. So the case tests, through a balance of momentum, how the grid sees a \
         sphere that is strained, as drag and torque test one that is pushed and turned.",
    ],
    scenes: &["scene.toml"],
    literature: &["literature.csv"],
    rows: "expected.csv",
    studies: &["study.csv"],
    units: "solid_fraction, intrinsic_viscosity and imbalance (of the forces on the two walls, over the larger) without units; cells \
            along each edge of the cube",
    full: "cargo run --release -p psmrt-validation --example viscosity_study",
    measure,
    judge,
    draw,
};

/// Cells across the sphere of the scene.
const CELLS_PER_DIAMETER: usize = 8;

/// A sheared sphere in a cube: what a run of the scene is changed to.
#[derive(Clone, Copy, Debug)]
pub struct ShearedSphere {
    /// The operator of the solid, as scenes spell it.
    pub operator: &'static str,
    /// Relaxation time.
    pub tau: f64,
    /// Cells across the sphere.
    pub diameter: usize,
    /// Cells along each edge of the cube.
    pub cells: usize,
}

/// What a run has shown.
#[derive(Clone, Copy, Debug)]
pub struct Sheared {
    /// Volume of the sphere over that of the cube.
    pub solid_fraction: f64,
    /// `(η/η₀ - 1)/c`.
    pub intrinsic_viscosity: f64,
    /// Sum of the forces on the two walls along the shear, over the larger.
    pub imbalance: f64,
}

impl ShearedSphere {
    /// That of the scene in a cube of so many cells.
    pub fn of_scene(cells: usize) -> Self {
        ShearedSphere { operator: "bounce_back", tau: 1.0, diameter: CELLS_PER_DIAMETER, cells }
    }

    /// Runs the scene with these changes. The diameter, the water and the Reynolds number stay.
    pub fn run(&self, bench: &mut Bench) -> Result<Sheared, CaseError> {
        let (cells, diameter) = (self.cells as f64, self.diameter as f64);
        let (si_diameter, si_rate, si_nu) = (8e-5, 7.8125, 1e-6);
        let si_dx = si_diameter / diameter;
        let (si_edge, nu) = (cells * si_dx, (self.tau - 0.5) / 3.0);
        let (wall, centre) = (0.5 * si_rate * si_edge, 0.5 * si_edge);
        // Six times that in which the slowest part of the flow decays by e.
        let steps = (6.0 * cells * cells / (PI * PI * nu)).round();
        let changes = [
            format!("domain.cells=[{0}, {0}, {0}]", self.cells),
            format!("domain.dx={si_dx:e}"),
            format!("time.tau={:?}", self.tau),
            format!("faces.z_low.velocity=[{:e}, 0.0, 0.0]", -wall),
            format!("faces.z_high.velocity=[{wall:e}, 0.0, 0.0]"),
            format!("solid.operator=\"{}\"", self.operator),
            format!("grains[0].centre=[{centre:e}, {centre:e}, {centre:e}]"),
            format!("stop.steps={steps}"),
        ];
        let (run, _) = bench.run("viscosity/scene.toml", &changes)?;
        let walls = run.record("walls")?;
        // A mean over the last half-dozen rows: the force on a wall goes to and fro a little as the sphere moves over the grid.
        let force = |face: &str| -> Result<f64, TableError> {
            let forces = walls.with(&[("face", face)])?.numbers("fluid_force_x (N)")?;
            let last = &forces[forces.len().saturating_sub(6)..];
            Ok(last.iter().sum::<f64>() / last.len() as f64)
        };
        let (low, high) = (force("z_low")?, force("z_high")?);
        // η/η₀ = τ/(η₀ γ̇)
        let stress = 0.5 * (low - high) / si_edge.powi(2);
        let relative = stress / (run.scene.units.si_density * si_nu * si_rate);
        let solid_fraction = PI / 6.0 * (diameter / cells).powi(3);
        Ok(Sheared {
            solid_fraction,
            intrinsic_viscosity: (relative - 1.0) / solid_fraction,
            imbalance: (low + high).abs() / low.abs().max(high.abs()),
        })
    }
}

/// Edges of the cubes of the quick form, cells.
const CUBES: [usize; 2] = [20, 28];

fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    let mut table =
        Table::new(&["engine", "cells", "solid_fraction", "intrinsic_viscosity", "imbalance"]);
    for cells in CUBES {
        let found = ShearedSphere::of_scene(cells).run(bench)?;
        table.add(vec![
            bench.engine_name().word().to_owned(),
            cells.to_string(),
            format!("{:.6}", found.solid_fraction),
            format!("{:.5}", found.intrinsic_viscosity),
            format!("{:.1e}", found.imbalance),
        ]);
    }
    Ok(table)
}

/// The value at c = 0 of the straight line through the first and the last point.
fn alone(rows: &Table) -> Result<f64, TableError> {
    let points = rows.points("solid_fraction", "intrinsic_viscosity")?;
    let (Some((c1, v1)), Some((c2, v2))) = (points.first(), points.last()) else {
        return Err(TableError("there are no cubes".to_owned()));
    };
    Ok((v2 * c1 - v1 * c2) / (c1 - c2))
}

/// The rows of the study with an operator, tau and grid.
fn of_study(study: &Table, kind: &[String; 3]) -> Result<Table, TableError> {
    study.with(&[("operator", &kind[0]), ("tau", &kind[1]), ("cells_per_diameter", &kind[2])])
}

/// The kinds of runs of the study: operator, tau, cells per diameter.
fn kinds(study: &Table) -> Result<Vec<[String; 3]>, TableError> {
    let mut kinds = Vec::new();
    for operator in study.values("operator")? {
        let own = study.with(&[("operator", &operator)])?;
        for tau in own.values("tau")? {
            for grid in own.with(&[("tau", &tau)])?.values("cells_per_diameter")? {
                kinds.push([operator.clone(), tau.clone(), grid]);
            }
        }
    }
    Ok(kinds)
}

/// The intrinsic viscosity of a sphere alone, from each pair of cubes of the study: the kind of run (operator, tau, cells),
/// cells across the sphere, and the value. Errors if the study lacks a cube.
pub fn of_a_sphere_alone(study: &Table) -> Result<Vec<([String; 3], f64, f64)>, CaseError> {
    let of_kind = |kind: [String; 3]| {
        let own = of_study(study, &kind)?;
        let cells = own.numbers("cells_per_diameter")?.first().copied().unwrap_or(f64::NAN);
        let value = alone(&own)?;
        Ok((kind, cells, value))
    };
    kinds(study)?.into_iter().map(of_kind).collect()
}

fn judge(golden: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let einstein = golden.table("literature.csv")?.number("intrinsic_viscosity")?;
    let mut claims = Vec::new();
    for engine in rows.values("engine")? {
        let own = rows.with(&[("engine", &engine)])?;
        claims.push(Claim {
            what: format!("{engine}: intrinsic viscosity of a sphere alone, over Einstein's 5/2"),
            measured: alone(&own)? / einstein,
            allowed: 0.9..=1.1,
            why: "at 8 cells per diameter the grid sees a radius that is off by up to 3 %, and the stresslet goes with its cube",
        });
        claims.push(Claim {
            what: format!("{engine}: forces on the two walls that do not cancel, over one of them"),
            measured: own.numbers("imbalance")?.into_iter().fold(0.0, f64::max),
            allowed: 0.0..=1e-3,
            why: "in a steady mean flow nothing but the walls acts along the shear",
        });
    }
    let study = golden.table("study.csv")?;
    for kind in kinds(&study)? {
        let [operator, tau, grid] = &kind;
        let cells: f64 = grid.parse().unwrap_or(f64::NAN);
        let allowed = 0.8 / cells;
        claims.push(Claim {
            what: format!("study: {operator}, tau {tau}, {grid} cells per diameter, over Einstein's 5/2"),
            measured: alone(&of_study(&study, &kind)?)? / einstein,
            allowed: 1.0 - allowed..=1.0 + allowed,
            why: "10 % at 8 cells per diameter, as in the quick form, and in proportion to the cell",
        });
    }
    Ok(claims)
}

fn draw(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let einstein = golden.table("literature.csv")?.number("intrinsic_viscosity")?;
    let mut figure = Figure::new(
        "What a sphere adds to the viscosity, in cubes of several sizes",
        Axis::linear("solid fraction c").range(0.0, 0.036),
        Axis::linear("(eta/eta_0 - 1)/c").range(2.2, 3.0),
    )
    .with(Series::dashed(
        "Einstein, a sphere alone: 5/2",
        vec![(0.0, einstein), (0.036, einstein)],
    ));
    let study = golden.table("study.csv")?;
    for kind in kinds(&study)? {
        let own = of_study(&study, &kind)?;
        let mut points = own.points("solid_fraction", "intrinsic_viscosity")?;
        points.push((0.0, alone(&own)?));
        let [operator, tau, grid] = kind;
        figure =
            figure.with(Series::line(format!("{operator}, tau {tau}, {grid} cells/d"), points));
    }
    for engine in rows.values("engine")? {
        let own = rows.with(&[("engine", &engine)])?;
        let points = own.points("solid_fraction", "intrinsic_viscosity")?;
        figure = figure.with(found("", &engine, points, None));
    }
    Ok(vec![figure.note(
        "lines: the study, carried on to c = 0; marks: the quick form (bounce_back, tau 1, 8 cells per diameter)",
    )])
}
