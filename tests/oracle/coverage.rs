//! Exact solid fraction of a sphere in a cell.
//!
//! Expected values come from closed forms or from `common/sphere_quadrature.rs`, which takes
//! another route (cross-sections, integrated along z) than the code under test (cones).
//! No cell updates: geometry only.

use crate::common;

use common::cuts::{anywhere, assert_close, cut, images};
use common::random::Random;
use common::sphere_quadrature::{STEP, fraction_by_quadrature, quadrature_with_step};
use proptest::prelude::*;
use psmrt_reference::coverage::{Coverage, CoverageRule, exact_fraction};
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Solid;
use std::f64::consts::PI;

/// Bound on the rounding error of the exact fraction.
///
/// Why: it sums some 50 terms of at most order `radius²` (or 1, for a small sphere), each rounded a
/// few times, in either direction. Against the same formula at 40 digits, 30,000 random and nearly
/// degenerate cuts of radii from 0.05 to 50 gave at most 1.7 ulp of `1 + radius²` (7e-13 in all).
pub(crate) fn rounding(radius: f64) -> f64 {
    8.0 * f64::EPSILON * (1.0 + radius * radius)
}

/// Bound on the error of the quadrature and of the exact fraction together.
///
/// Why: a cross-section is a difference of areas of order `radius²`; in a thin strip a rounded root
/// weighs more, so that the quadrature errs more than the closed form: up to 7 ulp of `1 + radius²`.
/// Half its step changes it by less than 1e-13, which is what it leaves out.
pub(crate) fn quadrature_error(radius: f64) -> f64 {
    1e-13 + 20.0 * f64::EPSILON * (1.0 + radius * radius)
}

// --- The sphere as a whole ---------------------------------------------------------------------

#[test]
fn fractions_of_all_cells_add_up_to_the_volume_of_the_sphere() {
    let mut random = Random(1);
    for radius in [0.3, 1.0, 2.0, 4.37, 8.0, 15.0] {
        let volume = 4.0 / 3.0 * PI * radius * radius * radius;
        let corner_edge_face_middle = [[0.5, 0.5, 0.5], [0.5, 0.5, 0.0], [0.5, 0.0, 0.0], [0.0; 3]];
        let special = corner_edge_face_middle.map(Vec3::from);
        let anywhere = (0..25).map(|_| anywhere(&mut random) * 0.5);
        for position in special.into_iter().chain(anywhere) {
            let sum = sum_over_cells(&position, radius);
            // Why: up to 4,000 cut cells, each off by at most rounding(15) = 4e-13, in either
            // direction, and the rounding of the sum itself, 14,137 for the largest sphere.
            assert!(
                (sum - volume).abs() < 1e-10,
                "radius {radius} at {position:?}: the fractions of all cells add up to {sum}, \
                 the sphere has {volume}"
            );
        }
    }
}

fn sum_over_cells(position: &Vec3, radius: f64) -> f64 {
    let reach = (radius + 1.5).floor();
    let row = || (0..).map(|i| f64::from(i) - reach).take_while(|&x| x <= reach);
    row()
        .map(|x| {
            row()
                .flat_map(|y| row().map(move |z| Vec3::new(x, y, z)))
                .map(|cell| exact_fraction(&(position - cell), radius))
                .sum::<f64>() // plane by plane, so that rounding of the sum itself stays small
        })
        .sum()
}

// --- Single cells ------------------------------------------------------------------------------

#[test]
fn fraction_agrees_with_a_quadrature_over_cross_sections() {
    let mut random = Random(2);
    for _ in 0..2000 {
        let (centre, radius) = cut(&mut random);
        let expected = fraction_by_quadrature(&centre, radius);
        assert_close(exact_fraction(&centre, radius), expected, quadrature_error(radius));
    }
}

#[test]
fn the_quadrature_does_not_depend_on_the_number_of_its_points() {
    let mut random = Random(3);
    for _ in 0..200 {
        let (centre, radius) = cut(&mut random);
        let coarse = fraction_by_quadrature(&centre, radius);
        let fine = quadrature_with_step(&centre, radius, STEP / 2.0);
        assert_close(coarse, fine, quadrature_error(radius));
    }
}

#[test]
fn sphere_within_the_cell_has_its_volume() {
    for (centre, radius) in [
        (Vec3::zeros(), 0.5), // touches all six faces
        (Vec3::zeros(), 0.05),
        (Vec3::new(0.1, -0.2, 0.3), 0.1),
        (Vec3::new(-0.2, 0.2, 0.2), 0.3), // touches three faces
    ] {
        let volume = 4.0 / 3.0 * PI * radius * radius * radius;
        assert_close(exact_fraction(&centre, radius), volume, rounding(radius));
    }
}

#[test]
fn half_a_sphere_about_the_middle_of_a_face_is_in_the_cell() {
    for radius in [0.05, 0.2, 0.5] {
        let half = 2.0 / 3.0 * PI * radius * radius * radius;
        assert_close(exact_fraction(&Vec3::new(0.0, 0.5, 0.0), radius), half, rounding(radius));
    }
}

