//! The extremes of `tests/suite/extremes.rs` on each engine.

use crate::common::Budget;
use crate::edges;
use crate::trials::EngineClaim;
use psmrt::engine::EngineName;

fn a_box_of_one_cell_gains_what_the_force_gives(engine: EngineName) {
    Budget::kernel(100).spend(edges::STEPS);
    // 20 roundings of populations some 1e-5 from their weights, over a lattice velocity of 2e-4.
    edges::one_cell(engine.word(), 1e-5);
}

fn a_channel_of_one_column_is_the_channel_of_nine(engine: EngineName) {
    Budget::kernel(2_000).spend(edges::STEPS * 80);
    // Shaders of different boxes may round differently: 20 steps of 6e-8.
    edges::one_column(engine.word(), 1e-5);
}

fn a_box_that_is_all_solid_stops_the_fluid(engine: EngineName) {
    Budget::kernel(2_000).spend(edges::STEPS * 64);
    // The rounding of 19 populations that are some 1e-3 from their weights.
    edges::all_solid(engine.word(), 1e-5);
}

fn what_is_at_rest_stays_at_rest_and_is_not_taken_for_steady(engine: EngineName) {
    Budget::kernel(11_000).spend(edges::STEPS * 512);
    edges::at_rest(engine.word());
}

fn scenes_that_break_are_stopped_and_leave_nothing_that_is_not_finite(engine: EngineName) {
    Budget::kernel(1_300_000).spend(200 * (4096 + 1728));
    edges::broken_scenes(engine.word());
}

/// What is claimed here.
pub const CLAIMS: &[EngineClaim] = &[
    ("a_box_of_one_cell_gains_what_the_force_gives", a_box_of_one_cell_gains_what_the_force_gives),
    (
        "a_channel_of_one_column_is_the_channel_of_nine",
        a_channel_of_one_column_is_the_channel_of_nine,
    ),
    ("a_box_that_is_all_solid_stops_the_fluid", a_box_that_is_all_solid_stops_the_fluid),
    (
        "what_is_at_rest_stays_at_rest_and_is_not_taken_for_steady",
        what_is_at_rest_stays_at_rest_and_is_not_taken_for_steady,
    ),
    (
        "scenes_that_break_are_stopped_and_leave_nothing_that_is_not_finite",
        scenes_that_break_are_stopped_and_leave_nothing_that_is_not_finite,
    ),
];
