//! Which values of a scene change in time, and what they are in a step.

use std::ops::Range;

use psmrt_reference::drive::{Drive, FaceValue};
use psmrt_reference::grains::contact::Motion;
use psmrt_reference::lattice::Vec3;

use super::signal::Signal;

/// What a face holds, where it changes.
#[derive(Clone, Debug, PartialEq)]
pub enum FaceSignal {
    /// It does not change.
    Constant,
    /// The velocity of a wall or of an inlet.
    Velocity(Signal<Vec3>),
    /// The density of a face of given pressure.
    Density(Signal<f64>),
}

impl FaceSignal {
    /// The values between which all others lie.
    pub fn corners(&self) -> Vec<FaceValue> {
        match self {
            FaceSignal::Constant => Vec::new(),
            FaceSignal::Velocity(signal) => {
                signal.corners().into_iter().map(FaceValue::Velocity).collect()
            }
            FaceSignal::Density(signal) => {
                signal.corners().into_iter().map(FaceValue::Density).collect()
            }
        }
    }

    fn end(&self) -> f64 {
        match self {
            FaceSignal::Constant => f64::NEG_INFINITY,
            FaceSignal::Velocity(signal) => signal.end(),
            FaceSignal::Density(signal) => signal.end(),
        }
    }
}

/// Solids that move with a velocity or an angular velocity that changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Prescribed {
    /// Their numbers.
    pub solids: Range<usize>,
    /// The number of their `[[grains]]` section.
    pub section: usize,
    /// Velocity.
    pub velocity: Signal<Vec3>,
    /// Angular velocity.
    pub angular_velocity: Signal<Vec3>,
}

impl Prescribed {
    /// The motion at a time.
    pub fn at(&self, time: f64) -> Motion {
        Motion {
            velocity: self.velocity.at(time),
            angular_velocity: self.angular_velocity.at(time),
        }
    }

    /// The motion with which it gets from where it is at `step` to where it is a step later.
    pub fn through(&self, step: u64) -> Motion {
        let (now, then) = (self.at(step as f64), self.at(step as f64 + 1.0));
        // (u(n) + u(n + 1))/2
        Motion {
            velocity: 0.5 * (now.velocity + then.velocity),
            angular_velocity: 0.5 * (now.angular_velocity + then.angular_velocity),
        }
    }
}

/// The values of a scene that change in time; lattice units, times in steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Drives {
    /// The faces, `[axis][side]`, the low side first.
    pub faces: [[FaceSignal; 2]; 3],
    /// Acceleration of the fluid by `body_force`.
    pub body_force: Signal<Vec3>,
    /// Gravity.
    pub gravity: Signal<Vec3>,
    /// The part of gravity that is a body force on the fluid.
    pub gravity_on_fluid: f64,
    /// Solids whose motion changes.
    pub prescribed: Vec<Prescribed>,
}

impl Drives {
    /// Whether anything changes.
    pub fn varies(&self) -> bool {
        let faces = self.faces.as_flattened();
        faces.iter().any(|face| *face != FaceSignal::Constant)
            || self.body_force.varies()
            || self.gravity.varies()
            || !self.prescribed.is_empty()
    }

    /// What drives the fluid in step `step`, and otherwise as `constant` has it.
    pub fn drive(&self, constant: Drive, step: u64) -> Drive {
        let mut drive = constant;
        let now = step as f64;
        drive.body_force = drive.body_force.map(|force| self.body_force_in(force, step));
        for (value, signal) in
            drive.faces.as_flattened_mut().iter_mut().zip(self.faces.as_flattened())
        {
            match signal {
                FaceSignal::Constant => {}
                FaceSignal::Velocity(signal) => *value = FaceValue::Velocity(signal.at(now + 0.5)),
                FaceSignal::Density(signal) => *value = FaceValue::Density(signal.at(now + 0.5)),
            }
        }
        drive
    }

    /// The body force in step `step`: `constant` if it does not change.
    pub fn body_force_in(&self, constant: Vec3, step: u64) -> Vec3 {
        let gravity_varies = self.gravity.varies() && self.gravity_on_fluid != 0.0;
        if !self.body_force.varies() && !gravity_varies {
            return constant;
        }
        let now = step as f64;
        self.body_force.at(now) + self.gravity_on_fluid * self.gravity.at(now)
    }

    /// Gravity on free grains in step `step`, if it changes.
    pub fn weight_in(&self, step: u64) -> Option<Vec3> {
        let now = step as f64;
        // (g(n) + g(n + 1))/2
        let mean = || 0.5 * (self.gravity.at(now) + self.gravity.at(now + 1.0));
        self.gravity.varies().then(mean)
    }

    /// The last time at which something changes; infinite if there is none.
    pub fn end(&self) -> f64 {
        self.all().into_iter().map(|(_, _, end)| end).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The keys of a scene whose values change, whether as a sine of that period in steps, and when each changes last.
    pub fn all(&self) -> Vec<(String, Option<f64>, f64)> {
        let period = |signal: &Signal<Vec3>| match signal {
            Signal::Sine { period, .. } => Some(*period),
            _ => None,
        };
        let mut all = Vec::new();
        for axis in 0..3 {
            for side in 0..2 {
                let signal = &self.faces[axis][side];
                let (key, period) = match signal {
                    FaceSignal::Constant => continue,
                    FaceSignal::Velocity(signal) => ("velocity", period(signal)),
                    FaceSignal::Density(Signal::Sine { period, .. }) => ("pressure", Some(*period)),
                    FaceSignal::Density(_) => ("pressure", None),
                };
                let name = ["x", "y", "z"][axis];
                let side = ["low", "high"][side];
                all.push((format!("faces.{name}_{side}.{key}"), period, signal.end()));
            }
        }
        let named = |key: &str, signal: &Signal<Vec3>| {
            signal.varies().then(|| (key.to_owned(), period(signal), signal.end()))
        };
        all.extend(named("body_force.acceleration", &self.body_force));
        all.extend(named("gravity.acceleration", &self.gravity));
        for Prescribed { section, velocity, angular_velocity, .. } in &self.prescribed {
            all.extend(named(&format!("grains[{section}].velocity"), velocity));
            all.extend(named(&format!("grains[{section}].spin"), angular_velocity));
        }
        all
    }
}
