//! Free grains among other solids, on the oracle (on other engines: `tests/device/kernel_engine.rs`), and grains that are
//! none of the solids.

use crate::common::Budget;
use crate::mixed;
use psmrt::engine::{EngineName, StartError, starting_from};
use psmrt::scene::Scene;
use psmrt_reference::lattice::Vec3;

#[test]
fn grains_among_other_solids_move_the_same_in_whatever_order_they_are_listed() {
    let mut budget = Budget::oracle(600_000);
    // No cell is shared by two of them: not even the order of a sum differs.
    mixed::grains_among_other_solids_move_the_same_in_whatever_order_they_are_listed(
        EngineName::Reference,
        None,
        &mut budget,
        1e-15,
    );
}

#[test]
fn a_grain_that_is_none_of_the_solids_or_not_alone_one_is_refused() {
    let file = std::path::Path::new("golden/cloud_settling/scene.toml");
    let scene = Scene::load(file, &[]).unwrap_or_else(|error| panic!("{error}"));
    let part = scene.free.clone().unwrap();
    let count = part.grains.len();
    for (wrong, named) in [(vec![count; 1], (0, count)), (vec![0, 0], (1, 0)), (vec![], (0, 0))] {
        let mut part = part.clone();
        part.solids.splice(0..wrong.len().max(1), wrong.iter().copied());
        if wrong.is_empty() {
            part.solids.clear();
        }
        let start = |_| (1.0, Vec3::zeros());
        let error = starting_from(EngineName::Reference, &scene.setup, Some(&part), None, start)
            .unwrap_err();
        let StartError::NoSolid { grain, solid, .. } = error else { panic!("{error}") };
        assert_eq!((grain, solid), named);
    }
}
