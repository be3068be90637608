//! How far the kernel is from the oracle, over what single precision explains:
//! `cargo run -p psmrt-validation --example kernel_parity > golden/kernel_parity/parity.csv`.
//!
//! The same scenes and bounds as `tests/device/kernel_parity.rs` and `tests/device/kernel_runs.rs`, which say where the
//! bounds come from.

#[path = "../../common/mod.rs"]
mod common;
#[path = "../../parity/mod.rs"]
mod parity;
#[path = "../../trials/mod.rs"]
mod trials;

use common::Budget;
use common::random::Random;
use common::solid_rules::solid_rules;
use parity::{
    Both, CELLS, G, collisions, error_of_one_step, given_fractions, mixed_faces, random_state,
    scenes, waves,
};
use psmrt::engine::EngineName;
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::setup::{Setup, SolidPhase};

fn row(what: &str, steps: u64, quantity: &str, error: f64, allowed: f64) {
    println!("{},{steps},{quantity},{error:.2e},{allowed:.0}", what.replace(',', ";"));
}

fn one_step(budget: &mut Budget) {
    let mut random = Random(1);
    let periodic = || Domain::new(CELLS, Faces::PERIODIC).expect("a box");
    let mut measure = |what: &str, setup: &Setup, random: &mut Random| {
        let start = random_state(random, setup.domain.cell_count());
        let error = error_of_one_step(EngineName::Wgpu, budget, setup, &start);
        row(what, 1, "populations over epsilon times gauge", error, 16.0);
    };
    for (name, collision) in collisions() {
        measure(name, &Setup::fluid(periodic(), collision), &mut random);
        let forced = Setup::fluid(periodic(), collision).with_body_force(G);
        measure(&format!("{name}; body force"), &forced, &mut random);
    }
    let (_, collision) = collisions().remove(3);
    for (operator, weighting) in solid_rules() {
        for moving in [false, true] {
            let solids = given_fractions(&mut random, moving);
            let phase = SolidPhase { solids, weighting, operator, ..SolidPhase::default() };
            let setup = Setup::fluid(periodic(), collision).with_solids(phase);
            let motion = if moving { "moving" } else { "fixed" };
            let what = format!("d'Humieres; {motion} solids; {weighting:?}; {operator:?}");
            measure(&what, &setup, &mut random);
        }
    }
    for (number, faces) in mixed_faces().into_iter().enumerate() {
        let setup = Setup::fluid(Domain::new(CELLS, faces).expect("a box"), collision);
        measure(&format!("d'Humieres; faces {}", number + 1), &setup, &mut random);
    }
}

fn many_steps(budget: &mut Budget) {
    for steps in [100, 1000] {
        let mut random = Random(2);
        for (name, setup) in scenes() {
            let start = waves(&mut random, &setup.domain);
            let mut both = Both::new(EngineName::Wgpu, &setup, &start);
            both.run(budget, steps);
            let errors = both.errors();
            row(name, steps, "populations over bound", errors.populations, 1.0);
            if setup.solid_phase.as_ref().is_some_and(|phase| !phase.solids.is_empty()) {
                row(name, steps, "forces over bound", errors.forces, 1.0);
                row(name, steps, "torques over bound", errors.torques, 1.0);
            }
        }
    }
}

fn main() {
    let gpu = trials::gpu().expect("an adapter");
    let facts = gpu.facts();
    println!("# The kernel against the oracle: the largest error of any cell or solid over what");
    println!(
        "# single precision explains (tests/device/kernel_parity.rs, tests/device/kernel_runs.rs)."
    );
    println!(
        "# Made by: cargo run -p psmrt-validation --example kernel_parity > golden/kernel_parity/parity.csv"
    );
    println!("# Adapter: {} ({}, {}; {})", facts.name, facts.kind, facts.backend, facts.driver);
    println!("scene,steps,quantity,error,allowed");
    let mut budget = Budget::kernel(20_000_000);
    one_step(&mut budget);
    many_steps(&mut budget);
    // Its last line is for tests.
    std::mem::forget(budget);
}