#[test]
fn a_quarter_of_a_sphere_about_the_middle_of_an_edge_is_in_the_cell() {
    for radius in [0.05, 0.2, 0.5] {
        let quarter = PI / 3.0 * radius * radius * radius;
        assert_close(exact_fraction(&Vec3::new(-0.5, 0.0, 0.5), radius), quarter, rounding(radius));
    }
}

#[test]
fn an_eighth_of_a_sphere_about_a_corner_is_in_the_cell() {
    for radius in [0.05, 0.3, 1.0] {
        let eighth = PI / 6.0 * radius * radius * radius;
        assert_close(exact_fraction(&Vec3::new(0.5, -0.5, 0.5), radius), eighth, rounding(radius));
    }
}

#[test]
fn a_sphere_that_pokes_through_one_face_covers_a_cap() {
    // Radius, height of the cap; the cap's rim has the radius sqrt(h (2a - h)) <= 1/2.
    for (radius, height) in [(0.4, 0.7), (0.4, 0.1), (2.0, 0.06), (50.0, 2e-3), (50.0, 1e-7)] {
        let centre = Vec3::new(0.0, 0.0, -0.5 - radius + height);
        // V = π h² (3a - h) / 3
        let cap = PI * height * height * (3.0 * radius - height) / 3.0;
        // Why: the place of the centre is rounded too, by ulp(radius); it shifts the rim's area.
        let place = f64::EPSILON * radius;
        assert_close(exact_fraction(&centre, radius), cap, rounding(radius) + place);
    }
}

#[test]
fn a_sphere_that_pokes_out_of_one_face_lacks_a_cap() {
    let (radius, height) = (0.45, 0.2);
    let centre = Vec3::new(0.5 - radius + height, 0.01, -0.03);
    let sphere = 4.0 / 3.0 * PI * radius * radius * radius;
    let cap = PI * height * height * (3.0 * radius - height) / 3.0;
    assert_close(exact_fraction(&centre, radius), sphere - cap, rounding(radius));
}

#[test]
fn cells_wholly_outside_or_inside_have_exactly_0_or_1() {
    for (centre, radius, fraction) in [
        ([2.6, 0.0, 0.0], 2.0, 0.0),
        ([2.5, 0.0, 0.0], 2.0, 0.0), // touches a face from outside
        ([0.5, 3.5, 4.5], 5.0, 0.0), // touches an edge from outside
        ([1.5, 2.5, 2.5], 3.0, 0.0), // touches a corner from outside
        ([0.5, 1.5, 1.5], 3.0, 1.0), // farthest corner on the surface
        ([0.0, 0.0, 0.0], 0.9, 1.0),
        ([0.5, -0.5, 0.5], 1.8, 1.0),
        ([20.0, -30.0, 10.0], 50.0, 1.0),
    ] {
        assert_eq!(
            exact_fraction(&Vec3::from(centre), radius),
            fraction,
            "a cell wholly in or out of the sphere at {centre:?}, radius {radius}, has not exactly 1 or 0"
        );
    }
}

// --- Symmetry, bounds, growth ------------------------------------------------------------------

#[test]
fn all_48_symmetries_of_the_cube_hold_to_the_last_bit() {
    let mut random = Random(4);
    for _ in 0..200 {
        let (centre, radius) = cut(&mut random);
        let fraction = exact_fraction(&centre, radius);
        for image in images(&centre) {
            assert_eq!(
                exact_fraction(&image, radius),
                fraction,
                "sphere at {centre:?} and its image {image:?} under a symmetry of the cube, \
                 radius {radius}: the fractions differ in bits"
            );
        }
    }
}

#[test]
fn the_quadrature_has_the_48_symmetries_that_the_exact_fraction_assumes() {
    let mut random = Random(5);
    for _ in 0..20 {
        let (centre, radius) = cut(&mut random);
        let fraction = exact_fraction(&centre, radius);
        for image in images(&centre) {
            let expected = fraction_by_quadrature(&image, radius);
            assert_close(fraction, expected, quadrature_error(radius));
        }
    }
}

#[test]
fn rounding_does_not_carry_the_fraction_out_of_0_to_1() {
    for radius in [0.9, 2.0, 8.0, 50.0] {
        for corner in
            [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.6, 0.8, 0.0), Vec3::new(0.48, 0.6, 0.64)]
        {
            for depth in (1..=60).map(|k| 0.5_f64.powi(k)) {
                // The surface reaches by `depth` past the nearest point of the cell, or lacks as
                // much to its farthest point, the corner.
                let reaches = corner * (radius - depth) + corner.map(|n| 0.5 * n.signum());
                let lacks = corner * (radius + depth) - Vec3::repeat(0.5);
                for centre in [reaches, lacks] {
                    let fraction = exact_fraction(&centre, radius);
                    assert!(
                        (0.0..=1.0).contains(&fraction),
                        "rounding carries the fraction of a sphere at {centre:?}, radius \
                         {radius}, out of 0 to 1: {fraction:e}"
                    );
                }
            }
        }
    }
}

