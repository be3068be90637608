//! Solid fractions that are linear in the distance of the centres: what they get right, and how far the others are off.
//! No cell updates: geometry only.

use crate::common;

use common::cuts::{assert_close, cut_of_radius, images, rms};
use common::random::Random;
use psmrt_reference::collision::Collision;
use psmrt_reference::coverage::{CoverageRule, exact_fraction, linear_fraction};
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::{Setup, SetupError, SolidPhase};
use psmrt_reference::solids::Solid;
use std::f64::consts::PI;

#[test]
fn linear_fraction_falls_from_one_to_nothing_over_one_cell_about_the_surface() {
    // The surface of radius 5 counts as one of 5 - 1/60; two cells away on either side are full and empty ones.
    let at = |d: f64| linear_fraction(&Vec3::new(0.0, -d, 0.0), 5.0);
    let surface = 5.0 - 1.0 / 60.0;
    assert_eq!([at(0.0), at(surface - 0.51), at(surface + 0.51), at(9.0)], [1.0, 1.0, 0.0, 0.0]);
    for (d, fraction) in [(-0.25, 0.75), (0.0, 0.5), (0.4, 0.1)] {
        // Sums of numbers up to 6.
        assert_close(at(surface + d), fraction, 4e-15);
    }
}

#[test]
fn linear_fractions_add_up_to_the_volume_of_the_sphere_over_all_its_positions() {
    // A lattice of positions in a cell: the mean over it is that over all positions but for what varies faster.
    let n = 12;
    for radius in [1.0, 1.3, 2.0, 3.7] {
        let mut sum = 0.0;
        for i in 0..n * n * n {
            let centre =
                Vec3::from([i % n, i / n % n, i / n / n].map(|i| f64::from(i) / f64::from(n)));
            for cell in 0..12 * 12 * 12 {
                let cell = [cell % 12, cell / 12 % 12, cell / 144].map(|i| f64::from(i) - 6.0);
                sum += linear_fraction(&(centre - Vec3::from(cell)), radius);
            }
        }
        let mean = sum / f64::from(n * n * n);
        let volume = 4.0 / 3.0 * PI * radius.powi(3);
        // α = a - 1/(12 a) instead of the root of α³ + α/4 = a³ is off by (1/(12 a²))³ a/3 of the radius: 6e-4 of the
        // volume at radius 1. The kinks of the fraction leave the sum over positions about 1/n⁴ off, 5e-5.
        let tolerance = volume * ((1.0 / (12.0 * radius * radius)).powi(3) + 2e-4);
        assert_close(mean, volume, tolerance);
    }
}

#[test]
fn linear_fractions_are_two_hundredths_off_the_exact_ones() {
    let mut random = Random(9);
    for radius in [2.0, 4.0, 20.0] {
        let cuts: Vec<Vec3> = (0..4000).map(|_| cut_of_radius(&mut random, radius)).collect();
        let rms = rms(&cuts, |c| linear_fraction(c, radius) - exact_fraction(c, radius));
        // A plane at distance s from the centre of a cell leaves 1/2 - s of it if it lies across an axis. Across a
        // diagonal of a face it leaves 1/2 - √2 s + s² and reaches to s = 1/√2, where the linear form has ended at 1/2:
        // there it is off by 0.043 at the most. Of that the root of the mean square over all planes is about a half.
        assert!(
            (0.01..0.03).contains(&rms),
            "radius {radius}: the linear fraction is off the exact one by {rms} (rms over cut cells), 0.01 to 0.03 expected"
        );
    }
}

#[test]
fn linear_fraction_keeps_the_48_symmetries_of_the_cube() {
    let mut random = Random(10);
    for _ in 0..200 {
        let centre = cut_of_radius(&mut random, 3.0);
        let fraction = linear_fraction(&centre, 3.0);
        for image in images(&centre) {
            // Three squares in another order.
            assert_close(linear_fraction(&image, 3.0), fraction, 2e-15);
        }
    }
}

#[test]
fn sphere_below_one_cell_is_refused_by_the_linear_rule_and_a_box_of_cells_is_not() {
    let domain = Domain::new([6, 6, 6], Faces::PERIODIC).unwrap();
    let with = |solids: Vec<Solid>, coverage| {
        let phase = SolidPhase { solids, coverage, ..SolidPhase::default() };
        Setup::fluid(domain.clone(), Collision::Srt { tau: 0.8 }).with_solids(phase).check()
    };
    let sphere = |radius| Solid::fixed_sphere(Vec3::repeat(3.0), radius);
    let refused = SetupError::TooSmallForLinear { solid: 1, radius: 0.99 };
    assert_eq!(with(vec![sphere(1.0), sphere(0.99)], CoverageRule::Linear), Err(refused));
    assert_eq!(with(vec![sphere(0.99)], CoverageRule::Exact), Ok(()));
    let cells = Solid::fixed_cells(vec![(3, 0.4)]);
    assert_eq!(with(vec![sphere(1.0), cells], CoverageRule::Linear), Ok(()));
}
