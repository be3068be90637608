//! What the coupling carries of each grain from one step to the next.

use crate::grains::grain::Grain;
use crate::lattice::Vec3;
use crate::solids::Load;

/// Velocity and spin of a grain a step ago, and what has acted on it since.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LastStep {
    /// Velocity before the last step.
    pub velocity: Vec3,
    /// Spin before the last step.
    pub angular_velocity: Vec3,
    /// Load of the fluid during the last step.
    pub load: Load,
    /// All that acted on it besides contacts during the last step, the load included.
    pub outside: Load,
    /// What contacts gave it in the last step: the rest of its change of momentum. Nothing for a grain that is held.
    pub contacts: Load,
}

impl LastStep {
    /// Before the first step: as if the grain had always moved as it does, with no load.
    pub(super) fn at_rest(grain: &Grain) -> Self {
        Self::beginning(grain, &Load::default(), &Load::default())
    }

    /// A step begins, in which `outside` acts on `grain`, `load` of it from the fluid.
    pub(super) fn beginning(grain: &Grain, load: &Load, outside: &Load) -> Self {
        LastStep {
            velocity: grain.velocity,
            angular_velocity: grain.angular_velocity,
            load: *load,
            outside: *outside,
            contacts: Load::default(),
        }
    }

    /// The step has ended with `grain` as it is now.
    pub(super) fn end(&mut self, grain: &Grain) {
        if grain.held {
            return;
        }
        // C = M (v_(n+1) - v_n) - F - E,  and so for the moment
        self.contacts = Load {
            force: grain.mass * (grain.velocity - self.velocity) - self.outside.force,
            torque: grain.inertia * (grain.angular_velocity - self.angular_velocity)
                - self.outside.torque,
        };
    }

    /// What contacts are expected to give in the step that begins: what they gave in the last one, as far as something
    /// pressed against them.
    ///
    /// A grain that rests has them again, and a prediction without them would be that of a grain that falls. An impact
    /// is over: what is left of it is no more than all else that acted, `C min(1, |F + E|/|C|)`.
    pub(super) fn expected_contacts(&self) -> Load {
        Load {
            force: no_longer_than(self.contacts.force, self.outside.force.norm()),
            torque: no_longer_than(self.contacts.torque, self.outside.torque.norm()),
        }
    }
}

/// `vector`, cut to the length `most` if it is longer.
fn no_longer_than(vector: Vec3, most: f64) -> Vec3 {
    let length = vector.norm();
    if length > most { vector * (most / length) } else { vector }
}
