//! The kernel against the oracle, cell by cell: one step of random states.
//!
//! Both start from the same populations, rounded to what single precision holds of them less their
//! weights. After one step the error of a population, divided by single precision's epsilon times the
//! gauge of its cell, must stay below 16; the gauge is the sum of the absolute values of what the
//! kernel adds up there: the populations less their weights before and after the collision.

mod common;

use std::process::ExitCode;

use common::collisions::{dhumieres, magic, srt};
use common::random::Random;
use common::{Budget, trials};
use psmrt::kernel::Kernel;
use psmrt_reference::collision::Collision;
use psmrt_reference::directions::Q;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::{Populations, Vec3, W};
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

const CELLS: [usize; 3] = [6, 5, 4];

/// What single precision holds of a population less its weight.
fn rounded(f: &Populations) -> Populations {
    #[expect(clippy::cast_possible_truncation, reason = "the point is to round")]
    std::array::from_fn(|a| f64::from((f[a] - W[a]) as f32) + W[a])
}

fn random_state(random: &mut Random, count: usize) -> Vec<Populations> {
    (0..count).map(|_| rounded(&random.populations())).collect()
}

/// Sum of the absolute values of the populations less their weights.
fn gauge(f: &Populations) -> f64 {
    (0..Q).map(|a| (f[a] - W[a]).abs()).sum()
}

/// Largest error after one step over epsilon times the largest gauge that met in it.
fn error_of_one_step(budget: &mut Budget, setup: &Setup, start: &[Populations]) -> f64 {
    let mut oracle = Solver::from_populations(setup.clone(), start.to_vec()).unwrap();
    budget.spend(start.len() as u64);
    oracle.step().unwrap();
    let mut kernel = Kernel::new(&trials::gpu().unwrap(), setup.clone(), false).unwrap();
    kernel.set_populations(start).unwrap();
    budget.advance(&mut kernel, 1);
    let all: Vec<usize> = (0..start.len()).collect();
    let found = kernel.populations(&all).unwrap();
    let mut worst = 0.0_f64;
    for (cell, (found, expected)) in found.iter().zip(oracle.populations()).enumerate() {
        let place = setup.domain.coordinates(cell).map(|x| i64::try_from(x).unwrap());
        // A population comes from this cell or one next to it.
        let mut largest = gauge(expected);
        for offset in 0..27_i64 {
            let near = [offset % 3 - 1, offset / 3 % 3 - 1, offset / 9 - 1];
            let near = std::array::from_fn(|axis| place[axis] + near[axis]);
            if let Some(near) = setup.domain.locate(near) {
                largest = largest.max(gauge(&start[setup.domain.index(near)]));
            }
        }
        for a in 0..Q {
            let error = (found[a] - expected[a]).abs() / (f64::from(f32::EPSILON) * largest);
            worst = worst.max(error);
        }
    }
    worst
}

fn collisions() -> Vec<(&'static str, Collision)> {
    let rates = Rates { e: 0.3, eps: 1.9, q: 0.7, nu: 1.0 / 0.9, pi: 1.1, m: 0.2 };
    vec![
        ("SRT", srt(0.8)),
        ("SRT near 1/2", srt(0.505)),
        ("d'Humieres", dhumieres(0.7)),
        ("d'Humieres near 1/2", dhumieres(0.505)),
        ("magic", magic(1.5, 0.1875)),
        ("all rates apart", Collision::Mrt { rates }),
    ]
}

const G: Vec3 = Vec3::new(1e-3, -2e-3, 5e-4);

/// The bound of one step, see the top of this file.
const BOUND: f64 = 16.0;

fn fluid_collides_and_streams_as_in_the_oracle_with_every_set_of_rates() {
    let mut budget = Budget::kernel(100_000);
    let mut random = Random(1);
    for (name, collision) in collisions() {
        for force in [None, Some(G)] {
            let domain = Domain::new(CELLS, Faces::PERIODIC).unwrap();
            let mut setup = Setup::fluid(domain, collision);
            setup.body_force = force;
            let start = random_state(&mut random, 120);
            let error = error_of_one_step(&mut budget, &setup, &start);
            println!("{name}, force {force:?}: {error:.2}");
            assert!(error < BOUND, "{name}, force {force:?}: {error}");
        }
    }
}

