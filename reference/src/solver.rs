//! The time step: the order of operations, nothing else.
//!
//! Populations are stored cell by cell (`Vec<[f64; 19]>`), in two copies: the collision is then a product of a 19 × 19
//! matrix with a contiguous vector, as Eq. 3 is written, and still does several million cell updates per second and core.
//! Results do not depend on the number of threads: a plane of cells is worked on by one thread in the order of its
//! cells, and sums over planes are taken in the order of the planes.

use crate::cell_collision::{CellCollision, Impulse};
use crate::collision::CollisionOperator;
use crate::coverage::Coverage;
use crate::directions::Q;
use crate::domain::Domain;
use crate::drive::{Drive, DriveError};
use crate::forcing::forced_velocity;
use crate::guard::{Evidence, Guard, Stopped};
use crate::lattice::{Populations, Vec3, density, momentum};
use crate::non_reflecting::SlowMeans;
use crate::partial_saturation::share_weight;
use crate::planes::map_planes;
use crate::setup::{Setup, SetupError};
use crate::solids::{Load, Solid};
use crate::start::fill;
use crate::streaming::stream;

/// What a solver carries from step to step besides its set-up and its populations.
#[derive(Clone, Debug, PartialEq)]
pub struct Memory {
    /// Steps made so far.
    pub steps: u64,
    /// Force and torque on each solid during the last step.
    pub loads: Vec<Load>,
    /// What the guard has seen.
    pub evidence: Evidence,
    /// Slow means of the outward velocity in the cells at non-reflecting faces.
    pub slow_means: Vec<f64>,
}

/// The oracle: the fluid of one domain, and the solids that move through it as prescribed.
#[derive(Clone, Debug)]
pub struct Solver {
    setup: Setup,
    operator: CollisionOperator,
    coverage: Option<Coverage>,
    f: Vec<Populations>,
    post: Vec<Populations>,
    loads: Vec<Load>,
    guard: Guard,
    slow_means: SlowMeans,
    steps: u64,
}

impl Solver {
    /// A fluid of density 1 at rest. Errors if the set-up cannot be run.
    pub fn new(setup: Setup) -> Result<Self, SetupError> {
        Self::starting_from(setup, |_| (1.0, Vec3::zeros()))
    }

    /// A fluid whose density and velocity at each cell centre are `state(centre)`, with the
    /// populations in equilibrium; if a solid moves, or its operator turns populations back, all cells that solids cover
    /// start with their solid (`start.rs`). Errors if the set-up cannot be run.
    pub fn starting_from(
        setup: Setup,
        state: impl Fn(Vec3) -> (f64, Vec3),
    ) -> Result<Self, SetupError> {
        let with_solids = setup.solid_phase.iter().any(|phase| {
            phase.operator.turns_populations_back() || phase.solids.iter().any(Solid::has_velocity)
        });
        Self::started(setup, state, with_solids)
    }

    /// The same with solids that are free to move: the cells that they cover start with them, also
    /// if all are at rest. Errors if the set-up cannot be run.
    pub fn starting_with_free_solids(
        setup: Setup,
        state: impl Fn(Vec3) -> (f64, Vec3),
    ) -> Result<Self, SetupError> {
        Self::started(setup, state, true)
    }

    fn started(
        setup: Setup,
        state: impl Fn(Vec3) -> (f64, Vec3),
        covered_move: bool,
    ) -> Result<Self, SetupError> {
        let empty = vec![[0.0; Q]; setup.domain.cell_count()];
        let mut solver = Self::from_populations(setup, empty)?;
        let Solver { setup, coverage, f, slow_means, .. } = &mut solver;
        fill(f, setup, coverage.as_ref().filter(|_| covered_move), state);
        *slow_means = SlowMeans::starting_from(&setup.domain, f);
        Ok(solver)
    }

    /// A fluid with the given populations, one set per cell. Errors if the set-up cannot be run.
    ///
    /// # Panics
    /// If there are not as many sets as cells: a mistake in the calling code.
    pub fn from_populations(setup: Setup, f: Vec<Populations>) -> Result<Self, SetupError> {
        setup.check()?;
        assert_eq!(f.len(), setup.domain.cell_count(), "one set of populations per cell");
        let operator = CollisionOperator::new(&setup.collision);
        Ok(Self::with_operator(setup, operator, f))
    }

