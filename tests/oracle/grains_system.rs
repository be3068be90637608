//! Many grains: rest, restarts, independence of numbering, and changes by hand.

use crate::common;

use common::random::Random;
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::motion::SUBSTEPS_PER_CONTACT;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::Vec3;

/// A pyramid of 9 + 4 + 1 spheres of diameter 1 on a rough floor. The lowest are held by friction alone:
/// it takes a coefficient of tan(45°/2) = 0.41, and more while the springs are drawn.
fn pyramid() -> GrainSystem {
    let mass = Grain::sphere(Vec3::zeros(), 0.5, 1.0).mass;
    let law = ContactLaw::from_stiffness_and_restitution(1e4 * mass, 0.3, 0.5 * mass).unwrap();
    let law = law.with_friction(1.0).unwrap();
    let mut grains = Vec::new();
    for (layer, side) in [(0.0, 3), (1.0, 2), (2.0, 1)] {
        for i in 0..side * side {
            let along = |i: i32| f64::from(i) + 0.5 * layer;
            let height = 0.5 + layer * 0.5_f64.sqrt();
            let place = Vec3::new(along(i % side), along(i / side), height);
            grains.push(Grain::sphere(place, 0.5, 1.0));
        }
    }
    let floor = Plane::fixed(Vec3::zeros(), Vec3::z(), law);
    let setup = GrainSetup { gravity: Vec3::new(0.0, 0.0, -1.0), ..GrainSetup::new(law) };
    GrainSystem::new(setup, grains, vec![floor]).unwrap()
}

#[test]
fn a_pyramid_at_rest_stays_at_rest_for_a_hundred_thousand_sub_steps() {
    let mut system = pyramid();
    let substep = system.shortest_time() / SUBSTEPS_PER_CONTACT;
    let run = |system: &mut GrainSystem, count: u32| {
        for _ in 0..count {
            system.substep(substep, &[]).unwrap();
        }
    };
    run(&mut system, 20_000); // the weight is taken up
    let start = system.grains().to_vec();
    run(&mut system, 100_000);
    for (now, then) in system.grains().iter().zip(&start) {
        let (way, turn) =
            ((now.position - then.position).norm(), now.orientation.angle_to(&then.orientation));
        // Round-off of positions of order 2, added up at random over 1e5 sub-steps: 300 x 4e-16.
        assert!(
            way < 1e-13 && now.velocity.norm() < 1e-12,
            "a grain of a pyramid at rest has moved by {way:e}, its velocity is {:e}",
            now.velocity.norm()
        );
        assert!(
            turn < 1e-7 && now.angular_velocity.norm() < 1e-12,
            "a grain of a pyramid at rest has turned by {turn:e}, its angular velocity is {:e}",
            now.angular_velocity.norm()
        );
    }
    let weight: f64 = start.iter().map(|grain| grain.mass).sum();
    assert!((system.force_on_plane(0).z + weight).abs() < 1e-10 * weight);
}

/// Spheres thrown into a periodic box, rough and damped.
fn shaken(count: usize, side: f64, seed: u64) -> GrainSystem {
    let mut random = Random(seed);
    let mass = Grain::sphere(Vec3::zeros(), 0.5, 1.0).mass;
    let law = ContactLaw::from_duration_and_restitution(0.05, 0.7, 0.5 * mass).unwrap();
    let law = law.with_friction(0.4).unwrap().with_rolling(0.05).unwrap();
    let cells = side.floor();
    let place = |i: usize| {
        let i = i as f64;
        let cell = Vec3::new(i % cells, (i / cells).floor() % cells, (i / cells / cells).floor());
        cell * (side / cells)
    };
    let grains = (0..count).map(|i| {
        let radius = random.between(0.35, 0.5);
        Grain::sphere(place(i), radius, 1.0).moving(random.vector(1.0)).spinning(random.vector(2.0))
    });
    let grains = grains.collect();
    let setup = GrainSetup { sides: PeriodicBox::all([side; 3]), ..GrainSetup::new(law) };
    GrainSystem::new(setup, grains, Vec::new()).unwrap()
}

