//! A fluid engine with all that is the same above every one: free grains and prescribed motion, the guard,
//! the count of steps, and where the time goes.
//!
//! A step of fluid and grains: the fluid advances with the solids where they are; its loads move the free
//! grains; the fluid's solids are put where the grains are now. Where the operator of the solids asks for it, the
//! velocities that free grains have in the collision are solved for before it.

use std::cell::RefCell;

use psmrt_reference::coupling::{
    FreeGrains, balancing, grips_with_displaced, is_implicit, with_displaced,
};
use psmrt_reference::directions::Q;
use psmrt_reference::drive::Drive;
use psmrt_reference::grains::setup::GrainError;
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::guard::Guard;
use psmrt_reference::lattice::{Populations, Vec3};
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::{Grip, Load, Solid};

use super::{Block, BoxMeans, CellState, DeviceError, EngineStop, FluidEngine, StartError};
use crate::bodies::moving::Bodies;
use crate::diagnosis::diagnosed;
use crate::in_time::Drives;
use crate::machine::{Beginning, Spent};
use crate::scene::FreePart;

/// A grain further off than cells can be numbered is as lost as one that is nowhere: between two checks of the
/// guard a load that has broken throws a light grain so far.
const FARTHEST: f64 = 2_147_483_648.0;

/// Where the time has gone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    /// Steps that it covers.
    pub steps: u64,
    /// The parts of a step.
    pub parts: Vec<(&'static str, Spent)>,
}

/// A fluid and the solids in it.
#[derive(Debug)]
pub struct Coupled {
    pub(super) fluid: Box<dyn FluidEngine>,
    pub(super) grains: Option<Grains>,
    pub(super) guard: Guard,
    pub(super) steps: u64,
    /// Bodies that move as prescribed, if there are any.
    pub(super) bodies: Option<Bodies>,
    /// What changes in time, if anything does.
    pub(super) drives: Option<Drives>,
    /// The first failure while something was observed.
    failure: RefCell<Option<DeviceError>>,
    profile: Option<MovingProfile>,
}

/// Free grains, and what the scene says of how they move.
#[derive(Debug)]
pub(super) struct Grains {
    pub(super) moving: FreeGrains,
    pub(super) part: FreePart,
}

/// The part of a profile that fluid engines know nothing of.
#[derive(Debug, Default)]
struct MovingProfile {
    steps: u64,
    grains: Spent,
}

impl Coupled {
    /// A fluid whose solids, if there are any, are not free.
    pub fn of_fluid(fluid: Box<dyn FluidEngine>) -> Self {
        Self::new(fluid, None)
    }

    pub(super) fn new(fluid: Box<dyn FluidEngine>, grains: Option<Grains>) -> Self {
        let guard = Guard::new(fluid.setup().guard);
        let failure = RefCell::default();
        Coupled {
            fluid,
            grains,
            guard,
            steps: 0,
            bodies: None,
            drives: None,
            failure,
            profile: None,
        }
    }

