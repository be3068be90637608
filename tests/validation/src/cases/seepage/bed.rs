//! Seepage through a bed of spheres: one run of `golden/seepage/scene.toml`, and what it is worth.

use std::f64::consts::PI;

use psmrt::packing::contacts;
use psmrt_reference::collision::Preset;
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::setup::PeriodicBox;
use psmrt_reference::lattice::viscosity;
use psmrt_reference::solids::{Shape, Solid};

use crate::cases::bench::Finished;
use crate::cases::{Bench, CaseError};
use psmrt::run::RunError;
use psmrt::scene::preset_changes;

/// Diameter, m, and viscosity, m2/s, of the scene.
const SI_DIAMETER: f64 = 1.6e-4;
const SI_VISCOSITY: f64 = 1e-6;

/// How the spheres lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Packing {
    /// At random in a periodic cube.
    Random {
        /// Edge of the cube, diameters.
        side: f64,
        /// Spheres.
        count: u32,
        /// Seed of their places.
        seed: u32,
    },
    /// Face-centred cubic at a solid fraction of 0.6, one unit cell.
    Fcc,
}

impl Packing {
    /// Nine spheres in a cube of two diameters.
    pub const SMALL: Packing = Packing::Random { side: 2.0, count: 9, seed: 1 };
}

/// One run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BedRun {
    /// Collision: `mrt`, `srt` or `magic`.
    pub collision: Preset,
    /// Weight: `noble_torczynski` or `solid_fraction`.
    pub weighting: &'static str,
    /// The spheres.
    pub packing: Packing,
    /// Reynolds number `U d/(nu (1 - porosity))` that the body force would give if psi were
    /// 180/Re + 1.2, within 12 % of Beetstra's law up to Re = 100; what the flow has is measured.
    pub reynolds: f64,
    /// Cells along the edge of the cube.
    pub side_cells: u32,
    /// Relaxation time.
    pub tau: f64,
    /// What the superficial velocity may still have to go, relative, when it is steady.
    pub tolerance: f64,
}

impl BedRun {
    /// The columns of [`BedRun::row`].
    pub const COLUMNS: [&'static str; 23] = [
        "engine",
        "collision",
        "weighting",
        "packing",
        "spheres",
        "seed",
        "Re_wanted",
        "cells_per_diameter",
        "tau",
        "outcome",
        "porosity",
        "coordination",
        "largest_overlap",
        "Re",
        "psi",
        "psi_Re",
        "permeability_d2",
        "lattice_velocity",
        "max_speed",
        "steps",
        "cell_updates",
        "change",
        "left",
    ];

    /// The start of its row, which tells it from all others.
    pub fn start(&self, engine: &str) -> Vec<String> {
        let (packing, count, seed) = match self.packing {
            Packing::Random { side, count, seed } => (format!("random {side}"), count, seed),
            Packing::Fcc => ("fcc".to_owned(), 4, 0),
        };
        let words = [engine, self.collision.word(), self.weighting, &packing].map(str::to_owned);
        let numbers = [
            count.to_string(),
            seed.to_string(),
            self.reynolds.to_string(),
            format!("{:.4}", self.cells_per_diameter()),
            self.tau.to_string(),
        ];
        [words.to_vec(), numbers.to_vec()].concat()
    }

    fn side(&self) -> f64 {
        match self.packing {
            Packing::Random { side, .. } => side,
            // 4 π/6 d³ = φ L³
            Packing::Fcc => (4.0 * PI / 6.0 / FCC_FRACTION).cbrt(),
        }
    }

    fn solid_fraction(&self) -> f64 {
        match self.packing {
            Packing::Random { side, count, .. } => f64::from(count) * PI / 6.0 / side.powi(3),
            Packing::Fcc => FCC_FRACTION,
        }
    }

    fn cells_per_diameter(&self) -> f64 {
        f64::from(self.side_cells) / self.side()
    }

    /// Runs it until it is steady and returns its row. Errors if it cannot be run or does not become
    /// steady; a run that the guard stops has a row that says so.
    pub fn row(&self, bench: &mut Bench) -> Result<Vec<String>, CaseError> {
        self.row_of(bench, |bench, scene, changes| bench.steady(scene, changes))
    }

    /// The same after a number of steps, steady or not: whether it gets there is the question.
    pub fn row_after(&self, bench: &mut Bench, steps: u64) -> Result<Vec<String>, CaseError> {
        self.row_of(bench, |bench, scene, changes| {
            let limit = [format!("stop.steps={steps}"), "stop.steady.tolerance=1e-15".to_owned()];
            Ok(bench.run(scene, &[changes, &limit].concat())?.0)
        })
    }

