//! The guard stops a run whose state breaks, at its interval, with the step and the cell; set-ups that cannot be run are refused.

use crate::common::broken;
use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, DomainError, Face, Faces};
use psmrt_reference::guard::{Failure, GuardSettings};
use psmrt_reference::lattice::Vec3;
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

#[test]
fn a_broken_state_is_found_at_the_next_check_with_its_step_and_cell() {
    for ((rho, u), mut solver) in broken::at_the_start() {
        let stopped = solver.run(10).expect_err("a broken cell must not survive");
        assert_eq!((stopped.step, stopped.cell), (0, broken::CELL), "density {rho}, velocity {u}");
        for part in ["before step 0", "cell [2, 1, 0]"] {
            assert!(stopped.to_string().contains(part), "no {part:?} in: {stopped}");
        }
    }
}

#[test]
fn guard_checks_at_its_interval_and_no_broken_state_passes_it() {
    for interval in [1, 7, 16, 50] {
        let mut setup =
            Setup::fluid(box_of([4, 4, 4], Faces::PERIODIC), SRT).with_body_force(along_x(1e-3));
        setup.guard = GuardSettings { interval, ..GuardSettings::default() };
        let stopped = Solver::new(setup).unwrap().run(2000).expect_err("nothing holds it back");
        assert!(matches!(stopped.failure, Failure::TooFast(_)), "{stopped}");
        assert_eq!(
            stopped.step % interval,
            0,
            "checked every {interval} steps, and stopped: {stopped}"
        );
        // 0.5 of speed at 1e-3 a step takes 500 steps.
        assert!(
            (500..500 + interval + 1).contains(&stopped.step),
            "the limit is reached at step 500, and the run was stopped at {}",
            stopped.step
        );
    }
}

#[test]
fn check_at_the_callers_wish_finds_a_broken_state_between_two_checks() {
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
