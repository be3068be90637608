//! Warnings of faces that do not go together.

use psmrt_reference::domain::Face;

use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::Scene;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let faces = scene.setup.domain.faces();
    let has = |wanted: fn(&Face) -> bool| (0..3).any(|axis| faces.axis(axis).iter().any(wanted));
    if has(|face| matches!(face, Face::VelocityInlet { .. }))
        && !has(|face| face.held_density().is_some())
    {
        return vec![warning(
            "a velocity inlet with a free outflow does not determine the mean density",
            "use a `pressure` outlet (sound leaves through it with `non_reflecting = true`), or watch the column density \
             of a record `box`",
        )];
    }
    Vec::new()
}
