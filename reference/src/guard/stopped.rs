//! Why a run was stopped: what is wrong, why probably, and what to change.

use super::Guard;
use crate::domain::{FACE_NAMES, Face};
use crate::lattice::viscosity;
use crate::setup::Setup;
use crate::solids::{Shape, Solid};
use std::fmt;
use thiserror::Error;

/// What is wrong with a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Symptom {
    /// A population is NaN or infinite.
    NotFinite,
    /// The density is zero or negative.
    NoDensity(f64),
    /// The fluid is faster than [`super::GuardSettings::max_speed`].
    TooFast(f64),
    /// The mean density of the box is less than half or more than twice its first value.
    MeanDensity(f64),
}

/// Why it probably went wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cause {
    /// The state was broken before the first step.
    InitialState,
    /// A solid moves too fast.
    SolidSpeed {
        /// Number of the solid.
        solid: usize,
        /// Largest speed of its surface or centre.
        speed: f64,
    },
    /// A wall or an inlet moves too fast.
    FaceSpeed {
        /// The face.
        face: &'static str,
        /// Its speed.
        speed: f64,
    },
    /// The pressures at two faces differ so much that they drive the fluid too fast.
    PressureDifference {
        /// The speed `sqrt(2 (p_high - p_low)/rho)` that the difference can drive.
        speed: f64,
    },
    /// The mean density has drifted away: an inlet with a free outflow does not hold it.
    DensityDrift {
        /// Mean density now over mean density at the first look.
        ratio: f64,
    },
    /// The body force has driven the fluid too fast.
    BodyForce {
        /// Gain of speed per step.
        acceleration: f64,
    },
    /// The flow is too fast for the viscosity: structures smaller than a cell.
    Unresolved {
        /// Grid Reynolds number `|u|/nu` at the last look that found nothing.
        grid_reynolds: f64,
    },
    /// None of the above.
    Unknown,
}

/// A run that was stopped.
#[derive(Clone, Debug, Error, PartialEq)]
pub struct Stopped {
    /// The step before which the state was looked at.
    pub step: u64,
    /// The first broken cell, `[x, y, z]`; `[0, 0, 0]` where all are.
    pub cell: [usize; 3],
    /// What is wrong there.
    pub symptom: Symptom,
    /// Why, probably.
    pub cause: Cause,
}

impl fmt::Display for Stopped {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Stopped { step, cell, symptom, cause } = self;
        write!(out, "stopped before step {step} ")?;
        match symptom {
            Symptom::MeanDensity(_) => write!(out, "on the mean over all cells: ")?,
            _ => write!(out, "at cell {cell:?}: ")?,
        }
        match symptom {
            Symptom::NotFinite => write!(out, "a population is not a finite number")?,
            Symptom::NoDensity(rho) => write!(out, "density = {rho:.3e} must be positive")?,
            Symptom::TooFast(speed) => write!(
                out,
                "speed = {speed:.3} lattice units is past the limit (the speed of sound is 0.577)"
            )?,
            Symptom::MeanDensity(ratio) => write!(
                out,
                "the mean density is {ratio:.3} times its first value and must stay within 0.5 to 2"
            )?,
        }
        write!(out, ". Probable cause: ")?;
        match cause {
            Cause::InitialState => write!(
                out,
                "the initial state is broken. Give every cell a positive density and a finite \
                 velocity below the limit"
            ),
            Cause::SolidSpeed { solid, speed } => write!(
                out,
                "solid {solid} moves at {speed:.3}. Use a smaller time step so that it stays \
                 below 0.1"
            ),
            Cause::FaceSpeed { face, speed } => write!(
                out,
                "the velocity at face {face} is {speed:.3}. Use a smaller time step so that it \
                 stays below 0.1"
            ),
            Cause::PressureDifference { speed } => write!(
                out,
                "the pressures at the faces can drive a speed of {speed:.3}. Bring the densities \
                 at the faces closer together or use a smaller time step"
            ),
            Cause::DensityDrift { ratio } => write!(
                out,
                "the mean density has drifted to {ratio:.3} times its first value; a velocity \
                 inlet with a free outflow does not hold it. Use a pressure outlet"
            ),
            Cause::BodyForce { acceleration } => write!(
                out,
                "the body force gains {acceleration:.3e} per step and nothing held the fluid \
                 back. Use a weaker force or a smaller time step"
            ),
            Cause::Unresolved { grid_reynolds } => write!(
                out,
                "the grid Reynolds number |u| dx/nu reached {grid_reynolds:.0}: the flow is too \
                 fast for its viscosity. Refine the grid, raise the viscosity (tau further from \
                 1/2), or use MRT with d'Humieres' rates"
            ),
            Cause::Unknown => write!(
                out,
                "none of the known ones. Try a smaller time step (tau nearer 1) or a finer grid"
            ),
        }
    }
}