/// Spheres whose surface passes near the cell or through it, from 0.05 to 50 in radius.
fn near_cut() -> impl Strategy<Value = (Vec3, f64)> {
    let direction = [-1.0..1.0, -1.0..1.0, -1.0..1.0_f64];
    let small_or_large = prop_oneof![0.05..2.0, 0.05..50.0_f64];
    (direction, small_or_large, -1.0..1.0_f64).prop_map(|(direction, radius, offset)| {
        let direction = Vec3::from(direction).try_normalize(1e-3).unwrap_or_else(Vec3::x);
        (direction * (radius + offset), radius)
    })
}

/// No file of past failures: tests never write. The failing case is printed, shrunk.
fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(cases(4000))]

    #[test]
    fn fraction_lies_between_0_and_1((centre, radius) in near_cut()) {
        let fraction = exact_fraction(&centre, radius);
        prop_assert!((0.0..=1.0).contains(&fraction), "the fraction {fraction} is not from 0 to 1");
    }

    #[test]
    fn fraction_grows_with_the_radius((centre, radius) in near_cut(), digits in 0.0..16.0_f64) {
        let growth = 10.0_f64.powf(-digits);
        let change = exact_fraction(&centre, radius + growth) - exact_fraction(&centre, radius);
        // Why: dV/da is the area of the surface in the cell. It is at least 0, and at most 6, since
        // no convex body in the cell has a larger surface than the cell.
        let (least, most) = (-2.0 * rounding(radius), 6.0 * growth + 2.0 * rounding(radius + 1.0));
        prop_assert!(
            (least..=most).contains(&change),
            "the fraction changes by {change} where the radius grows by {growth}: it falls, or \
             grows by more than the surface in the cell"
        );
    }

    #[test]
    fn fraction_moves_with_the_centre((centre, radius) in near_cut(), digits in 0.0..16.0_f64) {
        for axis in 0..3 {
            let shift = 10.0_f64.powf(-digits);
            let mut moved = centre;
            moved[axis] += shift;
            let change = exact_fraction(&moved, radius) - exact_fraction(&centre, radius);
            // Why: dV/dx is the surface's shadow along x, at most the cell's: 1.
            prop_assert!(
                change.abs() <= shift + 2.0 * rounding(radius),
                "the fraction changes by {change} where the centre moves by {shift}: it jumps"
            );
        }
    }
}

// --- Numbers that are none; whole domains -------------------------------------------------------

#[test]
fn a_radius_or_position_that_is_no_number_does_not_panic() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let _ = exact_fraction(&Vec3::new(bad, 0.0, 0.0), 1.0);
        let _ = exact_fraction(&Vec3::new(0.1, bad, bad), bad);
        let _ = exact_fraction(&Vec3::zeros(), bad);
    }
    assert!(exact_fraction(&Vec3::new(0.0, f64::NAN, 0.0), 1.0).is_nan());
    assert_eq!(exact_fraction(&Vec3::zeros(), 0.0), 0.0);
}

#[test]
fn coverage_of_spheres_that_have_moved_is_that_of_spheres_placed_there() {
    let mut random = Random(31);
    let domain = Domain::new([12, 10, 11], Faces::PERIODIC).unwrap();
    // Three that meet in some cells, wherever they go.
    let mut spheres: Vec<Solid> =
        (0..3).map(|_| Solid::fixed_sphere(Vec3::repeat(6.0) + random.vector(2.0), 2.3)).collect();
    let mut moved = Coverage::new(&domain, &spheres, CoverageRule::Exact);
    for _ in 0..20 {
        // The first stays: what it covers must not be lost with the others.
        for sphere in &mut spheres[1..] {
            sphere.centre += random.vector(1.5);
        }
        moved.update(&domain, &spheres, CoverageRule::Exact);
        let placed = Coverage::new(&domain, &spheres, CoverageRule::Exact);
        // In the same order too, so that sums over the solids of a cell do not depend on the way here.
        for cell in 0..domain.cell_count() {
            assert_eq!(
                moved.shares(cell),
                placed.shares(cell),
                "cell {cell}: what moved spheres cover differs from what spheres placed there cover"
            );
        }
    }
}

#[test]
fn a_sphere_far_larger_than_its_box_costs_what_it_covers_of_the_box() {
    // 8e21 cells about it. Its surface crosses the box at x = 2, as flat as a wall: over the 8 x 8 cells
    // it bends by at most (4² + 4²)/(2 a) = 1.6e-6.
    let radius = 1e7;
    let free_slip = [Face::FreeSlip; 2];
    let domain = Domain::new([8; 3], Faces { x: free_slip, y: free_slip, z: free_slip }).unwrap();
    let sphere = Solid::fixed_sphere(Vec3::new(2.0 - radius, 4.0, 4.0), radius);
    let coverage = Coverage::new(&domain, &[sphere], CoverageRule::Exact);
    for cell in 0..domain.cell_count() {
        let x = domain.coordinates(cell)[0];
        let (found, wall) = (coverage.solid_fraction(cell), if x < 2 { 1.0 } else { 0.0 });
        // Round-off of the fraction is a few times 1e-16 a², 0.01: a wall all the same.
        assert!((found - wall).abs() < 0.05, "cell {cell} at x = {x}: {found} instead of {wall}");
    }
}
