//! The extremes, on the oracle: scenes at the edge of what makes sense. (On the kernel: `tests/device/kernel_extremes.rs`.)

use crate::common::Budget;
use crate::edges;

#[test]
fn a_box_of_one_cell_gains_what_the_force_gives() {
    Budget::oracle(100).spend(edges::STEPS);
    // 20 roundings of a sum of 19 populations.
    edges::one_cell("reference", 1e-10);
}

#[test]
fn a_channel_of_one_column_is_the_channel_of_nine() {
    Budget::oracle(2_000).spend(edges::STEPS * 80);
    // The same sums in the same order, but for the mean over more cells.
    edges::one_column("reference", 1e-12);
}

#[test]
fn a_box_that_is_all_solid_stops_the_fluid() {
    Budget::oracle(2_000).spend(edges::STEPS * 64);
    // What is left is the rounding of 19 populations, over a lattice velocity of 1e-3.
    edges::all_solid("reference", 1e-11);
}

#[test]
fn what_is_at_rest_stays_at_rest_and_is_not_taken_for_steady() {
    Budget::oracle(11_000).spend(edges::STEPS * 512);
    edges::at_rest("reference");
}

#[test]
fn scenes_that_break_are_stopped_and_leave_nothing_that_is_not_finite() {
    // At most all their steps.
    Budget::oracle(1_300_000).spend(200 * (4096 + 1728));
    edges::broken_scenes("reference");
}
