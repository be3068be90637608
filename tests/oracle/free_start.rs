//! Free grains that start with a velocity or an angular velocity: against the exact motion of a lone sphere in Stokes
//! flow, and what momentum a scene has at its start.
//!
//! The exact curves are `golden/free_start/exact.csv`, made and derived by `exact.py` beside it. At the
//! start the fluid outside is at rest up to the surface (`reference/src/start.rs`).

use crate::common;

use common::collisions::dhumieres;
use common::random::Random;
use common::{Budget, golden_rows};
use psmrt_reference::coupling::{CoupledSolver, CouplingSettings, InternalFluid};
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::grains::grain::{Grain, sphere_volume};
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::lattice::{Vec3, momentum, viscosity};
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

const TAU: f64 = 0.6;
const RADIUS: f64 = 4.0;

/// The rows of the exact curves of one density ratio: `(T, spin over initial, velocity over initial)`.
fn exact(ratio: f64) -> Vec<[f64; 3]> {
    let rows = golden_rows("free_start/exact.csv");
    let number = |text: &str| text.parse::<f64>().unwrap();
    let numbers = rows[1..].iter().map(|row| [0, 1, 2, 3].map(|column| number(&row[column])));
    numbers.filter(|row| row[0] == ratio).map(|row| [row[1], row[2], row[3]]).collect()
}

/// One grain in fluid at rest. Along an axis whose faces are mirrors it lies in the corner, so that half
/// of it stands for the whole; along the others in the middle.
fn lone_grain(cells: [usize; 3], faces: Faces, grain: Grain) -> CoupledSolver {
    let domain = Domain::new(cells, faces).unwrap();
    let is_periodic = [0, 1, 2].map(|axis| domain.is_periodic(axis));
    let side = |axis: usize| is_periodic[axis].then(|| cells[axis] as f64);
    let place = Vec3::from_fn(|axis, _| side(axis).map_or(0.0, |length| 0.5 * length));
    let setup = Setup::fluid(domain, dhumieres(TAU)).with_solids(SolidPhase::default());
    let law = ContactLaw::from_duration_and_restitution(5.0, 0.5, 100.0).unwrap();
    let sides = PeriodicBox { lengths: [side(0), side(1), side(2)] };
    CoupledSolver::new(
        setup,
        |_| (1.0, Vec3::zeros()),
        GrainSetup { sides, ..GrainSetup::new(law) },
        vec![Grain { position: place, ..grain }],
        Vec::new(),
        CouplingSettings::default(),
    )
    .unwrap()
}

/// Runs to each time `T = ν t/a²` in turn and returns `observe` there, between the two steps about it.
fn at_times(
    budget: &mut Budget,
    solver: &mut CoupledSolver,
    times: &[f64],
    observe: impl Fn(&Grain) -> f64,
) -> Vec<f64> {
    let a_step = viscosity(TAU) / (RADIUS * RADIUS);
    let mut seen = vec![observe(&solver.grains().grains()[0])];
    let mut found = Vec::new();
    for time in times {
        let steps = time / a_step;
        while (seen.len() as f64) < steps + 1.0 {
            budget.spend(solver.fluid().domain().cell_count() as u64);
            solver.step().unwrap_or_else(|stop| panic!("{stop}"));
            seen.push(observe(&solver.grains().grains()[0]));
        }
        let before = (0..seen.len()).rfind(|&step| step as f64 <= steps).unwrap();
        let part = steps - before as f64;
        found.push(seen[before] * (1.0 - part) + seen.get(before + 1).unwrap_or(&0.0) * part);
    }
    found
}

