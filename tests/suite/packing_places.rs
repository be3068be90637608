//! Suspensions at random places, sizes of grains, and what packings refuse.

use psmrt::packing::periodic::PeriodicPacking;
use psmrt::packing::suspension::RandomSuspension;
use psmrt::packing::{Amount, FOLLOWS, Grading, Packing, PackingError, Sizes, passing_diameter};
use psmrt_reference::lattice::Vec3;
use std::f64::consts::PI;

const LENGTHS: [f64; 3] = [9.0, 8.0, 7.5];
const PERIODIC: [bool; 3] = [true, false, true];
const GAP: f64 = 0.05;

/// Grains of three sizes, a sixth of the domain.
fn suspension(seed: u64) -> RandomSuspension {
    let radii = (0..140).map(|i| [0.4, 0.5, 0.6][i % 3]).collect();
    RandomSuspension { lengths: LENGTHS, periodic: PERIODIC, radii, gap: GAP, seed }
}

fn positions(packing: &Packing) -> Vec<Vec3> {
    packing.grains.iter().map(|grain| grain.position).collect()
}

#[test]
fn grains_of_a_random_suspension_keep_their_gap_and_are_anywhere_else() {
    let (mut least, mut all) = (f64::INFINITY, Vec::new());
    for seed in 0..4 {
        let wanted = suspension(seed);
        let packing = wanted.make().unwrap();
        assert_eq!(packing.grains.len(), 140);
        for (number, grain) in packing.grains.iter().enumerate() {
            let (at, r) = (grain.position, grain.radius);
            assert_eq!(r, wanted.radii[number], "grains keep the order of their radii");
            for axis in 0..3 {
                let margin = if PERIODIC[axis] { 0.0 } else { r + GAP };
                assert!(
                    at[axis] >= margin && at[axis] <= LENGTHS[axis] - margin,
                    "grain {number} at {at:?} is out of the domain or too near to a wall"
                );
            }
            for other in &packing.grains[number + 1..] {
                let offset = Vec3::from_fn(|axis, _| {
                    let along = other.position[axis] - at[axis];
                    if PERIODIC[axis] {
                        along - (along / LENGTHS[axis]).round() * LENGTHS[axis]
                    } else {
                        along
                    }
                });
                let left = offset.norm() - r - other.radius - GAP;
                assert!(
                    left >= 0.0,
                    "grains at {at:?} and {:?} are {left} too near",
                    other.position
                );
                least = least.min(left);
            }
        }
        let solid: f64 = wanted.radii.iter().map(|r| 4.0 / 3.0 * PI * r.powi(3)).sum();
        let porosity = 1.0 - solid / LENGTHS.iter().product::<f64>();
        assert!((packing.report.porosity - porosity).abs() < 1e-12, "{:?}", packing.report);
        all.extend(packing.grains);
    }
    // No more is kept free than was asked for: of some 500 near pairs one comes within a fiftieth of a radius.
    assert!(least < 0.01, "the nearest pair has {least} more than the gap");
    for axis in 0..3 {
        let places: Vec<f64> = all.iter().map(|grain| grain.position[axis]).collect();
        let mean = places.iter().sum::<f64>() / places.len() as f64;
        let [low, high] =
            places.iter().fold([f64::INFINITY, 0.0], |[l, h], &x| [l.min(x), h.max(x)]);
        let (half, margin) = (0.5 * LENGTHS[axis], if PERIODIC[axis] { 0.0 } else { 0.45 });
        // Why: the mean of 560 places spread evenly over L is off by L/sqrt(12 * 560) = 0.012 L; four times that.
        assert!((mean - half).abs() < 0.05 * LENGTHS[axis], "axis {axis}: mean place {mean}");
        // The outermost of 560 places leave 2 L/560 free at either end, and seldom ten times that.
        let free = 0.04 * LENGTHS[axis];
        assert!(
            low < margin + free && high > LENGTHS[axis] - margin - free,
            "axis {axis}: places from {low} to {high}"
        );
    }
}

#[test]
fn a_seed_gives_one_suspension_and_another_seed_another() {
    let [first, again, other] = [1, 1, 2].map(|seed| positions(&suspension(seed).make().unwrap()));
    assert_eq!(first, again);
    assert_ne!(first, other);
}

