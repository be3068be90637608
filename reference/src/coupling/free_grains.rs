//! Free grains, driven by the loads of whatever engine computes the fluid.

use crate::domain::{Domain, Face};
use crate::grains::contact::Motion;
use crate::grains::grain::{Grain, sphere_volume};
use crate::grains::hold;
use crate::grains::plane::Plane;
use crate::grains::setup::{GrainError, GrainSetup};
use crate::grains::system::{GrainState, GrainSystem};
use crate::lattice::Vec3;
use crate::solids::{Load, Shape, Solid};

use super::last_step::LastStep;

/// Fastest grain, cells per time step: what the guard of the fluid allows the fluid.
const FASTEST: f64 = 0.5;

/// What becomes of the inertia of the fluid inside a grain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InternalFluid {
    /// Retained by the grain, as if it were heavier by `m_f`.
    Kept,
    /// Added back with a lag of one step.
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
    /// By reduced pressure, and the net weight of all grains is balanced by a uniform body force
    /// ([`super::balancing_force`], which the set-up of the fluid must have): for domains that are periodic
    /// along gravity. Whoever drives the grains adds what the body force lacks in their cells to their
    /// loads ([`super::with_displaced`]).
    Balanced {
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

impl Gravity {
    /// The acceleration of either form.
    pub fn acceleration(&self) -> Vec3 {
        match *self {
            Gravity::Reduced { acceleration }
            | Gravity::Balanced { acceleration }
            | Gravity::OnFluidToo { acceleration } => acceleration,
        }
    }

    /// The same form with another acceleration.
    #[must_use]
    pub fn with(self, acceleration: Vec3) -> Self {
        match self {
            Gravity::Reduced { .. } => Gravity::Reduced { acceleration },
            Gravity::Balanced { .. } => Gravity::Balanced { acceleration },
            Gravity::OnFluidToo { .. } => Gravity::OnFluidToo { acceleration },
        }
    }
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
    /// lets the angular velocity of a neutrally buoyant grain of 6 cells at tau = 1 oscillate for hundreds of steps,
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

/// Grains that move under the loads of a fluid. Lattice units throughout; grain number `i` is the
/// fluid's solid number `i`.
#[derive(Clone, Debug)]
pub struct FreeGrains {
    domain: Domain,
    grains: GrainSystem,
    settings: CouplingSettings,
    last: Vec<LastStep>,
}

impl FreeGrains {
    /// Grains in the fluid's domain. The grains' set-up must not have gravity, which is in `settings`.
    /// Errors if they cannot be moved.
    pub fn new(
        domain: &Domain,
        setup: GrainSetup,
        grains: Vec<Grain>,
        planes: Vec<Plane>,
        settings: CouplingSettings,
    ) -> Result<Self, GrainError> {
        let last = grains.iter().map(LastStep::at_rest).collect();
        let grains = GrainSystem::new(setup, grains, planes)?;
        Ok(FreeGrains { domain: domain.clone(), grains, settings, last })
    }

    /// Goes on, bit for bit, from the state of [`Self::system`] and from [`Self::last_steps`]. Errors
    /// if the grains cannot be moved.
    pub fn going_on_from(
        domain: &Domain,
        (setup, state): (GrainSetup, GrainState),
        settings: CouplingSettings,
        last: Vec<LastStep>,
    ) -> Result<Self, GrainError> {
        let grains = GrainSystem::resume(setup, state)?;
        Ok(FreeGrains { domain: domain.clone(), grains, settings, last })
    }

    /// Moves the grains by one step under `loads`, the fluid's load on each during its last step.
    /// Returns the number of sub-steps. Errors if the motion breaks down or a contact does not hold.
    pub fn step(&mut self, loads: &[Load]) -> Result<u32, GrainError> {
        let outside = self.outside_loads(loads);
        let acting = loads.iter().zip(&outside);
        for ((last, grain), (load, outside)) in
            self.last.iter_mut().zip(self.grains.grains()).zip(acting)
        {
            *last = LastStep::beginning(grain, load, outside);
        }
        let substeps = self.grains.step(1.0, &outside)?;
        for (last, grain) in self.last.iter_mut().zip(self.grains.grains()) {
            last.end(grain);
        }
        if let Some(sunk) = hold::deepest(&self.grains) {
            return Err(sunk.into());
        }
        self.check_thrown(&outside)?;
        Ok(substeps)
    }

    /// Errors if a contact has thrown a grain: it is past [`FASTEST`], and got more of its speed in the last
    /// step from contacts than from `outside`.
    ///
    /// Without fluid there is no such limit: a cell is a unit of length then, and [`hold`] sees what contacts do not.
    fn check_thrown(&self, outside: &[Load]) -> Result<(), GrainError> {
        if self.settings.fluid_density == 0.0 {
            return Ok(());
        }
        for (number, grain) in self.grains.grains().iter().enumerate() {
            let speed = grain.velocity.norm();
            if grain.held || speed <= FASTEST {
                continue;
            }
            // v - v_(n-1) = F/m + what contacts have given
            let pushed = outside[number].force / grain.mass;
            let gained = (grain.velocity - self.last[number].velocity - pushed).norm();
            if gained > pushed.norm() {
                let limit = FASTEST;
                return Err(GrainError::Thrown { grain: number, speed, gained, limit });
            }
        }
        Ok(())
    }

    /// Lets gravity be `acceleration` from now on, in the form that it has; nothing happens where there is none.
    pub fn set_gravity(&mut self, acceleration: Vec3) {
        self.settings.gravity = self.settings.gravity.map(|gravity| gravity.with(acceleration));
    }

    /// Gives a held grain another motion from now on; any other keeps its own.
    pub fn prescribe(&mut self, grain: usize, motion: &Motion) {
        self.grains.prescribe(grain, motion);
    }

    /// What acts on each grain besides contacts in the coming step: the fluid's load, the inertia of
    /// the fluid inside, weight and buoyancy.
    pub fn outside_loads(&self, loads: &[Load]) -> Vec<Load> {
        let each = self.grains.grains().iter().zip(loads).zip(&self.last);
        each.map(|((grain, load), last)| self.outside_load(grain, load, last)).collect()
    }

    /// The grains as solids of the fluid, where they are now.
    pub fn solids(&self) -> Vec<Solid> {
        self.grains.grains().iter().map(as_solid).collect()
    }

    /// The grains, their contacts and how they move.
    pub fn system(&self) -> &GrainSystem {
        &self.grains
    }

    /// The fluid's domain.
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// How fluid and grains act on each other.
    pub fn settings(&self) -> &CouplingSettings {
        &self.settings
    }

    /// What is carried from the last step besides the grains.
    pub fn last_steps(&self) -> &[LastStep] {
        &self.last
    }

    /// Momentum of the grains.
    pub fn plain_momentum(&self) -> Vec3 {
        self.grains.grains().iter().map(|grain| grain.mass * grain.velocity).sum()
    }

    /// The grains' part of the momentum `Q` that a periodic domain without gravity conserves.
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
            total.torque += 0.4
                * fluid_mass
                * grain.radius
                * grain.radius
                * (grain.angular_velocity - last.angular_velocity);
        }
        match self.settings.gravity {
            // + (m_s - m_f) g
            Some(Gravity::Reduced { acceleration } | Gravity::Balanced { acceleration }) => {
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
        for axis in 0..3 {
            if mirrors_through(&self.domain, grain, axis) {
                // F + F': the part along the normal cancels; T is axial: the part across it does
                load.force *= 2.0;
                load.force[axis] = 0.0;
                load.torque =
                    Vec3::from_fn(|i, _| if i == axis { 2.0 * load.torque[i] } else { 0.0 });
            }
        }
        load
    }
}

/// Whether a mirror plane across `axis` goes through the centre of a grain.
pub(super) fn mirrors_through(domain: &Domain, grain: &Grain, axis: usize) -> bool {
    let planes = [0.0, domain.cells()[axis] as f64];
    let faces = domain.faces().axis(axis);
    (0..2).any(|side| faces[side] == Face::FreeSlip && grain.position[axis] == planes[side])
}

/// A grain as a solid of the fluid.
fn as_solid(grain: &Grain) -> Solid {
    Solid {
        shape: Shape::Sphere { radius: grain.radius },
        centre: grain.position,
        velocity: grain.velocity,
        angular_velocity: grain.angular_velocity,
    }
}
