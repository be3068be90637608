//! Causes that the guard must tell apart, each provoked: the message says what would help, and not what would not.

use crate::common;

use common::Budget;
use common::collisions::dhumieres;
use psmrt_reference::collision::Collision;
use psmrt_reference::coupling::{
    CoupledSolver, CoupledStop, CouplingSettings, FreeGrains, Gravity,
};
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::guard::{Cause, Failure, Stopped};
use psmrt_reference::lattice::Vec3;
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
fn stop(mut solver: Solver, steps: u64) -> Stopped {
    solver.run(steps).expect_err("this set-up must not survive")
}

/// Errors unless the message holds all of `due` and none of `wrong`.
fn check_words(stopped: &Stopped, due: &[&str], wrong: &[&str]) {
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
fn fall(budget: &mut Budget, density: f64, gravity: Gravity, tau: f64) -> Stopped {
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
            Err(CoupledStop::Fluid(stopped)) => return stopped,
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
    let grains = FreeGrains::new(&domain, setup, grains.to_vec(), Vec::new(), settings).unwrap();
    let failure = Failure::NotFinite;
    grains.explain(Stopped { step: 1000, cell: [0; 3], failure, cause: Cause::Unknown }).cause
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
