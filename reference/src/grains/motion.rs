//! Motion of grains: velocity Verlet, and the length of a sub-step.
//!
//! ```text
//!   v' = v + a dt/2;   x += v' dt;   a from the forces at the new x;   v = v' + a dt/2
//! ```
//!
//! and likewise for the angular velocity. The springs move with `v'`, as the centres do; the dashpots act on the
//! velocity at the end of the sub-step, foretold as `v' + a dt/2` with the old `a`, which keeps
//! second order.
//!
//! How long a sub-step may be is measured in shortest contact times ([`ContactLaw::shortest_time`]).
//! Largest error of the restitution of a central impact, over restitutions from 0.05 to 1 and wherever
//! in a sub-step the contact begins and ends (`tests/oracle/grains_motion.rs`):
//!
//! | sub-steps per contact | 10 | 15 | 25 | 50 |
//! |---|---|---|---|---|
//! | damped | 0.016 | 0.0073 | 0.0027 | 0.0007 |
//! | undamped | 0.0113 | 0.0052 | 0.0019 | 0.0005 |
//!
//! Hertz's contacts are resolved as well ([`HertzLaw::shortest_time`]); their dashpots start as the fourth root of the
//! overlap, which costs damped impacts an order: they converge as the power 5/4 of the sub-step.
//!
//! [`HertzLaw::shortest_time`]: crate::grains::hertz::HertzLaw::shortest_time
//! [`ContactLaw::shortest_time`]: crate::grains::law::ContactLaw::shortest_time

use crate::grains::contact::Motion;
use crate::grains::grain::Grain;
use crate::lattice::Vec3;
use crate::solids::Load;
use nalgebra::UnitQuaternion;
use thiserror::Error;

/// Sub-steps in the shortest contact time, if the caller leaves the choice to us.
pub const SUBSTEPS_PER_CONTACT: f64 = 25.0;

/// Fewest sub-steps in the shortest contact time that are accepted.
pub const FEWEST_SUBSTEPS_PER_CONTACT: f64 = 10.0;

/// How the sub-steps of a step are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Substeps {
    /// As many as make them a 25th of the shortest contact time or shorter.
    #[default]
    Automatic,
    /// This many, refused if they are too long.
    Fixed(u32),
}

/// A sub-step that cannot be used.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SubstepError {
    /// Contacts would be over before they are seen.
    #[error(
        "sub-step = {substep} is too long: at most {longest}, a tenth of the shortest contact time \
         {shortest_time}, is allowed; make at least {needed} sub-steps per step, or lengthen the \
         contact duration (lower the stiffness)"
    )]
    TooLong {
        /// The sub-step as given.
        substep: f64,
        /// The longest that is accepted.
        longest: f64,
        /// The shortest contact time.
        shortest_time: f64,
        /// Fewest sub-steps in the step.
        needed: f64,
    },
    /// The step is negative or not a number.
    #[error("time step = {value}: it must be positive and finite")]
    Step {
        /// The step as given.
        value: f64,
    },
    /// No sub-steps at all.
    #[error("sub-steps = 0: there must be at least 1; leave the number out to have it chosen")]
    None,
}

/// The number of sub-steps of a step `dt`, and their length. Errors if they would be too long.
pub fn divide(dt: f64, shortest_time: f64, choice: Substeps) -> Result<(u32, f64), SubstepError> {
    if !(dt > 0.0 && dt.is_finite()) {
        return Err(SubstepError::Step { value: dt });
    }
    let longest = shortest_time / FEWEST_SUBSTEPS_PER_CONTACT;
    let needed = |per_contact: f64| (dt * per_contact / shortest_time).ceil().max(1.0);
    let count = match choice {
        Substeps::Fixed(0) => return Err(SubstepError::None),
        Substeps::Fixed(count) => f64::from(count),
        Substeps::Automatic => needed(SUBSTEPS_PER_CONTACT),
    };
    let substep = dt / count;
    // Beyond 2^32 sub-steps per step something is wrong with the time scales.
    if substep > longest || count > f64::from(u32::MAX) {
        let needed = needed(FEWEST_SUBSTEPS_PER_CONTACT);
        return Err(SubstepError::TooLong { substep, longest, shortest_time, needed });
    }
    Ok((whole(count), substep))
}

/// A whole number in the range of `u32` that was computed as a floating-point one.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked by divide")]
fn whole(count: f64) -> u32 {
    count as u32
}

/// Motion of a grain in the course of a sub-step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course {
    /// In its middle.
    pub middle: Motion,
    /// At its end, as foretold from the old forces.
    pub end: Motion,
}

impl Course {
    /// The motion of a grain now, as a sub-step of no length.
    pub fn now(grain: &Grain) -> Self {
        let motion = Motion { velocity: grain.velocity, angular_velocity: grain.angular_velocity };
        Course { middle: motion, end: motion }
    }

    /// The course that a grain takes under `load` in a sub-step `dt`.
    pub fn ahead(grain: &Grain, load: &Load, gravity: &Vec3, dt: f64) -> Self {
        // v' = v + a dt/2
        let a = acceleration(grain, load, gravity);
        let after = |time: f64| Motion {
            velocity: grain.velocity + a.velocity * time,
            angular_velocity: grain.angular_velocity + a.angular_velocity * time,
        };
        Course { middle: after(0.5 * dt), end: after(dt) }
    }
}

/// Moves a grain along its course, to the end of the sub-step `dt`; its velocity stays behind.
pub fn drift(grain: &mut Grain, course: &Course, dt: f64) {
    // x += v' dt
    grain.position += course.middle.velocity * dt;
    grain.orientation =
        UnitQuaternion::new(course.middle.angular_velocity * dt) * grain.orientation;
    grain.orientation.renormalize_fast();
}

/// The velocity at the end of the sub-step `dt`, under the load there.
pub fn kick(grain: &mut Grain, course: &Course, load: &Load, gravity: &Vec3, dt: f64) {
    // v = v' + a dt/2
    let a = acceleration(grain, load, gravity);
    grain.velocity = course.middle.velocity + a.velocity * (0.5 * dt);
    grain.angular_velocity = course.middle.angular_velocity + a.angular_velocity * (0.5 * dt);
}

/// Acceleration (length/time²) and angular acceleration (1/time²) of a grain under `load`; zero if
/// it is held.
fn acceleration(grain: &Grain, load: &Load, gravity: &Vec3) -> Motion {
    if grain.held {
        return Motion { velocity: Vec3::zeros(), angular_velocity: Vec3::zeros() };
    }
    // a = F/m + g,  dω/dt = T/I (a sphere: no gyroscopic term)
    Motion {
        velocity: load.force / grain.mass + gravity,
        angular_velocity: load.torque / grain.inertia,
    }
}
