//! Solid fractions as the device finds them in single precision, against quadrature and exact volumes.
//!
//! **The bound.** The volume is an integral by a rule of six points between places where the integrand is
//! smooth, of parts of the size of the cell. The rule is good to 1.3e-6 (the worst is a ball of about the
//! cell's own size), and an epsilon of a place r cells from the centre moves the surface by r epsilon
//! through an area of at most about √2.

use crate::common::collisions::srt;
use crate::common::cuts::{cut, images};
use crate::common::random::Random;
use crate::common::solid_rules::solid_rules;
use crate::common::sphere_quadrature::fraction_by_quadrature;
use crate::parity::sphere;
use crate::trials::{self, Claim};
use psmrt::kernel::{Kernel, solid_fractions_on_device};
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solver::Solver;
use std::f64::consts::PI;

fn bound(radius: f64) -> f64 {
    2e-6 + 2.0 * f64::from(f32::EPSILON) * radius
}

fn found(balls: &[(Vec3, f64)]) -> Vec<f64> {
    let balls: Vec<([f64; 3], f64)> =
        balls.iter().map(|(centre, radius)| ((*centre).into(), *radius)).collect();
    solid_fractions_on_device(&trials::gpu().unwrap(), &balls).unwrap()
}

fn device_fractions_are_the_volumes_that_quadrature_finds() {
    let mut random = Random(21);
    let balls: Vec<(Vec3, f64)> = (0..2000).map(|_| cut(&mut random)).collect();
    let mut worst = 0.0_f64;
    for ((centre, radius), found) in balls.iter().zip(found(&balls)) {
        let error = (found - fraction_by_quadrature(centre, *radius)).abs() / bound(*radius);
        assert!(error <= 1.0, "{centre:?}, radius {radius}: {error} of the bound");
        worst = worst.max(error);
    }
    println!("worst: {worst:.2} of the bound");
}

fn device_fractions_add_up_to_the_volume_of_the_ball() {
    let mut random = Random(22);
    for radius in [0.1, 0.4, 0.87, 1.3, 2.0, 3.7, 6.0] {
        let centre = random.vector(0.5);
        let cells = (0..16 * 16 * 16)
            .map(|i| Vec3::from([i % 16, i / 16 % 16, i / 256].map(|i| f64::from(i) - 8.0)));
        let balls: Vec<(Vec3, f64)> = cells.map(|cell| (centre - cell, radius)).collect();
        let sum: f64 = found(&balls).iter().sum();
        let volume = 4.0 / 3.0 * PI * radius.powi(3);
        // About 4π (r + 1)² cells are cut; all might be off the same way.
        let tolerance = 4.0 * PI * (radius + 1.0).powi(2) * bound(radius);
        assert!(
            (sum - volume).abs() <= tolerance,
            "radius {radius}: the fractions of all cells add up to {sum}, the sphere has \
             {volume}",
        );
    }
}

fn device_fractions_of_balls_that_miss_fill_or_halve_the_cell_are_exact() {
    let at = |x: f64, y: f64, z: f64| Vec3::new(x, y, z);
    let balls = [
        (at(2.0, 0.0, 0.0), 1.5),
        (at(0.0, 0.0, 0.0), 0.9),
        (at(0.5, 0.5, 0.5), 0.2),
        (at(0.5, 0.5, 0.0), 0.2),
        (at(0.0, 0.0, -0.5), 0.2),
        (at(0.0, 0.0, 0.0), 0.3),
    ];
    let expected = [0.0, 1.0, 0.125, 0.25, 0.5, 1.0];
    for (number, (found, share)) in found(&balls).iter().zip(expected).enumerate() {
        let volume = if number < 2 { 1.0 } else { 4.0 / 3.0 * PI * balls[number].1.powi(3) };
        let error = (found - share * volume).abs();
        // The first two are told by their distance. The others are a few terms of the volume's size, by a
        // rule whose error is that of the bound for a cell, scaled down with the ball.
        let tolerance = if number < 2 { 0.0 } else { 2e-6 * volume };
        assert!(error <= tolerance, "ball {number}: off by {error:e}");
    }
}