#[test]
fn suspensions_that_cannot_be_are_refused_by_name() {
    let refused = |wanted: RandomSuspension| wanted.make().unwrap_err().to_string();
    for gap in [-0.01, f64::NAN, f64::INFINITY] {
        let message = refused(RandomSuspension { gap, ..suspension(0) });
        assert!(message.contains("gap"), "{gap}: {message}");
    }
    // 2 (0.6 + 0.05) = 1.3 across.
    for (length, fits) in [(1.299, false), (1.3, false), (1.31, true), (f64::INFINITY, false)] {
        let radii = vec![0.6];
        let wanted = RandomSuspension { lengths: [9.0, length, 9.0], radii, ..suspension(0) };
        match wanted.make() {
            Ok(_) => assert!(fits, "a length of {length} ought to be refused"),
            Err(error) => {
                assert!(!fits && error.to_string().contains("box length"), "{length}: {error}");
            }
        }
    }
    let radii = vec![0.5; 2000];
    let crowded = RandomSuspension { radii, ..suspension(0) }.make().unwrap_err();
    let PackingError::Crowded { placed, wanted: 2000 } = crowded else { panic!("{crowded}") };
    // Random places run out near a solid fraction of 0.3; with the gap, spheres of 0.55 count.
    let fraction =
        placed as f64 * 4.0 / 3.0 * PI * 0.525_f64.powi(3) / LENGTHS.iter().product::<f64>();
    assert!(
        (0.25..0.38).contains(&fraction),
        "{placed} grains found a place, a fraction of {fraction}"
    );
}

#[test]
fn grains_by_a_sieve_curve_have_that_curve_and_that_volume() {
    let curve = Grading::new(&[(1e-4, 0.0), (2e-4, 0.4), (4e-4, 1.0)]).unwrap();
    let (radii, scale) = curve.radii(Amount::Volume { volume: 1e-8, most: 100_000 }, 5).unwrap();
    assert!((scale - 1.0).abs() < 0.01, "scaled by {scale}");
    let volume: f64 = radii.iter().map(|radius| 4.0 / 3.0 * PI * radius.powi(3)).sum();
    assert!((volume / 1e-8 - 1.0).abs() < 1e-12, "the grains have {volume:e} m3");
    let diameters: Vec<f64> = radii.iter().map(|radius| 2.0 * radius).collect();
    // Straight lines over the logarithm: 1/4 of the first part is at 2^(1/4) and so on.
    for (share, expected) in [
        (0.1, 1e-4 * 2.0_f64.powf(0.25)),
        (0.2, 1e-4 * 2.0_f64.sqrt()),
        (0.4, 2e-4),
        (0.7, 2e-4 * 2.0_f64.sqrt()),
        (0.94, 2e-4 * 2.0_f64.powf(0.9)),
    ] {
        let found = passing_diameter(&diameters, share);
        // The largest of these 1,600 grains have 0.4 % of the mass each, the first part of the curve 1/40 of a factor of 2 for
        // each percent: 2 % of the diameter and a percent for the volume.
        assert!(
            (found / expected - 1.0).abs() < 0.03,
            "{share} is finer than {found:e}, not {expected:e}"
        );
    }
    let (again, _) = curve.radii(Amount::Volume { volume: 1e-8, most: 100_000 }, 5).unwrap();
    assert_eq!(radii, again, "the same seed gives the same sizes");
    let (others, _) = curve.radii(Amount::Volume { volume: 1e-8, most: 100_000 }, 6).unwrap();
    assert_ne!(radii, others);
}

#[test]
fn a_mixture_of_two_sizes_has_each_of_them_and_a_log_normal_one_its_median() {
    let mixture = Grading::new(&[(1.0, 0.0), (1.0, 0.25), (2.0, 0.25), (2.0, 1.0)]).unwrap();
    let (radii, _) = mixture.radii(Amount::Count(1100), 1).unwrap();
    // Of the mass a quarter: 0.25/1 to 0.75/8 by number, 8 to 3.
    let small = radii.iter().filter(|radius| (**radius - 0.5).abs() < 1e-9).count();
    let large = radii.iter().filter(|radius| (**radius - 1.0).abs() < 1e-9).count();
    assert_eq!((small, large), (800, 300));
    let curve = Grading::log_normal(1.0, 1.3).unwrap();
    let (radii, _) = curve.radii(Amount::Count(20_000), 1).unwrap();
    let diameters: Vec<f64> = radii.iter().map(|radius| 2.0 * radius).collect();
    // Median by mass 1, 84.13 % below one factor of 1.3; by number the median is exp(-3 ln² 1.3) (Hatch & Choate 1929).
    for (share, expected) in [(0.5, 1.0), (0.841_34, 1.3), (0.158_66, 1.0 / 1.3)] {
        let found = passing_diameter(&diameters, share);
        assert!(
            (found / expected - 1.0).abs() < 0.01,
            "{share} of the mass is below {found}, not {expected}"
        );
    }
    let mut sorted = diameters;
    sorted.sort_by(f64::total_cmp);
    let (median, expected) = (sorted[10_000], (-3.0 * 1.3_f64.ln().powi(2)).exp());
    assert!(
        (median / expected - 1.0).abs() < 0.02,
        "half of the grains are below {median}, not {expected}"
    );
}

