//! The kernel against the oracle over 100 and 1000 steps: populations, forces and torques; random
//! scenes; the same bits twice.
//!
//! **The bound.** One step rounds a population by about half an epsilon of its cell's gauge, the sum of
//! its populations less their weights (`kernel_parity.rs` prints 0.1 to 0.5). Errors of successive steps
//! are independent and the flow forgets or at worst keeps them, so that after n steps they add up to
//! √n times as much; four times that is
//!
//! ```text
//!   |f - f_oracle| < 2 √n ε g,    g the largest gauge that the oracle's run shows
//! ```
//!
//! The force on a solid is a sum of `B_s (j - ρ u_s)` over N cells, each j made of ten populations that
//! are off independently: √(10 N) times as much, and the torque the radius times that. Solid fractions are found by each in its own
//! way in double precision and rounded once; near tau = 1/2 the weight `B` magnifies that by `1/(2
//! (tau - 1/2))`, which stays below the bound at the 0.55 and more used here.

mod common;

use std::process::ExitCode;
use std::sync::Arc;

use common::collisions::{dhumieres, magic, srt};
use common::random::Random;
use common::{Budget, trials};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use psmrt::kernel::{Gpu, Kernel};
use psmrt_reference::collision::Collision;
use psmrt_reference::directions::Q;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::{Populations, Vec3, W};
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::{Shape, Solid};
use psmrt_reference::solver::Solver;

fn gauge(f: &Populations) -> f64 {
    (0..Q).map(|a| (f[a] - W[a]).abs()).sum()
}

/// A scene computed by both.
struct Both {
    oracle: Solver,
    kernel: Kernel,
    largest_gauge: f64,
}

/// Errors of populations, forces and torques over their bounds.
#[derive(Debug)]
struct Errors {
    populations: f64,
    forces: f64,
    torques: f64,
}

impl Errors {
    fn worst(&self) -> f64 {
        self.populations.max(self.forces).max(self.torques)
    }
}

impl Both {
    fn new(setup: &Setup, start: &[Populations]) -> Self {
        Self::on(&trials::gpu().unwrap(), setup, start)
    }

    fn on(gpu: &Arc<Gpu>, setup: &Setup, start: &[Populations]) -> Self {
        let oracle = Solver::from_populations(setup.clone(), start.to_vec()).unwrap();
        let mut kernel = Kernel::new(gpu, setup.clone(), false).unwrap();
        kernel.set_populations(start).unwrap();
        let largest_gauge = start.iter().map(gauge).fold(0.0, f64::max);
        Both { oracle, kernel, largest_gauge }
    }

    /// Makes `steps` steps, moving the solids of the kernel as the oracle moves its own.
    fn run(&mut self, budget: &mut Budget, steps: u64) {
        let solids =
            |solver: &Solver| solver.setup().solid_phase.as_ref().map(|p| p.solids.clone());
        let moves = solids(&self.oracle).is_some_and(|solids| solids.iter().any(Solid::moves));
        let batch = if moves { 1 } else { 10.min(steps) };
        for _ in 0..steps / batch {
            self.oracle.run(batch).unwrap();
            budget.advance(&mut self.kernel, batch);
            if moves {
                self.kernel.place_solids(solids(&self.oracle).unwrap()).unwrap();
            }
            let now = self.oracle.populations().iter().map(gauge).fold(0.0, f64::max);
            self.largest_gauge = self.largest_gauge.max(now);
        }
    }

    fn errors(&self) -> Errors {
        let steps = self.oracle.steps() as f64;
        let bound = 2.0 * steps.sqrt() * f64::from(f32::EPSILON) * self.largest_gauge;
        let all: Vec<usize> = (0..self.oracle.populations().len()).collect();
        let found = self.kernel.populations(&all).unwrap();
        let pairs = found.iter().flatten().zip(self.oracle.populations().iter().flatten());
        let populations = pairs.map(|(f, o)| (f - o).abs()).fold(0.0, f64::max) / bound;
        let (mut forces, mut torques) = (0.0_f64, 0.0_f64);
        let phase = self.oracle.setup().solid_phase.as_ref();
        let solids = phase.map_or(&[][..], |phase| &phase.solids);
        let loads = self.kernel.loads().unwrap();
        for ((load, expected), solid) in loads.iter().zip(self.oracle.loads()).zip(solids) {
            let Shape::Sphere { radius } = solid.shape else { unreachable!("only spheres here") };
            // Cells that it touches, and how far they are at most.
            let (cells, reach) = (4.2 * (radius + 0.8).powi(3), radius + 0.8);
            let bound = (10.0 * cells).sqrt() * bound;
            forces = forces.max((load.force - expected.force).norm() / bound);
            torques = torques.max((load.torque - expected.torque).norm() / (reach * bound));
        }
        Errors { populations, forces, torques }
    }
}

