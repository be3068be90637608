//! Each engine against the oracle, cell by cell: one step of random states.
//!
//! Both start from the same populations, rounded to what single precision holds of them less their
//! weights. After one step the error of a population, divided by single precision's epsilon times the
//! gauge of its cell, must stay below 16; the gauge is the sum of the absolute values of what the
//! engine adds up there: the populations less their weights before and after the collision.

use crate::common::Budget;
use crate::common::collisions::dhumieres;
use crate::common::random::Random;
use crate::common::solid_rules::solid_rules;
use crate::parity::{
    Both, CELLS, G, collisions, error_of_one_step, given_fractions, mixed_faces, random_state,
    sphere, waves,
};
use crate::trials::EngineClaim;
use psmrt::engine::EngineName;
use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::{Setup, SolidPhase};

/// A plane, a row and a single cell.
const FLAT: [[usize; 3]; 3] = [[1, 5, 4], [6, 1, 1], [1, 1, 1]];

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
    for (number, (name, collision)) in collisions().into_iter().enumerate() {
        // Three of seven in turn, so that each meets three collisions.
        for (operator, weighting) in solid_rules().into_iter().cycle().skip(3 * number).take(3) {
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
        // All in a box; of the flat ones, in which a cell lies at two faces, one for each set of faces in turn.
        for cells in [CELLS, FLAT[case % FLAT.len()]] {
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

fn spheres_on_the_move_cover_what_they_do_in_the_oracle_by_every_rule(engine: EngineName) {
    let mut budget = Budget::kernel(400_000);
    let mut random = Random(4);
    let domain = Domain::new([12, 11, 10], Faces::PERIODIC).unwrap();
    // Two that overlap, one that leaves through a side, one that stays; of sizes such that no sample point lies on a
    // surface, where rounding would decide.
    let solids = vec![
        sphere([3.3, 4.2, 5.0], 2.2137, Vec3::new(0.02, 0.0, -0.01), Vec3::new(0.0, 0.01, 0.0)),
        sphere([6.9, 4.6, 5.1], 2.0091, Vec3::new(-0.01, 0.01, 0.0), Vec3::zeros()),
        sphere([9.8, 9.0, 1.1], 1.7173, Vec3::new(0.05, 0.05, -0.05), Vec3::new(0.01, -0.02, 0.01)),
        sphere([9.0, 2.0, 7.9], 1.1311, Vec3::zeros(), Vec3::zeros()),
    ];
    for coverage in [CoverageRule::Exact, CoverageRule::Sampled { n: 5 }, CoverageRule::Linear] {
        for (operator, weighting) in
            [solid_rules()[0], solid_rules()[1], solid_rules()[4], solid_rules()[6]]
        {
            let solids = solids.clone();
            let phase = SolidPhase { solids, weighting, operator, coverage };
            let setup = Setup::fluid(domain.clone(), dhumieres(0.7)).with_solids(phase);
            let mut both = Both::new(engine, &setup, &waves(&mut random, &domain));
            // So many that a sphere enters and leaves cells.
            both.run(&mut budget, 20);
            let errors = both.errors();
            println!("{coverage:?}, {operator:?}, {weighting:?}: {errors:.2?}");
            assert!(
                errors.worst() < 1.0,
                "{coverage:?}, {operator:?}, {weighting:?}: after 20 steps populations and loads are these many times as far from the \
                 oracle's as rounding explains: {errors:.2?}",
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
    (
        "spheres_on_the_move_cover_what_they_do_in_the_oracle_by_every_rule",
        spheres_on_the_move_cover_what_they_do_in_the_oracle_by_every_rule,
    ),
];
