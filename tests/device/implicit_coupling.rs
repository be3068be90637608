//! Free grains under full bounce-back on each engine: how they hold the fluid before a collision, the motion that follows
//! from it, runs, saved states.
//!
//! **The bound.** A grip is a sum over cells of `b j` and `b ρ`, some of it times arms, as a load is: the bound of
//! `kernel_parity.rs`, 16 epsilons of the sum of what is added up. That is the gauge of a cell for its momentum `j`, one
//! more for `ρ`, and `2 ε_s` of it, since `b = 2 B_s` and no weight is above the solid fraction. The engine's own
//! populations are given to the oracle, so that nothing but these sums is compared. On a device the weights of
//! spheres are off by `δB` besides (`kernel_runs.rs`), which stands beside `16 epsilon ε_s`.
//!
//! The motion solves `A U' = b`, where `A` is that of the grain alone, `diag(M, I)`, and a positive semidefinite part from
//! the grip. So what the grip's errors leave over in that equation, `r`, the lengths of which follow from the bounds of the
//! grip, moves the solution by no more than `M |δU|² + I |δω|² ≤ |r_F|²/M + |r_T|²/I`.

use std::sync::Arc;

use crate::common::Budget;
use crate::common::collisions::dhumieres;
use crate::common::random::Random;
use crate::implicit;
use crate::parity::{
    CELLS, G, Rounding, gauge, given_fractions, mixed_faces, random_state, waves, weight_error,
};
use crate::scenes::scene;
use crate::trials::{Claim, EngineClaim, device_of};
use psmrt::engine::{Block, CpuEngine, EngineName, FluidEngine, KernelEngine, Start, open};
use psmrt::kernel::Gpu;
use psmrt_reference::coupling::{CouplingSettings, FreeGrains, Gravity, grips};
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::lattice::{Populations, Vec3};
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::{Grip, Solid};
use psmrt_reference::solver::Solver;

/// The CPU engine, or the kernel on `gpu`.
fn fluid(
    name: EngineName,
    gpu: Option<&Arc<Gpu>>,
    setup: Setup,
    f: &[Populations],
) -> Box<dyn FluidEngine> {
    let start = Start::Populations(f);
    match (name, gpu) {
        (EngineName::CpuSingle, _) => Box::new(CpuEngine::<f32>::start(setup, &start)),
        (_, Some(gpu)) => Box::new(KernelEngine::start(setup, gpu, &start).unwrap()),
        (_, None) => Box::new(CpuEngine::<f64>::start(setup, &start)),
    }
}

/// How far the parts of a grip may be off: lengths of vectors, and of the tensor.
#[derive(Default)]
struct Allowed {
    impulse: f64,
    moment: f64,
    mass: f64,
    mass_arm: f64,
    inertia: f64,
    displaced: f64,
}

/// The oracle of an engine's state of now.
fn oracle_of(engine: &dyn FluidEngine) -> Solver {
    let all = Block::whole(&engine.setup().domain);
    Solver::from_populations(engine.setup().clone(), engine.populations(all).unwrap()).unwrap()
}

/// The bounds for each solid (see the top of this file).
fn allowed(oracle: &Solver, Rounding { epsilon, kept }: Rounding, off: f64) -> Vec<Allowed> {
    let solids = oracle.setup().solid_phase.as_ref().unwrap().solids.len();
    let mut all: Vec<Allowed> = (0..solids).map(|_| Allowed::default()).collect();
    for (cell, f) in oracle.populations().iter().enumerate() {
        let gauge = gauge(f) + kept;
        for share in oracle.coverage().unwrap().shares(cell) {
            let (allowed, r) = (&mut all[share.solid], share.arm.norm());
            let weight = 16.0 * epsilon * share.epsilon + off;
            allowed.impulse += 2.0 * weight * gauge;
            allowed.moment += 2.0 * weight * gauge * r;
            allowed.mass += 2.0 * weight * (1.0 + gauge);
            allowed.mass_arm += 2.0 * weight * (1.0 + gauge) * r;
            // |r² I - r rᵀ| = √2 r²
            allowed.inertia += 2.0 * weight * (1.0 + gauge) * 2.0_f64.sqrt() * r * r;
            allowed.displaced += weight;
        }
    }
    all
}