#[test]
fn permuted_numbers_give_the_same_motion_over_the_first_contacts() {
    let mut system = shaken(64, 4.8, 5);
    // Backwards, and the two halves exchanged: no pair keeps its order.
    let order: Vec<usize> = (0..64).rev().map(|i| (i + 32) % 64).collect();
    let grains = order.iter().map(|&i| system.grains()[i]).collect();
    let mut permuted = GrainSystem::new(*system.setup(), grains, Vec::new()).unwrap();
    let (mut contacts, mut were_touching, mut substeps) = (0, 0, 0);
    while contacts < 10 {
        substeps += 1;
        assert!(
            substeps < 10_000,
            "after 10,000 sub-steps there are {contacts} contacts: the state that the test \
             needs was never reached"
        );
        system.substep(1e-3, &[]).unwrap();
        permuted.substep(1e-3, &[]).unwrap();
        let touching = system.pairs().iter().filter(|pair| pair.memory.is_some()).count();
        contacts += touching.saturating_sub(were_touching);
        were_touching = touching;
    }
    for (place, &number) in order.iter().enumerate() {
        let (one, two) = (&system.grains()[number], &permuted.grains()[place]);
        // Some hundred sub-steps, each rounding quantities of order 1; ten contacts multiply a
        // difference by about ten each at worst, but few grains have seen more than one.
        assert!(
            (one.position - two.position).norm() < 1e-12,
            "grain {number}: its place depends on how the grains are numbered"
        );
        assert!(
            (one.velocity - two.velocity).norm() < 1e-11,
            "grain {number}: its velocity depends on how the grains are numbered"
        );
        assert!(
            (one.angular_velocity - two.angular_velocity).norm() < 1e-11,
            "grain {number}: its angular velocity depends on how the grains are numbered"
        );
    }
}

#[test]
fn a_run_that_is_stopped_and_resumed_gives_the_same_bits() {
    let mut system = shaken(125, 5.2, 9);
    // Stopped in the midst of ten contacts.
    let mut steps = 0;
    while system.state().pair_contacts.len() < 10 {
        system.step(0.01, &[]).unwrap();
        steps += 1;
        assert!(
            steps < 1000,
            "after 1,000 steps there are {} contacts: the state that the test needs was never reached",
            system.state().pair_contacts.len()
        );
    }
    let mut resumed = GrainSystem::resume(*system.setup(), system.state()).unwrap();
    system.step(0.4, &[]).unwrap();
    resumed.step(0.4, &[]).unwrap();
    assert!(system.state() == resumed.state());
}

#[test]
fn pairs_that_are_moved_apart_by_hand_forget_their_springs_and_others_keep_them() {
    let law = ContactLaw::new(1.0, 0.1).unwrap().with_friction(0.5).unwrap();
    let sphere = |x: f64, y: f64, v: f64| {
        Grain::sphere(Vec3::new(x, y, 0.0), 0.5, 1.0).moving(Vec3::new(0.0, v, 0.0))
    };
    // Two sliding pairs; the one that comes first in the list is pulled apart.
    let grains = vec![
        sphere(0.0, 0.0, 0.1),
        sphere(0.9, 0.0, 0.0),
        sphere(5.0, 0.0, 0.1),
        sphere(5.9, 0.0, 0.0),
    ];
    let mut system = GrainSystem::new(GrainSetup::new(law), grains, Vec::new()).unwrap();
    system.step(0.5, &[]).unwrap();
    let before = system.state().pair_contacts;
    assert_eq!(before.len(), 2);
    system.edit(|grains, _| grains[0].position.x = -3.0).unwrap();
    let after = system.state().pair_contacts;
    assert_eq!((after.len(), after[0].pair), (1, before[1].pair));
    // Put into the plane of contact again, which rounds.
    let spring = before[1].memory.spring;
    assert!(
        (after[0].memory.spring - spring).norm() < 1e-16 && spring.y > 0.01,
        "the spring of the pair that stayed together has changed; it was {spring}"
    );
}
