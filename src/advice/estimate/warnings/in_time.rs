//! Warnings of values that change in time: faster than the time step or the grid resolves, or not as long as the run.

use std::f64::consts::TAU;

use psmrt_reference::lattice::viscosity;

use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::Scene;

/// Time steps of a period with which the error of second order, `(ω dt)²/12`, is below a thousandth.
const STEPS_OF_PERIOD: f64 = 50.0;

/// Cells across an oscillating boundary layer, `√(2ν/ω)`, below which it is not resolved.
const CELLS_OF_LAYER: f64 = 2.0;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let Some(drives) = &scene.drives else { return Vec::new() };
    let (units, stop) = (&scene.units, scene.stop.steps as f64);
    let mut warnings = Vec::new();
    for (key, period, end) in drives.all() {
        match period {
            Some(period) => {
                if period < STEPS_OF_PERIOD {
                    warnings.push(warning(
                        format!("the period of {key} is {period:.1} time steps: its phase is not resolved"),
                        format!(
                            "use time.dt = {:.3e} (s) or less, for {STEPS_OF_PERIOD} steps",
                            period * units.si_dt / STEPS_OF_PERIOD
                        ),
                    ));
                }
                // δ = √(2ν/ω)
                let layer =
                    (2.0 * viscosity(scene.setup.collision.tau()) * period / TAU).sqrt();
                if layer < CELLS_OF_LAYER {
                    warnings.push(warning(
                        format!(
                            "the boundary layer of the oscillation of {key}, sqrt(2 nu/omega) = {:.3e} m, is {layer:.1} \
                             cells",
                            layer * units.si_dx
                        ),
                        format!(
                            "use domain.dx = {:.3e} (m) or less if walls or grains matter",
                            layer / CELLS_OF_LAYER * units.si_dx
                        ),
                    ));
                }
            }
            None if end < stop => warnings.push(warning(
                format!(
                    "{key} changes until {:.4e} s and keeps its last value then; the run ends at {:.4e} s",
                    end * units.si_dt,
                    stop * units.si_dt
                ),
                "nothing is wrong if that is meant; else give it rows to the end",
            )),
            None => {}
        }
    }
    if scene.stop.steady.is_some() {
        let reason =
            "values change in time: [stop.steady] may be met before they have come to their ends";
        warnings
            .push(warning(reason.to_owned(), "remove [stop.steady], or make the values constant"));
    }
    warnings
}
