//! Packings: what is asked for is what comes out, the same for the same seed.

use psmrt::packing::bed::{BedSides, SettledBed};
use psmrt::packing::periodic::PeriodicPacking;
use psmrt::packing::{Packing, TOUCHING, count_for, jamming_porosity, porosity, radius_for};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::setup::PeriodicBox;
use psmrt_reference::lattice::Vec3;
use std::f64::consts::PI;

/// Largest overlap over the mean diameter and number of touching pairs, by looking at all pairs.
fn by_looking(packing: &Packing) -> (f64, u32) {
    let (mut worst, mut touching) = (0.0_f64, 0);
    for (number, one) in packing.grains.iter().enumerate() {
        for two in &packing.grains[number + 1..] {
            let apart = nearest(&packing.sides, two.position - one.position).norm();
            let overlap = 1.0 - apart / (one.radius + two.radius);
            worst = worst.max(overlap);
            touching += u32::from(overlap > -TOUCHING);
        }
    }
    (worst, touching)
}

/// The shortest image of an offset.
fn nearest(sides: &PeriodicBox, offset: Vec3) -> Vec3 {
    Vec3::from_fn(|i, _| {
        sides.lengths[i].map_or(offset[i], |l| offset[i] - (offset[i] / l).round() * l)
    })
}

fn positions(packing: &Packing) -> Vec<Vec3> {
    packing.grains.iter().map(|grain| grain.position).collect()
}

#[test]
fn a_thousand_spheres_are_packed_at_porosity_040_in_the_box_of_the_paper_s_section_6() {
    let lengths = [128.0, 218.0, 128.0];
    let volume = lengths.iter().product();
    let radius = radius_for(0.40, 1000, volume);
    // The paper's d is 16.
    assert!(
        (2.0 * radius - 16.0).abs() < 0.01,
        "radius {radius} for 1,000 spheres in the paper's box, whose diameter is 16 cells"
    );
    assert_eq!(count_for(0.40, 8.0, volume), 999.0);
    let packing = PeriodicPacking::new(lengths, vec![radius; 1000], 1).make().unwrap();
    let report = packing.report;
    println!("{report:?}");
    assert!(
        (report.porosity - 0.40).abs() < 1e-12,
        "the packing has not the porosity of 0.40 that was asked for: {report:?}"
    );
    assert!(report.largest_overlap < 0.005, "half a percent of a diameter: {report:?}");
    let (overlap, touching) = by_looking(&packing);
    assert!(
        (overlap - report.largest_overlap).abs() < 1e-12,
        "largest overlap counted pair by pair {overlap}, reported {report:?}"
    );
    assert_eq!(2.0 * f64::from(touching) / 1000.0, report.coordination);
    // Above jamming (0.36, where it is 6) fewer.
    assert!(
        (2.0..6.0).contains(&report.coordination),
        "coordination number of a loose random packing out of 2 to 6: {report:?}"
    );
    assert!(packing.grains.iter().all(|grain| {
        (0..3).all(|i| (0.0..=lengths[i]).contains(&grain.position[i]))
            && grain.angular_velocity == Vec3::zeros()
    }));
    // Evenly spread: each octant holds an eighth, to four times the scatter of independent places.
    for octant in 0..8 {
        let inside = |grain: &&Grain| {
            (0..3).all(|i| (grain.position[i] > 0.5 * lengths[i]) == (octant >> i & 1 == 1))
        };
        let count = packing.grains.iter().filter(inside).count();
        assert!(
            count.abs_diff(125) < 42,
            "octant {octant} holds {count} of 1,000 grains, far from 125: the packing is not even"
        );
    }
}

#[test]
fn a_seed_gives_one_packing_on_any_number_of_threads_and_another_seed_another() {
    let make = |seed, threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let side = (1100.0 * PI / 6.0 / 0.5_f64).cbrt();
        let wanted = PeriodicPacking::new([side; 3], vec![0.5; 1100], seed);
        positions(&pool.install(|| wanted.make().unwrap()))
    };
    let first = make(7, 1);
    assert!(first == make(7, 3), "the same bits");
    assert!(first != make(8, 1));
}

