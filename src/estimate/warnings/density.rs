//! Warnings of grains too light for the fluid inside them.

use psmrt_reference::grains::grain::sphere_volume;

use super::warning;
use crate::estimate::Warning;
use crate::estimate::grains::free;
use crate::scene::Scene;

/// Smallest density ratio that was right with the inertia of the fluid inside given back a step later, and
/// kept, at tau up to 1; the next smaller that was tried, 0.5, broke at tau of 0.6 and more either way:
/// golden/stability/movers.csv.
const LIGHT: f64 = 0.8;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let Some(part) = &scene.free else { return Vec::new() };
    let lightest = free(part)
        .map(|grain| grain.mass / (part.settings.fluid_density * sphere_volume(grain.radius)))
        .fold(f64::INFINITY, f64::min);
    if lightest < LIGHT {
        let reason = format!(
            "a grain of {lightest:.2} times the density of the fluid: grains lighter than {LIGHT} times were driven \
             by the inertia of the fluid inside until the run broke (golden/stability/movers.csv)"
        );
        return vec![warning(reason, "use denser grains: psmrt has no scheme for light ones")];
    }
    Vec::new()
}