/// A slow flow of several waves: populations in equilibrium, a hundredth away from it.
fn waves(random: &mut Random, domain: &Domain) -> Vec<Populations> {
    let size = Vec3::from(domain.cells().map(|n| n as f64));
    let phase = random.vector(3.0);
    (0..domain.cell_count())
        .map(|cell| {
            let x = domain.centre(domain.coordinates(cell)).component_div(&size);
            let angle = |i: usize| std::f64::consts::TAU * x[i] + phase[i];
            let u = 0.03 * Vec3::new(angle(1).sin(), angle(2).cos(), angle(0).sin());
            let f = psmrt_reference::equilibrium::equilibrium(1.0 + 0.01 * angle(0).cos(), &u);
            // What single precision holds of it, so that both start from the same.
            std::array::from_fn(|a: usize| {
                let off = f[a] * (1.0 + random.between(-0.01, 0.01)) - W[a];
                #[expect(clippy::cast_possible_truncation, reason = "the point is to round")]
                let rounded = f64::from(off as f32);
                rounded + W[a]
            })
        })
        .collect()
}

fn sphere(centre: [f64; 3], radius: f64, velocity: Vec3, spin: Vec3) -> Solid {
    Solid { velocity, spin, ..Solid::fixed_sphere(Vec3::from(centre), radius) }
}

/// Scenes that between them hold every model and face.
fn scenes() -> Vec<(&'static str, Setup)> {
    let periodic = |cells| Domain::new(cells, Faces::PERIODIC).unwrap();
    let still = Vec3::zeros();
    let g = Vec3::new(1e-5, -2e-5, 5e-6);
    let lid = Face::Wall { velocity: Vec3::new(0.03, -0.02, 0.0) };
    let inlet = Face::VelocityInlet { velocity: Vec3::new(0.02, 0.0, 0.0) };
    let outlet = Face::Pressure { density: 1.0 };
    let walls = [Face::wall(), lid];
    let cavity = Faces { x: [Face::wall(); 2], y: [Face::FreeSlip, Face::wall()], z: walls };
    let channel = Faces { x: [inlet, outlet], y: [Face::FreeSlip; 2], z: [Face::wall(); 2] };
    let open = Faces { x: [inlet, Face::FreeOutflow], y: [Face::Periodic; 2], z: walls };
    let held = vec![sphere([5.2, 4.9, 5.3], 2.6, still, still)];
    let bed: Vec<Solid> = (0..8_u32)
        .map(|i| {
            let at = [i % 2, i / 2 % 2, i / 4].map(|k| 0.3 + 6.0 * f64::from(k));
            sphere(at, 2.9, still, still)
        })
        .collect();
    // Two that overlap in some cells, one that spins, one that leaves through a side.
    let moving = vec![
        sphere([3.3, 4.2, 5.0], 2.2, Vec3::new(0.02, 0.0, -0.01), Vec3::new(0.0, 0.01, 0.0)),
        sphere([7.4, 4.6, 5.1], 2.0, Vec3::new(-0.01, 0.01, 0.0), still),
        sphere([9.8, 9.0, 1.1], 1.7, still, Vec3::new(0.01, -0.02, 0.01)),
    ];
    let phase = |solids, weighting, operator| SolidPhase {
        solids,
        weighting,
        operator,
        ..SolidPhase::default()
    };
    let (nt, fraction) = (Weighting::NobleTorczynski, Weighting::SolidFraction);
    let (bounce, superposed) =
        (SolidOperator::NonEquilibriumBounceBack, SolidOperator::Superposition);
    vec![
        ("SRT, periodic", Setup::fluid(periodic([12, 9, 10]), srt(0.6))),
        ("MRT, a row of 11 cells", Setup::fluid(periodic([11, 9, 10]), dhumieres(0.55))),
        ("MRT, force, cavity", {
            Setup::fluid(Domain::new([12, 9, 10], cavity).unwrap(), dhumieres(0.7))
                .with_body_force(g)
        }),
        ("SRT, inlet and pressure", {
            Setup::fluid(Domain::new([13, 8, 9], channel).unwrap(), srt(0.9))
        }),
        ("magic, a sphere, inlet and outflow", {
            let setup = Setup::fluid(Domain::new([12, 10, 11], open).unwrap(), magic(0.8, 0.25));
            setup.with_solids(phase(held.clone(), nt, bounce))
        }),
        ("MRT, force, few solid cells", {
            let setup = Setup::fluid(periodic([16, 14, 12]), dhumieres(0.6)).with_body_force(g);
            setup.with_solids(phase(held, fraction, superposed))
        }),
        ("MRT, force, a bed", {
            let setup = Setup::fluid(periodic([12, 12, 12]), dhumieres(0.8)).with_body_force(g);
            setup.with_solids(phase(bed.clone(), nt, bounce))
        }),
        ("SRT, a bed, superposition", {
            Setup::fluid(periodic([12, 12, 12]), srt(0.55)).with_solids(phase(bed, nt, superposed))
        }),
        ("MRT, moving solids", {
            let setup = Setup::fluid(periodic([12, 12, 12]), dhumieres(0.7)).with_body_force(g);
            setup.with_solids(phase(moving.clone(), nt, bounce))
        }),
        ("MRT, moving solids between walls, superposition", {
            let setup = Setup::fluid(Domain::new([13, 11, 12], cavity).unwrap(), dhumieres(0.7));
            setup.with_solids(phase(moving, fraction, superposed))
        }),
    ]
}

