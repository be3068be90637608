//! Flows before non-reflecting faces: how soon they settle, and what the memory of the face does to them.

use crate::common;

use common::Budget;
use common::collisions::dhumieres;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::{CS2, Vec3};
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

fn along_x(u: f64) -> Vec3 {
    Vec3::new(u, 0.0, 0.0)
}

fn non_reflecting(memory: f64) -> Face {
    Face::NonReflectingPressure { density: 1.0, memory }
}

/// Steps that sound takes for `cells` cells.
fn crossing(cells: f64) -> f64 {
    cells / CS2.sqrt()
}

/// The stream of 64 cells between an inlet of 0.05 and `face` that rings without end at a pressure face: tau of a gas.
fn plug(face: Face) -> Solver {
    let inlet = Face::VelocityInlet { velocity: along_x(0.05) };
    let domain = Domain::new([64, 1, 1], Faces { x: [inlet, face], ..Faces::PERIODIC }).unwrap();
    Solver::new(Setup::fluid(domain, dhumieres(0.50225))).unwrap()
}

#[test]
fn stream_that_starts_from_rest_settles_before_a_non_reflecting_outlet() {
    let mut budget = Budget::oracle(900_000);
    // Largest distance of the mean velocity from the inlet's over four crossings, a period of the ringing, and of
    // the mean density from 1.
    let mut off_after = |face, crossings: f64| {
        let mut solver = plug(face);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "thousands")]
        budget.run(&mut solver, ((crossings - 4.0) * crossing(64.0)) as u64);
        let (mut velocity, mut density) = (0.0_f64, 0.0_f64);
        for _ in 0..444 {
            budget.run(&mut solver, 1);
            let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / 64.0;
            let u = mean(&mut solver.velocity_field().iter().map(|u| u.x));
            velocity = velocity.max((u / 0.05 - 1.0).abs());
            density = density.max((mean(&mut solver.density_field().into_iter()) - 1.0).abs());
        }
        (velocity, density)
    };
    let open = non_reflecting(4.0 * crossing(64.0));
    let (velocity, density) = off_after(open, 24.0);
    println!("after 24 crossings: velocity off by {velocity:.1e}, density by {density:.1e}");
    // Why: by linear acoustics the modes of a memory of four crossings fall like exp(-0.405 n) over n crossings, to
    // 9e-4 at 20, where this looks first; compression (u/c_s = 9 %) and waves of a grid of 64 cells may triple that.
    assert!(velocity < 3e-3, "the velocity is off by {velocity:e} of the inlet's");
    assert!(density < 3e-3 * 0.05 / CS2.sqrt(), "the mean density is off by {density:e}");
    let (velocity, _) = off_after(Face::Pressure { density: 1.0 }, 24.0);
    assert!(
        velocity > 0.5,
        "before a pressure face the velocity swings by {velocity} only: is this test still needed?"
    );
    // Memories of a quarter of that and of four times that settle later.
    let [short, default, long] =
        [1.0, 4.0, 16.0].map(|times| off_after(non_reflecting(times * crossing(64.0)), 20.0).0);
    println!("after 20 crossings by memory: 1: {short:.1e}, 4: {default:.1e}, 16: {long:.1e}");
    assert!(
        default < short && default < long,
        "a memory of 4 crossings leaves {default:e}, of 1 {short:e}, of 16 {long:e}"
    );
}

#[test]
fn flow_round_a_ball_two_diameters_before_a_non_reflecting_outlet_settles_to_that_of_a_developed_one()
 {
    const D: f64 = 5.0;
    let inlet = Face::VelocityInlet { velocity: along_x(0.02) };
    let sides = [Face::FreeSlip; 2];
    let cells = [30, 12, 12];
    let setup = |outlet| {
        let domain = Domain::new(cells, Faces { x: [inlet, outlet], y: sides, z: sides }).unwrap();
        // Its surface is two diameters from the outlet.
        let ball = Solid::fixed_sphere(Vec3::new(30.0 - 2.5 * D, 6.0, 6.0), 0.5 * D);
        let phase = SolidPhase { solids: vec![ball], ..SolidPhase::default() };
        Setup::fluid(domain, dhumieres(0.55)).with_solids(phase)
    };
    let mut budget = Budget::oracle(7_900_000);
    let mut solver = Solver::new(setup(non_reflecting(4.0 * crossing(30.0)))).unwrap();
    let force = |solver: &Solver| solver.loads()[0].force.x;
    budget.run(&mut solver, 1200);
    let settled = force(&solver);
    let developed = setup(Face::DevelopedPressure { density: 1.0 });
    let mut other = Solver::going_on_from(developed, solver.populations().to_vec(), {
        let mut memory = solver.memory();
        memory.slow_means.clear();
        memory
    })
    .unwrap();
    let (mut swing, mut mean) = (0.0_f64, 0.0);
    // Two periods of sound between inlet and outlet, 4 L/c_s.
    for _ in 0..40 {
        budget.run(&mut solver, 10);
        swing = swing.max((force(&solver) / settled - 1.0).abs());
    }
    // One: the change of faces sends out a little sound, which there rings on.
    for _ in 0..26 {
        budget.run(&mut other, 8);
        mean += force(&other) / 26.0;
    }
    let changed = (mean / settled - 1.0).abs();
    println!(
        "force {settled:.3e}, swings by {swing:.1e}, at a developed face changes by {changed:.1e}"
    );
    // Why 1e-3: 23 crossings leave exp(-0.405 · 23) = 1e-4 of the start, and the force swings more than the velocity.
    assert!(swing < 1e-3, "the force on the ball still swings by {swing:e} of itself");
    assert!(
        changed < 1e-3,
        "the steady flow is not that of a developed face: there the force changes by {changed:e}"
    );
}

