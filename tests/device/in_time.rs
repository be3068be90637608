//! Each engine with values of a scene that change in time.

use crate::common::Budget;
use crate::driven::in_time as driven;
use crate::trials::{EngineClaim, device_of};
use psmrt::engine::EngineName;

fn values_that_change_in_time_act_as_in_the_oracle(engine: EngineName) {
    let mut budget = Budget::kernel(330_000);
    let gpu = device_of(engine);
    driven::values_that_change_in_time_act_as_in_the_oracle(engine, gpu.as_ref(), &mut budget);
}

fn a_run_with_values_that_change_goes_on_from_any_step_with_the_same_bits(engine: EngineName) {
    let mut budget = Budget::kernel(200_000);
    let gpu = device_of(engine);
    driven::a_run_with_values_that_change_goes_on_from_any_step_with_the_same_bits(
        engine,
        gpu.as_ref(),
        &mut budget,
    );
}

fn a_table_of_one_value_gives_the_bits_of_the_value(engine: EngineName) {
    let mut budget = Budget::kernel(220_000);
    let gpu = device_of(engine);
    driven::a_table_of_one_value_gives_the_bits_of_the_value(engine, gpu.as_ref(), &mut budget);
}

/// What is claimed here.
pub const CLAIMS: &[EngineClaim] = &[
    (
        "values_that_change_in_time_act_as_in_the_oracle",
        values_that_change_in_time_act_as_in_the_oracle,
    ),
    (
        "a_run_with_values_that_change_goes_on_from_any_step_with_the_same_bits",
        a_run_with_values_that_change_goes_on_from_any_step_with_the_same_bits,
    ),
    (
        "a_table_of_one_value_gives_the_bits_of_the_value",
        a_table_of_one_value_gives_the_bits_of_the_value,
    ),
];
