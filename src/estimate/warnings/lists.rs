//! Warnings of what lists of grains say and nobody uses.

use super::warning;
use crate::estimate::Warning;
use crate::scene::Scene;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let unused = scene.attachments.iter().filter(|list| list.unused_densities);
    let of_list = |number: usize| {
        warning(
            format!(
                "the densities in the list of grains[{number}].file mean nothing: its grains are not free"
            ),
            "add `motion = \"free\"` to them if they are to move, or remove the column",
        )
    };
    unused.map(|list| of_list(list.section)).collect()
}
