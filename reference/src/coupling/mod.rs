//! Grains that move freely in the fluid: the order of operations of a coupled step.
//!
//! 1. the fluid collides and streams with the grains where they are, which gives the load `F` of the
//!    fluid on each grain (`solver.rs`);
//! 2. what acts on a grain besides contacts is put together ([`FreeGrains::outside_loads`]);
//! 3. the grains move by one step, in as many sub-steps as their contacts ask, this load held
//!    constant (`grains/system.rs`);
//! 4. the solids of the fluid are put where the grains are now.
//!
//! That is explicit: the grain goes through the collision of 1 with the velocity that it has come with. Under full
//! bounce-back it would be unstable, and the velocity for the collision is solved for before it (`implicit.rs`); all
//! else stays as it is.
//!
//! **The fluid inside a grain.** The PS term makes the fluid that a grain covers follow it. The inertia of that fluid
//! (the internal mass) is in `F`, though a real grain has none of it: `F` is too small by `m_f dv/dt`, with `m_f = rho_f V`.
//! [`InternalFluid::Lagged`] adds back `m_f` times the last step's change of velocity (and so for the
//! angular velocity). Adding back this step's change is unstable near a density ratio of 1, since then nothing is
//! left that has inertia; adding back nothing is stable and has the right terminal velocity after the
//! wrong start. `tests/oracle/coupling.rs` measures all three.
//!
//! The populations of the cells that a grain covers start with the grain's motion (`start.rs`): else
//! the grain would pay for setting `m_f` in motion, which [`InternalFluid::Lagged`] adds back only
//! for changes of its velocity from then on.
//!
//! **What is conserved.** Without gravity or with [`Gravity::Balanced`], in a periodic domain, to round-off:
//!
//! ```text
//!   Q = Σ j + Σ_s (m_s v_n - m_f v_(n-1)) + 1/2 Σ_s F_(n-1)
//! ```
//!
//! with `Σ j` the momentum in all populations, that inside the grains included, `v_n` and `v_(n-1)`
//! the velocities now and a step ago, and `F_(n-1)` the last load, of which half has not arrived yet
//! ([`CoupledSolver::conserved_momentum`]). Without [`InternalFluid::Lagged`] the term with `m_f` is
//! absent, without averaging that with `F`. At the start, with the fluid at rest, `Q` is the momentum of
//! the grains alone, `Σ_s m_s v_0`.

mod balance;
mod free_grains;
mod implicit;
mod last_step;

use crate::grains::grain::Grain;
use crate::grains::plane::Plane;
use crate::grains::setup::{GrainError, GrainSetup};
use crate::grains::system::{GrainState, GrainSystem};
use crate::guard::Stopped;
use crate::lattice::{Populations, Vec3, momentum};
use crate::setup::{Setup, SetupError};
use crate::solids::Load;
use crate::solver::{Memory, Solver};
use std::borrow::Cow;
use thiserror::Error;

pub use crate::grains::contact::Motion;
pub use balance::{balancing_force, with_displaced};
pub use free_grains::{CouplingSettings, FreeGrains, Gravity, InternalFluid};
pub use implicit::{grips, grips_with_displaced, load_by_grip};
pub use last_step::LastStep;

/// A coupled set-up that cannot be run.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CouplingError {
    /// The fluid's part.
    #[error(transparent)]
    Fluid(#[from] SetupError),
    /// The grains' part.
    #[error(transparent)]
    Grains(#[from] GrainError),
    /// The fluid's set-up has no solid phase or has solids of its own.
    #[error("the grains become the fluid's solids: give its set-up a solid phase with no solids")]
    SolidsGiven,
    /// Averaged loads where the coupling is implicit.
    #[error(
        "averaged loads are for explicit coupling, and full bounce-back couples free grains implicitly"
    )]
    Averaged,
}

