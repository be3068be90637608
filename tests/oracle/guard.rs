//! A run whose state breaks stops with the step, the cell, the probable cause and what to change:
//! each cause is provoked here.

use crate::common;

use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, DomainError, Face, Faces};
use psmrt_reference::guard::{Cause, Failure, GuardSettings, Stopped};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SetupError, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

const SRT: Collision = Collision::Srt { tau: 0.8 };

fn box_of(cells: [usize; 3], faces: Faces) -> Domain {
    Domain::new(cells, faces).unwrap()
}

fn along_x(u: f64) -> Vec3 {
    Vec3::new(u, 0.0, 0.0)
}

/// Runs until the guard stops it, and checks that the message says what a user needs. No test here
/// makes more than 2,000 steps of 600 cells.
fn stop(mut solver: Solver, remedy: &str) -> Stopped {
    let stopped = solver.run(2000).expect_err("this set-up must not survive");
    let message = stopped.to_string();
    for part in ["step", "cell", "Probable cause", remedy] {
        assert!(message.contains(part), "no {part:?} in: {message}");
    }
    stopped
}

#[test]
fn broken_initial_state_is_named_before_the_first_step() {
    for (rho, u) in [(-1.0, 0.0), (0.0, 0.0), (f64::NAN, 0.0), (1.0, f64::INFINITY), (1.0, 0.7)] {
        let setup = Setup::fluid(box_of([3, 3, 3], Faces::PERIODIC), SRT);
        let broken = Vec3::new(2.5, 1.5, 0.5);
        let solver = Solver::starting_from(setup, |x| {
            if x == broken { (rho, along_x(u)) } else { (1.0, Vec3::zeros()) }
        });
        let stopped = stop(solver.unwrap(), "initial state");
        assert_eq!((stopped.step, stopped.cell), (0, [2, 1, 0]));
        assert_eq!(stopped.cause, Cause::InitialState);
    }
}

#[test]
fn solid_that_moves_too_fast_is_named() {
    let slow = Solid::fixed_sphere(Vec3::new(2.0, 4.0, 4.0), 1.0);
    let fast =
        Solid { velocity: along_x(1.0), ..Solid::fixed_sphere(Vec3::new(4.0, 4.0, 4.0), 2.5) };
    let phase = SolidPhase { solids: vec![slow, fast], ..SolidPhase::default() };
    let setup = Setup::fluid(box_of([8, 8, 8], Faces::PERIODIC), SRT).with_solids(phase);
    let stopped = stop(Solver::new(setup).unwrap(), "solid 1 moves at 1.000");
    assert!(
        matches!(stopped.cause, Cause::SolidSpeed { solid: 1, .. }),
        "the cause ought to be the speed of solid 1, and is: {stopped}"
    );
}

#[test]
fn wall_that_moves_too_fast_is_named() {
    let lid = Face::Wall { velocity: along_x(0.9) };
    let faces = Faces { z: [Face::wall(), lid], ..Faces::PERIODIC };
    let solver = Solver::new(Setup::fluid(box_of([4, 4, 6], faces), SRT)).unwrap();
    let stopped = stop(solver, "face +z");
    assert!(
        matches!(stopped.cause, Cause::FaceSpeed { face: "+z", .. }),
        "the cause ought to be the speed at face +z, and is: {stopped}"
    );
}

#[test]
fn pressures_too_far_apart_are_named() {
    let faces = Faces {
        x: [Face::Pressure { density: 1.5 }, Face::Pressure { density: 0.5 }],
        ..Faces::PERIODIC
    };
    let setup = Setup::fluid(box_of([20, 3, 3], faces), Collision::Srt { tau: 0.55 });
    let stopped = stop(Solver::new(setup).unwrap(), "pressures at the faces");
    assert!(
        matches!(stopped.cause, Cause::PressureDifference { .. }),
        "the cause ought to be the difference of pressures, and is: {stopped}"
    );
}

#[test]
fn mean_density_that_drifts_away_is_named() {
    // An inlet that sucks fluid out: a free outflow at the other end does not replace it.
    let faces = Faces {
        x: [Face::VelocityInlet { velocity: along_x(-0.05) }, Face::FreeOutflow],
        y: [Face::wall(); 2],
        z: [Face::wall(); 2],
    };
    let solver = Solver::new(Setup::fluid(box_of([16, 6, 6], faces), SRT)).unwrap();
    let stopped = stop(solver, "pressure outlet");
    assert!(
        matches!(stopped.cause, Cause::DensityDrift { .. }),
        "the cause ought to be the drift of the density, and is: {stopped}"
    );
}

#[test]
fn body_force_that_nothing_holds_back_is_named() {
    let setup =
        Setup::fluid(box_of([4, 4, 4], Faces::PERIODIC), SRT).with_body_force(along_x(1e-3));
    let stopped = stop(Solver::new(setup).unwrap(), "body force");
    assert!(
        matches!(stopped.cause, Cause::BodyForce { .. }),
        "the cause ought to be the body force, and is: {stopped}"
    );
    // 0.5 of speed at 1e-3 a step takes 500 steps; the guard looks every 16.
    assert!(
        (500..=516).contains(&stopped.step),
        "the fall reaches the guard's limit at step 500, and was stopped at {}",
        stopped.step
    );
    assert!(matches!(stopped.failure, Failure::TooFast(_)));
}

