//! A sphere that falls onto a wall in a liquid: a run, and what is read off it.

use std::f64::consts::SQRT_2;

use crate::cases::{Bench, CaseError};
use psmrt::table::Table;

/// What acts between sphere and wall besides contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Between {
    /// Only what the grid resolves.
    Nothing,
    /// Lubrication as long as they are apart.
    WhileApart,
    /// Lubrication, and in contact too, as at the smallest gap.
    Always,
}

impl Between {
    /// Its name in the tables.
    pub fn word(self) -> &'static str {
        match self {
            Between::Nothing => "off",
            Between::WhileApart => "apart",
            Between::Always => "always",
        }
    }
}

/// A fall onto a wall.
#[derive(Clone, Copy, Debug)]
pub struct WetRebound {
    /// Nominal Stokes number, as literature.csv spells it.
    pub stokes: &'static str,
    /// Cells per diameter.
    pub cells: u32,
    /// Lubrication.
    pub between: Between,
    /// Gap from which it acts, cells.
    pub cutoff: f64,
    /// Smallest gap over the radius: the roughness.
    pub smallest: f64,
    /// Duration of the contact, time steps.
    pub contact: f64,
    /// Cells that the sphere falls in a step.
    pub speed: f64,
    /// Half the width of the shaft, its height, and the gap at the start, diameters.
    pub shaft: [u32; 3],
    /// Time of the run after the sphere would have met the wall at its first velocity, in units of `d/U`.
    pub after: f64,
}

/// Velocity at the start over that with which the sphere falls in the end: some of it goes into the fluid.
const START: f64 = 1.2;

/// Time after contact at which the rebound is judged, in units of `d/U`; the gap over it is the velocity of the rebound. It is about
/// that of the experiment's second point.
pub const JUDGED: f64 = 0.25;

/// The sphere and the liquid of literature.csv, SI units.
pub struct Liquid {
    density: f64,
    viscosity: f64,
    /// Diameter of the sphere.
    pub diameter: f64,
    /// Velocity with which it falls in the end.
    pub velocity: f64,
    solid_density: f64,
    /// Coefficient of restitution of a dry impact.
    pub dry: f64,
    /// What the two fits say of the restitution over it.
    pub fits: [f64; 2],
}

impl Liquid {
    /// Of a nominal Stokes number. Errors if the table has none.
    pub fn of(literature: &Table, stokes: &str) -> Result<Self, CaseError> {
        let own = literature.with(&[("St", stokes)])?;
        let (density, viscosity) = (own.number("rho_f")?, own.number("mu_Pa_s")?);
        let diameter = own.number("d_m")?;
        Ok(Liquid {
            velocity: own.number("Re")? * viscosity / (density * diameter),
            density,
            viscosity,
            diameter,
            solid_density: own.number("rho_p")?,
            dry: own.number("e_dry")?,
            fits: [own.number("legendre")?, own.number("critical")?],
        })
    }

    /// `St = ρ_p U d/(9 μ)`.
    pub fn stokes(&self, velocity: f64) -> f64 {
        self.solid_density * velocity * self.diameter / (9.0 * self.viscosity)
    }

    /// `d/U`, s.
    pub fn time(&self) -> f64 {
        self.diameter / self.velocity
    }
}

/// Time since the end of the contact in units of `d/U`, gap in diameters, velocity over `U`, upwards.
pub type Course = Vec<[f64; 3]>;

impl WetRebound {
    fn changes(&self, liquid: &Liquid) -> Vec<String> {
        let Liquid { density, viscosity, diameter, velocity, .. } = liquid;
        let [half, height, start] = self.shaft;
        let dx = diameter / f64::from(self.cells);
        let dt = self.speed * dx / velocity;
        let [half, height] = [half, height].map(|diameters| diameters * self.cells);
        let smallest = 0.5 * self.smallest * diameter;
        // The correction is that beyond the cut-off: with both gaps alike there is none.
        let cutoff =
            if self.between == Between::Nothing { smallest * 1.000_001 } else { self.cutoff * dx };
        let time = (f64::from(start) + self.after) * liquid.time();
        vec![
            format!("domain.dx={dx:e}"),
            format!("domain.cells=[{half}, {half}, {height}]"),
            format!("fluid.density={density:e}"),
            format!("fluid.kinematic_viscosity={:e}", viscosity / density),
            format!("time.lattice_velocity={}", self.speed),
            format!("time.reference_velocity={velocity:e}"),
            format!("grains[0].diameter={diameter:e}"),
            format!("grains[0].centre=[0.0, 0.0, {:e}]", (f64::from(start) + 0.5) * diameter),
            format!("grains[0].velocity=[0.0, 0.0, {:e}]", -START * velocity),
            // Of two spheres; one at a wall has twice the mass in its contact.
            format!("contact.duration={:e}", self.contact * dt / SQRT_2),
            format!("lubrication.cutoff_gap={cutoff:e}"),
            format!("lubrication.smallest_gap={smallest:e}"),
            format!("lubrication.while_touching={}", self.between == Between::Always),
            format!("stop.time={time:e}"),
        ]
    }

