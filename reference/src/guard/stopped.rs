//! Why a run was stopped: what is wrong, why probably, and what to change.

use super::Guard;
use crate::domain::{FACE_NAMES, Face};
use crate::lattice::viscosity;
use crate::setup::Setup;
use crate::solids::Solid;
use std::fmt;
use thiserror::Error;

/// What is wrong with a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Failure {
    /// A population is NaN or infinite.
    NotFinite,
    /// The density is zero or negative.
    NoDensity(f64),
    /// The fluid is faster than [`super::GuardSettings::max_speed`].
    TooFast(f64),
    /// The mean density of the domain is less than half or more than twice its initial value.
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
    /// The mean density has drifted away: an inlet with a free outflow does not determine it.
    DensityDrift {
        /// Mean density now over mean density at the first look.
        ratio: f64,
    },
    /// A velocity inlet accelerated fluid that started with another velocity, and the sound of that start travels back and forth
    /// between the inlet and a pressure face.
    ImpulsiveStart {
        /// The inlet.
        face: &'static str,
        /// Its velocity along its normal.
        speed: f64,
        /// Mean density now over mean density at the first look.
        ratio: f64,
    },
    /// A velocity inlet pushes against more resistance than the fluid's weak compressibility allows.
    ResistedInlet {
        /// The inlet.
        face: &'static str,
        /// Mean density now over mean density at the first look.
        ratio: f64,
    },
    /// A free grain too light for the fluid inside it.
    LightGrain {
        /// Number of the solid.
        solid: usize,
        /// Its density over the fluid's.
        ratio: f64,
    },
    /// Grains and fluid accelerate together in a domain that is periodic along gravity.
    EndlessFall {
        /// Name of the axis.
        axis: &'static str,
        /// Mean velocity of the free grains along it.
        speed: f64,
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
    pub failure: Failure,
    /// Why, probably.
    pub cause: Cause,
}

