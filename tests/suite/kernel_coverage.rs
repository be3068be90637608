//! The kernel's solid fractions against quadrature and exact volumes. Needs no adapter.

use crate::common::cuts::{assert_close, cut};
use crate::common::random::Random;
use crate::common::sphere_quadrature::fraction_by_quadrature;
use psmrt::ball::{cells_about, sampled_fraction, solid_fraction, solid_fractions};
use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::lattice::Vec3;
use std::f64::consts::PI;

#[test]
fn solid_fraction_is_the_volume_that_quadrature_finds() {
    let mut random = Random(11);
    for _ in 0..400 {
        let (centre, radius) = cut(&mut random);
        let found = solid_fraction(centre.into(), radius);
        // Its terms are of the order of the radius cubed, up to some 60 of them; the quadrature is good
        // to 1e-9 (tests/oracle/coverage.rs).
        let tolerance = 1e-9 + 1e-14 * radius.powi(3);
        assert_close(found, fraction_by_quadrature(&centre, radius), tolerance);
    }
}

#[test]
fn fractions_of_all_cells_add_up_to_the_volume_of_the_sphere() {
    let mut random = Random(12);
    for _ in 0..20 {
        let (centre, radius) = (random.vector(0.5), random.between(0.1, 6.0));
        let mut sum = 0.0;
        for cell in 0..16 * 16 * 16 {
            let cell = [cell % 16, cell / 16 % 16, cell / 256].map(|i| f64::from(i) - 8.0);
            sum += solid_fraction((centre - Vec3::from(cell)).into(), radius);
        }
        // Some 400 cut cells, each off by up to 1e-13 at this radius.
        assert_close(sum, 4.0 / 3.0 * PI * radius.powi(3), 1e-10);
    }
}

#[test]
fn fractions_of_all_cells_at_once_are_those_of_each() {
    let mut random = Random(14);
    for _ in 0..40 {
        let (centre, radius) = (random.vector(3.0), random.between(0.1, 9.0));
        let mut touched = 0;
        let about = cells_about(centre.into(), radius);
        solid_fractions(CoverageRule::Exact, centre.into(), radius, &about, |cell, found| {
            let from_cell = centre - Vec3::from(cell.map(|i| i as f64 + 0.5));
            // Terms up to the radius cubed, some 700, in another order.
            assert_close(found, solid_fraction(from_cell.into(), radius), 1e-12);
            touched += 1;
        });
        let all = (0..26 * 26 * 26).map(|i| [i % 26, i / 26 % 26, i / 676].map(|i| i - 13));
        // Round-off may make a cell of next to nothing of one that is barely touched.
        let expected = all.filter(|cell| {
            let from_cell = centre - Vec3::from(cell.map(|i| f64::from(i) + 0.5));
            solid_fraction(from_cell.into(), radius) > 1e-12
        });
        assert!(touched >= expected.count());
    }
}

#[test]
fn sphere_that_touches_or_fills_a_cell_is_nothing_or_all_of_it() {
    assert_eq!(solid_fraction([2.0, 0.0, 0.0], 1.5), 0.0);
    assert_eq!(solid_fraction([0.0, 0.0, 0.0], 0.9), 1.0);
    // A centre on a corner, an edge and a face: an eighth, a quarter and a half of a small sphere.
    let volume = 4.0 / 3.0 * PI * 0.2_f64.powi(3);
    for (centre, share) in [([0.5; 3], 0.125), ([0.5, 0.5, 0.0], 0.25), ([0.0, 0.0, -0.5], 0.5)] {
        // Sums of a dozen terms of the volume's size.
        assert_close(solid_fraction(centre, 0.2), share * volume, 1e-15);
    }
}

#[test]
fn sampled_fraction_counts_midpoints_and_tends_to_the_exact_one() {
    let mut random = Random(13);
    // Two points along each axis at ±1/4: by hand, a sphere about one of them with a radius below 1/2.
    assert_eq!(sampled_fraction([0.25; 3], 0.3, 2), 0.125);
    assert_eq!(sampled_fraction([0.25, 0.25, 0.0], 0.3, 2), 0.25);
    for _ in 0..20 {
        let (centre, radius) = cut(&mut random);
        let off =
            sampled_fraction(centre.into(), radius, 32) - solid_fraction(centre.into(), radius);
        // The surface cuts at most some 3 · 32² of 32³ sub-cells, each counted wrong by half at most;
        // their errors mostly cancel.
        assert!(
            off.abs() < 1.5 / 32.0,
            "the sampled fraction is off the exact one by {off}, 1.5/32 is explained by the \
             points",
        );
    }
}