/// Errors of a grip over their bounds.
fn errors(found: &Grip, expected: &Grip, allowed: &Allowed) -> [f64; 6] {
    [
        (found.impulse - expected.impulse).norm() / allowed.impulse,
        (found.moment - expected.moment).norm() / allowed.moment,
        (found.mass - expected.mass).abs() / allowed.mass,
        (found.mass_arm - expected.mass_arm).norm() / allowed.mass_arm,
        (found.inertia - expected.inertia).norm() / allowed.inertia,
        (found.displaced - expected.displaced).abs() / allowed.displaced,
    ]
}

/// Asserts that the grips of an engine are the oracle's, and returns both.
fn held_to_the_oracle(
    what: &str,
    name: EngineName,
    engine: &mut dyn FluidEngine,
    off: f64,
) -> (Vec<Grip>, Vec<Grip>, Vec<Allowed>) {
    let oracle = oracle_of(engine);
    let (expected, allowed) = (grips(&oracle), allowed(&oracle, Rounding::of(name), off));
    let wanted: Vec<usize> = (0..expected.len()).collect();
    let found = engine.grips(&wanted).unwrap();
    assert!(found == engine.grips(&wanted).unwrap(), "{what}: asked again it says something else");
    let alone = engine.grips(&[1]).unwrap();
    assert!(alone[1] == found[1], "{what}: asked of one alone it says something else");
    for (solid, found) in found.iter().enumerate() {
        let errors = errors(found, &expected[solid], &allowed[solid]);
        println!("{what}, solid {solid}: {errors:.2?}");
        assert!(
            errors.into_iter().all(|error| error < 1.0),
            "{what}, solid {solid}: impulse, moment, mass, mass times arm, inertia and Σ B are these many times as far from \
             the oracle's as rounding explains: {errors:?}; {found:?} against {:?}",
            expected[solid],
        );
    }
    (found, expected, allowed)
}

fn solids_hold_the_fluid_as_in_the_oracle_at_every_face(name: EngineName) {
    let mut budget = Budget::kernel(5_000);
    let mut random = Random(21);
    // A lid, a moving side with a mirror and pressures, developed and non-reflecting faces; then a periodic box of
    // solids that never move.
    let (lid, side, open) = (mixed_faces()[0], mixed_faces()[4], mixed_faces()[10]);
    for (case, faces) in [lid, side, open, Faces::PERIODIC].into_iter().enumerate() {
        let weighting =
            [Weighting::NobleTorczynski, Weighting::SolidFraction][usize::from(case == 1)];
        let phase = SolidPhase {
            solids: given_fractions(&mut random, case < 3),
            operator: SolidOperator::FullBounceBack,
            weighting,
            ..SolidPhase::default()
        };
        let mut setup = Setup::fluid(Domain::new(CELLS, faces).unwrap(), dhumieres(0.7));
        setup = setup.with_solids(phase).with_body_force(G);
        let start = random_state(&mut random, setup.domain.cell_count());
        let mut engine = fluid(name, device_of(name).as_ref(), setup, &start);
        // Before the first step, and as a step leaves it, with faces between.
        held_to_the_oracle(&format!("faces {case}, at the start"), name, &mut *engine, 0.0);
        budget.spend(2 * start.len() as u64);
        engine.advance(2, false).unwrap();
        held_to_the_oracle(&format!("faces {case}, after 2 steps"), name, &mut *engine, 0.0);
    }
}