    /// The name of the fluid engine, as `--engine` spells it.
    pub fn name(&self) -> &'static str {
        self.fluid.name()
    }

    /// The device that it computes on, if it is not the processor.
    pub fn adapter(&self) -> Option<String> {
        self.fluid.adapter()
    }

    /// Steps made so far.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// The set-up, with the solids where they are now and the drive of now.
    pub fn setup(&self) -> &Setup {
        self.fluid.setup()
    }

    /// Lets `drive` drive the fluid from now on ([`FluidEngine::set_drive`]): for one that changes, before each step.
    /// Errors, and changes nothing, as [`Setup::set_drive`].
    pub fn set_drive(&mut self, drive: &Drive) -> Result<(), StartError> {
        self.fluid.set_drive(drive)
    }

    /// Makes `count` steps. Errors when the guard finds the state broken, a free grain cannot be moved,
    /// or the device fails. What changes in time changes before each.
    pub fn step(&mut self, count: u64) -> Result<(), EngineStop> {
        let end = self.steps + count;
        let is_free = self.grains.is_some();
        let phase = self.fluid.setup().solid_phase.as_ref();
        let drives = self.drives.as_ref();
        let moves = is_free
            || phase.is_some_and(|phase| phase.solids.iter().any(Solid::moves))
            || drives.is_some_and(|drives| !drives.prescribed.is_empty());
        // From then on all stays as it is.
        let still_from = drives.map_or(f64::NEG_INFINITY, Drives::end);
        let interval = self.fluid.setup().guard.interval.max(1);
        while self.steps < end {
            if self.guard.is_due(self.steps) {
                self.check()?;
            }
            let next_check = (self.steps / interval + 1) * interval;
            let changes = self.steps as f64 <= still_from;
            let now = if moves || changes { 1 } else { end.min(next_check) - self.steps };
            let is_last = self.steps + now == end;
            self.put_into_motion_for_collision()?;
            self.fluid.advance(now, is_free || is_last)?;
            self.steps += now;
            if let Some(profile) = &mut self.profile {
                profile.steps += now;
            }
            if moves {
                self.move_solids()?;
            }
            if changes {
                self.put_values_of_now().map_err(DeviceError::new)?;
            }
        }
        Ok(())
    }

    /// Gives free grains the velocities of the implicit coupling, if that is what the solids ask for.
    fn put_into_motion_for_collision(&mut self) -> Result<(), EngineStop> {
        let Some(Grains { moving, part }) = &self.grains else { return Ok(()) };
        if !is_implicit(self.fluid.setup()) {
            return Ok(());
        }
        let free = part.solids.iter().zip(&part.grains).filter(|(_, grain)| !grain.held);
        let free: Vec<usize> = free.map(|(&solid, _)| solid).collect();
        let grips = self.fluid.grips(&free)?;
        let mut grips: Vec<Grip> = part.solids.iter().map(|&solid| grips[solid]).collect();
        if let Some(g) = balancing(self.fluid.setup(), moving.settings()) {
            grips = grips_with_displaced(grips, g);
        }
        let motions = moving.motion_in_collision(&grips);
        let mut solids = self.solids();
        for (&number, motion) in part.solids.iter().zip(&motions) {
            solids[number].velocity = motion.velocity;
            solids[number].angular_velocity = motion.angular_velocity;
        }
        Ok(self.fluid.place_solids(solids)?)
    }

    /// Moves the free grains under the loads of the last step, and puts those of `solids` that are grains where these
    /// are now.
    pub(super) fn move_grains(&mut self, solids: &mut [Solid]) -> Result<(), EngineStop> {
        let Some(Grains { moving, part }) = &mut self.grains else { return Ok(()) };
        let loads = match balancing(self.fluid.setup(), moving.settings()) {
            Some(g) => {
                let (loads, displaced) = self.fluid.loads_with_displaced()?;
                with_displaced(&loads, &displaced, g)
            }
            None => self.fluid.loads()?,
        };
        let loads: Vec<Load> = part.solids.iter().map(|&solid| loads[solid]).collect();
        let since = self.profile.is_some().then(Beginning::now);
        moving.step(&loads)?;
        let moved = moving.solids();
        if let (Some(profile), Some(since)) = (&mut self.profile, since) {
            profile.grains.add(since);
        }
        if let Some(grain) = moved.iter().position(|solid| solid.centre.amax() > FARTHEST) {
            let position = moved[grain].centre.into();
            return Err(GrainError::NotFinite { grain, position }.into());
        }
        part.solids.iter().zip(moved).for_each(|(&number, solid)| solids[number] = solid);
        Ok(())
    }

    /// Checks for a broken state now, whatever the step. Errors as [`Self::step`].
    pub fn check(&mut self) -> Result<(), EngineStop> {
        let findings = self.fluid.findings(&self.guard)?;
        let setup = self.fluid.setup();
        let judged = self.guard.judge(&setup.domain, self.steps, &findings);
        let grains = self.grains.as_ref();
        let grains = grains.map(|Grains { moving, part }| (moving, part.solids.as_slice()));
        Ok(judged.map_err(|stopped| Box::new(diagnosed(stopped, setup, grains)))?)
    }

    /// Errors if the device has failed while something was observed: what was seen then is not a
    /// number.
    pub fn still_works(&self) -> Result<(), EngineStop> {
        match self.failure.borrow().clone() {
            Some(error) => Err(error.into()),
            None => Ok(()),
        }
    }

    /// What was observed; a failure is kept for [`Self::still_works`].
    fn observed<T>(&self, found: Result<T, DeviceError>) -> Option<T> {
        found.map_err(|error| self.failure.borrow_mut().get_or_insert(error).clone()).ok()
    }

    /// Keeps from now on where the time goes, if the fluid engine can. A device is then waited for after each
    /// part of a step, so that each gets its own time.
    pub fn keep_profile(&mut self) {
        self.fluid.keep_times();
        self.profile = Some(MovingProfile::default());
    }

    /// Where the time has gone, if that is kept.
    pub fn profile(&self) -> Option<Profile> {
        let moving = self.profile.as_ref()?;
        let mut parts = self.fluid.times();
        if parts.is_empty() {
            return None;
        }
        parts.push(("grains", moving.grains));
        Some(Profile { steps: moving.steps, parts })
    }

    /// Means over the domain. The next collision that the mass flux is taken from is with the velocities that the solids
    /// have now; implicit coupling gives free grains those of the end of the step, as far as it knows them.
    pub fn box_means(&self) -> BoxMeans {
        let broken =
            BoxMeans { density: f64::NAN, mass_flux: Vec3::repeat(f64::NAN), max_speed: f64::NAN };
        self.observed(self.fluid.means()).unwrap_or(broken)
    }

    /// The state of the cells of a block, x fastest, z slowest.
    pub fn cells(&self, block: Block) -> Vec<CellState> {
        let broken = CellState {
            density: f64::NAN,
            velocity: Vec3::repeat(f64::NAN),
            solid_fraction: f64::NAN,
        };
        self.observed(self.fluid.cells(block)).unwrap_or_else(|| vec![broken; block.cell_count()])
    }

    /// The populations of the cells of a block before their next collision, in the same order.
    pub fn populations(&self, block: Block) -> Vec<Populations> {
        let found = self.observed(self.fluid.populations(block));
        found.unwrap_or_else(|| vec![[f64::NAN; Q]; block.cell_count()])
    }

    /// The solids, where they are now.
    pub fn solids(&self) -> Vec<Solid> {
        let phase = self.fluid.setup().solid_phase.as_ref();
        phase.map_or_else(Vec::new, |phase| phase.solids.clone())
    }

    /// The number of each grain among the solids, if some are free.
    pub fn solids_of_grains(&self) -> &[usize] {
        self.grains.as_ref().map_or(&[], |grains| &grains.part.solids)
    }

    /// All grains with their contacts, if some are free.
    pub fn free_grains(&self) -> Option<&GrainSystem> {
        self.grains.as_ref().map(|grains| grains.moving.system())
    }

    /// Force and torque of the fluid on each solid during the last step.
    pub fn loads(&self) -> Vec<Load> {
        let broken = Load { force: Vec3::repeat(f64::NAN), torque: Vec3::repeat(f64::NAN) };
        self.observed(self.fluid.loads()).unwrap_or_else(|| vec![broken; self.solids().len()])
    }

    /// `Σ B_s` over the cells of each solid, where it is now, in cells: the body force does not act on the
    /// fluid there, and is no part of the loads.
    pub fn displaced(&self) -> Vec<f64> {
        let found = self.observed(self.fluid.displaced());
        found.unwrap_or_else(|| vec![f64::NAN; self.solids().len()])
    }
}
