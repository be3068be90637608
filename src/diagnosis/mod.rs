//! Why a run was stopped, probably, and what to change. The guard says what is broken; here the set-up, what the guard
//! had seen until then, and the free grains are asked for a cause.

mod fluid;
mod grains;

use std::fmt;

use psmrt_reference::coupling::{FreeGrains, is_implicit};
use psmrt_reference::guard::Stopped;
use psmrt_reference::setup::Setup;
use thiserror::Error;

/// A stop with its probable cause. `solids`: the number of each free grain among the solids.
pub fn diagnosed(
    stopped: Stopped,
    setup: &Setup,
    grains: Option<(&FreeGrains, &[usize])>,
) -> ExplainedStop {
    let of_fluid = fluid::cause(&stopped, setup);
    let of_grains = match (of_fluid, grains) {
        (Cause::InitialState, _) | (_, None) => None,
        (_, Some((grains, solids))) => {
            grains::cause(grains, solids, stopped.step, is_implicit(setup))
        }
    };
    ExplainedStop { stopped, cause: of_grains.unwrap_or(of_fluid) }
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

/// A run that was stopped, and why.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub struct ExplainedStop {
    /// Where and when, and what is wrong there.
    pub stopped: Stopped,
    /// Why, probably.
    pub cause: Cause,
}

impl fmt::Display for ExplainedStop {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}. Probable cause: {}", self.stopped, self.cause)
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
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
