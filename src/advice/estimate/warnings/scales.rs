//! Warnings of the scales in lattice units: relaxation time, velocity, grid Reynolds number.

use psmrt_reference::lattice::viscosity;

use crate::advice::estimate::velocity::si_velocity;
use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::Scene;

/// Speeds above this Mach number make more than a few percent of error.
const HIGH_MACH: f64 = 0.17;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let tau = scene.setup.collision.tau();
    if let Some((si_speed, source)) = si_velocity(scene) {
        let speed = si_speed / scene.units.si_velocity();
        if speed * 3.0_f64.sqrt() > HIGH_MACH {
            warnings.push(warning(
                format!("the velocity from {source} is {speed:.3} cells per time step"),
                "use a shorter time step; below 0.05 errors of compressibility vanish",
            ));
        }
        let grid_reynolds = speed / viscosity(tau);
        if grid_reynolds > 10.0 {
            warnings.push(warning(
                format!("the grid Reynolds number is {grid_reynolds:.0}, above 10"),
                "use a finer grid: the flow has structures smaller than a cell",
            ));
        }
    }
    warnings
}