#[test]
fn free_sphere_that_starts_spinning_slows_down_as_the_exact_curve_says() {
    let mut budget = Budget::oracle(2_100_000);
    let angular_velocity = 1e-4;
    for ratio in [1.0, 2.65] {
        // A box of three diameters; half of it, with a mirror plane through the equator.
        let grain = Grain::sphere(Vec3::zeros(), RADIUS, ratio).spinning(Vec3::new(
            0.0,
            0.0,
            angular_velocity,
        ));
        let faces = Faces { z: [Face::FreeSlip; 2], ..Faces::PERIODIC };
        let mut solver = lone_grain([24, 24, 12], faces, grain);
        let exact = exact(ratio);
        let times: Vec<f64> = exact.iter().map(|row| row[0]).collect();
        let found = at_times(&mut budget, &mut solver, &times, |grain| {
            grain.angular_velocity.z / angular_velocity
        });
        println!("ratio {ratio}: spin over its start {found:.4?}");
        for ([time, expected, _], found) in exact.into_iter().zip(found) {
            // At T = 0.02, ten steps after the start, the layer of fluid that turns with the sphere is
            // half a cell thick and the curve falls by 0.015 a step (density ratio 1): the first load
            // acts a step late and the inertia of the fluid inside another, which makes 0.03. From T =
            // 0.1 on a step is below 0.003, and what is left is the grid: 8 cells at tau = 0.6 place a
            // surface within 1/16 of a cell, 1/64 of the radius, and the torque goes as its cube, 5 %,
            // or its fifth power while the layer is thin, 8 %: the curve at a time 5 to 8 % off differs
            // by 0.012 at most. The images, 6 radii away, do not feel a rotation yet.
            let tolerance = if time < 0.1 { 0.03 } else { 0.015 };
            assert!(
                (found - expected).abs() < tolerance,
                "density ratio {ratio}, T = {time}: spin over initial spin {found:.4}, exact \
                 {expected:.4}; if far too low, the grain has set the fluid inside it in motion, if far \
                 too high, the inertia of that fluid is not given back"
            );
        }
    }
}

#[test]
fn free_sphere_that_starts_moving_slows_down_as_basset_boussinesq_and_oseen_say() {
    let mut budget = Budget::oracle(2_400_000);
    let speed = 1e-3;
    for ratio in [1.0, 2.65] {
        // A quarter of a box of four diameters, with mirror planes through the axis.
        let slip = [Face::FreeSlip; 2];
        let faces = Faces { x: slip, y: slip, ..Faces::PERIODIC };
        let grain = Grain::sphere(Vec3::zeros(), RADIUS, ratio).moving(Vec3::new(0.0, 0.0, speed));
        let mut solver = lone_grain([16, 16, 32], faces, grain);
        let rows = exact(ratio);
        // Sound that the start sends out comes back from the images after 56 steps, T = 0.12, weaker by
        // far; before T = 0.05, 24 steps, it has not yet left the sphere's surroundings.
        let rows: Vec<_> = rows.into_iter().filter(|row| row[0] >= 0.05).collect();
        let times: Vec<f64> = rows.iter().map(|row| row[0]).collect();
        let found = at_times(&mut budget, &mut solver, &times, |grain| grain.velocity.z / speed);
        println!("ratio {ratio}: velocity over its start {found:.4?}");
        for ([time, _, expected], found) in rows.into_iter().zip(found) {
            // The drag of 8 cells at tau = 0.6 is 3 % too low (golden/sphere_arrays/study.csv): at most
            // 3 % of what has been lost since v(0+), 0.02. In the box the momentum stays: the mean
            // flow is the solid fraction, 0.008, of what the sphere has lost, and adds as much.
            assert!(
                (found - expected).abs() < 0.03,
                "density ratio {ratio}, T = {time}: velocity over its start {found:.4}, exact \
                 {expected:.4}"
            );
        }
    }
}

/// Momentum of the populations of a fluid of density 1, and that of solids of the density of the fluid in
/// its place: `Σ_s V_s v_s + (V - Σ_s V_s) u`.
fn expected_momentum(cells: usize, spheres: &[(f64, Vec3)], u: Vec3) -> Vec3 {
    let solid = |(radius, v): &(f64, Vec3)| sphere_volume(*radius) * (v - u);
    spheres.iter().map(solid).sum::<Vec3>() + cells as f64 * u
}

