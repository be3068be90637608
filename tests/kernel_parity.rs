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

fn main() -> ExitCode {
    trials::run(&[(
        "fluid_collides_and_streams_as_in_the_oracle_with_every_set_of_rates",
        fluid_collides_and_streams_as_in_the_oracle_with_every_set_of_rates,
    )])
}
