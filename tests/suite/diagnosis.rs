//! Why a run was stopped: each cause is provoked, and the message says what would help, and not what would not.

use crate::common;

use common::Budget;
use common::broken;
use common::collisions::dhumieres;
use psmrt::diagnosis::{Cause, ExplainedStop, diagnosed};
use psmrt_reference::collision::{Collision, CollisionOperator, MrtOperator};
use psmrt_reference::coupling::{
    CoupledSolver, CoupledStop, CouplingSettings, FreeGrains, Gravity,
};
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::guard::{Evidence, Failure, Stopped};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

const AMBIENT: Face = Face::Pressure { density: 1.0 };

fn inlet(u: f64) -> Face {
    Face::VelocityInlet { velocity: Vec3::new(u, 0.0, 0.0) }
}

/// A duct of one cell across, between two faces.
fn duct(length: usize, x: [Face; 2], tau: f64) -> Setup {
    let domain = Domain::new([length, 1, 1], Faces { x, ..Faces::PERIODIC }).unwrap();
    Setup::fluid(domain, dhumieres(tau))
}

/// Runs until the guard stops it: after a few hundred steps of tens of cells.
fn stop(mut solver: Solver, steps: u64) -> ExplainedStop {
    let stopped = solver.run(steps).expect_err("this set-up must not survive");
    diagnosed(stopped, solver.setup(), None)
}

/// The same of at most 2,000 steps of 600 cells; the message says what a user needs.
fn stopped_with(solver: Solver, remedy: &str) -> ExplainedStop {
    let diagnosis = stop(solver, 2000);
    check_words(&diagnosis, &["step", "cell", "Probable cause", remedy], &[]);
    diagnosis
}

/// Errors unless the message holds all of `due` and none of `wrong`.
fn check_words(stopped: &ExplainedStop, due: &[&str], wrong: &[&str]) {
    let message = stopped.to_string();
    for part in due {
        assert!(message.contains(part), "no {part:?} in: {message}");
    }
    for part in wrong {
        assert!(!message.contains(part), "{part:?} does not help here, but is in: {message}");
    }
}

#[test]
fn inlet_with_a_pressure_outlet_started_from_rest_is_told_of_its_start_and_not_of_another_outlet() {
    let from_rest = Solver::new(duct(64, [inlet(0.2), AMBIENT], 0.51)).unwrap();
    let stopped = stop(from_rest, 200);
    assert!(matches!(stopped.cause, Cause::ImpulsiveStart { face: "-x", .. }), "{stopped}");
    // A velocity step of 0.2 sends out a wave of 0.2 √3 = 0.346 times the density (p' = ρ c_s u).
    check_words(
        &stopped,
        &["face -x", "0.200", "0.346", "with the inlet's velocity"],
        &["free outflow", "Use a pressure outlet"],
    );
    // The remedy works: the same started with the inlet's velocity stays a uniform stream.
    let start = |_| (1.0, Vec3::new(0.2, 0.0, 0.0));
    let mut moving = Solver::starting_from(duct(64, [inlet(0.2), AMBIENT], 0.51), start).unwrap();
    Budget::oracle(20_000).run(&mut moving, 300);
    let off = moving.velocity_field().iter().map(|u| (u.x - 0.2).abs()).fold(0.0, f64::max);
    // Why: 300 steps of round-off of values of order 1.
    assert!(off < 1e-12, "the stream that starts with its inlet's velocity is off by {off:e}");
}

#[test]
fn inlet_that_pushes_into_a_tight_plug_is_told_of_the_resistance_and_not_of_sound() {
    // 24 of 32 cells nearly full: by Darcy's law with nu/2 = 1/60 of a cell (ERRATA.md, leakage) the plug needs
    // a density of 3 * 24 * 0.05 * 2 = 7 times that at the outlet, which no sound of the start explains.
    let plug = Solid::fixed_cells((4..28).map(|cell| (cell, 1.0)).collect());
    let phase = SolidPhase { solids: vec![plug], ..SolidPhase::default() };
    let setup = duct(32, [inlet(0.05), AMBIENT], 0.6).with_solids(phase);
    let start = |_| (1.0, Vec3::new(0.05, 0.0, 0.0));
    let stopped = stop(Solver::starting_from(setup, start).unwrap(), 6000);
    assert!(matches!(stopped.cause, Cause::ResistedInlet { face: "-x", .. }), "{stopped}");
    check_words(&stopped, &["resistance", "smaller time step"], &["free outflow", "sound"]);
}

