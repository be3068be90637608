//! One run of a bed that is fluidized: a row for each level at which the velocity below is held.

use crate::cases::{Bench, CaseError};
use psmrt::in_time::FaceSignal;
use psmrt::scene::Scene;
use psmrt::table::Table;
use psmrt_reference::lattice::viscosity;

/// A run of the study: grains on a sieve, the velocity below raised from level to level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FluidizedBed {
    /// Its name in the table.
    pub name: &'static str,
    /// Diameter, mm.
    pub diameter_mm: f64,
    /// Cells across a grain.
    pub cells: u32,
    /// Height of the domain, diameters; it is five wide.
    pub height: u32,
    /// Relaxation time.
    pub tau: f64,
    /// Seed of the bed.
    pub seed: u32,
    /// Superficial velocity, m/s, and for how many steps.
    pub levels: &'static [(f64, f64)],
}

/// Scene of the study, and width of its domain in diameters.
const SCENE: &str = "fluidization/bed.toml";
const WIDTH: u32 = 5;

/// From one level to the next the velocity rises over so many steps.
const RAMP: f64 = 50.0;

/// Of the time at a level, the share at its end that means are taken over.
const SHARE: f64 = 0.4;

/// Runs that make the study.
pub const RUNS: [FluidizedBed; 6] = [
    FluidizedBed { seed: 1, ..ONSET },
    FluidizedBed { name: "fine sand (other bed)", seed: 2, ..ONSET },
    FluidizedBed {
        name: "fine sand (finer grid)",
        cells: 12,
        levels: &[(0.0, 900.0), (2e-4, 2700.0), (4e-4, 2700.0)],
        ..ONSET
    },
    FluidizedBed {
        name: "coarse sand",
        diameter_mm: 1.0,
        tau: 0.51,
        levels: &[(0.0, 300.0), (4e-3, 1500.0), (8e-3, 1500.0)],
        ..ONSET
    },
    FluidizedBed {
        name: "medium sand",
        diameter_mm: 0.5,
        height: 13,
        levels: &[
            (0.0, 300.0),
            (1.2e-3, 800.0),
            (2.4e-3, 800.0),
            (8e-3, 9000.0),
            (1.6e-2, 9000.0),
            (2.5e-2, 9000.0),
        ],
        ..ONSET
    },
    FluidizedBed {
        name: "fine sand (expanded)",
        height: 13,
        tau: 0.6,
        levels: &[(0.0, 300.0), (2.5e-3, 12000.0), (5e-3, 12000.0)],
        ..ONSET
    },
];

/// Fine sand, to its onset.
const ONSET: FluidizedBed = FluidizedBed {
    name: "fine sand",
    diameter_mm: 0.2,
    cells: 8,
    height: 7,
    tau: 0.53,
    seed: 1,
    levels: &[(0.0, 300.0), (2e-4, 1200.0), (4e-4, 1200.0)],
};

impl FluidizedBed {
    /// The columns of the rows.
    pub const COLUMNS: [&'static str; 13] = [
        "engine",
        "run",
        "diameter_mm",
        "cells_per_diameter",
        "tau",
        "velocity",
        "reynolds",
        "sieve",
        "lift",
        "height",
        "swing",
        "porosity",
        "porosity_inside",
    ];

    /// The changes of the scene that make this run, as `--set` takes them.
    pub fn changes(&self) -> Vec<String> {
        let si_diameter = 1e-3 * self.diameter_mm;
        let si_dx = si_diameter / f64::from(self.cells);
        // dt = (tau - 1/2)/3 dx²/ν
        let si_dt = (self.tau - 0.5) / 3.0 * si_dx * si_dx / 1e-6;
        let (mut rows, mut steps) = (Vec::new(), 0.0);
        for &(velocity, held) in self.levels {
            let begins = if rows.is_empty() { 0.0 } else { steps + RAMP };
            steps += held;
            for step in [begins, steps] {
                rows.push(format!("[{:.9e}, 0.0, 0.0, {velocity:e}]", step * si_dt));
            }
        }
        let wide = WIDTH * self.cells;
        vec![
            format!("domain.cells=[{wide}, {wide}, {}]", self.height * self.cells),
            format!("domain.dx={si_dx:e}"),
            format!("time.tau={}", self.tau),
            format!("grains[0].diameter={si_diameter:e}"),
            format!("grains[0].seed={}", self.seed),
            format!("faces.z_low.velocity={{ table = [{}] }}", rows.join(", ")),
            format!("records[2].layers={}", 2 * self.height),
            format!("stop.time={:.9e}", steps * si_dt),
        ]
    }

    /// Runs it. Errors if it cannot be run.
    pub fn rows(&self, bench: &mut Bench) -> Result<Vec<Vec<String>>, CaseError> {
        let (run, _) = bench.run(SCENE, &self.changes())?;
        let records = Records {
            walls: run.record("walls")?,
            means: run.record("means")?,
            layers: run.record("layers")?,
        };
        rows_of(&run.scene, &records, (bench.engine_name().word(), self.name))
    }
}

