//! Warnings of contacts that are too soft, too short or too dear.

use super::warning;
use crate::estimate::Warning;
use crate::estimate::grains::{free, overlaps};
use crate::scene::Scene;

/// A grain pressed in by more than this share of its diameter is no hard sphere any more.
const DEEP: f64 = 0.01;

/// Contacts shorter than so many time steps are over before the fluid takes part.
const BRIEF: f64 = 4.0;

/// More sub-steps than this in a time step begin to cost as much as the fluid.
const MANY: u32 = 100;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let Some(part) = &scene.free else { return Vec::new() };
    let mut warnings = Vec::new();
    let [_, under] = overlaps(scene, part);
    if under > DEEP {
        let reason = format!("weight presses grains into each other by {under:.1e} of a diameter");
        let remedy = "make contacts shorter (contact.duration) or stiffer (contact.stiffness)";
        warnings.push(warning(reason, remedy));
    }
    let pair = 0.5 * free(part).map(|grain| grain.mass).fold(f64::INFINITY, f64::min);
    let duration = part.setup.law.duration(pair);
    if duration < BRIEF {
        let reason = format!(
            "contacts last {duration:.1} time steps: the load of the fluid is held during a step, and it \
             hardly takes part"
        );
        warnings.push(warning(reason, "make contacts last 10 time steps (contact.duration)"));
    }
    if let Some(count) = part.substeps().ok().filter(|&count| count > MANY) {
        let reason = format!(
            "the grains make {count} sub-steps in a time step: they cost more than the fluid"
        );
        let remedy = "make contacts last longer (contact.duration), 10 time steps are usual";
        warnings.push(warning(reason, remedy));
    }
    warnings
}