fn hundred_steps_of_every_model_and_face_stay_within_rounding_of_the_oracle() {
    let mut budget = Budget::kernel(2_000_000);
    let mut random = Random(1);
    for (name, setup) in scenes() {
        let start = waves(&mut random, &setup.domain);
        let mut both = Both::new(&setup, &start);
        both.run(&mut budget, 100);
        let errors = both.errors();
        println!("{name}: {errors:.3?}");
        assert!(errors.worst() < 1.0, "{name}: {errors:?}");
    }
}

fn cells_one_at_a_time_and_populations_over_two_bindings_give_the_same() {
    let mut budget = Budget::kernel(400_000);
    let mut random = Random(4);
    // A device of its own: 16 directions of 12³ cells to a binding, three in the next.
    let gpu = Gpu::open_like_hardware(140_000).unwrap();
    for (name, setup) in scenes() {
        let start = waves(&mut random, &setup.domain);
        let mut both = Both::on(&gpu, &setup, &start);
        both.run(&mut budget, 20);
        let errors = both.errors();
        println!("{name}: {errors:.3?}");
        assert!(errors.worst() < 1.0, "{name}: {errors:?}");
    }
}

fn thousand_steps_stay_within_rounding_of_the_oracle() {
    let mut budget = Budget::kernel(6_000_000);
    let mut random = Random(2);
    for (name, setup) in scenes().into_iter().skip(1).step_by(3) {
        let start = waves(&mut random, &setup.domain);
        let mut both = Both::new(&setup, &start);
        both.run(&mut budget, 1000);
        let errors = both.errors();
        println!("{name}: {errors:.3?}");
        assert!(errors.worst() < 1.0, "{name}: {errors:?}");
    }
}