    /// Runs it. Errors if it cannot be run.
    pub fn run(&self, bench: &mut Bench, literature: &Table) -> Result<Fall, CaseError> {
        let liquid = Liquid::of(literature, self.stokes)?;
        let (run, _) = bench.run("wet_rebound/scene.toml", &self.changes(&liquid))?;
        let record = run.record("sphere")?;
        let [times, heights, velocities] =
            ["time (s)", "z (m)", "velocity_z (m/s)"].map(|name| record.numbers(name));
        let (times, heights, velocities) = (times?, heights?, velocities?);
        let course: Course = (0..times.len())
            .map(|row| {
                let gap = heights[row] / liquid.diameter - 0.5;
                [times[row] / liquid.time(), gap, velocities[row] / liquid.velocity]
            })
            .collect();
        Ok(Fall::of(course, &liquid))
    }

    /// What a row of the study begins with.
    pub fn start(&self) -> String {
        let WetRebound { stokes, cells, between, cutoff, smallest, contact, speed, .. } = self;
        format!("{stokes},{cells},{},{cutoff},{smallest},{contact},{speed}", between.word())
    }
}

/// A course, with what is read off it.
pub struct Fall {
    /// With time 0 at the end of the contact.
    pub course: Course,
    /// Velocity over U at a gap of one diameter on the way down, and the Stokes number with it.
    pub incoming: f64,
    /// That Stokes number.
    pub stokes: f64,
    /// Velocity of the rebound over the incoming one, over the dry restitution.
    pub restitution: f64,
    /// Height of the rebound, diameters.
    pub peak: f64,
    /// Time until the second contact, in units of `d/U`; NaN if it was not reached.
    pub duration: f64,
}

impl Fall {
    pub fn of(mut course: Course, liquid: &Liquid) -> Self {
        // The turn from down to up nearest to the wall, and the end of the contact in which it lies: where the gap passes 0.
        let turn = course.windows(2).position(|pair| pair[0][2] < 0.0 && pair[1][2] >= 0.0);
        let turn = turn.map_or(course.len() - 1, |row| row + 1);
        let touches = course[turn][1] <= 0.0;
        let parting = |pair: &&[[f64; 3]]| touches && pair[0][1] <= 0.0 && pair[1][1] > 0.0;
        let parted = course[turn..].windows(2).find(parting);
        // In a contact shorter than a step it is passed between two rows.
        let [time, gap, velocity] = course[turn];
        let step = course.get(1).map_or(0.0, |row| row[0] - course[0][0]);
        let at_once = time - (gap / velocity.max(1e-9)).clamp(0.0, step);
        let end = parted.map_or(at_once, |pair| {
            pair[0][0] - pair[0][1] * (pair[1][0] - pair[0][0]) / (pair[1][1] - pair[0][1])
        });
        for row in &mut course {
            row[0] -= end;
        }
        let incoming = course.iter().find(|row| row[1] < 1.0).map_or(f64::NAN, |row| -row[2]);
        let after = &course[turn..];
        let peak = after
            .windows(2)
            .find(|pair| pair[0][2] > 0.0 && pair[1][2] <= 0.0)
            .map_or(f64::NAN, |pair| pair[0][1].max(pair[1][1]));
        let fallen = after.iter().skip_while(|row| row[2] >= 0.0).find(|row| row[1] <= TOUCH);
        let points: Vec<_> = course.iter().map(|row| (row[0], row[1])).collect();
        Fall {
            incoming,
            stokes: liquid.stokes(incoming * liquid.velocity),
            restitution: at(&points, JUDGED) / (JUDGED * incoming * liquid.dry),
            peak,
            duration: fallen.map_or(f64::NAN, |row| row[0]),
            course,
        }
    }
}

/// A gap over the diameter at which the fall after the rebound has ended: lubrication stretches what is left.
const TOUCH: f64 = 0.005;

/// A curve at `x`, on a straight line between two of its points; NaN beyond.
pub fn at(curve: &[(f64, f64)], x: f64) -> f64 {
    let pair = curve.windows(2).find(|pair| pair[0].0 <= x && x <= pair[1].0);
    pair.map_or(f64::NAN, |pair| {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    })
}