const WEIGHTINGS: [Weighting; 2] = [Weighting::SolidFraction, Weighting::NobleTorczynski];
const OPERATORS: [SolidOperator; 2] =
    [SolidOperator::NonEquilibriumBounceBack, SolidOperator::Superposition];

/// Solids with given fractions of all cells, of which each has up to three; some are full, some bare.
fn given_fractions(random: &mut Random, moving: bool) -> Vec<Solid> {
    (0..3)
        .map(|_| {
            let mut fractions = Vec::new();
            for cell in 0..CELLS.iter().product() {
                match random.between(0.0, 3.0) {
                    x if x < 0.3 => fractions.push((cell, 1.0)),
                    x if x < 2.0 => fractions.push((cell, random.between(0.0, 1.0))),
                    _ => {}
                }
            }
            let velocity = if moving { random.vector(0.05) } else { Vec3::zeros() };
            let spin = if moving { random.vector(0.01) } else { Vec3::zeros() };
            Solid { velocity, spin, ..Solid::fixed_cells(fractions) }
        })
        .collect()
}

fn solid_part_is_that_of_the_oracle_for_every_weighting_and_operator_with_given_fractions() {
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
                let error = error_of_one_step(&mut budget, &setup, &start);
                println!("{name}, {weighting:?}, {operator:?}, moving {moving}: {error:.2}");
                assert!(error < BOUND, "{name}, {weighting:?}, {operator:?}: {error}");
            }
        }
    }
}

/// Boxes in which every kind of face meets every other at an edge.
fn mixed_faces() -> Vec<Faces> {
    let lid = Face::Wall { velocity: Vec3::new(0.03, -0.02, 0.0) };
    let side = Face::Wall { velocity: Vec3::new(0.0, 0.02, -0.01) };
    let inlet = Face::VelocityInlet { velocity: Vec3::new(0.04, 0.01, -0.01) };
    let [low, high] = [0.98, 1.01].map(|density| Face::Pressure { density });
    let (slip, out, wall) = (Face::FreeSlip, Face::FreeOutflow, Face::wall());
    let periodic = [Face::Periodic; 2];
    vec![
        Faces { x: [wall; 2], y: [wall; 2], z: [wall, lid] },
        Faces { x: [inlet, out], y: periodic, z: [wall, lid] },
        Faces { x: [inlet, high], y: [slip; 2], z: [slip, wall] },
        Faces { x: [inlet, high], y: [slip, out], z: [low, lid] },
        Faces { x: [side, slip], y: [low, high], z: periodic },
        Faces { x: [low, out], y: [high, slip], z: [out, low] },
        Faces { x: [slip, out], y: [out, slip], z: [inlet, out] },
        Faces { x: periodic, y: [slip, low], z: [high, slip] },
    ]
}

fn every_face_and_edge_lets_in_what_the_oracles_does() {
    let mut budget = Budget::kernel(100_000);
    let mut random = Random(3);
    for (case, faces) in mixed_faces().into_iter().enumerate() {
        for cells in [CELLS, [1, 5, 4], [6, 1, 1], [1, 1, 1]] {
            let domain = Domain::new(cells, faces).unwrap();
            let setup = Setup::fluid(domain, dhumieres(0.7));
            let start = random_state(&mut random, setup.domain.cell_count());
            // Two steps: the first collides only, the faces come in at what is seen after it.
            let error = error_of_one_step(&mut budget, &setup, &start);
            println!("faces {case}, {cells:?}: {error:.2}");
            assert!(error < BOUND, "faces {case}, {cells:?}: {error}");
        }
    }
}

fn main() -> ExitCode {
    trials::run(&[
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
    ])
}
