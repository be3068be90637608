//! What the tests of the engines against the oracle share, and `tests/validation/examples/kernel_parity.rs` with them.

#![allow(dead_code, reason = "each file that compares the two uses a part of this")]

use std::sync::Arc;

use psmrt::engine::{Block, Coupled, EngineName, from_populations};
use psmrt::kernel::Gpu;
use psmrt_reference::collision::Collision;
use psmrt_reference::directions::Q;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::{Populations, Vec3, W};
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::{Shape, Solid};
use psmrt_reference::solver::Solver;

use crate::common::Budget;
use crate::common::collisions::{dhumieres, magic, srt};
use crate::common::random::Random;
use crate::trials;

pub const CELLS: [usize; 3] = [6, 5, 4];

/// What single precision holds of a population less its weight.
pub fn rounded(f: &Populations) -> Populations {
    #[expect(clippy::cast_possible_truncation, reason = "the point is to round")]
    std::array::from_fn(|a| f64::from((f[a] - W[a]) as f32) + W[a])
}

pub fn random_state(random: &mut Random, count: usize) -> Vec<Populations> {
    (0..count).map(|_| rounded(&random.populations())).collect()
}

/// How an engine rounds.
#[derive(Clone, Copy)]
pub struct Rounding {
    /// Relative, of one number.
    pub epsilon: f64,
    /// What is rounded in a cell besides populations less their weights. Where the engine has double precision it is the
    /// oracle that rounds most: it keeps populations with their weights, the sum of which is 1.
    pub kept: f64,
}

impl Rounding {
    pub fn of(engine: EngineName) -> Self {
        match engine.bytes_of_number() {
            4 => Rounding { epsilon: f64::from(f32::EPSILON), kept: 0.0 },
            _ => Rounding { epsilon: f64::EPSILON, kept: 1.0 },
        }
    }
}

/// Sum of the absolute values of the populations less their weights.
pub fn gauge(f: &Populations) -> f64 {
    (0..Q).map(|a| (f[a] - W[a]).abs()).sum()
}

/// Largest error after one step over epsilon times the largest gauge that met in it; of the populations
/// and of the forces and torques on solids of given cells, whose gauges are the sums over their cells of
/// what the loads are added up from: gauge and momentum of the solid, times the arm for a torque.
pub fn error_of_one_step(
    engine: EngineName,
    budget: &mut Budget,
    setup: &Setup,
    start: &[Populations],
) -> f64 {
    let mut oracle = Solver::from_populations(setup.clone(), start.to_vec()).unwrap();
    budget.spend(start.len() as u64);
    oracle.step().unwrap();
    let gpu = trials::device_of(engine);
    let Rounding { epsilon, kept } = Rounding::of(engine);
    let mut engine = from_populations(engine, setup, gpu.as_ref(), start).unwrap();
    budget.spend(start.len() as u64);
    engine.step(1).unwrap();
    let found = engine.populations(Block::whole(&setup.domain));
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
            let error = (found[a] - expected[a]).abs() / (epsilon * (largest + kept));
            worst = worst.max(error);
        }
    }
    let phase = oracle.setup().solid_phase.as_ref();
    let solids = phase.map_or(&[][..], |phase| &phase.solids);
    let loads = engine.loads();
    for ((load, expected), solid) in loads.iter().zip(oracle.loads()).zip(solids) {
        let Shape::Cells { fractions, .. } = &solid.shape else { continue };
        let (mut of_force, mut of_torque) = (0.0, 0.0);
        for &(cell, epsilon) in fractions.iter() {
            let arm = setup.domain.centre(setup.domain.coordinates(cell)) - solid.centre;
            let term = gauge(&start[cell]) + kept + solid.velocity_at(&arm).norm();
            of_force += epsilon * term;
            of_torque += epsilon * term * arm.norm();
        }
        let force = (load.force - expected.force).norm() / of_force;
        let torque = (load.torque - expected.torque).norm() / of_torque;
        worst = worst.max(force.max(torque) / epsilon);
    }
    worst
}

