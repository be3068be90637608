//! A sphere in a stream: one run of the scene `golden/sphere_drag/scene.toml`, and what it is worth.

use std::f64::consts::PI;

use psmrt_reference::collision::Preset;
use psmrt_reference::lattice::viscosity;

use crate::cases::{Bench, CaseError};
use psmrt::run::RunError;
use psmrt::scene::preset_changes;

/// Diameter, m, and viscosity, m2/s, of the scene.
const SI_DIAMETER: f64 = 3e-4;
const SI_VISCOSITY: f64 = 1e-6;

/// One run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stream {
    /// Collision: `mrt`, `srt` or `magic`.
    pub collision: Preset,
    /// Collision in the sphere, as scenes spell it. Rows do not name it: a table with several has a column before.
    pub operator: &'static str,
    /// Reynolds number `U d/nu`, with the velocity `U` of the inlet.
    pub reynolds: f64,
    /// Cells per diameter.
    pub cells: u32,
    /// Relaxation time.
    pub tau: f64,
    /// Width of the box in diameters; its length is twice that.
    pub width: f64,
    /// What the force may still have to go, relative, when it is steady.
    pub tolerance: f64,
}

impl Stream {
    /// The columns of [`Stream::row`].
    pub const COLUMNS: [&'static str; 16] = [
        "engine",
        "collision",
        "Re",
        "cells_per_diameter",
        "tau",
        "width_d",
        "outcome",
        "CD",
        "K",
        "flux_over_inlet",
        "lattice_velocity",
        "max_speed",
        "steps",
        "cell_updates",
        "change",
        "left",
    ];

    /// The start of its row, which tells it from all others.
    pub fn start(&self, engine: &str) -> Vec<String> {
        let Stream { collision, reynolds, cells, tau, width, .. } = self;
        let numbers = [reynolds.to_string(), cells.to_string(), tau.to_string(), width.to_string()];
        [vec![engine.to_owned(), collision.word().to_owned()], numbers.to_vec()].concat()
    }

    /// Velocity of the inlet, cells per step.
    pub fn lattice_velocity(&self) -> f64 {
        self.reynolds * viscosity(self.tau) / f64::from(self.cells)
    }

    /// Runs it until it is steady and returns its row. A run that the guard stops, or that does not
    /// become steady, has a row that says so and no numbers. Errors if it cannot be run.
    pub fn row(&self, bench: &mut Bench) -> Result<Vec<String>, CaseError> {
        let mut row = self.start(bench.engine_name().word());
        let before = bench.cell_updates();
        let run = match bench.steady("sphere_drag/scene.toml", &self.changes()) {
            Err(CaseError::Run(RunError::Stopped(why))) => return Ok(none(row, &why.to_string())),
            Err(CaseError::NotSteady { steps, .. }) => {
                return Ok(none(row, &format!("not steady after {steps} steps")));
            }
            run => run?,
        };
        let (nu, d, u) = (viscosity(self.tau), f64::from(self.cells), self.lattice_velocity());
        // A quarter of the sphere is in the box.
        let force = 4.0 * run.engine.loads().iter().map(|load| load.force.y).sum::<f64>();
        // The mass flux is the same in every section, and so its mean over the box is that at the inlet.
        let means = run.engine.box_means();
        let flux = means.mass_flux.y;
        let [change, left] = run.settled.as_ref().map_or([f64::NAN; 2], |s| [s.change, s.left]);
        row.extend([
            "steady".to_owned(),
            // C_D = F/(1/2 ρ U² π d²/4), with ρ U the mass flux
            format!("{:.5}", force / (0.125 * PI * d * d * flux * u)),
            // K = F/(3π ρ ν d U)
            format!("{:.5}", force / (3.0 * PI * nu * d * flux)),
            format!("{:.6}", flux / u),
            format!("{u:.5}"),
            format!("{:.4}", means.max_speed),
            run.engine.steps().to_string(),
            (bench.cell_updates() - before).to_string(),
            format!("{change:.1e}"),
            format!("{left:.1e}"),
        ]);
        Ok(row)
    }

    fn changes(&self) -> Vec<String> {
        let Stream { reynolds, cells, tau, width, tolerance, operator, .. } = *self;
        let d = SI_DIAMETER;
        let velocity = format!("[0.0, {:e}, 0.0]", reynolds * SI_VISCOSITY / d);
        let rows = self.interval();
        let mut changes = vec![
            format!("domain.dx={:e}", d / f64::from(cells)),
            format!("domain.size=[{0:e}, {1:e}, {0:e}]", 0.5 * width * d, 2.0 * width * d),
            format!("time.tau={tau}"),
            format!("faces.y_low.velocity={velocity}"),
            format!("initial.velocity={velocity}"),
            format!("grains[0].centre=[0.0, {:e}, 0.0]", width * d),
            format!("records[0].every_steps={rows}"),
            format!("records[1].every_steps={rows}"),
            format!("stop.steps={}", 150 * rows),
            format!("stop.steady.tolerance={tolerance:e}"),
            format!("solid.operator=\"{operator}\""),
        ];
        changes.extend(preset_changes(self.collision));
        changes
    }

    /// Steps between two looks at the force: a third of the time in which the slowest disturbance, a wave
    /// as long as the box is wide, dies down by a factor of e, or a tenth of that in which the stream
    /// passes through the box, whichever is shorter.
    #[expect(clippy::cast_possible_truncation, reason = "far below 2^53")]
    #[expect(clippy::cast_sign_loss, reason = "a time")]
    fn interval(&self) -> u64 {
        let width = self.width * f64::from(self.cells);
        // 1/(ν k²), k = 2π/W
        let viscous = width * width / (4.0 * PI * PI * viscosity(self.tau));
        let passing = 2.0 * width / self.lattice_velocity();
        (viscous / 3.0).min(passing / 10.0).ceil() as u64
    }
}

/// A row without results, and why.
fn none(mut row: Vec<String>, why: &str) -> Vec<String> {
    row.push(why.replace(',', ";"));
    row.resize(Stream::COLUMNS.len(), "0".to_owned());
    row
}