/// The records of a run.
#[derive(Debug)]
pub struct Records {
    /// Of kind `walls`.
    pub walls: Table,
    /// Of kind `grain_means`.
    pub means: Table,
    /// Of kind `layers`.
    pub layers: Table,
}

/// A row for each level of a run, by its records. Errors if the scene is none of this case.
pub fn rows_of(
    scene: &Scene,
    records: &Records,
    (engine, name): (&str, &str),
) -> Result<Vec<Vec<String>>, CaseError> {
    let (Some(part), Some(FaceSignal::Velocity(inlet))) =
        (&scene.free, scene.drives.as_ref().map(|drives| &drives.faces[2][0]))
    else {
        return Err(CaseError::table("the scene needs free grains and an inlet that changes"));
    };
    let units = &scene.units;
    let [nx, ny, nz] = scene.setup.domain.cells().map(|n| n as f64 * units.si_dx);
    let si_area = nx * ny;
    let gravity = part.settings.gravity.map_or(0.0, |gravity| gravity.acceleration().norm());
    let volume = |radius: f64| psmrt_reference::grains::grain::sphere_volume(radius);
    // (m_s - m_f) g
    let weights = part.grains.iter().map(|grain| (grain.mass - volume(grain.radius)) * gravity);
    let si_weight = weights.sum::<f64>() * units.si_force();
    let volumes = part.grains.iter().map(|grain| volume(grain.radius)).sum::<f64>();
    let si_solid = volumes * units.si_dx.powi(3);
    let si_diameter = part.grains.first().map_or(f64::NAN, |one| 2.0 * one.radius * units.si_dx);
    let si_viscosity = viscosity(scene.setup.collision.tau()) * units.si_viscosity();

    let times = records.means.numbers("time (s)")?;
    let heights = records.means.numbers("z (m)")?;
    let bottom = records.walls.with(&[("face", "z_low")])?.numbers("grain_force_z (N)")?;
    let (porosities, pressures) =
        (records.layers.numbers("porosity")?, records.layers.numbers("pressure (Pa)")?);
    let layers = porosities.len() / times.len().max(1);
    let velocity = |row: usize| inlet.at(times[row] / units.si_dt).z * units.si_velocity();
    let mut rows = Vec::new();
    for [first, end] in held(times.len(), &velocity) {
        let last = end - 1;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a share of it"
        )]
        let from = last - ((last - first) as f64 * SHARE) as usize;
        let over = (end - from) as f64;
        let mean = |value: &dyn Fn(usize) -> f64| (from..end).map(value).sum::<f64>() / over;
        // A bed of one density from the sieve to its top has its middle at half its height.
        let si_height = 2.0 * mean(&|row| heights[row]);
        let square = mean(&|row| (2.0 * heights[row] - si_height).powi(2));
        let layer = |number: usize, values: &[f64]| mean(&|row| values[row * layers + number]);
        let thick = nz / layers as f64;
        // Without a grain's diameter at the sieve and at the top.
        let is_inside = |number: &usize| {
            let [low, high] = [*number as f64 * thick, (*number as f64 + 1.0) * thick];
            low >= 0.99 * si_diameter && high <= si_height - 0.99 * si_diameter
        };
        let inside: Vec<f64> =
            (0..layers).filter(is_inside).map(|number| layer(number, &porosities)).collect();
        // From the middles of the lowest two layers down to the sieve; above the bed the pressure is the same everywhere.
        let at_sieve = 1.5 * layer(0, &pressures) - 0.5 * layer(1, &pressures);
        let drop = at_sieve - layer(layers - 1, &pressures);
        let si_velocity = velocity(last);
        rows.push(vec![
            engine.to_owned(),
            name.to_owned(),
            format!("{:.4}", 1e3 * si_diameter)
                .trim_end_matches('0')
                .trim_end_matches('.')
                .to_owned(),
            format!("{:.2}", si_diameter / units.si_dx),
            format!("{}", scene.setup.collision.tau()),
            format!("{si_velocity:.6e}"),
            format!("{:.5}", si_velocity * si_diameter / si_viscosity),
            format!("{:.5}", -mean(&|row| bottom[row]) / si_weight),
            format!("{:.5}", drop * si_area / si_weight),
            format!("{:.5}", si_height / si_diameter),
            format!("{:.5}", square.sqrt() / si_diameter),
            format!("{:.5}", 1.0 - si_solid / si_area / si_height),
            format!("{:.5}", inside.iter().sum::<f64>() / inside.len() as f64),
        ]);
    }
    Ok(rows)
}

/// Stretches of rows in which the velocity does not change, with at least `LEAST` rows each: the first, and the one after the last.
fn held(rows: usize, velocity: &dyn Fn(usize) -> f64) -> Vec<[usize; 2]> {
    /// A level has at least so many rows; fewer are on their way from one to the next.
    const LEAST: usize = 3;
    let mut found = Vec::new();
    let mut first = 0;
    for row in 1..=rows {
        let is_same = row < rows
            && (velocity(row) - velocity(first)).abs() <= 1e-9 * velocity(first).abs().max(1e-9);
        if !is_same {
            if row - first >= LEAST {
                found.push([first, row]);
            }
            first = row;
        }
    }
    found
}
