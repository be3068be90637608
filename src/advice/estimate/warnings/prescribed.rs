//! Warnings of prescribed spheres whose way ends at a face or in another sphere.

use crate::advice::estimate::warning::{Warning, warning};
use crate::courses::{Lookout, leavings};
use crate::scene::Scene;

/// Places of spheres that are looked at, at most: a second's work. A run looks ahead as it goes.
const MOST_WORK: u64 = 5_000_000;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let mut warnings = Vec::new();
    if let Some(meeting) = Lookout::from_start(scene).meeting_until(scene.stop.steps, MOST_WORK) {
        let reason = format!("{}: the run stops there", meeting.said(scene));
        warnings.push(warning(reason, meeting.remedy(scene)));
    }
    if let Some((grain, face, step)) = leavings(scene).into_iter().min_by_key(|left| left.2) {
        let reason = format!(
            "prescribed grain {grain} begins to leave through the open face {face} after step {step} ({:.4e} s): the \
             force on it is then that on the part inside",
            step as f64 * scene.units.si_dt
        );
        warnings.push(warning(reason, "stop before, or lengthen the domain, if that is not meant"));
    }
    warnings
}
