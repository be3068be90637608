//! A scene whose values change in time, at its strongest: what is told before a run is told of that.

use std::borrow::Cow;

use psmrt_reference::drive::FaceValue;
use psmrt_reference::lattice::Vec3;

use super::Scene;
use crate::in_time::FaceSignal;

impl Scene {
    /// The same with each value that changes in time as large as it ever is, at the same time.
    pub fn at_its_strongest(&self) -> Cow<'_, Scene> {
        let Some(drives) = &self.drives else { return Cow::Borrowed(self) };
        let mut scene = self.clone();
        let mut drive = scene.setup.drive();
        let signals = drives.faces.as_flattened();
        for (value, signal) in drive.faces.as_flattened_mut().iter_mut().zip(signals) {
            match signal {
                FaceSignal::Constant => {}
                FaceSignal::Velocity(signal) => {
                    *value = FaceValue::Velocity(signal.largest(Vec3::norm));
                }
                FaceSignal::Density(signal) => {
                    *value = FaceValue::Density(signal.largest(|density| (density - 1.0).abs()));
                }
            }
        }
        let gravity = drives.gravity.largest(Vec3::norm);
        if drives.body_force.varies() || drives.gravity.varies() {
            drive.body_force = drive
                .body_force
                .map(|_| drives.body_force.largest(Vec3::norm) + drives.gravity_on_fluid * gravity);
        }
        // All of these have passed the checks of the scene.
        if scene.setup.set_drive(&drive).is_err() {
            return Cow::Borrowed(self);
        }
        if let Some(part) = scene.free.as_mut().filter(|_| drives.gravity.varies()) {
            part.settings.gravity = part.settings.gravity.map(|form| form.with(gravity));
        }
        for prescribed in &drives.prescribed {
            let phase = scene.setup.solid_phase.as_mut();
            let solids = phase.and_then(|phase| phase.solids.get_mut(prescribed.solids.clone()));
            for solid in solids.into_iter().flatten() {
                solid.velocity = prescribed.velocity.largest(Vec3::norm);
                solid.angular_velocity = prescribed.angular_velocity.largest(Vec3::norm);
            }
        }
        Cow::Owned(scene)
    }
}
