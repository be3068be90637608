//! The extremes of set-ups, on the oracle: nothing solid, units from nanometres to metres, and runs on either
//! side of the frontiers of stability. (On the kernel: `tests/validation/tests/device/extremes.rs`.)

use crate::common::Budget;
use crate::edges;
use psmrt::engine::EngineName;
use psmrt_validation::stability::Lab;

const LAB: Lab = Lab { gpu: None };

#[test]
fn a_solid_phase_without_solids_is_none() {
    edges::no_grains(EngineName::Reference, &LAB, &mut Budget::oracle(3_000));
}

#[test]
fn units_from_nanometres_to_metres_give_the_same_lattice_numbers() {
    edges::any_units(EngineName::Reference, &LAB, &mut Budget::oracle(300_000));
}

#[test]
fn runs_inside_the_frontiers_survive_and_those_outside_are_stopped() {
    let mut budget = Budget::oracle(17_500_000);
    for near in edges::near_frontiers() {
        edges::assert_near(&near, EngineName::Reference, &LAB, &mut budget);
    }
}

#[test]
fn eight_grains_in_a_cell_and_the_briefest_contacts_live_and_too_few_sub_steps_are_refused() {
    edges::in_one_cell_and_too_hard(EngineName::Reference, &LAB, &mut Budget::oracle(2_000_000));
}
