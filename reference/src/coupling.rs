//! Grains that move freely in the fluid: the order of operations of a coupled step.
//!
//! 1. the fluid collides and streams with the grains where they are, which gives the load `F` of the
//!    fluid on each grain (`solver.rs`);
//! 2. what acts on a grain besides contacts is put together ([`CoupledSolver::outside_loads`]);
//! 3. the grains move by one step, in as many sub-steps as their contacts ask, this load held
//!    constant (`grains/system.rs`);
//! 4. the solids of the fluid are put where the grains are now.
//!
//! **The fluid inside a grain.** The PS term drags along the fluid that a grain covers. Its inertia is
//! in `F`, though a real grain has none of it: `F` is too small by `m_f dv/dt`, with `m_f = rho_f V`.
//! [`InternalFluid::Lagged`] gives back `m_f` times the last step's change of velocity (and so for the
//! spin). Giving back this step's change blows up near a density ratio of 1, since then nothing is
//! left that has inertia; giving back nothing is stable and has the right terminal velocity after the
//! wrong start. `tests/coupling.rs` measures all three.
//!
//! **What is conserved.** Without gravity, in a periodic box, to round-off:
//!
//! ```text
//!   Q = Σ j + Σ_s (m_s v_n - m_f v_(n-1)) + 1/2 Σ_s F_(n-1)
//! ```
//!
//! with `Σ j` the momentum in all populations, that inside the grains included, `v_n` and `v_(n-1)`
//! the velocities now and a step ago, and `F_(n-1)` the last load, of which half has not arrived yet
//! ([`CoupledSolver::conserved_momentum`]). Without [`InternalFluid::Lagged`] the term with `m_f` is
//! absent, without averaging that with `F`.

use crate::domain::Face;
use crate::grains::grain::{Grain, sphere_volume};
use crate::grains::plane::Plane;
use crate::grains::setup::{GrainError, GrainSetup};
use crate::grains::system::{GrainState, GrainSystem};
use crate::guard::Stopped;
use crate::lattice::{Populations, Vec3, momentum};
use crate::setup::{Setup, SetupError};
use crate::solids::{Load, Shape, Solid};
use crate::solver::{Memory, Solver};
use thiserror::Error;

/// What becomes of the inertia of the fluid inside a grain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InternalFluid {
    /// It stays with the grain, as if the grain were heavier by `m_f`.
    Kept,
    /// It is given back one step later.
    #[default]
    Lagged,
}

/// How gravity acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gravity {
    /// By reduced pressure: the fluid carries no gravity, a grain its weight less its buoyancy,
    /// `(m_s - m_f) g`. Hydrostatics is exact.
    Reduced {
        /// Acceleration, lattice units.
        acceleration: Vec3,
    },
    /// On fluid and grains: the fluid carries the body force `rho_f g` (which the set-up of the fluid
    /// must have), a grain `m_s g`. The PS term displaces the sum of `B`, not `V`, so the buoyancy is
    /// too small on coarse grids.
    OnFluidToo {
        /// Acceleration, lattice units.
        acceleration: Vec3,
    },
}

/// How fluid and grains act on each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouplingSettings {
    /// The fluid inside the grains.
    pub internal_fluid: InternalFluid,
    /// Gravity, if there is any.
    pub gravity: Option<Gravity>,
    /// Use the mean of the last two loads (Ladd 1994, the paper's reference 7). Off by default: the PS
    /// load hardly alternates from step to step, and together with [`InternalFluid::Lagged`] the delay
    /// lets the spin of a neutrally buoyant grain of 6 cells at tau = 1 swing for hundreds of steps,
    /// which without it is calm after twenty.
    pub average_loads: bool,
    /// Density of the fluid at rest.
    pub fluid_density: f64,
}

impl Default for CouplingSettings {
    fn default() -> Self {
        CouplingSettings {
            internal_fluid: InternalFluid::default(),
            gravity: None,
            average_loads: false,
            fluid_density: 1.0,
        }
    }
}

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

/// Velocity and spin of a grain, and the load on it, a step ago.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LastStep {
    /// Velocity before the last step.
    pub velocity: Vec3,
    /// Spin before the last step.
    pub spin: Vec3,
    /// Load of the fluid during the last step.
    pub load: Load,
}

/// Fluid and free grains. Lattice units throughout; grain number `i` is the fluid's solid number `i`.
#[derive(Clone, Debug)]
pub struct CoupledSolver {
    fluid: Solver,
    grains: GrainSystem,
    settings: CouplingSettings,
    last: Vec<LastStep>,
}