/// A free grain in a periodic box of 8 cells, under gravity along z; runs until it is stopped.
fn fall(budget: &mut Budget, density: f64, gravity: Gravity, tau: f64) -> ExplainedStop {
    let domain = Domain::new([8; 3], Faces::PERIODIC).unwrap();
    let mut setup = Setup::fluid(domain, Collision::Srt { tau }).with_solids(SolidPhase::default());
    if let Gravity::OnFluidToo { acceleration } = gravity {
        setup = setup.with_body_force(acceleration);
    }
    let grain = Grain::sphere(Vec3::new(4.2, 3.9, 4.0), 2.4, density);
    let settings = CouplingSettings { gravity: Some(gravity), ..CouplingSettings::default() };
    let law = ContactLaw::from_duration_and_restitution(10.0, 0.5, 0.5 * grain.mass).unwrap();
    let sides = PeriodicBox::all([8.0; 3]);
    let grain_setup = GrainSetup { sides, ..GrainSetup::new(law) };
    let start = |_| (1.0, Vec3::zeros());
    let mut solver =
        CoupledSolver::new(setup, start, grain_setup, vec![grain], Vec::new(), settings).unwrap();
    loop {
        budget.spend(10 * 512);
        match solver.run(10) {
            Ok(()) => {}
            Err(CoupledStop::Fluid(stopped)) => {
                let grains = Some((solver.free_grains(), &[0][..]));
                return diagnosed(stopped, solver.fluid().setup(), grains);
            }
            Err(other) => panic!("must be stopped by the guard, not by {other}"),
        }
    }
}

#[test]
fn grain_lighter_than_the_fluid_is_named_at_every_time_step_and_no_smaller_one_is_advised() {
    let acceleration = Vec3::new(0.0, 0.0, -1e-4);
    let mut budget = Budget::oracle(600_000);
    for tau in [0.8, 0.51] {
        let stopped = fall(&mut budget, 0.3, Gravity::Reduced { acceleration }, tau);
        assert!(matches!(stopped.cause, Cause::LightGrain { solid: 0, .. }), "{tau}: {stopped}");
        check_words(&stopped, &["0.30 times the density", "denser"], &["smaller time step"]);
    }
}

#[test]
fn endless_fall_in_a_box_periodic_along_gravity_is_named_and_no_smaller_step_is_advised() {
    let acceleration = Vec3::new(0.0, 0.0, -5e-3);
    let mut budget = Budget::oracle(600_000);
    for gravity in [Gravity::Reduced { acceleration }, Gravity::OnFluidToo { acceleration }] {
        let stopped = fall(&mut budget, 5.0, gravity, 0.8);
        let Cause::EndlessFall { axis, speed } = stopped.cause else {
            panic!("{gravity:?}: {stopped}")
        };
        assert!(axis == "z" && speed < 0.0, "{stopped}");
        check_words(&stopped, &["periodic along gravity", "Balance"], &["Use a smaller time step"]);
    }
}

/// What grains that are as given say of a stop of the fluid before step 1000, of which it knows no cause, in a
/// periodic box of 16 cells.
fn blamed(grains: &[Grain], gravity: Option<Gravity>) -> Cause {
    let domain = Domain::new([16; 3], Faces::PERIODIC).unwrap();
    let law = ContactLaw::from_duration_and_restitution(10.0, 0.5, 1.0).unwrap();
    let setup = GrainSetup { sides: PeriodicBox::all([16.0; 3]), ..GrainSetup::new(law) };
    let settings = CouplingSettings { gravity, ..CouplingSettings::default() };
    let solids: Vec<usize> = (0..grains.len()).collect();
    let grains = FreeGrains::new(&domain, setup, grains.to_vec(), Vec::new(), settings).unwrap();
    let evidence =
        Evidence { first_mean_density: Some(1.0), last_mean_density: 1.0, last_max_speed: 0.0 };
    let stopped = Stopped { step: 1000, cell: [0; 3], failure: Failure::NotFinite, evidence };
    let fluid = Setup::fluid(domain, Collision::Srt { tau: 0.8 });
    diagnosed(stopped, &fluid, Some((&grains, &solids))).cause
}