#[test]
fn a_suspension_keeps_its_clearance_and_sizes_are_kept() {
    // Solid fraction 0.2 with gaps of at least 2% - 0.2% of a diameter.
    let radii: Vec<f64> = (0..300).map(|i| 0.3 + 0.4 * f64::from(i) / 300.0).collect();
    let solid = 1.0 - porosity(&radii, 1.0);
    let side = (solid / 0.2).cbrt();
    let wanted = PeriodicPacking { clearance: 0.02, ..PeriodicPacking::new([side; 3], radii, 3) };
    let packing = wanted.make().unwrap();
    assert!((packing.report.porosity - 0.8).abs() < 1e-12);
    assert!((packing.report.coordination, packing.report.largest_overlap) == (0.0, 0.0));
    for (number, one) in packing.grains.iter().enumerate() {
        assert_eq!(one.radius, wanted.radii[number]);
        for two in &packing.grains[number + 1..] {
            let apart = nearest(&packing.sides, two.position - one.position).norm();
            assert!(apart / (one.radius + two.radius) > 1.02 * (1.0 - 2e-3) - 1e-12);
        }
    }
}

/// A small bed of graded grains.
fn bed(sides: BedSides, friction: f64) -> Packing {
    let radii = (0..120).map(|i| 0.45 + 0.1 * f64::from(i) / 120.0).collect();
    SettledBed { lengths: [4.5, 4.0], sides, radii, friction, seed: 2 }.make().unwrap()
}

#[test]
fn a_bed_settles_between_walls_or_periodic_sides() {
    for sides in [BedSides::Walls, BedSides::Periodic] {
        let packing = bed(sides, 0.3);
        let report = packing.report;
        println!("{sides:?}: {report:?}");
        assert_eq!(packing.planes.len(), if sides == BedSides::Walls { 5 } else { 1 });
        // Weight presses the grains into each other by a thousandth of d and some chains by more.
        assert!(
            report.largest_overlap > 1e-4 && report.largest_overlap < 0.008,
            "grains of a settled bed overlap by their weight, here out of 1e-4 to 0.008 diameters: {report:?}"
        );
        let (overlap, touching) = by_looking(&packing);
        assert!(report.largest_overlap >= overlap - 1e-12);
        assert_eq!(2.0 * f64::from(touching) / 120.0, report.coordination);
        // Between the densest random packing and the loosest mechanically stable one in so narrow a
        // box; a stable rough sphere needs 4 contacts, with walls' and the surface's taken off.
        assert!(
            (0.36..0.52).contains(&report.porosity),
            "porosity of a settled bed out of 0.36 to 0.52: {report:?}"
        );
        assert!(
            (3.0..6.5).contains(&report.coordination),
            "coordination number of a settled bed out of 3 to 6.5: {report:?}"
        );
        for grain in &packing.grains {
            for plane in &packing.planes {
                assert!(plane.height(&grain.position) > 0.98 * grain.radius, "inside the box");
            }
        }
    }
}

/// A bed of grains of two sizes, with all lengths so many times as long.
fn mixed_bed(sides: BedSides, scale: f64) -> SettledBed {
    let radii = (0..90).map(|i| if i % 3 == 0 { 0.6 * scale } else { 0.45 * scale }).collect();
    SettledBed { lengths: [5.5 * scale, 5.6 * scale], sides, radii, friction: 0.3, seed: 5 }
}