/// A random scene in a few numbers, which proptest can shrink.
fn random_setup() -> impl Strategy<Value = (Setup, u64)> {
    let rates = prop::array::uniform5(0.3..1.8_f64);
    let collision = (any::<bool>(), 0.55..2.0_f64, rates).prop_map(|(is_srt, tau, free)| {
        let [e, eps, q, pi, m] = free;
        let rates = Rates { e, eps, q, nu: 1.0 / tau, pi, m };
        if is_srt { Collision::Srt { tau } } else { Collision::Mrt { rates } }
    });
    let wall = prop::array::uniform3(-0.05..0.05_f64);
    let face = (0..5_usize, wall, 0.98..1.02_f64);
    let faces = prop::array::uniform6(face).prop_map(|six| {
        let one = |i: usize, axis: usize| {
            let (kind, mut velocity, density) = six[i];
            match kind {
                1 => {
                    velocity[axis] = 0.0;
                    Face::Wall { velocity: Vec3::from(velocity) }
                }
                2 => Face::FreeSlip,
                3 => Face::Pressure { density },
                4 => Face::VelocityInlet { velocity: 0.5 * Vec3::from(velocity) },
                _ => Face::wall(),
            }
        };
        let pair = |axis: usize| match six[2 * axis].0 {
            0 => [Face::Periodic; 2],
            _ => [one(2 * axis, axis), one(2 * axis + 1, axis)],
        };
        Faces { x: pair(0), y: pair(1), z: pair(2) }
    });
    let cells = prop::array::uniform3(1..12_usize);
    let solid = (
        prop::array::uniform3(0.0..9.0_f64),
        0.4..3.0_f64,
        prop::array::uniform3(-0.03..0.03_f64),
        prop::array::uniform3(-0.01..0.01_f64),
        any::<bool>(),
    );
    let solids = (prop::collection::vec(solid, 0..4), any::<bool>(), any::<bool>());
    let force = prop::option::of(prop::array::uniform3(-1e-4..1e-4_f64));
    (collision, faces, cells, solids, force, any::<u64>()).prop_filter_map(
        "an inlet needs an outlet",
        |(collision, faces, cells, (solids, nt, superposed), force, seed)| {
            let mut setup = Setup::fluid(Domain::new(cells, faces).ok()?, collision);
            setup.body_force = force.map(Vec3::from);
            setup.guard.max_speed = 10.0;
            let solids: Vec<Solid> = solids
                .into_iter()
                .map(|(centre, radius, velocity, spin, held)| {
                    let share = if held { 0.0 } else { 1.0 };
                    sphere(centre, radius, share * Vec3::from(velocity), share * Vec3::from(spin))
                })
                .collect();
            if !solids.is_empty() {
                let weighting =
                    if nt { Weighting::NobleTorczynski } else { Weighting::SolidFraction };
                let operator = if superposed {
                    SolidOperator::Superposition
                } else {
                    SolidOperator::NonEquilibriumBounceBack
                };
                let phase = SolidPhase { solids, weighting, operator, ..SolidPhase::default() };
                setup = setup.with_solids(phase);
            }
            Some((setup, seed))
        },
    )
}

fn random_scenes_stay_within_rounding_of_the_oracle() {
    const CASES: u32 = 16;
    const STEPS: u64 = 10;
    // At most 11³ cells, and as much again while it shrinks.
    let mut budget = Budget::kernel(4_000_000);
    let config = Config { cases: CASES, failure_persistence: None, ..Config::default() };
    // The same scenes in every run: a failure fails again.
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(config, rng);
    let budget = std::cell::RefCell::new(&mut budget);
    let outcome = runner.run(&random_setup(), |(setup, seed)| {
        let start = waves(&mut Random(seed), &setup.domain);
        let mut both = Both::new(&setup, &start);
        both.run(&mut budget.borrow_mut(), STEPS);
        let errors = both.errors();
        // Random rates may amplify what is rounded for a few steps: four times the bound.
        prop_assert!(errors.worst() < 4.0, "{errors:?}");
        Ok(())
    });
    if let Err(error) = outcome {
        panic!("{error}");
    }
}

fn two_runs_give_the_same_bits() {
    let mut budget = Budget::kernel(1_000_000);
    for (name, setup) in scenes().into_iter().skip(6).step_by(2) {
        let start = waves(&mut Random(3), &setup.domain);
        let mut once = || {
            let gpu = trials::gpu().unwrap();
            let mut kernel = Kernel::new(&gpu, setup.clone(), false).unwrap();
            kernel.set_populations(&start).unwrap();
            budget.advance(&mut kernel, 50);
            let mut bits = Vec::new();
            kernel.save(|row| std::io::Write::write_all(&mut bits, row)).unwrap();
            (bits, kernel.loads().unwrap())
        };
        let (first, second) = (once(), once());
        assert!(first.0 == second.0, "{name}: populations differ");
        assert_eq!(first.1, second.1, "{name}: loads differ");
    }
}

fn main() -> ExitCode {
    trials::run(&[
        (
            "hundred_steps_of_every_model_and_face_stay_within_rounding_of_the_oracle",
            hundred_steps_of_every_model_and_face_stay_within_rounding_of_the_oracle,
        ),
        (
            "cells_one_at_a_time_and_populations_over_two_bindings_give_the_same",
            cells_one_at_a_time_and_populations_over_two_bindings_give_the_same,
        ),
        (
            "thousand_steps_stay_within_rounding_of_the_oracle",
            thousand_steps_stay_within_rounding_of_the_oracle,
        ),
        (
            "random_scenes_stay_within_rounding_of_the_oracle",
            random_scenes_stay_within_rounding_of_the_oracle,
        ),
        ("two_runs_give_the_same_bits", two_runs_give_the_same_bits),
    ])
}
