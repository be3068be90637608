//! Whether contacts hold: which grain is said to lie too deep in what, by geometry alone.

use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::hold::{Sunk, SunkInto, deepest, deepest_of};
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::Vec3;

/// Grains in a domain that is periodic along x, 32 long.
fn system(grains: Vec<Grain>, planes: Vec<Plane>) -> GrainSystem {
    let sides = PeriodicBox { lengths: [Some(32.0), None, None] };
    let setup = GrainSetup { sides, ..GrainSetup::new(law()) };
    GrainSystem::new(setup, grains, planes).unwrap()
}

fn law() -> ContactLaw {
    ContactLaw::new(1.0, 0.1).unwrap()
}

/// A sphere at `x` on the axis.
fn sphere(x: f64, radius: f64) -> Grain {
    Grain::sphere(Vec3::new(x, 0.0, 0.0), radius, 1.0)
}

fn fixed(grain: Grain) -> Grain {
    Grain { held: true, ..grain }
}

fn floor() -> Plane {
    Plane::fixed(Vec3::zeros(), Vec3::z(), law())
}

/// A sphere at height `z` over the floor, far from all others.
fn over_floor(z: f64, radius: f64) -> Grain {
    Grain::sphere(Vec3::new(16.0, 0.0, z), radius, 1.0)
}

#[test]
fn a_grain_that_lies_more_than_half_its_radius_in_another_is_named_with_depth_and_approach() {
    // Radii 2 and 4, centres 4 apart: 2 deep, a whole radius of the smaller.
    let grains = vec![
        sphere(1.0, 4.0).moving(Vec3::new(0.25, 0.0, 0.0)),
        sphere(5.0, 2.0).moving(Vec3::new(-0.5, 0.0, 0.0)),
    ];
    let sunk = deepest(&system(grains, Vec::new())).expect("6 - 4 = 2 of radius 2 is too deep");
    let expected =
        Sunk { grain: 1, obstacle: SunkInto::Grain(0), overlap: 2.0, radius: 2.0, approach: 0.75 };
    assert_eq!(sunk, expected, "of two free grains the smaller is named");
    assert_eq!(sunk.depth(), 1.0, "2 deep at radius 2 is one radius");
    let deeper = Sunk { overlap: 3.0, ..sunk };
    assert_eq!(deeper.depth(), 1.5, "3 deep at radius 2 is one and a half radii");
}

#[test]
fn of_two_equal_free_grains_the_first_is_named_and_of_a_free_and_a_fixed_one_the_free() {
    let named = |first: Grain, second: Grain| {
        let sunk = deepest(&system(vec![first, second], Vec::new())).expect("too deep");
        (sunk.grain, sunk.obstacle)
    };
    let (one, two) = (sphere(1.0, 2.0), sphere(3.0, 2.0));
    assert_eq!(named(one, two), (0, SunkInto::Grain(1)), "equal free grains");
    assert_eq!(named(fixed(one), two), (1, SunkInto::Grain(0)), "the first is fixed");
    assert_eq!(named(one, fixed(two)), (0, SunkInto::Grain(1)), "the second is fixed");
    let small = sphere(3.0, 1.5);
    assert_eq!(named(one, small), (1, SunkInto::Grain(0)), "the second is smaller");
    assert_eq!(named(small, one), (0, SunkInto::Grain(1)), "the first is smaller");
    assert_eq!(named(one, fixed(small)), (0, SunkInto::Grain(1)), "the smaller is fixed");
}

#[test]
fn exactly_half_a_radius_still_holds_and_two_fixed_grains_are_nobody_s_concern() {
    let half = system(vec![sphere(1.0, 2.0), sphere(4.0, 2.0)], Vec::new());
    assert_eq!(deepest(&half), None, "an overlap of half a radius is the deepest that holds");
    let both = system(vec![fixed(sphere(1.0, 2.0)), fixed(sphere(3.0, 2.0))], vec![floor()]);
    assert_eq!(deepest(&both), None, "fixed grains may overlap, and may lie in the floor");
}

#[test]
fn depth_is_measured_to_the_image_across_a_periodic_side() {
    // 31 and 1 are 2 apart across the side at 32, not 30.
    let sunk = deepest(&system(vec![sphere(1.0, 2.0), sphere(31.0, 2.0)], Vec::new()));
    let sunk = sunk.expect("centres 2 apart across the periodic side overlap by a radius");
    assert_eq!(sunk.overlap, 2.0, "2 + 2 - 2");
}

#[test]
fn the_deepest_is_found_among_planes_and_grains() {
    // In the floor: radius 2, height 0.5 gives 1.5 of 2; in each other: 2.5 of radius 2 (centres 1.5 apart).
    let grains = vec![
        over_floor(0.5, 2.0).moving(Vec3::new(0.0, 0.0, -0.25)),
        Grain::sphere(Vec3::new(4.0, 0.0, 8.0), 2.0, 1.0),
        Grain::sphere(Vec3::new(5.5, 0.0, 8.0), 2.0, 1.0),
    ];
    let system_of_three = system(grains.clone(), vec![floor()]);
    let sunk = deepest(&system_of_three).expect("two are too deep");
    assert_eq!(sunk.obstacle, SunkInto::Grain(2), "2.5 in a grain is deeper than 1.5 in the floor");
    let in_floor = deepest_of(&system_of_three, 0).expect("it is at the floor");
    let expected =
        Sunk { grain: 0, obstacle: SunkInto::Plane(0), overlap: 1.5, radius: 2.0, approach: 0.25 };
    assert_eq!(in_floor, expected, "what the first grain lies deepest in");
    let other = deepest_of(&system_of_three, 2).expect("it lies in grain 1");
    assert_eq!((other.grain, other.overlap), (1, 2.5), "named from either side of a pair");

    let only = system(vec![grains[0]], vec![floor()]);
    assert_eq!(deepest(&only), Some(expected), "1.5 of a radius of 2 in the floor is too deep");
    let behind = system(vec![over_floor(-3.0, 2.0)], vec![floor()]);
    assert_eq!(
        deepest(&behind).map(|sunk| sunk.overlap),
        Some(5.0),
        "3 behind the floor at radius 2"
    );
}

#[test]
fn the_approach_to_a_moving_plane_is_relative_to_it() {
    // The floor rises at 0.5, the grain sinks at 0.25.
    let grain = over_floor(0.5, 2.0).moving(Vec3::new(0.0, 0.0, -0.25));
    let rising = floor().moving(Vec3::new(0.0, 0.0, 0.5));
    let sunk = deepest(&system(vec![grain], vec![rising])).expect("1.5 of 2 deep");
    assert_eq!(sunk.approach, 0.75, "0.5 + 0.25");
}

#[test]
fn what_a_grain_lies_deepest_in_does_not_tell_of_other_grains() {
    // Grain 2 is far from the deep pair, and only near the floor: 0.25 over it.
    let grains = vec![
        Grain::sphere(Vec3::new(4.0, 0.0, 8.0), 2.0, 1.0),
        Grain::sphere(Vec3::new(5.0, 0.0, 8.0), 2.0, 1.0),
        over_floor(2.25, 2.0),
    ];
    let sunk =
        deepest_of(&system(grains, vec![floor()]), 2).expect("the floor is listed however far");
    assert_eq!((sunk.grain, sunk.obstacle, sunk.overlap), (2, SunkInto::Plane(0), -0.25));
}