#[test]
fn light_grain_that_is_slow_fixed_or_prescribed_is_not_blamed_for_what_a_heavy_fast_one_does() {
    let light = Grain::sphere(Vec3::new(4.0, 4.0, 4.0), 2.4, 0.3);
    let fast = Vec3::new(0.3, 0.0, 0.0);
    let heavy = Grain::sphere(Vec3::new(11.0, 11.0, 11.0), 2.4, 3.0).moving(fast);
    let turning = |omega: f64| light.spinning(Vec3::new(0.0, 0.0, omega));
    // Its surface turns at 2.4 * 0.03 = 0.07 cells a step; slower than 0.1 breaks nothing.
    let slow = turning(0.03).moving(Vec3::new(0.0, 0.05, 0.0));
    let prescribed = Grain { held: true, ..light.moving(fast) };
    for (name, grain) in [("slow", slow), ("prescribed", prescribed), ("fixed", light)] {
        let grain = Grain { held: grain.held || name == "fixed", ..grain };
        let cause = blamed(&[heavy, grain], None);
        assert_eq!(cause, Cause::Unknown, "beside a heavy fast grain, a light one that is {name}");
    }
    // Either motion is enough: 0.3 cells a step along x, or 2.4 * 0.1 = 0.24 of its surface.
    for (name, grain) in [("moves fast", light.moving(fast)), ("turns fast", turning(0.1))] {
        let cause = blamed(&[heavy, grain], None);
        let Cause::LightGrain { solid: 1, ratio } = cause else {
            panic!("a light grain that {name} beside a heavy fast one: {cause:?}")
        };
        // Why: a handful of roundings.
        assert!((ratio - 0.3).abs() < 1e-12, "a density of 0.3 times the fluid's, not {ratio}");
    }
}

#[test]
fn a_fall_is_endless_from_half_of_free_fall_up_and_its_speed_is_the_mean() {
    let gravity = Gravity::Reduced { acceleration: Vec3::new(0.0, 0.0, -5e-3) };
    // Of 5 times the fluid's density: an excess mass of 4 V each, in a box of 16³ cells of fluid of density 1.
    let volume = 4.0 / 3.0 * std::f64::consts::PI * 2.4_f64.powi(3);
    let excess = 2.0 * 4.0 * volume;
    // After 1,000 steps in which all mass is accelerated by the excess weight.
    let free_fall = 1000.0 * 5e-3 * excess / (4096.0 + excess);
    // Why: between round-off and the least that another mass of grains or fluid would make, 1 of 4,559.
    for (share, due) in [(0.5 + 1e-5, true), (0.5 - 1e-5, false)] {
        let mean = share * free_fall;
        let at = |z: f64, speed: f64| {
            Grain::sphere(Vec3::new(8.0, 8.0, z), 2.4, 5.0).moving(Vec3::new(0.0, 0.0, -speed))
        };
        let cause = blamed(&[at(4.0, 1.5 * mean), at(12.0, 0.5 * mean)], Some(gravity));
        match cause {
            Cause::EndlessFall { axis: "z", speed } => {
                assert!(due && (speed + mean).abs() < 1e-12, "at {share} of free fall: {speed}");
            }
            other => assert!(!due, "at {share} of free fall: {other:?}"),
        }
    }
}

