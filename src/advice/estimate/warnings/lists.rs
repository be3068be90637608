//! Warnings of columns of grain lists that are not used.

use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::{Attachment, Scene};

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let unused = scene.attachments.iter().filter(|list| !list.unused.is_empty());
    let of_list = |list: &Attachment| {
        let (key, columns) = (&list.key, list.unused.join(" and "));
        warning(
            format!("the {columns} in the list of {key} are not used: its grains are not free"),
            "add `motion = \"free\"` to them if they are to move, or remove the column",
        )
    };
    unused.map(of_list).collect()
}
