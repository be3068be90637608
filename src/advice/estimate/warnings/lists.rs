//! Warnings of columns of grain lists that are not used.

use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::Scene;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let unused = scene.attachments.iter().filter(|list| list.unused_densities);
    let of_list = |key: &str| {
        warning(
            format!("the densities in the list of {key} are not used: its grains are not free"),
            "add `motion = \"free\"` to them if they are to move, or remove the column",
        )
    };
    unused.map(|list| of_list(&list.key)).collect()
}