#[test]
fn grains_of_a_bed_fall_from_places_in_which_none_touches_anything() {
    for sides in [BedSides::Walls, BedSides::Periodic] {
        let bed = mixed_bed(sides, 1.0);
        let grains = bed.column();
        assert_eq!(grains.len(), 90, "a place for each grain");
        let lengths = match sides {
            BedSides::Walls => [None; 3],
            BedSides::Periodic => [Some(5.5), Some(5.6), None],
        };
        let domain = PeriodicBox { lengths };
        for (number, grain) in grains.iter().enumerate() {
            let (at, r) = (grain.position, grain.radius);
            assert_eq!(r, bed.radii[number], "grain {number} has the radius that was asked for");
            for (axis, length) in [(0, 5.5), (1, 5.6)] {
                assert!(
                    at[axis] >= r && at[axis] <= length - r,
                    "grain {number} of radius {r} at {at:?} reaches out of the sides"
                );
            }
            assert!(at.z >= r, "grain {number} of radius {r} at {at:?} lies in the floor");
            for other in &grains[number + 1..] {
                let apart = nearest(&domain, other.position - at).norm();
                assert!(
                    apart >= r + other.radius,
                    "grains at {at:?} and {:?} touch",
                    other.position
                );
            }
        }
        // Cells of 1.26 (2.1 times the largest radius) and a little more: 4 x 4 in a layer, 6 layers.
        let top = grains.iter().map(|grain| grain.position.z).fold(0.0, f64::max);
        assert!((5.0 * 1.26..6.0 * 1.26).contains(&top), "the uppermost grain is at {top}");
        // Not on a lattice, and not sorted by size: large grains, first in the list, are everywhere.
        let heights =
            grains.iter().filter(|grain| grain.radius == 0.6).map(|grain| grain.position.z);
        let mean = heights.sum::<f64>() / 30.0;
        // Why: the mean of 30 heights spread evenly over 7.1 is off by 7.1/sqrt(12 * 30) = 0.37; three times that.
        assert!(
            (mean - 0.5 * 90.0 / 16.0 * 1.26).abs() < 1.1,
            "mean height of the large grains: {mean}"
        );
        let on_lattice = |grain: &&Grain| {
            (grain.position.x / 1.375).fract() == (grains[0].position.x / 1.375).fract()
        };
        assert!(
            grains.iter().filter(on_lattice).count() < 5,
            "places are random within their cells"
        );
    }
}

#[test]
fn a_bed_has_no_scale_of_its_own() {
    // Four times all lengths is twice all times, 64 times all masses and 256 times all forces: powers of two, so
    // that the same numbers come out.
    for sides in [BedSides::Walls, BedSides::Periodic] {
        let [one, four] = [1.0, 4.0].map(|scale| mixed_bed(sides, scale).make().unwrap());
        for (number, (small, large)) in one.grains.iter().zip(&four.grains).enumerate() {
            let off = (4.0 * small.position - large.position).norm();
            assert!(
                off <= 1e-9,
                "{sides:?}: grain {number} at {:?} in the bed, at {:?} in the one of four times the size",
                small.position,
                large.position
            );
        }
        let (report, scaled) = (one.report, four.report);
        assert!((report.porosity - scaled.porosity).abs() < 1e-12, "{report:?}, {scaled:?}");
        assert_eq!(report.coordination, scaled.coordination);
    }
}

#[test]
fn porosity_of_a_bed_s_middle_is_that_of_its_slices() {
    // By counting points in the middle half, instead of volumes of slices of spheres.
    let packing = bed(BedSides::Periodic, 0.3);
    let mass: f64 = packing.grains.iter().map(|g| g.mass).sum();
    let middle = packing.grains.iter().map(|g| g.mass * g.position.z).sum::<f64>() / mass;
    let n = 60;
    let (mut inside, mut all) = (0_u32, 0_u32);
    for i in 0..n {
        for j in 0..n {
            for k in 0..n {
                let part = |x: i32| (f64::from(x) + 0.5) / f64::from(n);
                let z = middle * (0.5 + part(k));
                let point = Vec3::new(4.5 * part(i), 4.0 * part(j), z);
                let covers = |g: &Grain| {
                    nearest(&packing.sides, point - g.position).norm_squared() < g.radius * g.radius
                };
                inside += u32::from(packing.grains.iter().any(covers));
                all += 1;
            }
        }
    }
    let counted = 1.0 - f64::from(inside) / f64::from(all);
    // Overlaps of a few thousandths count once here, twice there; points miss by a few tenths of n⁻¹·⁵.
    assert!(
        (counted - packing.report.porosity).abs() < 2e-3,
        "porosity counted by points {counted}, reported {:?}",
        packing.report
    );
}