fn device_fractions_hardly_know_the_axes_of_the_box() {
    let mut random = Random(23);
    for _ in 0..20 {
        let (centre, radius) = cut(&mut random);
        let balls: Vec<(Vec3, f64)> =
            images(&centre).into_iter().map(|centre| (centre, radius)).collect();
        let found = found(&balls);
        let spread = found.iter().map(|x| (x - found[0]).abs()).fold(0.0, f64::max);
        assert!(
            spread <= 2.0 * bound(radius),
            "sphere at {centre:?}, radius {radius}: fractions under the symmetries of the cube \
             differ by {spread:e}",
        );
    }
}

/// Overlapping spheres across a periodic face, some at rest and some on the move.
fn fractions_that_are_seen_are_those_of_the_oracle() {
    let domain = Domain::new([12, 10, 9], Faces::PERIODIC).unwrap();
    let mut random = Random(24);
    for (rule, is_moving) in [(0, false), (0, true), (1, false), (1, true), (6, true)] {
        let (operator, weighting) = solid_rules()[rule];
        let speed = if is_moving { 0.01 } else { 0.0 };
        let places = [[1.0, 4.3, 5.1], [3.2, 4.0, 5.5], [8.1, 9.2, 0.4], [9.0, 4.9, 4.6]];
        let radii = [2.6, 1.9, 2.2, 0.7];
        let solids = places.iter().zip(radii);
        let solids = solids
            .map(|(&place, radius)| sphere(place, radius, random.vector(speed), Vec3::zeros()));
        let phase =
            SolidPhase { solids: solids.collect(), weighting, operator, ..SolidPhase::default() };
        for tau in [0.52, 0.8, 1.5] {
            let setup = Setup::fluid(domain.clone(), srt(tau)).with_solids(phase.clone());
            let kernel = Kernel::new(&trials::gpu().unwrap(), setup.clone(), false).unwrap();
            let oracle = Solver::new(setup).unwrap();
            let coverage = oracle.coverage().unwrap();
            let all: Vec<usize> = (0..domain.cell_count()).collect();
            // Two solids may share a cell. The weight is rounded once more, to no more than an epsilon of the
            // fraction that it comes back as.
            let bound = 2.0 * bound(2.6) + 2.0 * f64::from(f32::EPSILON);
            for (cell, (_, seen)) in kernel.states(&all).unwrap().into_iter().enumerate() {
                let expected = coverage.solid_fraction(cell);
                assert!(
                    (seen - expected).abs() <= bound,
                    "{weighting:?}, moving {is_moving}, tau {tau}: cell {:?} is seen {seen} solid, the oracle \
                     has {expected}",
                    domain.coordinates(cell)
                );
            }
            for (number, (found, expected)) in
                kernel.displaced().unwrap().iter().zip(oracle.displaced()).enumerate()
            {
                // B grows with the fraction by a factor of (τ + 1/2)/(τ - 1/2) at most; a ball of radius r
                // touches fewer than (2 r + 2)³ cells.
                let slope = (tau + 0.5) / (tau - 0.5);
                let allowed = (2.0 * radii[number] + 2.0).powi(3) * slope * bound;
                assert!(
                    (found - expected).abs() <= allowed,
                    "{weighting:?}, moving {is_moving}, tau {tau}: solid {number} displaces {found}, that of \
                     the oracle {expected}"
                );
            }
        }
    }
}

/// What is claimed here.
pub const CLAIMS: &[Claim] = &[
    (
        "device_fractions_are_the_volumes_that_quadrature_finds",
        device_fractions_are_the_volumes_that_quadrature_finds,
    ),
    (
        "device_fractions_add_up_to_the_volume_of_the_ball",
        device_fractions_add_up_to_the_volume_of_the_ball,
    ),
    (
        "device_fractions_of_balls_that_miss_fill_or_halve_the_cell_are_exact",
        device_fractions_of_balls_that_miss_fill_or_halve_the_cell_are_exact,
    ),
    (
        "device_fractions_hardly_know_the_axes_of_the_box",
        device_fractions_hardly_know_the_axes_of_the_box,
    ),
    (
        "fractions_that_are_seen_are_those_of_the_oracle",
        fractions_that_are_seen_are_those_of_the_oracle,
    ),
];
