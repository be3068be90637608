//! Pairs: the list of cells against all pairs, periodic images, and the same bits on any number of
//! threads.

use crate::common;

use common::random::Random;
use proptest::prelude::*;
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::neighbours::{Candidate, candidates};
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::grains::system::{GrainState, GrainSystem};
use psmrt_reference::lattice::Vec3;
use std::f64::consts::PI;

/// All pairs within reach, by looking at every pair and every image.
fn by_looking(grains: &[Grain], sides: &PeriodicBox, reach: f64) -> Vec<Candidate> {
    let mut found = Vec::new();
    // Grains up to two boxes away from each other have images up to three boxes away in reach.
    let images = |axis: usize| if sides.lengths[axis].is_some() { -5..=5 } else { 0..=0 };
    for first in 0..grains.len() {
        for second in first + 1..grains.len() {
            for x in images(0) {
                for y in images(1) {
                    for z in images(2) {
                        let (one, two) = (&grains[first], &grains[second]);
                        let offset = sides.offset(&one.position, &two.position, [x, y, z]);
                        if offset.norm() < one.radius + two.radius + reach {
                            let [first, second] =
                                [first, second].map(|n| u32::try_from(n).unwrap());
                            found.push(Candidate { first, second, image: [x, y, z] });
                        }
                    }
                }
            }
        }
    }
    found.sort_unstable();
    found
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 200, failure_persistence: None, ..ProptestConfig::default()
    })]

    #[test]
    fn the_list_of_cells_finds_what_looking_at_all_pairs_finds(
        seed in any::<u64>(), count in 0_usize..40,
        lengths in prop::array::uniform3(1.21..6.0_f64),
        periodic in prop::array::uniform3(any::<bool>()),
        graded in any::<bool>(), far in any::<bool>(),
    ) {
        let mut random = Random(seed);
        let lengths_of = |axis: usize| periodic[axis].then_some(lengths[axis]);
        let sides = PeriodicBox { lengths: std::array::from_fn(lengths_of) };
        // Unwrapped: up to two boxes away; and one grain far off, for a box that is mostly empty.
        let mut grains: Vec<Grain> = (0..count).map(|_| {
            let place = Vec3::from_fn(|i, _| random.between(-1.0, 2.0) * lengths[i]);
            let radius = if graded { random.between(0.05, 0.5) } else { 0.5 };
            Grain::sphere(place, radius, 1.0)
        }).collect();
        if far && count > 0 && !periodic[0] {
            grains[0].position.x = 1e7;
        }
        let reach = 0.2;
        let found = candidates(&grains, &sides, reach);
        prop_assert_eq!(&found, &by_looking(&grains, &sides, reach));
        prop_assert!(found.is_sorted());
    }
}

#[test]
fn a_pair_that_touches_through_two_faces_has_two_contacts_and_twice_the_stiffness() {
    // Box of 1.9 diameters: both gaps are -0.05 when they stand evenly.
    let law = ContactLaw::new(1.0, 0.0).unwrap();
    let sides = PeriodicBox { lengths: [Some(1.9), None, None] };
    let grain = |x: f64| Grain { mass: 1.0, ..Grain::sphere(Vec3::new(x, 0.0, 0.0), 0.5, 1.0) };
    let start = |shift: f64| {
        let setup = GrainSetup { sides, ..GrainSetup::new(law) };
        GrainSystem::new(setup, vec![grain(0.5), grain(1.45 + shift)], Vec::new()).unwrap()
    };
    let even = start(0.0);
    let images: Vec<_> = even.pairs().iter().map(|pair| pair.candidate.image[0]).collect();
    assert_eq!(images, [-1, 0]);
    assert!(even.pairs().iter().all(|pair| pair.memory.is_some()));
    // The two forces cancel to the rounding of 1.45 and 1.9.
    assert!(even.contact_loads()[0].force.norm() < 4.0 * f64::EPSILON);

    // Shifted by less than the overlap it swings with 2 k: ω = √(2 k/(m/2)) = 2.
    let mut system = start(0.01);
    for _ in 0..100 {
        system.substep(2.0 * PI / 2.0 / 100.0, &[]).unwrap();
    }
    let shift = system.grains()[1].position.x - system.grains()[0].position.x - 0.95;
    // After one period; Verlet's phase is off by (ω dt)²/24 of it, which counts squared.
    assert!(
        (shift - 0.01).abs() < 1e-7,
        "after a period of twice the stiffness the pair is {shift} off its balance, not 0.01 as at the start"
    );
}

