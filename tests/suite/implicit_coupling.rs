//! Free grains under full bounce-back: the CPU engine against the oracle, saved states, and what does not go with it.

use crate::common::Budget;
use crate::implicit::{self, CLOSED, STEPS};
use crate::scenes::{read, scene};
use psmrt::engine::EngineName;

#[test]
fn the_cpu_engine_moves_grains_as_the_oracle_does_to_round_off() {
    let mut budget = Budget::oracle(214_000);
    let steps = STEPS as f64;
    // Each of 24 steps rounds a population, of up to 1/3, a few tens of times in either, and the weights of cut cells
    // are some 1e-14 off (cpu_engine.rs), of changes of up to 0.05. Grains sum up some 200 cells and divide by masses
    // of 100; what they then do goes into the populations again.
    let double = steps * (16.0 * f64::EPSILON / 3.0 + 1e-14 * 0.05) * 10.0;
    // In single precision, of populations less their weights: up to 0.03.
    let single = steps * 0.03 * f64::from(f32::EPSILON) * 10.0;
    let engines = [(EngineName::Cpu, double), (EngineName::CpuSingle, single)];
    implicit::grains_move_as_in_the_oracle(&engines, None, &mut budget);
}

#[test]
fn engines_go_on_bit_for_bit_from_what_they_saved_during_contacts() {
    let mut budget = Budget::oracle(308_000);
    for engine in [EngineName::Reference, EngineName::Cpu, EngineName::CpuSingle] {
        let mut of_cpu = Budget::kernel(308_000);
        let budget = if engine == EngineName::Reference { &mut budget } else { &mut of_cpu };
        implicit::a_contact_goes_on_bit_for_bit(engine, None, budget);
    }
}

#[test]
fn averaged_loads_are_refused_with_a_way_out() {
    let averaged = CLOSED.replace("[engine]", "[coupling]\naverage_loads = true\n[engine]");
    let message = read(&averaged).unwrap_err();
    for word in ["coupling.average_loads", "full_bounce_back", "remove the key"] {
        assert!(message.contains(word), "{word} is missing: {message}");
    }
    // The way out.
    scene(&averaged.replace("\"full_bounce_back\"", "\"bounce_back\""));
    let graded = read(&CLOSED.replace("\"full_bounce_back\"", "\"graded_viscosity\"")).unwrap_err();
    assert!(graded.contains("solid.operator"), "{graded}");
}