    fn row_of(
        &self,
        bench: &mut Bench,
        run: impl Fn(&mut Bench, &str, &[String]) -> Result<Finished, CaseError>,
    ) -> Result<Vec<String>, CaseError> {
        let mut row = self.start(bench.engine_name().word());
        let before = bench.cell_updates();
        let scene = match self.packing {
            Packing::Random { .. } => "seepage/scene.toml",
            Packing::Fcc => "seepage/ordered.toml",
        };
        let run = match run(bench, scene, &self.changes()) {
            Err(CaseError::Run(RunError::Stopped(why))) => {
                let why = why.to_string().replace(',', ";");
                let numbers = std::iter::repeat_n("0".to_owned(), Self::COLUMNS.len() - 10);
                row.extend(std::iter::once(why).chain(numbers));
                return Ok(row);
            }
            run => run?,
        };
        let seepage = Seepage::of(&run);
        let [change, left] = run.settled.as_ref().map_or([f64::NAN; 2], |s| [s.change, s.left]);
        row.extend([
            if run.settled.is_some() { "steady" } else { "stable" }.to_owned(),
            format!("{:.5}", seepage.porosity),
            format!("{:.3}", seepage.coordination),
            format!("{:.1e}", seepage.largest_overlap),
            format!("{:.5}", seepage.reynolds),
            format!("{:.5}", seepage.psi),
            format!("{:.4}", seepage.psi * seepage.reynolds),
            format!("{:.5e}", seepage.permeability),
            format!("{:.4e}", seepage.velocity),
            format!("{:.4}", seepage.max_speed),
            run.engine.steps().to_string(),
            (bench.cell_updates() - before).to_string(),
            format!("{change:.1e}"),
            format!("{left:.1e}"),
        ]);
        Ok(row)
    }

    /// What the scene is changed by.
    pub fn changes(&self) -> Vec<String> {
        let (d, phi, side) = (SI_DIAMETER, self.solid_fraction(), self.side() * SI_DIAMETER);
        let velocity = self.reynolds * SI_VISCOSITY * phi / d;
        let psi = 180.0 / self.reynolds + 1.2;
        // psi = (dP/L) d ε³/(ρ U² (1 - ε))
        let acceleration = psi * velocity * velocity * phi / (d * (1.0 - phi).powi(3));
        let rows = self.interval();
        let mut changes = vec![
            format!("domain.dx={:e}", side / f64::from(self.side_cells)),
            format!("domain.size=[{side:e}, {side:e}, {side:e}]"),
            format!("time.tau={}", self.tau),
            format!("body_force.acceleration=[{acceleration:e}, 0.0, 0.0]"),
            format!("solid.weighting=\"{}\"", self.weighting),
            format!("records[0].every_steps={rows}"),
            format!("stop.steps={}", 600 * rows),
            format!("stop.steady.tolerance={:e}", self.tolerance),
        ];
        if let Packing::Random { count, seed, .. } = self.packing {
            changes.push(format!("grains[0].count={count}"));
            changes.push(format!("grains[0].seed={seed}"));
        }
        changes.extend(preset_changes(self.collision));
        changes
    }

    /// Steps between two looks: a fifth of the viscous time.
    #[expect(clippy::cast_possible_truncation, reason = "far below 2^53")]
    #[expect(clippy::cast_sign_loss, reason = "a time")]
    fn interval(&self) -> u64 {
        (0.2 * self.viscous_time()).ceil() as u64
    }

    /// Steps in which a disturbance as long as a sphere is wide dies down by a factor of e.
    pub fn viscous_time(&self) -> f64 {
        // 1/(ν k²), k = 2π/d
        let d = self.cells_per_diameter();
        d * d / (4.0 * PI * PI * viscosity(self.tau))
    }
}

/// Solid fraction of the face-centred cubic bed.
pub const FCC_FRACTION: f64 = 0.6;

/// What a steady flow through a bed says.
struct Seepage {
    porosity: f64,
    coordination: f64,
    largest_overlap: f64,
    reynolds: f64,
    psi: f64,
    /// Over the square of the diameter.
    permeability: f64,
    /// Superficial, cells per step.
    velocity: f64,
    max_speed: f64,
}

impl Seepage {
    fn of(run: &Finished) -> Self {
        let (setup, solids) = (&run.scene.setup, run.engine.solids());
        let (nu, volume) = (viscosity(setup.collision.tau()), setup.domain.cell_count() as f64);
        let force = setup.body_force.map_or(0.0, |g| g.x);
        let grain = |solid: &Solid| match solid.shape {
            Shape::Sphere { radius } => Some(Grain::sphere(solid.centre, radius, 1.0)),
            Shape::Cells { .. } => None,
        };
        let grains: Vec<Grain> = solids.iter().filter_map(grain).collect();
        let d = 2.0 * grains.first().map_or(f64::NAN, |grain| grain.radius);
        let sides = PeriodicBox::all(setup.domain.cells().map(|n| n as f64));
        let (coordination, largest_overlap) = contacts(&grains, &sides, &[]);
        // Grains of density 1.
        let phi = grains.iter().map(|grain| grain.mass).sum::<f64>() / volume;
        let porosity = 1.0 - phi;
        let means = run.engine.box_means();
        let u = means.mass_flux.x / means.density;
        let gradient = force / means.density;
        Seepage {
            porosity,
            coordination,
            largest_overlap,
            // Re = U d/(ν (1 - ε))
            reynolds: u * d / (nu * phi),
            // psi = (dP/L) d ε³/(ρ U² (1 - ε)), the body force being the pressure gradient
            psi: gradient * d * porosity.powi(3) / (u * u * phi),
            // k = ν U/(dP/L)
            permeability: nu * u / gradient / (d * d),
            velocity: u,
            max_speed: means.max_speed,
        }
    }
}
