//! Motion: how long a sub-step may be, free flight, grains that are held, and what is refused.

use crate::common;

use common::observed_order;
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::{ContactLaw, Friction};
use psmrt_reference::grains::lubrication::Lubrication;
use psmrt_reference::grains::motion::{SUBSTEPS_PER_CONTACT, Substeps, divide};
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::{GrainError, GrainSetup, PeriodicBox};
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Load;

/// Restitution of a central impact of unit duration with `per_contact` sub-steps, begun `phase`
/// sub-steps before the touch.
fn restitution(law: ContactLaw, per_contact: f64, phase: f64) -> f64 {
    let (dt, speed) = (1.0 / per_contact, 1e-6);
    let grain = |x: f64, v: f64| Grain {
        mass: 1.0,
        inertia: 0.1,
        ..Grain::sphere(Vec3::new(x, 0.0, 0.0), 0.5, 1.0).moving(Vec3::new(v, 0.0, 0.0))
    };
    let grains = vec![grain(0.0, 0.5 * speed), grain(1.0 + phase * dt * speed, -0.5 * speed)];
    let mut system = GrainSystem::new(GrainSetup::new(law), grains, Vec::new()).unwrap();
    let mut time = 0.0;
    while time < 3.0 {
        system.substep(dt, &[]).unwrap();
        time += dt;
    }
    (system.grains()[1].velocity.x - system.grains()[0].velocity.x) / speed
}

/// The linear law of a set-up.
fn linear(setup: &GrainSetup) -> ContactLaw {
    *setup.law.linear().unwrap()
}

#[test]
fn the_length_of_sub_steps_is_justified_by_the_error_of_restitution() {
    // Over where in a sub-step the contact begins, and ends.
    let worst = |e: f64, per_contact: f64| {
        let law = ContactLaw::from_duration_and_restitution(1.0, e, 0.5).unwrap();
        let error = |begin: u32, more: u32| {
            let (phase, more) = (f64::from(begin) / 20.0, f64::from(more) / 8.0);
            (restitution(law, per_contact + more, phase) - e).abs()
        };
        let errors = (0..20).flat_map(|begin| (0..8).map(move |more| error(begin, more)));
        errors.fold(0.0, f64::max)
    };
    // The table in motion.rs.
    let table =
        [(10.0, 0.016, 0.012), (15.0, 7.3e-3, 5.3e-3), (25.0, 2.7e-3, 2e-3), (50.0, 7e-4, 5e-4)];
    let mut points = Vec::new();
    for (per_contact, damped, undamped) in table {
        let of_damped = [0.05, 0.2, 0.4, 0.55, 0.6, 0.9].map(|e| worst(e, per_contact));
        let largest = of_damped.into_iter().fold(0.0, f64::max);
        println!("{per_contact}: {of_damped:?}, undamped {}", worst(1.0, per_contact));
        assert!(
            largest < damped,
            "{per_contact} sub-steps a contact: the damped impact errs by {largest}, more than the bound"
        );
        assert!(
            worst(1.0, per_contact) < undamped,
            "{per_contact} sub-steps a contact: the elastic impact errs by more than the bound"
        );
        points.push((1.0 / per_contact, largest));
    }
    // Second order, though the dashpot's force starts with a jump.
    let order = observed_order(&points);
    assert!(order > 1.9, "the error of an impact falls with order {order} of the sub-step, not 2");
    assert_eq!(SUBSTEPS_PER_CONTACT, 25.0);
}

/// Two grains of unit mass that last 1 in contact, with `substeps`.
fn pair(substeps: Substeps) -> GrainSystem {
    let law = ContactLaw::from_duration_and_restitution(1.0, 0.8, 0.5).unwrap();
    let grain = |x: f64| Grain { mass: 1.0, ..Grain::sphere(Vec3::new(x, 0.0, 0.0), 0.5, 1.0) };
    let setup = GrainSetup { substeps, ..GrainSetup::new(law) };
    GrainSystem::new(setup, vec![grain(0.0), grain(3.0)], Vec::new()).unwrap()
}