pub fn collisions() -> Vec<(&'static str, Collision)> {
    let rates = Rates { e: 0.3, eps: 1.9, q: 0.7, nu: 1.0 / 0.9, pi: 1.1, m: 0.2 };
    vec![
        ("SRT", srt(0.8)),
        ("SRT near 1/2", srt(0.505)),
        ("SRT as a set of rates", Collision::Mrt { rates: Rates::srt(0.8).unwrap() }),
        ("d'Humieres", dhumieres(0.7)),
        ("d'Humieres near 1/2", dhumieres(0.505)),
        ("magic", magic(1.5, 0.1875)),
        ("all rates apart", Collision::Mrt { rates }),
    ]
}

pub const G: Vec3 = Vec3::new(1e-3, -2e-3, 5e-4);

/// Solids with given fractions of all cells, of which each has up to three; some are full, some bare.
pub fn given_fractions(random: &mut Random, moving: bool) -> Vec<Solid> {
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
            let angular_velocity = if moving { random.vector(0.01) } else { Vec3::zeros() };
            let centre = random.vector(6.0);
            Solid { velocity, angular_velocity, centre, ..Solid::fixed_cells(fractions) }
        })
        .collect()
}

/// Boxes in which every kind of face meets every other at an edge.
pub fn mixed_faces() -> Vec<Faces> {
    let lid = Face::Wall { velocity: Vec3::new(0.03, -0.02, 0.0) };
    let side = Face::Wall { velocity: Vec3::new(0.0, 0.02, -0.01) };
    let inlet = Face::VelocityInlet { velocity: Vec3::new(0.04, 0.01, -0.01) };
    let [low, high] = [0.98, 1.01].map(|density| Face::Pressure { density });
    let [through, on] = [0.99, 1.02].map(|density| Face::DevelopedPressure { density });
    let [open, wide] = [(0.99, 7.0), (1.02, 60.0)]
        .map(|(density, memory)| Face::NonReflectingPressure { density, memory });
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
        Faces { x: [through, on], y: [wall, slip], z: [out, low] },
        Faces { x: [inlet, on], y: periodic, z: [slip, through] },
        Faces { x: [open, wide], y: [wall, slip], z: [out, open] },
        Faces { x: [wide, through], y: [on, open], z: [wide, low] },
        Faces { x: [inlet, wide], y: periodic, z: [open, wide] },
    ]
}

/// A scene computed by both.
pub struct Both {
    pub oracle: Solver,
    pub engine: Coupled,
    rounding: Rounding,
    largest_gauge: f64,
}

/// Errors of populations, forces and torques over their bounds.
#[derive(Debug)]
pub struct Errors {
    pub populations: f64,
    pub forces: f64,
    pub torques: f64,
}

impl Errors {
    pub fn worst(&self) -> f64 {
        self.populations.max(self.forces).max(self.torques)
    }
}

impl Both {
    pub fn new(engine: EngineName, setup: &Setup, start: &[Populations]) -> Self {
        Self::on(engine, trials::device_of(engine).as_ref(), setup, start)
    }

    pub fn on(
        engine: EngineName,
        gpu: Option<&Arc<Gpu>>,
        setup: &Setup,
        start: &[Populations],
    ) -> Self {
        let oracle = Solver::from_populations(setup.clone(), start.to_vec()).unwrap();
        let rounding = Rounding::of(engine);
        let engine = from_populations(engine, setup, gpu, start).unwrap();
        let largest_gauge = start.iter().map(gauge).fold(0.0, f64::max);
        Both { oracle, engine, rounding, largest_gauge }
    }

    /// Makes `steps` steps.
    pub fn run(&mut self, budget: &mut Budget, steps: u64) {
        let phase = self.oracle.setup().solid_phase.as_ref();
        let moves = phase.is_some_and(|phase| phase.solids.iter().any(Solid::moves));
        let batch = if moves { 1 } else { 10.min(steps) };
        for _ in 0..steps / batch {
            budget.spend(batch * self.oracle.domain().cell_count() as u64);
            self.oracle.run(batch).unwrap();
            self.engine.step(batch).unwrap();
            let now = self.oracle.populations().iter().map(gauge).fold(0.0, f64::max);
            self.largest_gauge = self.largest_gauge.max(now);
        }
    }