/// A cluster of rough spheres that drifts along with `drift`, in a box with these sides.
fn cluster(drift: Vec3, sides: PeriodicBox) -> GrainSystem {
    let mut random = Random(3);
    let law = ContactLaw::from_duration_and_restitution(0.05, 0.6, 0.25).unwrap();
    let law = law.with_friction(0.5).unwrap();
    // Eight corners of a cube, pushed together.
    let grains = (0..8).map(|i| {
        let corner = Vec3::from_fn(|axis, _| f64::from(i >> axis & 1) - 0.5);
        let grain = Grain::sphere(2.5 * Vec3::repeat(1.0) + 1.02 * corner, 0.5, 1.0);
        grain.moving(drift - corner + random.vector(0.3)).spinning(random.vector(3.0))
    });
    let grains = grains.collect();
    GrainSystem::new(GrainSetup { sides, ..GrainSetup::new(law) }, grains, Vec::new()).unwrap()
}

#[test]
fn contacts_and_their_springs_pass_through_periodic_faces() {
    // The drift carries the cluster through faces, edges and corners of the box, some eight boxes far.
    let drift = Vec3::new(20.0, -30.0, 15.0);
    let (mut at_home, mut adrift) = (
        cluster(Vec3::zeros(), PeriodicBox::default()),
        cluster(drift, PeriodicBox::all([5.0, 4.0, 6.0])),
    );
    let mut touched = 0;
    let (dt, steps) = (1e-3, 1000);
    for _ in 0..steps {
        at_home.substep(dt, &[]).unwrap();
        adrift.substep(dt, &[]).unwrap();
        touched += at_home.pairs().iter().filter(|pair| pair.memory.is_some()).count();
        assert_eq!(
            at_home.pairs().iter().filter(|pair| pair.memory.is_some()).count(),
            adrift.pairs().iter().filter(|pair| pair.memory.is_some()).count(),
        );
    }
    assert!(touched > 500, "only {touched} contacts were seen: too few to tell anything");
    for (one, two) in at_home.grains().iter().zip(adrift.grains()) {
        // Positions of order 30 are rounded to 4e-15 each of 1000 sub-steps; contacts multiply that.
        let off = two.position - drift - one.position;
        assert!(
            off.norm() < 1e-9,
            "a cluster that drifts through periodic faces moves otherwise than the same at \
             home: a grain is off by {off}"
        );
        assert!((two.velocity - drift - one.velocity).norm() < 1e-8);
        assert!((two.angular_velocity - one.angular_velocity).norm() < 1e-8);
        let sides = adrift.setup().sides;
        let inside = sides.wrap(&two.position);
        assert!((0..3).all(|i| (0.0..=sides.lengths[i].unwrap()).contains(&inside[i])));
    }
}

#[test]
fn one_two_and_seven_threads_give_the_same_bits() {
    // More grains than are worked on serially, dense enough to touch several others each, on a floor.
    let run = |threads: usize| -> GrainState {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut random = Random(11);
            let law = ContactLaw::from_duration_and_restitution(0.1, 0.6, 0.25).unwrap();
            let law = law.with_friction(0.4).unwrap().with_rolling(0.1).unwrap();
            let grains = (0..1500).map(|_| {
                let place = Vec3::from_fn(|_, _| random.between(0.0, 10.0));
                Grain::sphere(place, random.between(0.4, 0.6), 1.0).moving(random.vector(1.0))
            });
            let grains = grains.collect();
            let floor = Plane::fixed(Vec3::zeros(), Vec3::z(), law);
            let setup = GrainSetup {
                sides: PeriodicBox { lengths: [Some(10.0), Some(10.0), None] },
                gravity: Vec3::new(0.0, 0.0, -1.0),
                ..GrainSetup::new(law)
            };
            let mut system = GrainSystem::new(setup, grains, vec![floor]).unwrap();
            system.step(0.5, &[]).unwrap();
            assert!(system.list_builds() > 3, "the list was made anew on the way");
            system.state()
        })
    };
    let one = run(1);
    assert!(one.pair_contacts.len() > 2000 && !one.plane_contacts.is_empty());
    for threads in [2, 7] {
        assert!(one == run(threads), "the state differs on {threads} threads");
    }
}

#[test]
fn the_list_of_pairs_is_made_anew_when_a_grain_has_moved_by_half_of_what_it_looks_ahead() {
    // Radius 1: the list looks 0.4 ahead (a fifth of the diameter), so it holds until a grain has moved by 0.2, which
    // at speed 1 takes 20 sub-steps of 0.01 (the next one, should the sum of twenty fall short of 0.2).
    let law = ContactLaw::new(1.0, 0.0).unwrap();
    let far = |x: f64| Grain::sphere(Vec3::new(x, 0.0, 0.0), 1.0, 1.0);
    let grains = vec![far(0.0).moving(Vec3::new(0.0, 1.0, 0.0)), far(8.0)];
    let mut system = GrainSystem::new(GrainSetup::new(law), grains, Vec::new()).unwrap();
    let mut builds = Vec::new();
    for _ in 0..21 {
        system.substep(0.01, &[]).unwrap();
        builds.push(system.list_builds());
    }
    assert_eq!(builds[..19], [1; 19], "the list is made anew before a grain has moved by 0.2");
    assert_eq!(builds[20], 2, "the list is not made anew after a grain has moved by 0.2");
}
