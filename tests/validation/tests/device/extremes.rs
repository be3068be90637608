//! The extremes of `tests/validation/tests/suite/extremes.rs` on the kernel.

use crate::common::Budget;
use crate::edges;
use crate::trials::{self, Claim};
use psmrt::engine::EngineName;
use psmrt_validation::stability::Lab;

fn lab() -> Lab {
    Lab { gpu: Some(trials::gpu().unwrap()) }
}

fn a_solid_phase_without_solids_is_none() {
    edges::no_grains(EngineName::Wgpu, &lab(), &mut Budget::kernel(3_000));
}

fn units_from_nanometres_to_metres_give_the_same_lattice_numbers() {
    edges::any_units(EngineName::Wgpu, &lab(), &mut Budget::kernel(300_000));
}

fn runs_inside_the_frontiers_survive_and_those_outside_are_stopped() {
    let mut budget = Budget::kernel(17_500_000);
    for near in edges::near_frontiers() {
        edges::assert_near(&near, EngineName::Wgpu, &lab(), &mut budget);
    }
}

fn eight_grains_in_a_cell_and_the_briefest_contacts_live_and_too_few_sub_steps_are_refused() {
    edges::in_one_cell_and_too_hard(EngineName::Wgpu, &lab(), &mut Budget::kernel(2_000_000));
}

/// What is claimed here.
pub const CLAIMS: &[Claim] = &[
    ("a_solid_phase_without_solids_is_none", a_solid_phase_without_solids_is_none),
    (
        "units_from_nanometres_to_metres_give_the_same_lattice_numbers",
        units_from_nanometres_to_metres_give_the_same_lattice_numbers,
    ),
    (
        "runs_inside_the_frontiers_survive_and_those_outside_are_stopped",
        runs_inside_the_frontiers_survive_and_those_outside_are_stopped,
    ),
    (
        "eight_grains_in_a_cell_and_the_briefest_contacts_live_and_too_few_sub_steps_are_refused",
        eight_grains_in_a_cell_and_the_briefest_contacts_live_and_too_few_sub_steps_are_refused,
    ),
];