    pub fn errors(&self) -> Errors {
        let steps = self.oracle.steps() as f64;
        let Rounding { epsilon, kept } = self.rounding;
        // Rounding that differs from step to step grows with the root of their number. That of the oracle's whole
        // populations does not: near a steady state the same numbers are rounded the same way at every step.
        let rounding = if kept > 0.0 { steps * epsilon } else { steps.sqrt() * epsilon };
        let bound = 2.0
            * (rounding + weight_error(self.rounding, self.oracle.setup()))
            * (self.largest_gauge + kept);
        let found = self.engine.populations(Block::whole(self.oracle.domain()));
        let pairs = found.iter().flatten().zip(self.oracle.populations().iter().flatten());
        let populations = pairs.map(|(f, o)| (f - o).abs()).fold(0.0, f64::max) / bound;
        let (mut forces, mut torques) = (0.0_f64, 0.0_f64);
        let phase = self.oracle.setup().solid_phase.as_ref();
        let solids = phase.map_or(&[][..], |phase| &phase.solids);
        let loads = self.engine.loads();
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

/// How far the weight `B` may be off in a cell that a moving ball covers: on a device its solid fraction is found in
/// single precision, to within the bound of `kernel_fractions.rs`; where no solid moves it is found in double precision and told.
pub fn weight_error(Rounding { epsilon, kept }: Rounding, setup: &Setup) -> f64 {
    let still = Vec3::zeros();
    let Some(phase) = &setup.solid_phase else { return 0.0 };
    let moves = |solid: &Solid| solid.velocity != still || solid.angular_velocity != still;
    if kept == 0.0 && !phase.solids.iter().any(moves) {
        return 0.0;
    }
    let radius = |solid: &Solid| match solid.shape {
        Shape::Sphere { radius } => radius,
        Shape::Cells { .. } => 0.0,
    };
    let largest = phase.solids.iter().map(radius).fold(0.0, f64::max);
    // In double precision each of the two is a few (1 + radius³) 1e-16 off, as their documents say.
    let of_fraction =
        if kept > 0.0 { 6e-16 * (1.0 + largest.powi(3)) } else { 2e-6 + 2.0 * epsilon * largest };
    match phase.weighting {
        Weighting::SolidFraction => of_fraction,
        // dB/dε = (τ - 1/2) (τ + 1/2) / (τ + 1/2 - ε)² is largest in a full cell.
        Weighting::NobleTorczynski => {
            let excess = setup.collision.tau() - 0.5;
            of_fraction * (1.0 + excess) / excess
        }
        // dB/dε = k/[(1 - ε) + k ε]² is largest in a full cell, as k < 1 (tau < 5); the rates of the moments go with
        // ε itself.
        Weighting::Graded => {
            let excess = setup.collision.tau() - 0.5;
            of_fraction * (1.0 + (4.0 * excess + 0.4) / (excess * excess))
        }
    }
}

/// A slow flow of several waves: populations in equilibrium, a hundredth away from it.
pub fn waves(random: &mut Random, domain: &Domain) -> Vec<Populations> {
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

pub fn sphere(centre: [f64; 3], radius: f64, velocity: Vec3, angular_velocity: Vec3) -> Solid {
    Solid { velocity, angular_velocity, ..Solid::fixed_sphere(Vec3::from(centre), radius) }
}

/// Scenes that between them hold every model and face.
pub fn scenes() -> Vec<(&'static str, Setup)> {
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
    let [end, side] = [(1.0, 40.0), (0.999, 7.0)]
        .map(|(density, memory)| Face::NonReflectingPressure { density, memory });
    let jet = Faces { x: [inlet, end], y: [Face::FreeSlip, side], z: [Face::Periodic; 2] };
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
            setup.with_solids(phase(moving.clone(), fraction, superposed))
        }),
        ("MRT, moving solids before non-reflecting faces", {
            let setup = Setup::fluid(Domain::new([13, 11, 12], jet).unwrap(), dhumieres(0.6));
            setup.with_solids(phase(moving, nt, bounce)).with_body_force(g)
        }),
    ]
}