#[test]
fn no_fall_is_endless_where_one_of_the_grains_is_fixed() {
    let gravity = Gravity::Reduced { acceleration: Vec3::new(0.0, 0.0, -5e-3) };
    let at = |x: f64, z: f64| Grain::sphere(Vec3::new(x, x, z), 2.4, 5.0);
    // With an excess mass of 4 V each (V = 57.9) beside 4096 of the fluid, all fall freely at 0.51 (two grains) or
    // 0.73 cells a step (three) after 1000 steps. Two at 0.7 and one at rest are 0.64 of that: still a free fall.
    let falling = Vec3::new(0.0, 0.0, -0.7);
    let [first, second] = [at(4.0, 4.0), at(11.0, 4.0)].map(|grain| grain.moving(falling));
    let third = at(4.0, 11.0);
    let cause = blamed(&[first, second], Some(gravity));
    assert!(matches!(cause, Cause::EndlessFall { axis: "z", .. }), "all are free: {cause:?}");
    for (name, resting, due) in
        [("free", third, false), ("fixed", Grain { held: true, ..third }, true)]
    {
        let cause = blamed(&[first, second, resting], Some(gravity));
        let is_endless = matches!(cause, Cause::EndlessFall { .. });
        assert_eq!(!is_endless, due, "two fall, one at rest is {name}: {cause:?}");
    }
}

const SRT: Collision = Collision::Srt { tau: 0.8 };

fn box_of(cells: [usize; 3], faces: Faces) -> Domain {
    Domain::new(cells, faces).unwrap()
}

fn along_x(u: f64) -> Vec3 {
    Vec3::new(u, 0.0, 0.0)
}

#[test]
fn broken_initial_state_is_named_before_the_first_step() {
    for (_, solver) in broken::at_the_start() {
        let stopped = stopped_with(solver, "initial state");
        assert_eq!((stopped.stopped.step, stopped.stopped.cell), (0, broken::CELL));
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
    let stopped = stopped_with(Solver::new(setup).unwrap(), "solid 1 moves at 1.000");
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
    let stopped = stopped_with(solver, "face +z");
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
    let stopped = stopped_with(Solver::new(setup).unwrap(), "pressures at the faces");
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
    let stopped = stopped_with(solver, "pressure outlet");
    assert!(
        matches!(stopped.cause, Cause::DensityDrift { .. }),
        "the cause ought to be the drift of the density, and is: {stopped}"
    );
}

#[test]
fn body_force_that_nothing_holds_back_is_named() {
    let setup =
        Setup::fluid(box_of([4, 4, 4], Faces::PERIODIC), SRT).with_body_force(along_x(1e-3));
    let stopped = stopped_with(Solver::new(setup).unwrap(), "body force");
    assert!(
        matches!(stopped.cause, Cause::BodyForce { .. }),
        "the cause ought to be the body force, and is: {stopped}"
    );
    // 0.5 of speed at 1e-3 a step takes 500 steps; the guard looks every 16.
    assert!(
        (500..=516).contains(&stopped.stopped.step),
        "the fall reaches the guard's limit at step 500, and was stopped at {}",
        stopped.stopped.step
    );
    assert!(matches!(stopped.stopped.failure, Failure::TooFast(_)));
}

#[test]
fn flow_too_fast_for_its_viscosity_is_named() {
    // A shear layer of two cells at a grid Reynolds number of 30,000.
    let setup = Setup::fluid(box_of([24, 24, 1], Faces::PERIODIC), Collision::Srt { tau: 0.50001 });
    let solver = Solver::starting_from(setup, |x| {
        let u = 0.25 * ((x.y - 12.0) / 1.0).tanh();
        (1.0, Vec3::new(u, 0.05 * (x.x * 0.2618).sin(), 0.0))
    });
    let stopped = stopped_with(solver.unwrap(), "grid Reynolds number");
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
    let operator = MrtOperator::new(&rates.diagonal());
    let operator = CollisionOperator::Mrt(Box::new(operator));
    let mut random = common::random::Random(1);
    let start = (0..64).map(|_| random.populations()).collect();
    let stopped = stopped_with(Solver::with_operator(setup, operator, start), "none of the known");
    assert_eq!(stopped.cause, Cause::Unknown);
}