    /// A solver that goes on, bit for bit, where another was: with the set-up, the populations and
    /// the memory that [`Self::setup`], [`Self::populations`] and [`Self::memory`] gave there.
    /// Errors if the set-up cannot be run.
    ///
    /// # Panics
    /// If there are not as many sets as cells, loads as solids, or slow means as cells at faces that need one: a
    /// mistake in the calling code.
    pub fn going_on_from(
        setup: Setup,
        f: Vec<Populations>,
        memory: Memory,
    ) -> Result<Self, SetupError> {
        let mut solver = Self::from_populations(setup, f)?;
        assert_eq!(memory.loads.len(), solver.loads.len(), "one load per solid");
        solver.guard = Guard::going_on_from(solver.setup.guard, memory.evidence);
        solver.loads = memory.loads;
        solver.slow_means = SlowMeans::going_on_from(&solver.setup.domain, memory.slow_means);
        solver.steps = memory.steps;
        Ok(solver)
    }

    /// The same with a collision operator of the caller's making, which the set-up's does not
    /// check: for trying what a misprinted matrix does.
    pub fn with_operator(setup: Setup, operator: CollisionOperator, f: Vec<Populations>) -> Self {
        let coverage = setup
            .solid_phase
            .as_ref()
            .map(|phase| Coverage::new(&setup.domain, &phase.solids, phase.coverage));
        let loads = vec![Load::default(); setup.solid_phase.as_ref().map_or(0, |p| p.solids.len())];
        let guard = Guard::new(setup.guard);
        let slow_means = SlowMeans::starting_from(&setup.domain, &f);
        let post = f.clone();
        Solver { setup, operator, coverage, f, post, loads, guard, slow_means, steps: 0 }
    }

    /// One step. Errors when the guard, which looks every so many steps, finds the state broken.
    pub fn step(&mut self) -> Result<(), Stopped> {
        self.advance_fluid()?;
        if self.setup.solid_phase.iter().any(|phase| phase.solids.iter().any(Solid::moves)) {
            self.place_solids(|_, solid| {
                if solid.moves() {
                    solid.centre += solid.velocity;
                }
            });
        }
        Ok(())
    }

    /// One step of the fluid, the solids staying where they are. Errors as [`Self::step`].
    pub fn advance_fluid(&mut self) -> Result<(), Stopped> {
        self.guard.check(&self.setup.domain, &self.f, self.steps)?;
        self.advance_unguarded();
        Ok(())
    }

    /// The same without a look of the guard, for a caller that has its own.
    pub fn advance_unguarded(&mut self) {
        self.collide(); // f → f*, and the loads on the solids         (right side of Eq. 1)
        // f* → f   (left side of Eq. 1)
        stream(&self.setup.domain, &self.slow_means, &self.post, &mut self.f);
        self.slow_means.follow(&self.setup.domain, &self.post);
        self.steps += 1;
    }

    /// Lets `place` change each solid, by its number, and lists anew what the moved ones cover.
    pub fn place_solids(&mut self, place: impl Fn(usize, &mut Solid)) {
        if let (Some(phase), Some(coverage)) = (&mut self.setup.solid_phase, &mut self.coverage) {
            phase.solids.iter_mut().enumerate().for_each(|(number, solid)| place(number, solid));
            coverage.update(&self.setup.domain, &phase.solids, phase.coverage);
        }
    }

    /// `count` steps.
    pub fn run(&mut self, count: u64) -> Result<(), Stopped> {
        (0..count).try_for_each(|_| self.step())
    }

    /// Looks for a broken state now, whatever the step.
    pub fn check_now(&mut self) -> Result<(), Stopped> {
        self.guard.check_now(&self.setup.domain, &self.f, self.steps)
    }

