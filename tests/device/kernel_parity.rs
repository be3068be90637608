//! Each engine against the oracle, cell by cell: one step of random states.
//!
//! Both start from the same populations, rounded to what single precision holds of them less their
//! weights. After one step the error of a population, divided by single precision's epsilon times the
//! gauge of its cell, must stay below 16; the gauge is the sum of the absolute values of what the
//! engine adds up there: the populations less their weights before and after the collision.

use crate::common::Budget;
use crate::common::collisions::dhumieres;
use crate::common::random::Random;
use crate::parity::{
    CELLS, G, OPERATORS, WEIGHTINGS, collisions, error_of_one_step, given_fractions, mixed_faces,
    random_state,
};
use crate::trials::EngineClaim;
use psmrt::engine::EngineName;
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::setup::{Setup, SolidPhase};

/// The bound of one step, see the top of this file.
const BOUND: f64 = 16.0;

fn fluid_collides_and_streams_as_in_the_oracle_with_every_set_of_rates(engine: EngineName) {
    let mut budget = Budget::kernel(100_000);
    let mut random = Random(1);
    for (name, collision) in collisions() {
        for force in [None, Some(G)] {
            let domain = Domain::new(CELLS, Faces::PERIODIC).unwrap();
            let mut setup = Setup::fluid(domain, collision);
            setup.body_force = force;
            let start = random_state(&mut random, 120);
            let error = error_of_one_step(engine, &mut budget, &setup, &start);
            println!("{name}, force {force:?}: {error:.2}");
            assert!(
                error < BOUND,
                "{name}, force {force:?}: populations after a step are {error} times as far \
                 from the oracle's as single precision explains, {BOUND} is allowed",
            );
        }
    }
}

fn solid_part_is_that_of_the_oracle_for_every_weighting_and_operator_with_given_fractions(
    engine: EngineName,
) {
    let mut budget = Budget::kernel(100_000);
    let mut random = Random(2);
    for (name, collision) in collisions() {
        for (weighting, operator) in WEIGHTINGS.into_iter().flat_map(|w| OPERATORS.map(|o| (w, o)))
        {
            for (moving, force) in [(false, None), (true, Some(G)), (true, None)] {
                let solids = given_fractions(&mut random, moving);
                let phase = SolidPhase { solids, weighting, operator, ..SolidPhase::default() };
                let domain = Domain::new(CELLS, Faces::PERIODIC).unwrap();
                let mut setup = Setup::fluid(domain, collision).with_solids(phase);
                setup.body_force = force;
                let start = random_state(&mut random, 120);
                let error = error_of_one_step(engine, &mut budget, &setup, &start);
                println!("{name}, {weighting:?}, {operator:?}, moving {moving}: {error:.2}");
                assert!(
                    error < BOUND,
                    "{name}, {weighting:?}, {operator:?}: populations after a step are {error} \
                     times as far from the oracle's as single precision explains, {BOUND} is \
                     allowed",
                );
            }
        }
    }
}

fn every_face_and_edge_lets_in_what_the_oracles_does(engine: EngineName) {
    let mut budget = Budget::kernel(100_000);
    let mut random = Random(3);
    for (case, faces) in mixed_faces().into_iter().enumerate() {
        for cells in [CELLS, [1, 5, 4], [6, 1, 1], [1, 1, 1]] {
            let domain = Domain::new(cells, faces).unwrap();
            let setup = Setup::fluid(domain, dhumieres(0.7));
            let start = random_state(&mut random, setup.domain.cell_count());
            // Two steps: the first collides only, the faces come in at what is seen after it.
            let error = error_of_one_step(engine, &mut budget, &setup, &start);
            println!("faces {case}, {cells:?}: {error:.2}");
            assert!(
                error < BOUND,
                "faces {case}, {cells:?}: populations after a step are {error} times as far \
                 from the oracle's as single precision explains, {BOUND} is allowed: which \
                 face rule differs?",
            );
        }
    }
}

/// What is claimed here.
pub const CLAIMS: &[EngineClaim] = &[
    (
        "fluid_collides_and_streams_as_in_the_oracle_with_every_set_of_rates",
        fluid_collides_and_streams_as_in_the_oracle_with_every_set_of_rates,
    ),
    (
        "solid_part_is_that_of_the_oracle_for_every_weighting_and_operator_with_given_fractions",
        solid_part_is_that_of_the_oracle_for_every_weighting_and_operator_with_given_fractions,
    ),
    (
        "every_face_and_edge_lets_in_what_the_oracles_does",
        every_face_and_edge_lets_in_what_the_oracles_does,
    ),
];
