//! Warnings of runs that record nothing, or rows at other times than those asked for.

use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::{OutputInterval, Scene};

/// Rows further apart or closer than asked for by this share cause a warning.
const OFF: f64 = 0.01;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    if scene.records.is_empty() && scene.exact.is_none() {
        return vec![warning("nothing is recorded", "add [[records]]")];
    }
    let mut warnings = Vec::new();
    for record in &scene.records {
        let (OutputInterval::Every(steps), Some(si_every)) = (record.interval, record.si_every)
        else {
            continue;
        };
        let si_dt = scene.units.si_dt;
        let si_taken = steps as f64 * si_dt;
        if (si_taken / si_every - 1.0).abs() <= OFF {
            continue;
        }
        warnings.push(warning(
            format!(
                "record {}: `every` = {si_every:e} s is {:.2} time steps; rows are taken every {steps}, {si_taken:.4e} s",
                record.name,
                si_every / si_dt
            ),
            "give `every_steps`, a longer `every`, or a time step that divides it (`time.dt`)",
        ));
    }
    warnings
}