/// Above this many cells' worth of advection per diffusion a flow cannot be resolved.
const MAX_GRID_REYNOLDS: f64 = 10.0;

/// A mean density this far from its first value has drifted, if something else broke.
const MAX_DENSITY_DRIFT: f64 = 0.1;

/// The first cause for which there is evidence, the most certain kinds first.
pub(super) fn probable_cause(guard: &Guard, setup: &Setup, step: u64) -> Cause {
    if guard.first_mean_density.is_none() {
        return Cause::InitialState;
    }
    let limit = guard.settings.max_speed;
    if let Some((solid, speed)) = fastest_solid(setup).filter(|&(_, speed)| speed > 0.5 * limit) {
        return Cause::SolidSpeed { solid, speed };
    }
    if let Some((face, speed)) = fastest_face(setup).filter(|&(_, speed)| speed > 0.5 * limit) {
        return Cause::FaceSpeed { face, speed };
    }
    if let Some(speed) = pressure_speed(setup).filter(|&speed| speed > 0.5 * limit) {
        return Cause::PressureDifference { speed };
    }
    let ratio = guard.density_drift();
    if (ratio - 1.0).abs() > MAX_DENSITY_DRIFT {
        return Cause::DensityDrift { ratio };
    }
    // A body force is to blame if, unopposed since the last look, it explains the speed.
    let acceleration = setup.body_force.map_or(0.0, |g| g.norm() / guard.last_mean_density);
    let since = guard.settings.interval.min(step) as f64;
    if acceleration > 0.0 && guard.last_max_speed + 2.0 * acceleration * since > limit {
        return Cause::BodyForce { acceleration };
    }
    let nu = viscosity(setup.collision.tau());
    let grid_reynolds = guard.last_max_speed / nu;
    if grid_reynolds > MAX_GRID_REYNOLDS {
        return Cause::Unresolved { grid_reynolds };
    }
    Cause::Unknown
}

/// The solid whose centre or surface is fastest, and its speed.
fn fastest_solid(setup: &Setup) -> Option<(usize, f64)> {
    let solids = &setup.solid_phase.as_ref()?.solids;
    let speed = |solid: &Solid| match solid.shape {
        Shape::Sphere { radius } => solid.velocity.norm() + radius * solid.spin.norm(),
        Shape::Cells { .. } => solid.velocity.norm(),
    };
    solids.iter().map(speed).enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The wall or inlet that is fastest, and its speed.
fn fastest_face(setup: &Setup) -> Option<(&'static str, f64)> {
    let faces = setup.domain.faces();
    let speeds =
        (0..3).flat_map(|axis| [0, 1].map(|side| (axis, side))).filter_map(|(axis, side)| {
            match faces.axis(axis)[side] {
                Face::Wall { velocity } | Face::VelocityInlet { velocity } => {
                    Some((FACE_NAMES[axis][side], velocity.norm()))
                }
                _ => None,
            }
        });
    speeds.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The speed that the pressures at the faces can drive, by Bernoulli.
fn pressure_speed(setup: &Setup) -> Option<f64> {
    let faces = setup.domain.faces();
    let densities = (0..3).flat_map(|axis| faces.axis(axis)).filter_map(|face| match face {
        Face::Pressure { density } => Some(density),
        _ => None,
    });
    let (low, high) =
        densities.fold((f64::INFINITY, 0.0_f64), |(low, high), rho| (low.min(rho), high.max(rho)));
    // u = √(2 Δp/ρ),  p = ρ/3
    (high > 0.0).then(|| (2.0 / 3.0 * (high - low) / high).sqrt())
}