impl CoupledSolver {
    /// Fluid at density and velocity `state` at each cell centre, and grains. The fluid's set-up must
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
        let fluid = with_grains(fluid, &grains)?;
        let fluid = Solver::starting_from(fluid, state)?;
        let last = grains.iter().map(LastStep::at_rest).collect();
        let grains = GrainSystem::new(grain_setup, grains, planes)?;
        Ok(CoupledSolver { fluid, grains, settings, last })
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
        let grains = GrainSystem::resume(grains.0, grains.1)?;
        Ok(CoupledSolver { fluid, grains, settings, last })
    }

    /// One step of fluid and grains. Errors when either is broken.
    pub fn step(&mut self) -> Result<(), CoupledStop> {
        self.fluid.advance_fluid()?;
        let loads = self.outside_loads();
        for ((last, grain), load) in
            self.last.iter_mut().zip(self.grains.grains()).zip(self.fluid.loads())
        {
            *last = LastStep { velocity: grain.velocity, spin: grain.spin, load: *load };
        }
        self.grains.step(1.0, &loads)?;
        let grains = self.grains.grains();
        self.fluid.place_solids(|number, solid| {
            solid.centre = grains[number].position;
            solid.velocity = grains[number].velocity;
            solid.spin = grains[number].spin;
        });
        Ok(())
    }

    /// `count` steps.
    pub fn run(&mut self, count: u64) -> Result<(), CoupledStop> {
        (0..count).try_for_each(|_| self.step())
    }

    /// What acts on each grain besides contacts in the coming step, the fluid's last load included.
    pub fn outside_loads(&self) -> Vec<Load> {
        let each = self.grains.grains().iter().zip(self.fluid.loads()).zip(&self.last);
        each.map(|((grain, load), last)| self.outside_load(grain, load, last)).collect()
    }

    /// Load of the fluid, the inertia of the fluid inside, weight and buoyancy.
    fn outside_load(&self, grain: &Grain, load: &Load, last: &LastStep) -> Load {
        let mut total = if self.settings.average_loads {
            // (F_n + F_(n-1))/2
            Load {
                force: 0.5 * (load.force + last.load.force),
                torque: 0.5 * (load.torque + last.load.torque),
            }
        } else {
            *load
        };
        total = self.mirrored(grain, &total);
        let fluid_mass = self.settings.fluid_density * sphere_volume(grain.radius);
        if self.settings.internal_fluid == InternalFluid::Lagged {
            // + m_f (v_n - v_(n-1)),  + I_f (ω_n - ω_(n-1)),  I_f = 2/5 m_f a²
            total.force += fluid_mass * (grain.velocity - last.velocity);
            total.torque +=
                0.4 * fluid_mass * grain.radius * grain.radius * (grain.spin - last.spin);
        }
        match self.settings.gravity {
            // + (m_s - m_f) g
            Some(Gravity::Reduced { acceleration }) => {
                total.force += (grain.mass - fluid_mass) * acceleration;
            }
            // + m_s g; the fluid's body force provides the buoyancy
            Some(Gravity::OnFluidToo { acceleration }) => total.force += grain.mass * acceleration,
            None => {}
        }
        total
    }

    /// The load on a grain whose centre lies on a mirror plane, of which the fluid holds one half: the
    /// other half's is its mirror image.
    fn mirrored(&self, grain: &Grain, load: &Load) -> Load {
        let mut load = *load;
        let domain = self.fluid.domain();
        for axis in 0..3 {
            let planes = [0.0, domain.cells()[axis] as f64];
            let on_mirror = (0..2).any(|side| {
                domain.faces().axis(axis)[side] == Face::FreeSlip
                    && grain.position[axis] == planes[side]
            });
            if on_mirror {
                // F + F': the part along the normal cancels; T is axial: the part across it does
                load.force *= 2.0;
                load.force[axis] = 0.0;
                load.torque =
                    Vec3::from_fn(|i, _| if i == axis { 2.0 * load.torque[i] } else { 0.0 });
            }
        }
        load
    }

    /// The fluid.
    pub fn fluid(&self) -> &Solver {
        &self.fluid
    }

    /// The grains.
    pub fn grains(&self) -> &GrainSystem {
        &self.grains
    }

    /// What is carried from the last step besides fluid and grains.
    pub fn last_steps(&self) -> &[LastStep] {
        &self.last
    }

    /// Momentum of the populations plus that of the grains.
    pub fn plain_momentum(&self) -> Vec3 {
        let fluid: Vec3 = self.fluid.populations().iter().map(momentum).sum();
        fluid + self.grains.grains().iter().map(|grain| grain.mass * grain.velocity).sum::<Vec3>()
    }

    /// The momentum `Q` that a periodic box without gravity conserves to round-off (see the top of this
    /// file).
    pub fn conserved_momentum(&self) -> Vec3 {
        let mut total = self.plain_momentum();
        for (grain, last) in self.grains.grains().iter().zip(&self.last) {
            if self.settings.internal_fluid == InternalFluid::Lagged {
                let fluid_mass = self.settings.fluid_density * sphere_volume(grain.radius);
                total -= fluid_mass * last.velocity;
            }
            if self.settings.average_loads {
                total += 0.5 * last.load.force;
            }
        }
        total
    }
}

impl LastStep {
    /// Before the first step: as if the grain had always moved as it does, with no load.
    fn at_rest(grain: &Grain) -> Self {
        LastStep { velocity: grain.velocity, spin: grain.spin, load: Load::default() }
    }
}

/// The fluid's set-up with the grains as its solids.
fn with_grains(mut setup: Setup, grains: &[Grain]) -> Result<Setup, CouplingError> {
    match &mut setup.solid_phase {
        Some(phase) if phase.solids.is_empty() => {
            phase.solids = grains.iter().map(as_solid).collect();
            Ok(setup)
        }
        _ => Err(CouplingError::SolidsGiven),
    }
}

fn as_solid(grain: &Grain) -> Solid {
    Solid {
        shape: Shape::Sphere { radius: grain.radius },
        centre: grain.position,
        velocity: grain.velocity,
        spin: grain.spin,
    }
}
