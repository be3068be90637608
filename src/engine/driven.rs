//! What changes in time above any fluid engine: the drive of the fluid, gravity on free grains, and prescribed motion.
//! The moment of each value in a step: `in_time/mod.rs`.

use psmrt_reference::grains::contact::Motion;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Solid;

use super::coupled::{Coupled, Grains};
use super::{EngineStop, StartError};
use crate::in_time::{Drives, Prescribed};

impl Coupled {
    /// Lets these values drive fluid and grains from now on. Errors if the engine cannot take them.
    pub(super) fn follow(&mut self, drives: Drives) -> Result<(), StartError> {
        self.drives = Some(drives);
        self.put_values_of_now()
    }

    /// Gives fluid and grains the values of the coming step, where these change.
    pub(super) fn put_values_of_now(&mut self) -> Result<(), StartError> {
        let Some(drives) = &self.drives else { return Ok(()) };
        let now = self.fluid.setup().drive();
        let drive = drives.drive(now.clone(), self.steps);
        if drive != now {
            self.fluid.set_drive(&drive)?;
        }
        if let (Some(grains), Some(weight)) = (&mut self.grains, drives.weight_in(self.steps)) {
            grains.moving.set_gravity(weight);
        }
        Ok(())
    }

    /// The body force of the last step, whose loads are known; before the first step that of the first.
    pub fn body_force_of_last_step(&self) -> Option<Vec3> {
        let now = self.fluid.setup().body_force?;
        let last = self.steps.saturating_sub(1);
        Some(self.drives.as_ref().map_or(now, |drives| drives.body_force_in(now, last)))
    }

    /// Moves the solids, free or as prescribed, to where they are after the step that has just been counted.
    pub(super) fn move_solids(&mut self) -> Result<(), EngineStop> {
        let (last, now) = (self.steps - 1, self.steps as f64);
        let mut solids = self.moved_as_prescribed(last);
        // Contacts see the motion that takes a grain to where it is now, the fluid then that of now.
        self.prescribe(|prescribed| prescribed.through(last));
        self.move_grains(&mut solids)?;
        self.prescribe(|prescribed| prescribed.at(now));
        for prescribed in prescribed_of(self.drives.as_ref()) {
            let Motion { velocity, angular_velocity } = prescribed.at(now);
            for solid in &mut solids[prescribed.solids.clone()] {
                (solid.velocity, solid.angular_velocity) = (velocity, angular_velocity);
            }
        }
        self.turn_bodies(&mut solids)?;
        Ok(self.fluid.place_solids(solids)?)
    }

    /// Gives solids that are not free the motion that `own` has, or that of now where it changes.
    pub(super) fn prescribe_as(&mut self, own: &[Solid]) -> Result<(), EngineStop> {
        let mut solids = self.solids();
        let now = self.steps as f64;
        let prescribed = prescribed_of(self.drives.as_ref());
        for (number, solid) in solids.iter_mut().enumerate() {
            let part = self.grains.as_ref().map(|grains| &grains.part);
            if part.is_some_and(|part| part.moves_solid(number)) {
                continue;
            }
            let changing = prescribed.iter().find(|all| all.solids.contains(&number));
            let own = || Motion {
                velocity: own[number].velocity,
                angular_velocity: own[number].angular_velocity,
            };
            let motion = changing.map_or_else(own, |prescribed| prescribed.at(now));
            (solid.velocity, solid.angular_velocity) = (motion.velocity, motion.angular_velocity);
            if let Some(Grains { moving, part }) = &mut self.grains
                && let Some(grain) = part.solids.iter().position(|&solid| solid == number)
            {
                moving.prescribe(grain, &motion);
            }
        }
        Ok(self.fluid.place_solids(solids)?)
    }

    /// The solids after step `step`, those that move as prescribed.
    fn moved_as_prescribed(&self, step: u64) -> Vec<Solid> {
        let mut solids = self.solids();
        for prescribed in prescribed_of(self.drives.as_ref()) {
            let Motion { velocity, .. } = prescribed.through(step);
            for solid in &mut solids[prescribed.solids.clone()] {
                solid.velocity = velocity;
            }
        }
        for solid in solids.iter_mut().filter(|solid| solid.moves()) {
            solid.centre += solid.velocity;
        }
        solids
    }

    /// Gives those of the grains that contacts know and whose prescribed motion changes another one.
    fn prescribe(&mut self, motion: impl Fn(&Prescribed) -> Motion) {
        let Some(Grains { moving, part }) = &mut self.grains else { return };
        for prescribed in prescribed_of(self.drives.as_ref()) {
            let motion = motion(prescribed);
            for (grain, solid) in part.solids.iter().enumerate() {
                if prescribed.solids.contains(solid) {
                    moving.prescribe(grain, &motion);
                }
            }
        }
    }
}

/// The solids whose prescribed motion changes.
fn prescribed_of(drives: Option<&Drives>) -> &[Prescribed] {
    drives.map_or(&[], |drives| &drives.prescribed)
}