    /// Collides every cell into `post` and adds up what each solid receives, plane by plane.
    fn collide(&mut self) {
        let cell_collision =
            CellCollision::new(&self.setup, &self.operator, self.coverage.as_ref());
        let (f, [nx, ny, _]) = (&self.f, self.setup.domain.cells());
        let impulses = map_planes(&mut self.post, nx * ny, |z, plane| {
            let mut impulses: Vec<Impulse> = Vec::new();
            for (i, post) in plane.iter_mut().enumerate() {
                let cell = i + nx * ny * z;
                *post = cell_collision.collide(cell, &f[cell], &mut impulses);
            }
            impulses
        });
        self.loads.fill(Load::default());
        for impulse in impulses.iter().flatten() {
            let load = &mut self.loads[impulse.solid];
            load.force += impulse.force;
            load.torque += impulse.arm.cross(&impulse.force);
        }
    }

    /// Steps made so far.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// What it carries besides its set-up and populations.
    pub fn memory(&self) -> Memory {
        Memory {
            steps: self.steps,
            loads: self.loads.clone(),
            evidence: self.guard.evidence(),
            slow_means: self.slow_means.values().to_vec(),
        }
    }

    /// Mean density at the guard's last look over that at its first. A velocity inlet with a free
    /// outflow leaves it free, all other domains hold it.
    pub fn density_drift(&self) -> f64 {
        self.guard.evidence().density_drift()
    }

    /// The set-up, with the solids where they are now and the drive of now.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The domain.
    pub fn domain(&self) -> &Domain {
        &self.setup.domain
    }

    /// The populations, cell by cell, before the next collision.
    pub fn populations(&self) -> &[Populations] {
        &self.f
    }

    /// What the solids cover, if there are any.
    pub fn coverage(&self) -> Option<&Coverage> {
        self.coverage.as_ref()
    }

    /// Force and torque on each solid during the last step.
    pub fn loads(&self) -> &[Load] {
        &self.loads
    }

    /// `Σ B_s` over the cells of each solid, where it is now: the volume in which the body force does not
    /// act on the fluid. With it the forces of a step close the balance of momentum: in a periodic domain
    /// `ΔΣj = V G - Σ_s (F_s + G Σ B_s)`, the sums being those of the step.
    pub fn displaced(&self) -> Vec<f64> {
        let mut displaced = vec![0.0; self.loads.len()];
        if let (Some(phase), Some(coverage)) = (&self.setup.solid_phase, &self.coverage) {
            let tau = self.setup.collision.tau();
            for cell in 0..self.setup.domain.cell_count() {
                let shares = coverage.shares(cell);
                if !shares.is_empty() {
                    let epsilons = shares.iter().map(|share| share.epsilon);
                    share_weight(phase.weighting, tau, epsilons, |s, weight| {
                        displaced[shares[s].solid] += weight;
                    });
                }
            }
        }
        displaced
    }

    /// Drives the fluid so from the next step on. Errors as [`Setup::set_drive`].
    pub fn set_drive(&mut self, drive: &Drive) -> Result<(), DriveError> {
        self.setup.set_drive(drive)
    }

    /// Density of each cell.
    pub fn density_field(&self) -> Vec<f64> {
        self.f.iter().map(density).collect()
    }

    /// Velocity of the fluid in each cell, half-way through a collision that sees the body force
    /// alone: `(j + G/2)/rho`. Inside solids the mass flux is [`Self::mass_flux_field`].
    pub fn velocity_field(&self) -> Vec<Vec3> {
        let g = self.setup.body_force.unwrap_or_else(Vec3::zeros);
        self.f.iter().map(|f| forced_velocity(density(f), &momentum(f), &g)).collect()
    }

    /// Mass flux of each cell: the mean of its momentum before and after the next collision, solid
    /// cells included. Its mean over the domain, divided by the density, is the superficial velocity.
    pub fn mass_flux_field(&self) -> Vec<Vec3> {
        let cell_collision =
            CellCollision::new(&self.setup, &self.operator, self.coverage.as_ref());
        let mut impulses = Vec::new();
        let flux = |(cell, f): (usize, &Populations)| {
            let post = cell_collision.collide(cell, f, &mut impulses);
            0.5 * (momentum(f) + momentum(&post))
        };
        self.f.iter().enumerate().map(flux).collect()
    }
}
