//! Warnings of runs that leave nothing behind.

use super::warning;
use crate::estimate::Warning;
use crate::scene::Scene;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    if scene.records.is_empty() && scene.exact.is_none() {
        return vec![warning("nothing is recorded", "add [[records]]")];
    }
    Vec::new()
}