impl fmt::Display for Stopped {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Stopped { step, cell, failure, cause } = self;
        write!(out, "stopped before step {step} ")?;
        match failure {
            Failure::MeanDensity(_) => write!(out, "on the mean over all cells: ")?,
            _ => write!(out, "at cell {cell:?}: ")?,
        }
        match failure {
            Failure::NotFinite => write!(out, "a population is not a finite number")?,
            Failure::NoDensity(rho) => write!(out, "density = {rho:.3e} must be positive")?,
            Failure::TooFast(speed) => write!(
                out,
                "speed = {speed:.3} lattice units exceeds the limit (the speed of sound is 0.577)"
            )?,
            Failure::MeanDensity(ratio) => write!(
                out,
                "the mean density is {ratio:.3} times its initial value and must stay within 0.5 to 2"
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
                "the mean density has drifted to {ratio:.3} times its initial value; a velocity \
                 inlet with a free outflow does not determine it. Use a pressure outlet"
            ),
            Cause::ImpulsiveStart { face, speed, ratio } => write!(
                out,
                "the sound of an impulsive start. The inlet at face {face} moves at {speed:.3}; where the \
                 fluid starts with another velocity, at rest for example, a wave of that velocity and of {:.3} times \
                 the density travels back and forth between the inlet and the pressure face, and hardly decays (the mean \
                 density is {ratio:.3} times its initial value). Start the fluid with the inlet's \
                 velocity, or use a smaller velocity (a smaller time step)",
                3.0_f64.sqrt() * speed
            ),
            Cause::ResistedInlet { face, ratio } => write!(
                out,
                "the inlet at face {face} pushes against too much resistance: the mean density is \
                 {ratio:.3} times its initial value, and must stay near 1 for a nearly incompressible \
                 flow. Use a smaller time step, which lowers the pressure in lattice units, or a \
                 slower flow"
            ),
            Cause::LightGrain { solid, ratio } => write!(
                out,
                "free grain {solid} has {ratio:.2} times the density of the fluid: for grains this light \
                 the inertia of the fluid inside makes the coupling unstable, whatever the time step. Make \
                 it denser, or fix it or prescribe its motion"
            ),
            Cause::EndlessFall { axis, speed } => write!(
                out,
                "grains and fluid accelerate together (mean speed {speed:.3}): the domain \
                 is periodic along gravity ({axis}), and nothing balances their weight, whatever the time \
                 step. Balance the weight (`gravity.balance`), put walls at the ends of {axis} or fix a grain"
            ),
            Cause::BodyForce { acceleration } => write!(
                out,
                "the body force adds a velocity of {acceleration:.3e} per step and nothing slowed the fluid \
                 down. Use a weaker force or a smaller time step"
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

/// A mean density this far from its initial value has drifted, if something else broke.
const MAX_DENSITY_DRIFT: f64 = 0.1;

/// The first cause for which there is evidence, the most certain kinds first.
pub(super) fn probable_cause(guard: &Guard, setup: &Setup, step: u64) -> Cause {
    let limit = guard.settings.max_speed;
    // A speed that is no number any more is no slow one.
    let is_fast = |&(_, speed): &(usize, f64)| speed.is_nan() || speed > 0.5 * limit;
    // First of all: the cells that a solid covers start with its motion.
    if let Some((solid, speed)) = fastest_solid(setup).filter(is_fast) {
        return Cause::SolidSpeed { solid, speed };
    }
    if guard.first_mean_density.is_none() {
        return Cause::InitialState;
    }
    if let Some((face, speed)) = fastest_face(setup).filter(|&(_, speed)| speed > 0.5 * limit) {
        return Cause::FaceSpeed { face, speed };
    }
    if let Some(speed) = pressure_speed(setup).filter(|&speed| speed > 0.5 * limit) {
        return Cause::PressureDifference { speed };
    }
    if let Some(cause) = drift(setup, guard.density_drift()) {
        return cause;
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

/// Sound of a start changes the mean density by no more than this many times its amplitude. Once by linear
/// theory, until it first comes back from the other end; the rest is room for waves that steepen.
const SOUND: f64 = 2.0;

/// Why the mean density is not what it was, if it is not.
fn drift(setup: &Setup, ratio: f64) -> Option<Cause> {
    if (ratio - 1.0).abs() <= MAX_DENSITY_DRIFT {
        return None;
    }
    let faces = setup.domain.faces();
    let has = |wanted: fn(&Face) -> bool| (0..3).any(|axis| faces.axis(axis).iter().any(wanted));
    let has_pressure = has(|face| face.held_density().is_some());
    match strongest_inlet(setup).filter(|_| has_pressure) {
        // δρ/ρ = u/c_s, c_s = 1/√3
        Some((face, speed)) if (ratio - 1.0).abs() <= SOUND * 3.0_f64.sqrt() * speed => {
            Some(Cause::ImpulsiveStart { face, speed, ratio })
        }
        Some((face, _)) if ratio > 1.0 => Some(Cause::ResistedInlet { face, ratio }),
        _ => (!has_pressure && has(|face| *face == Face::FreeOutflow))
            .then_some(Cause::DensityDrift { ratio }),
    }
}

/// The inlet that lets most fluid in or out per area, and its velocity along its normal.
fn strongest_inlet(setup: &Setup) -> Option<(&'static str, f64)> {
    let all = (0..3).flat_map(|axis| [0, 1].map(|side| (axis, side)));
    let inlets = all.filter_map(|(axis, side)| match setup.domain.faces().axis(axis)[side] {
        Face::VelocityInlet { velocity } => Some((FACE_NAMES[axis][side], velocity[axis].abs())),
        _ => None,
    });
    inlets.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The solid whose centre or surface is fastest, and its speed.
fn fastest_solid(setup: &Setup) -> Option<(usize, f64)> {
    let solids = &setup.solid_phase.as_ref()?.solids;
    let speed = |solid: &Solid| solid.top_speed(&setup.domain);
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
    let all = (0..3).flat_map(|axis| faces.axis(axis));
    let densities = all.filter_map(|face| face.held_density());
    let (low, high) =
        densities.fold((f64::INFINITY, 0.0_f64), |(low, high), rho| (low.min(rho), high.max(rho)));
    // u = √(2 Δp/ρ),  p = ρ/3
    (high > 0.0).then(|| (2.0 / 3.0 * (high - low) / high).sqrt())
}