/// A Taylor vortex of radius 4 and speed 0.01 in a stream of 0.05 that leaves through `face` at about step 480: the
/// largest pressure meanwhile, over ρ U u', and the largest speed left at step 800, over u'.
fn vortex_that_leaves(face: Face, budget: &mut Budget) -> (f64, f64) {
    const N: usize = 40;
    let inlet = Face::VelocityInlet { velocity: along_x(0.05) };
    let domain = Domain::new([N, N, 1], Faces { x: [inlet, face], ..Faces::PERIODIC }).unwrap();
    let mut solver = Solver::starting_from(Setup::fluid(domain, dhumieres(0.53)), |x| {
        let r = (x - Vec3::new(16.0, 20.0, 0.5)) / 4.0;
        let bell = 0.01 * (0.5 * (1.0 - r.x * r.x - r.y * r.y)).exp();
        // p = -ρ u'² exp(1 - r²)/2
        (1.0 - 0.5 * bell * bell / CS2, along_x(0.05) + bell * Vec3::new(-r.y, r.x, 0.0))
    })
    .unwrap();
    budget.run(&mut solver, 300);
    let mut pressure = 0.0_f64;
    for _ in 0..20 {
        budget.run(&mut solver, 20);
        let largest =
            solver.density_field().iter().map(|rho| (rho - 1.0).abs()).fold(0.0, f64::max);
        pressure = pressure.max(CS2 * largest / (0.05 * 0.01));
    }
    budget.run(&mut solver, 100);
    let speeds = solver.velocity_field().into_iter().map(|u| (u - along_x(0.05)).norm());
    (pressure, speeds.fold(0.0, f64::max) / 0.01)
}

#[test]
fn vortex_leaves_through_a_non_reflecting_face_best_with_a_memory_shorter_than_its_passage() {
    let mut budget = Budget::oracle(3_900_000);
    let developed = Face::DevelopedPressure { density: 1.0 };
    // R/U = 80 steps: the default memory of four crossings is 277, a quarter of the passage is 20.
    let faces = [developed, non_reflecting(4.0 * crossing(40.0)), non_reflecting(20.0)];
    let [developed, default, short] = faces.map(|face| vortex_that_leaves(face, &mut budget));
    println!("pressure over ρ U u' and swirl left: {developed:.3?}, {default:.3?}, {short:.3?}");
    // Why 1: a face that took the swirl for sound would answer with ρ c_s u', 11 times that.
    assert!(
        default.0 < 1.0 && default.1 < 0.15,
        "with the default memory a vortex meets a pressure of {} ρ U u', and {} of its swirl stays",
        default.0,
        default.1
    );
    assert!(
        short.0 < developed.0 && short.0 < default.0 && short.1 < default.1,
        "with a memory of a quarter of R/U it meets {}, more than at a developed face, {}, or with the default, {}",
        short.0,
        developed.0,
        default.0
    );
}

#[test]
fn fluid_between_two_non_reflecting_faces_has_the_inertia_of_2_c_s_t_more_cells() {
    // Without friction: ρ_w - ρ_0 = ρ/c_s (u_n - m) = ρ T/c_s dm/dt at each end, so that a pressure difference
    // c_s² Δρ accelerates the L cells as if they were L + 2 c_s T.
    const L: f64 = 20.0;
    const T: f64 = 30.0;
    let face = |density| Face::NonReflectingPressure { density, memory: T };
    let difference = 1e-6;
    let x = [face(1.0 + difference), face(1.0)];
    let domain = Domain::new([20, 1, 1], Faces { x, ..Faces::PERIODIC }).unwrap();
    let mut solver = Solver::new(Setup::fluid(domain, dhumieres(0.8))).unwrap();
    let mut budget = Budget::oracle(40_000);
    let middle = |solver: &Solver| solver.velocity_field()[10].x;
    budget.run(&mut solver, 1000);
    let before = middle(&solver);
    budget.run(&mut solver, 800);
    let acceleration = (middle(&solver) - before) / 800.0;
    let theory = CS2 * difference / (L + 2.0 * CS2.sqrt() * T);
    // Why 2 %: sound between the ends has long left; each end is known to half a cell of 55.
    assert!(
        (acceleration / theory - 1.0).abs() < 0.02,
        "the fluid gains {acceleration:e} a step, by theory {theory:e}"
    );
}

#[test]
fn run_gone_on_with_from_its_memory_gives_the_same_bits() {
    let open = non_reflecting(20.0);
    let inlet = Face::VelocityInlet { velocity: along_x(0.05) };
    // A corner at which two such faces meet.
    let faces = Faces { x: [inlet, open], y: [Face::wall(), open], ..Faces::PERIODIC };
    let setup = Setup::fluid(Domain::new([7, 6, 5], faces).unwrap(), dhumieres(0.6));
    let mut budget = Budget::oracle(20_000);
    let mut straight = Solver::new(setup.clone()).unwrap();
    budget.run(&mut straight, 30);
    let (f, memory) = (straight.populations().to_vec(), straight.memory());
    assert_eq!(
        memory.slow_means.len(),
        6 * 5 + 7 * 5,
        "one slow mean for each cell at each such face"
    );
    let mut resumed = Solver::going_on_from(setup, f, memory).unwrap();
    budget.run(&mut straight, 30);
    budget.run(&mut resumed, 30);
    assert!(straight.populations() == resumed.populations(), "populations differ");
    assert_eq!(straight.memory(), resumed.memory());
}
