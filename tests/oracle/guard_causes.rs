//! Causes that the guard must tell apart, each provoked: the message says what would help, and not what would not.

use crate::common;

use common::Budget;
use common::collisions::dhumieres;
use psmrt_reference::collision::Collision;
use psmrt_reference::coupling::{CoupledSolver, CoupledStop, CouplingSettings, Gravity};
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::guard::{Cause, Stopped};
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