#[test]
fn sub_steps_are_chosen_and_refused_by_the_contact_duration() {
    assert_eq!(pair(Substeps::Automatic).step(1.0, &[]), Ok(25));
    assert_eq!(pair(Substeps::Automatic).step(0.01, &[]), Ok(1));
    assert_eq!(pair(Substeps::Fixed(10)).step(0.99, &[]), Ok(10));
    let message = |substeps, dt| pair(substeps).step(dt, &[]).unwrap_err().to_string();
    let too_long = message(Substeps::Fixed(9), 1.0);
    for part in [
        "sub-step = 0.1111111111111111 is too long",
        "a tenth of the shortest contact time",
        "make at least 10 sub-steps per step, or lengthen the contact duration (lower the stiffness)",
    ] {
        assert!(too_long.contains(part), "{too_long}");
    }
    assert!(message(Substeps::Fixed(0), 1.0).contains("there must be at least 1"));
    assert!(message(Substeps::Automatic, 0.0).contains("time step = 0: it must be positive"));
    assert!(message(Substeps::Automatic, f64::NAN).contains("it must be positive and finite"));
    // Light grains, planes and stiff tangential springs shorten it.
    let time = |change: fn(&mut GrainSetup, &mut Vec<Grain>, &mut Vec<Plane>)| {
        let start = pair(Substeps::Automatic);
        let (mut setup, mut grains, mut planes) =
            (*start.setup(), start.grains().to_vec(), Vec::new());
        change(&mut setup, &mut grains, &mut planes);
        GrainSystem::new(setup, grains, planes).unwrap().shortest_time()
    };
    assert!((time(|_, _, _| ()) - 1.0).abs() < 1e-12);
    assert!(time(|_, grains, _| grains[1].mass = 0.1) < 0.5);
    // Against a grain that is held the reduced mass is the mass itself.
    assert!(time(|_, grains, _| grains[1].held = true) > 1.4);
    assert!(time(|_, grains, _| grains.iter_mut().for_each(|g| g.held = true)).is_infinite());
    let stiff_floor = |setup: &mut GrainSetup, _: &mut Vec<Grain>, planes: &mut Vec<Plane>| {
        let law = linear(setup);
        let law = ContactLaw { stiffness: 100.0 * law.stiffness, ..law };
        planes.push(Plane::fixed(Vec3::new(0.0, 0.0, -5.0), Vec3::z(), law));
    };
    assert!(time(stiff_floor) < 0.2);
    let stiff_friction = |setup: &mut GrainSetup, _: &mut Vec<Grain>, _: &mut Vec<Plane>| {
        let law = linear(setup);
        let friction = Friction { coefficient: 0.5, stiffness: law.stiffness, damping: 0.0 };
        setup.law = ContactLaw { friction: Some(friction), ..law }.into();
    };
    assert!(time(stiff_friction) < 0.6);
    // Lubrication at its smallest gap: five times m/c, c = 6π μ a²/h about.
    let oil = |setup: &mut GrainSetup, _: &mut Vec<Grain>, _: &mut Vec<Plane>| {
        let (viscosity, cutoff_gap, smallest_gap) = (1.0, 0.1, 1e-3);
        setup.lubrication =
            Some(Lubrication { viscosity, cutoff_gap, smallest_gap, while_touching: true });
    };
    let slowest = 5.0 / (6.0 * std::f64::consts::PI * 0.25 / 1e-3);
    assert!((time(oil) / slowest - 1.0).abs() < 0.02);
    // A stiff dashpot too, though it makes contacts last longer.
    assert!(
        time(|setup, _, _| setup.law = ContactLaw { damping: 1e3, ..linear(setup) }.into()) < 0.01
    );
}

#[test]
fn sub_steps_at_the_limits_are_taken_and_beyond_them_refused() {
    // Ten in the shortest contact are allowed, to the last bit.
    assert_eq!(divide(1.0, 1.0, Substeps::Fixed(10)), Ok((10, 0.1)));
    assert!(divide(1.0, 1.0, Substeps::Fixed(9)).is_err());
    // As many as a u32 holds, and one more.
    let most = f64::from(u32::MAX);
    assert_eq!(divide(1.0, 25.0 / (most - 0.5), Substeps::Automatic), Ok((u32::MAX, 1.0 / most)));
    assert_eq!(divide(1.0, 1.0, Substeps::Fixed(u32::MAX)), Ok((u32::MAX, 1.0 / most)));
    assert!(divide(1.0, 25.0 / (most + 1.0), Substeps::Automatic).is_err());
    assert!(divide(1.0, 0.0, Substeps::Automatic).is_err());
    for step in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        assert!(divide(step, 1.0, Substeps::Automatic).is_err(), "step {step}");
    }
}