#[test]
fn covered_cells_start_with_their_solids_whether_free_or_prescribed() {
    let mut random = Random(7);
    let stream = Vec3::new(0.01, -0.02, 0.005);
    // The fluid starts half a step of the body force behind; of cells partly covered, its part does.
    let force = Vec3::new(1e-3, 0.0, -2e-3);
    let mut spheres = Vec::new();
    let mut grains = Vec::new();
    for place in [Vec3::new(3.0, 3.0, 3.0), Vec3::new(10.0, 9.0, 8.0)] {
        let (radius, v) = (random.between(2.0, 3.0), random.vector(0.05));
        spheres.push((radius, v));
        let grain = Grain::sphere(place + random.vector(0.5), radius, 3.0).moving(v);
        // An angular velocity about a centre between the cells' would add the little that cells' centres are off the
        // middle of what is covered of them.
        grains.push(grain);
    }
    // One that does not move, beside one that does.
    spheres[1].1 = Vec3::zeros();
    grains[1] = Grain { velocity: Vec3::zeros(), ..grains[1] };
    let domain = Domain::new([14, 13, 12], Faces::PERIODIC).unwrap();
    let count = domain.cell_count();
    let state = |_| (1.0, stream);
    let setup = Setup::fluid(domain, dhumieres(TAU)).with_body_force(force);
    let total = |solver: &Solver| solver.populations().iter().map(momentum).sum::<Vec3>();
    let expected = expected_momentum(count, &spheres, stream - 0.5 * force);

    let solids = grains.iter().map(|grain| Solid {
        velocity: grain.velocity,
        angular_velocity: grain.angular_velocity,
        ..Solid::fixed_sphere(grain.position, grain.radius)
    });
    let phase = SolidPhase { solids: solids.collect(), ..SolidPhase::default() };
    let prescribed = Solver::starting_from(setup.clone().with_solids(phase), state).unwrap();
    // Solid fractions are exact to 1e-12 of a cell, in about 200 cells with velocities below 0.1.
    let off = (total(&prescribed) - expected).norm();
    assert!(off < 1e-10, "prescribed: the fluid starts with {off:e} too much momentum");

    let law = ContactLaw::from_duration_and_restitution(5.0, 0.5, 100.0).unwrap();
    let sides = PeriodicBox::all([14.0, 13.0, 12.0]);
    for internal_fluid in [InternalFluid::Kept, InternalFluid::Lagged] {
        let free = CoupledSolver::new(
            setup.clone().with_solids(SolidPhase::default()),
            state,
            GrainSetup { sides, ..GrainSetup::new(law) },
            grains.clone(),
            Vec::new(),
            CouplingSettings { internal_fluid, ..Default::default() },
        )
        .unwrap();
        assert!(free.fluid().populations() == prescribed.populations(), "free: other populations");
        // Lagged, what is conserved is the momentum of the grains' own masses and of the fluid outside:
        // the fluid inside counts once with its populations and once, negative, with `m_f v`.
        if internal_fluid == InternalFluid::Lagged {
            let own: Vec3 = grains.iter().map(|grain| grain.mass * grain.velocity).sum();
            let outside: Vec<_> = spheres.iter().map(|&(a, _)| (a, Vec3::zeros())).collect();
            let expected = own + expected_momentum(count, &outside, stream - 0.5 * force);
            let off = (free.conserved_momentum() - expected).norm();
            assert!(off < 1e-10, "the conserved momentum starts {off:e} off");
        }
    }
}

#[test]
fn fixed_solids_leave_the_start_as_it_is_given() {
    let domain = Domain::new([8; 3], Faces::PERIODIC).unwrap();
    let phase = SolidPhase {
        solids: vec![Solid::fixed_sphere(Vec3::new(4.1, 3.9, 4.0), 2.5)],
        ..SolidPhase::default()
    };
    let state = |x: Vec3| (1.0 + 1e-3 * x.x, Vec3::new(0.01, 1e-3 * x.z, 0.0));
    let bare = Setup::fluid(domain, dhumieres(TAU));
    let with_solid = Solver::starting_from(bare.clone().with_solids(phase), state).unwrap();
    let without = Solver::starting_from(bare, state).unwrap();
    // The same function of the same state: the same bits.
    assert!(with_solid.populations() == without.populations());
}