#[test]
fn a_sieve_curve_that_is_none_is_told() {
    for (points, told) in [
        (vec![], "no sieves"),
        (vec![(1e-4, 0.0), (2e-4, 0.9)], "from 0 to 0.9"),
        (vec![(1e-4, 0.0), (2e-4, 0.6), (3e-4, 0.5), (4e-4, 1.0)], "must not fall"),
        (vec![(2e-4, 0.0), (1e-4, 1.0)], "must not fall"),
        (vec![(0.0, 0.0), (1e-4, 1.0)], "above 0"),
    ] {
        let said = Grading::new(&points).unwrap_err();
        assert!(said.contains(told), "{points:?}: {said}");
    }
    // Nothing stays on the first sieve, and nothing is finer than the second: they are not sizes of grains.
    let curve = Grading::new(&[(1e-6, 0.0), (1e-4, 0.0), (2e-4, 1.0), (1e-3, 1.0)]).unwrap();
    assert_eq!(curve.diameters(), [1e-4, 2e-4]);
    // The coarse end is a third of the mass and less than one of ten grains.
    let wide = Grading::new(&[(1e-5, 0.0), (3e-4, 1.0)]).unwrap();
    let (_, scale) = wide.radii(Amount::Count(10), 1).unwrap();
    assert!(scale > 1.0 + FOLLOWS, "ten grains follow it but for {scale}");
    assert!(Grading::log_normal(1e-4, 1.0).unwrap_err().contains("above 1"));
}

#[test]
fn sizes_are_alike_or_spread_evenly_and_as_many_as_fill_a_volume() {
    let alike = Sizes { diameters: [0.8, 0.8], seed: 3 };
    assert_eq!(alike.radii(Amount::Count(5)), Some(vec![0.4; 5]));
    assert_eq!(alike.radii(Amount::Count(0)), None, "there must be grains");
    let spread = Sizes { diameters: [0.5, 1.5], seed: 3 };
    let radii = spread.radii(Amount::Count(3000)).unwrap();
    let mean = radii.iter().sum::<f64>() / 3000.0;
    let [low, high] = radii.iter().fold([f64::INFINITY, 0.0], |[l, h], &r| [l.min(r), h.max(r)]);
    // Why: the mean of 3,000 radii spread over 0.5 is off by 0.5/sqrt(12 * 3000) = 0.0026; four times that.
    assert!((mean - 0.5).abs() < 0.0105, "mean radius {mean}");
    assert!((0.25..0.252).contains(&low) && (0.748..0.75).contains(&high), "from {low} to {high}");
    assert_ne!(Some(radii), Sizes { seed: 4, ..spread }.radii(Amount::Count(3000)));
    // 0.8 across: 0.2681 each. 10.4 of them are nearest to ten, 10.6 to eleven.
    let each = 4.0 / 3.0 * PI * 0.4_f64.powi(3);
    for (times, count) in [(10.4, 10), (10.6, 11), (0.6, 1)] {
        let radii = alike.radii(Amount::Volume { volume: times * each, most: 100 });
        assert_eq!(radii.map(|radii| radii.len()), Some(count), "{times} volumes of one grain");
    }
    assert_eq!(alike.radii(Amount::Volume { volume: 0.4 * each, most: 100 }), None, "none fits");
    for (most, fits) in [(10, true), (9, false)] {
        let radii = alike.radii(Amount::Volume { volume: 10.0 * each, most });
        assert_eq!(radii.is_some(), fits, "ten grains where {most} are the most");
    }
}

#[test]
fn periodic_packings_refuse_overlaps_clearances_and_lengths_that_make_no_sense() {
    let packing = || PeriodicPacking::new([4.0; 3], vec![0.5; 40], 1);
    for (largest_overlap, fits) in
        [(0.0, false), (-0.1, false), (0.1, true), (0.11, false), (f64::NAN, false)]
    {
        let made = PeriodicPacking { largest_overlap, ..packing() }.make();
        assert_eq!(made.is_ok(), fits, "an overlap of {largest_overlap} may be left");
    }
    for (clearance, fits) in [(0.0, true), (0.01, true), (-0.01, false), (f64::INFINITY, false)] {
        let made = PeriodicPacking { clearance, ..packing() }.make();
        assert_eq!(made.is_ok(), fits, "a clearance of {clearance}");
    }
    for length in [0.0, -4.0, f64::INFINITY, f64::NAN] {
        let made = PeriodicPacking { lengths: [4.0, length, 4.0], ..packing() }.make();
        let message = made.unwrap_err().to_string();
        assert!(message.contains("box length"), "{length}: {message}");
    }
}

#[test]
fn a_periodic_packing_has_no_scale_of_its_own() {
    // Four times all lengths is 64 times all masses and stiffnesses: powers of two, so that the same numbers come out.
    let [one, four] = [1.0, 4.0].map(|scale| {
        let radii = (0..60).map(|i| [0.4, 0.5, 0.6][i % 3] * scale).collect();
        let packing = PeriodicPacking::new([3.9 * scale; 3], radii, 7);
        PeriodicPacking { clearance: 0.01, ..packing }.make().unwrap()
    });
    for (small, large) in one.grains.iter().zip(&four.grains) {
        let off = (4.0 * small.position - large.position).norm();
        assert!(off <= 1e-9, "{:?} and, four times as large, {:?}", small.position, large.position);
    }
}