/// Half a grain at a mirror plane, one across a periodic side that has cells in common with it, and one so large that
/// several workgroups of a device add it up.
fn three_grains() -> (FreeGrains, Setup) {
    let faces = Faces {
        x: [Face::FreeSlip; 2],
        y: [Face::Periodic; 2],
        z: [Face::Wall { velocity: Vec3::new(0.02, 0.01, 0.0) }, Face::wall()],
    };
    let domain = Domain::new([14, 12, 11], faces).unwrap();
    let grains = vec![
        Grain::sphere(Vec3::new(0.0, 2.4, 5.2), 2.6, 0.6)
            .moving(Vec3::new(0.0, 0.02, -0.03))
            .spinning(Vec3::new(0.01, 0.0, 0.0)),
        Grain::sphere(Vec3::new(3.9, 11.5, 5.9), 2.1, 1.3)
            .moving(Vec3::new(-0.02, 0.01, 0.02))
            .spinning(Vec3::new(0.004, -0.01, 0.006)),
        Grain::sphere(Vec3::new(9.3, 5.2, 4.8), 4.1, 3.0).moving(Vec3::new(0.01, 0.0, 0.02)),
    ];
    let law = ContactLaw::from_duration_and_restitution(10.0, 0.5, grains[0].mass).unwrap();
    let sides = PeriodicBox { lengths: [None, Some(12.0), None] };
    let settings = CouplingSettings {
        gravity: Some(Gravity::Reduced { acceleration: Vec3::new(1e-4, 0.0, -2e-4) }),
        ..CouplingSettings::default()
    };
    let grain_setup = GrainSetup { sides, ..GrainSetup::new(law) };
    let moving = FreeGrains::new(&domain, grain_setup, grains, Vec::new(), settings).unwrap();
    let phase = SolidPhase {
        solids: moving.solids(),
        operator: SolidOperator::FullBounceBack,
        ..SolidPhase::default()
    };
    (moving, Setup::fluid(domain, dhumieres(0.7)).with_solids(phase))
}

fn grains_get_the_motion_that_the_oracle_solves_for(name: EngineName) {
    held_in_motion(name, device_of(name).as_ref(), 4);
}

fn populations_in_buffers_and_over_two_bindings_give_grains_the_same_motion() {
    // 13 directions of 1,848 cells to a binding, six in the next.
    let gpu = Gpu::open_like_hardware(100_000).unwrap();
    held_in_motion(EngineName::Wgpu, Some(&gpu), 2);
}

/// Asserts that grains get the motion that the oracle solves for, in so many steps.
fn held_in_motion(name: EngineName, gpu: Option<&Arc<Gpu>>, steps: u64) {
    let mut budget = Budget::kernel(20_000);
    let (moving, setup) = three_grains();
    let start = waves(&mut Random(22), &setup.domain);
    let off = weight_error(Rounding::of(name), &setup);
    let mut engine = fluid(name, gpu, setup, &start);
    for step in 0..steps {
        let what = format!("step {step}");
        let (found, expected, allowed) = held_to_the_oracle(&what, name, &mut *engine, off);
        let motions = moving
            .motion_in_collision(&found)
            .into_iter()
            .zip(moving.motion_in_collision(&expected));
        let mut solids: Vec<Solid> = engine.setup().solid_phase.as_ref().unwrap().solids.clone();
        for (number, (motion, expected)) in motions.enumerate() {
            let (grain, allowed) = (&moving.system().grains()[number], &allowed[number]);
            let (u, w) = (expected.velocity.norm(), expected.angular_velocity.norm());
            // Of half a grain, the mirror image too.
            let force = 2.0 * (allowed.impulse + allowed.mass * u + allowed.mass_arm * w);
            let torque = 2.0 * (allowed.moment + allowed.mass_arm * u + allowed.inertia * w);
            let left_over = force.powi(2) / grain.mass + torque.powi(2) / grain.inertia;
            let [du, dw] = [
                motion.velocity - expected.velocity,
                motion.angular_velocity - expected.angular_velocity,
            ];
            let error = grain.mass * du.norm_squared() + grain.inertia * dw.norm_squared();
            let error = (error / left_over).sqrt();
            println!("{what}, grain {number}: {error:.2}");
            assert!(
                error < 1.0,
                "{what}, grain {number}: it is to collide with {motion:?}, with {expected:?} in the oracle: {error} times as \
                 far apart as rounding explains",
            );
            solids[number].velocity = motion.velocity;
            solids[number].angular_velocity = motion.angular_velocity;
        }
        engine.place_solids(solids.clone()).unwrap();
        budget.spend(start.len() as u64);
        engine.advance(1, true).unwrap();
        solids.iter_mut().for_each(|solid| solid.centre += solid.velocity);
        engine.place_solids(solids).unwrap();
    }
}