#[test]
fn packings_that_cannot_be_are_refused() {
    let make = |radii: Vec<f64>, side: f64| PeriodicPacking::new([side; 3], radii, 0).make();
    let message = |radii, side| make(radii, side).unwrap_err().to_string();
    let dense = message(vec![0.5; 200], 5.0);
    assert!(dense.contains("is denser than spheres can be packed"), "{dense}");
    assert!(message(vec![], 5.0).contains("number of grains = 0 must be at least 1"));
    assert!(message(vec![0.5, -0.5], 5.0).contains("radius = -0.5 must be positive"));
    assert!(message(vec![0.5, 0.0], 5.0).contains("radius = 0 must be positive"));
    let narrow = message(vec![0.5; 1], 0.99);
    assert!(narrow.contains("a grain would touch its own image"), "{narrow}");
    // Denser than random packings get: porosity 0.33.
    let side = (60.0 * PI / 6.0 / 0.67_f64).cbrt();
    let jammed = message(vec![0.5; 60], side);
    assert!(jammed.contains("a porosity of 0.3300 was not reached"), "{jammed}");
    assert!(jammed.contains("raise the porosity"), "{jammed}");
    let bed = SettledBed {
        lengths: [0.8, 4.0],
        sides: BedSides::Walls,
        radii: vec![0.5; 4],
        friction: 0.3,
        seed: 0,
    };
    let narrow = bed.make().unwrap_err().to_string();
    assert!(narrow.contains("box length = 0.8 must be finite and exceed"), "{narrow}");
    for (length, fits) in [(1.0, false), (1.05, true), (f64::INFINITY, false)] {
        let one = SettledBed { lengths: [1.05, length], radii: vec![0.5], ..bed.clone() };
        assert_eq!(one.make().is_ok(), fits, "a grain 1 across between walls {length} apart");
    }
}

#[test]
fn mixtures_jam_where_independent_simulations_say() {
    // O'Hern, Silbert, Liu & Nagel, Phys. Rev. E 68, 011306 (2003): solid fraction 0.639 for equal spheres, 0.648
    // for as many of radius 1 as of 1.4. Ways of packing differ by some 0.005, and so may the two sources.
    let allowed = 0.01;
    for (what, radii, solid) in
        [("equal spheres", vec![2.0; 10], 0.639), ("radii 1 and 1.4", [1.0, 1.4].repeat(5), 0.648)]
    {
        let found = 1.0 - jamming_porosity(&radii);
        assert!(
            (found - solid).abs() < allowed,
            "{what} jam at a solid fraction of {found}, where simulations found {solid}"
        );
    }
}

#[test]
fn few_large_grains_among_many_small_ones_jam_denser_than_few_small_ones_among_large() {
    // The term with the skewness S: both have the same spread δ = 0.4, and S = +1.5 and -1.5. What S alone makes
    // of it, 2 · 0.0857 · 1.5 · 0.16 = 0.041, is far more than any rounding; its sign is Desmond & Weeks' finding.
    let mixture = |many: f64, one: f64| [many, many, many, many, one];
    let (mean, spread) = (1.0, 0.4);
    let large = mixture(mean - spread / 2.0, mean + 2.0 * spread);
    let small = mixture(mean + spread / 2.0, mean - 2.0 * spread);
    let gained = jamming_porosity(&small) - jamming_porosity(&large);
    assert!(
        (gained - 0.041).abs() < 0.001,
        "a large grain among four gains {gained} of solid fraction over a small one among four, not 0.041"
    );
}