#[test]
fn free_flight_and_steady_torque_are_exact() {
    let law = ContactLaw::new(1.0, 0.0).unwrap();
    let (v, omega) = (Vec3::new(1.0, 2.0, 3.0), Vec3::new(0.2, 0.0, -0.1));
    let grain = Grain::sphere(Vec3::new(0.5, 0.25, 0.0), 0.5, 2.0).moving(v).spinning(omega);
    let gravity = Vec3::new(0.0, 0.0, -9.81);
    let setup = GrainSetup { gravity, ..GrainSetup::new(law) };
    let load = Load { force: Vec3::new(0.3, 0.0, 0.1), torque: Vec3::new(0.0, 0.02, 0.01) };
    let mut system = GrainSystem::new(setup, vec![grain], Vec::new()).unwrap();
    let (t, steps) = (2.0, 50);
    for _ in 0..steps {
        system.step(t / f64::from(steps), &[load]).unwrap();
    }
    let after = system.grains()[0];
    // Verlet is exact under constant forces; each of some 100 sub-steps rounds once.
    let a = gravity + load.force / grain.mass;
    let round_off = 100.0 * f64::EPSILON * 20.0;
    assert!((after.position - (grain.position + v * t + 0.5 * t * t * a)).norm() < round_off);
    assert!((after.velocity - (v + a * t)).norm() < round_off);
    assert!(
        (after.angular_velocity - (omega + load.torque / grain.inertia * t)).norm() < round_off
    );
    // Turning about one axis: the angle is exact too.
    let mut system = GrainSystem::new(setup, vec![grain], Vec::new()).unwrap();
    for _ in 0..10 {
        system.step(0.3, &[]).unwrap();
    }
    let turned = system.grains()[0].orientation.scaled_axis();
    assert!(
        (turned - 3.0 * omega).norm() < round_off,
        "angle turned in a time of 3: {turned}, not three times the angular velocity"
    );
}

#[test]
fn held_grains_keep_their_motion_and_push_the_others() {
    let law = ContactLaw::from_duration_and_restitution(0.1, 0.5, 1.0).unwrap();
    let sphere = |x: f64| Grain { mass: 1.0, ..Grain::sphere(Vec3::new(x, 0.0, 0.0), 0.5, 1.0) };
    let ram = Grain { held: true, ..sphere(0.0) }.moving(Vec3::x()).spinning(Vec3::z());
    let mut system =
        GrainSystem::new(GrainSetup::new(law), vec![ram, sphere(1.01)], Vec::new()).unwrap();
    let load = Load { force: Vec3::y(), torque: Vec3::y() };
    system.step(0.5, &[load, Load::default()]).unwrap();
    let [ram, hit] = [system.grains()[0], system.grains()[1]];
    assert_eq!((ram.velocity, ram.angular_velocity), (Vec3::x(), Vec3::z()));
    assert!((ram.position.x - 0.5).abs() < 1e-14);
    // (1 + e) times the ram's speed, to the error of 25 sub-steps per contact.
    assert!(
        (hit.velocity.x - 1.5).abs() < 2.7e-3,
        "a grain hit by one that is held in its motion moves at {}, not at (1 + e) of the \
         other's velocity, 1.5",
        hit.velocity.x
    );
}

#[test]
fn broken_motion_is_reported_with_the_grain_s_number() {
    let mut system = pair(Substeps::Automatic);
    let bad = Load { force: Vec3::new(f64::NAN, 0.0, 0.0), ..Load::default() };
    let stopped = system.step(0.1, &[Load::default(), bad]).unwrap_err();
    assert!(matches!(stopped, GrainError::NotFinite { grain: 1, .. }), "{stopped}");
    assert!(stopped.to_string().contains("its motion has broken down"), "{stopped}");
}

#[test]
fn grains_and_boxes_that_make_no_sense_are_refused() {
    let law = ContactLaw::new(1.0, 0.0).unwrap();
    let sphere = Grain::sphere(Vec3::zeros(), 0.5, 1.0);
    let message = |setup, grain, planes| {
        GrainSystem::new(setup, vec![sphere, grain], planes).unwrap_err().to_string()
    };
    let free = GrainSetup::new(law);
    let radius = message(free, Grain { radius: -1.0, ..sphere }, Vec::new());
    assert_eq!(radius, "grain 1 has radius = -1: it must be positive and finite");
    let short = GrainSetup { sides: PeriodicBox::all([4.0, 0.9, 4.0]), ..free };
    let short = message(short, sphere, Vec::new());
    assert!(
        short.contains("0.9 long along its periodic axis y: it must be longer than 1"),
        "{short}"
    );
    let sides = PeriodicBox { lengths: [None, None, Some(4.0)] };
    let floor = Plane::fixed(Vec3::zeros(), Vec3::z(), law);
    let across = message(GrainSetup { sides, ..free }, sphere, vec![floor]);
    assert!(across.contains("plane 0 cuts the periodic axis z"), "{across}");
    let crooked = Plane { normal: Vec3::new(0.0, 0.0, 2.0), ..floor };
    assert!(message(free, sphere, vec![crooked]).contains("normal of length 2: it must be 1"));
}