fn kernel_moves_grains_as_the_oracle_does() {
    let mut budget = Budget::kernel(214_000);
    let setup = scene(&implicit::CLOSED).setup;
    // As the CPU engine in single precision (tests/suite/implicit_coupling.rs): populations less their weights are up to
    // 0.03, and a grain makes ten times their rounding. The weights of cut cells are δB off besides, which changes a
    // population by twice that part of what it is.
    let off = weight_error(Rounding::of(EngineName::Wgpu), &setup);
    let bound = implicit::STEPS as f64 * 0.03 * (10.0 * f64::from(f32::EPSILON) + 2.0 * off);
    let gpu = device_of(EngineName::Wgpu);
    let engines = [(EngineName::Wgpu, bound)];
    implicit::grains_move_as_in_the_oracle(&engines, gpu.as_ref(), &mut budget);
}

fn kernel_goes_on_bit_for_bit_from_what_it_saved_during_a_contact() {
    let mut budget = Budget::kernel(308_000);
    let gpu = device_of(EngineName::Wgpu);
    implicit::a_contact_goes_on_bit_for_bit(EngineName::Wgpu, gpu.as_ref(), &mut budget);
}

fn profile_shows_the_grips_where_an_operator_asks_for_them_and_only_there() {
    let mut budget = Budget::kernel(16_000);
    let gpu = device_of(EngineName::Wgpu);
    for (operator, asks) in [("full_bounce_back", true), ("bounce_back", false)] {
        let scene = scene(&implicit::CLOSED.replace("full_bounce_back", operator));
        let mut engine = open(EngineName::Wgpu, &scene, gpu.as_ref(), true).unwrap();
        budget.spend(2 * scene.setup.domain.cell_count() as u64);
        engine.step(2).unwrap();
        let parts = engine.profile().unwrap().parts;
        let shown = parts.iter().find(|(part, _)| *part == "grips");
        assert_eq!(shown.is_some(), asks, "{operator}: {parts:?}");
        assert!(shown.is_none_or(|(_, spent)| !spent.clock.is_zero()), "{parts:?}");
    }
}

/// What is claimed of each engine.
pub const CLAIMS: &[EngineClaim] = &[
    (
        "solids_hold_the_fluid_as_in_the_oracle_at_every_face",
        solids_hold_the_fluid_as_in_the_oracle_at_every_face,
    ),
    (
        "grains_get_the_motion_that_the_oracle_solves_for",
        grains_get_the_motion_that_the_oracle_solves_for,
    ),
];

/// What is claimed of the kernel alone; of the other engines, in tests/suite/implicit_coupling.rs.
pub const OF_KERNEL: &[Claim] = &[
    (
        "populations_in_buffers_and_over_two_bindings_give_grains_the_same_motion",
        populations_in_buffers_and_over_two_bindings_give_grains_the_same_motion,
    ),
    ("kernel_moves_grains_as_the_oracle_does", kernel_moves_grains_as_the_oracle_does),
    (
        "kernel_goes_on_bit_for_bit_from_what_it_saved_during_a_contact",
        kernel_goes_on_bit_for_bit_from_what_it_saved_during_a_contact,
    ),
    (
        "profile_shows_the_grips_where_an_operator_asks_for_them_and_only_there",
        profile_shows_the_grips_where_an_operator_asks_for_them_and_only_there,
    ),
];