/// A coupled run that was stopped.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CoupledStop {
    /// The guard of the fluid stopped it.
    #[error(transparent)]
    Fluid(#[from] Stopped),
    /// The grains could not be moved.
    #[error(transparent)]
    Grains(#[from] GrainError),
}

/// Fluid and free grains. Lattice units throughout; grain number `i` is the fluid's solid number `i`.
#[derive(Clone, Debug)]
pub struct CoupledSolver {
    fluid: Solver,
    grains: FreeGrains,
}

impl CoupledSolver {
    /// Fluid at density and velocity `state` at each cell centre, and grains; the fluid that a grain
    /// covers starts with the grain. The fluid's set-up must
    /// have a solid phase without solids; the grains' must not have gravity, which is in `settings`.
    /// Errors if any part cannot be run.
    pub fn new(
        fluid: Setup,
        state: impl Fn(Vec3) -> (f64, Vec3),
        grain_setup: GrainSetup,
        grains: Vec<Grain>,
        planes: Vec<Plane>,
        settings: CouplingSettings,
    ) -> Result<Self, CouplingError> {
        if is_implicit(&fluid) && settings.average_loads {
            return Err(CouplingError::Averaged);
        }
        let grains = FreeGrains::new(&fluid.domain, grain_setup, grains, planes, settings)?;
        let fluid = Solver::starting_with_free_solids(with_grains(fluid, &grains)?, state)?;
        Ok(CoupledSolver { fluid, grains })
    }

    /// Goes on, bit for bit, from what [`Self::fluid`], [`Self::grains`] and [`Self::last_steps`] gave.
    /// Errors if any part cannot be run.
    pub fn going_on_from(
        fluid: (Setup, Vec<Populations>, Memory),
        grains: (GrainSetup, GrainState),
        settings: CouplingSettings,
        last: Vec<LastStep>,
    ) -> Result<Self, CouplingError> {
        let (setup, f, memory) = fluid;
        let fluid = Solver::going_on_from(setup, f, memory)?;
        let grains = FreeGrains::going_on_from(fluid.domain(), grains, settings, last)?;
        Ok(CoupledSolver { fluid, grains })
    }

    /// One step of fluid and grains. Errors when either is broken.
    pub fn step(&mut self) -> Result<(), CoupledStop> {
        if is_implicit(self.fluid.setup()) {
            self.put_into_motion_for_collision();
        }
        self.fluid.advance_fluid()?;
        self.grains.step(&loads(&self.fluid, self.grains.settings()))?;
        let solids = self.grains.solids();
        self.fluid.place_solids(|number, solid| {
            solid.centre = solids[number].centre;
            solid.velocity = solids[number].velocity;
            solid.angular_velocity = solids[number].angular_velocity;
        });
        Ok(())
    }

    /// Gives the solids the velocities of the implicit coupling.
    fn put_into_motion_for_collision(&mut self) {
        let mut grips = grips(&self.fluid);
        if let Some(g) = balancing(self.fluid.setup(), self.grains.settings()) {
            grips = grips_with_displaced(grips, g);
        }
        let motions = self.grains.motion_in_collision(&grips);
        self.fluid.place_solids(|number, solid| {
            solid.velocity = motions[number].velocity;
            solid.angular_velocity = motions[number].angular_velocity;
        });
    }

    /// `count` steps.
    pub fn run(&mut self, count: u64) -> Result<(), CoupledStop> {
        (0..count).try_for_each(|_| self.step())
    }

    /// Looks for a broken state of the fluid now, whatever the step.
    pub fn check_now(&mut self) -> Result<(), CoupledStop> {
        Ok(self.fluid.check_now()?)
    }

    /// What acts on each grain besides contacts in the coming step, the fluid's last load included.
    pub fn outside_loads(&self) -> Vec<Load> {
        self.grains.outside_loads(&loads(&self.fluid, self.grains.settings()))
    }

    /// The fluid.
    pub fn fluid(&self) -> &Solver {
        &self.fluid
    }

    /// The grains.
    pub fn grains(&self) -> &GrainSystem {
        self.grains.system()
    }

    /// The grains, with how the fluid acts on them.
    pub fn free_grains(&self) -> &FreeGrains {
        &self.grains
    }

    /// How fluid and grains act on each other.
    pub fn settings(&self) -> &CouplingSettings {
        self.grains.settings()
    }

    /// What is carried from the last step besides fluid and grains.
    pub fn last_steps(&self) -> &[LastStep] {
        self.grains.last_steps()
    }

    /// Momentum of the populations plus that of the grains.
    pub fn plain_momentum(&self) -> Vec3 {
        self.fluid_momentum() + self.grains.plain_momentum()
    }

    /// The momentum `Q` that a periodic domain without gravity conserves to round-off (see the top of this
    /// file).
    pub fn conserved_momentum(&self) -> Vec3 {
        self.fluid_momentum() + self.grains.conserved_momentum()
    }

    fn fluid_momentum(&self) -> Vec3 {
        self.fluid.populations().iter().map(momentum).sum()
    }
}

/// The fluid's loads of the last step, with what a balancing body force lacks in the grains' cells.
fn loads<'a>(fluid: &'a Solver, settings: &CouplingSettings) -> Cow<'a, [Load]> {
    match balancing(fluid.setup(), settings) {
        Some(g) => with_displaced(fluid.loads(), &fluid.displaced(), g).into(),
        None => fluid.loads().into(),
    }
}

/// The body force of which grains get what their cells lack, if there is one.
pub fn balancing(setup: &Setup, settings: &CouplingSettings) -> Option<Vec3> {
    setup.body_force.filter(|_| matches!(settings.gravity, Some(Gravity::Balanced { .. })))
}

/// Whether the solids of a set-up ask for the implicit coupling of those that are free.
pub fn is_implicit(setup: &Setup) -> bool {
    setup.solid_phase.as_ref().is_some_and(|phase| phase.operator.asks_for_implicit_coupling())
}

/// The fluid's set-up with the grains as its solids.
fn with_grains(mut setup: Setup, grains: &FreeGrains) -> Result<Setup, CouplingError> {
    match &mut setup.solid_phase {
        Some(phase) if phase.solids.is_empty() => {
            phase.solids = grains.solids();
            Ok(setup)
        }
        _ => Err(CouplingError::SolidsGiven),
    }
}