#[test]
fn flow_too_fast_for_its_viscosity_is_named() {
    // A shear layer of two cells at a grid Reynolds number of 30,000.
    let setup = Setup::fluid(box_of([24, 24, 1], Faces::PERIODIC), Collision::Srt { tau: 0.50001 });
    let solver = Solver::starting_from(setup, |x| {
        let u = 0.25 * ((x.y - 12.0) / 1.0).tanh();
        (1.0, Vec3::new(u, 0.05 * (x.x * 0.2618).sin(), 0.0))
    });
    let stopped = stop(solver.unwrap(), "grid Reynolds number");
    assert!(
        matches!(stopped.cause, Cause::Unresolved { .. }),
        "the cause ought to be a flow that the grid does not resolve, and is: {stopped}"
    );
}

#[test]
fn what_fits_no_known_cause_is_said_to() {
    // Rates that amplify: unchecked on purpose, as a kernel under test might have them.
    let setup = Setup::fluid(box_of([4, 4, 4], Faces::PERIODIC), SRT);
    let rates = Rates { m: 2.5, ..Rates::dhumieres(0.8).unwrap() };
    let operator = psmrt_reference::collision::MrtOperator::new(&rates.diagonal());
    let operator = psmrt_reference::collision::CollisionOperator::Mrt(Box::new(operator));
    let mut random = common::random::Random(1);
    let start = (0..64).map(|_| random.populations()).collect();
    let stopped = stop(Solver::with_operator(setup, operator, start), "none of the known");
    assert_eq!(stopped.cause, Cause::Unknown);
}

#[test]
fn guard_looks_at_its_interval_and_no_broken_state_passes_it() {
    for interval in [1, 7, 50] {
        let mut setup =
            Setup::fluid(box_of([4, 4, 4], Faces::PERIODIC), SRT).with_body_force(along_x(1e-3));
        setup.guard = GuardSettings { interval, ..GuardSettings::default() };
        let stopped = stop(Solver::new(setup).unwrap(), "body force");
        assert_eq!(stopped.step % interval, 0);
    }
}

#[test]
fn look_at_the_callers_wish_finds_a_broken_state_between_two_looks() {
    let setup = Setup {
        guard: GuardSettings { interval: 1_000, ..GuardSettings::default() },
        ..Setup::fluid(box_of([4; 3], Faces::PERIODIC), Collision::Srt { tau: 0.51 })
    };
    let mut solver = Solver::starting_from(setup, |_| (1.0, along_x(0.01))).unwrap();
    solver.run(3).unwrap();
    solver.check_now().unwrap();
    let broken = vec![[f64::NAN; 19]; 64];
    let mut solver = Solver::from_populations(solver.setup().clone(), broken).unwrap();
    assert!(solver.check_now().is_err());
}

#[test]
fn impossible_boxes_and_faces_are_refused_with_a_way_out() {
    let still = Vec3::zeros();
    let inlet = Face::VelocityInlet { velocity: along_x(0.1) };
    let x = |low, high| Domain::new([4, 4, 4], Faces { x: [low, high], ..Faces::PERIODIC });
    let wrong: [(Result<Domain, DomainError>, &str); 9] = [
        (Domain::new([4, 0, 4], Faces::PERIODIC), "at least 1 cell"),
        (Domain::new([1 << 30, 1 << 30, 4], Faces::PERIODIC), "too large"),
        (x(Face::Periodic, Face::wall()), "face +x is not"),
        (x(Face::wall(), Face::Periodic), "face -x is not"),
        (x(Face::Wall { velocity: along_x(0.1) }, Face::wall()), "velocity inlet"),
        (x(Face::Wall { velocity: Vec3::new(0.0, f64::NAN, 0.0) }, Face::wall()), "finite"),
        (x(Face::Pressure { density: 0.0 }, Face::wall()), "positive"),
        (x(inlet, Face::wall()), "free outflow or a pressure outlet"),
        (x(Face::Wall { velocity: still }, Face::FreeOutflow), "add an inlet"),
    ];
    for (result, remedy) in wrong {
        let message = result.unwrap_err().to_string();
        assert!(message.contains(remedy), "no {remedy:?} in: {message}");
    }
    assert!(
        x(inlet, Face::FreeOutflow).is_ok() && x(inlet, Face::Pressure { density: 1.0 }).is_ok()
    );
}

#[test]
fn impossible_setups_are_refused_by_key_and_value() {
    let fluid = || Setup::fluid(box_of([4, 4, 4], Faces::PERIODIC), SRT);
    let with =
        |solid| fluid().with_solids(SolidPhase { solids: vec![solid], ..SolidPhase::default() });
    let sphere = |radius| Solid::fixed_sphere(Vec3::new(1.0, 1.0, 1.0), radius);
    let wrong = [
        (
            Setup::fluid(box_of([4, 4, 4], Faces::PERIODIC), Collision::Srt { tau: 0.5 }),
            "tau = 0.5",
        ),
        (fluid().with_body_force(along_x(f64::NAN)), "body force"),
        (with(sphere(0.0)), "radius = 0"),
        (with(sphere(f64::INFINITY)), "radius = inf"),
        (with(Solid { angular_velocity: along_x(f64::NAN), ..sphere(1.0) }), "spin = NaN"),
        (with(Solid::fixed_cells(vec![(64, 0.5)])), "cell 64"),
        (with(Solid::fixed_cells(vec![(0, 1.5)])), "solid fraction = 1.5"),
    ];
    for (setup, part) in wrong {
        let error: SetupError = Solver::new(setup).unwrap_err();
        assert!(error.to_string().contains(part), "no {part:?} in: {error}");
    }
}
