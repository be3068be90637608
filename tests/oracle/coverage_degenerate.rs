//! Exact solid fraction of a sphere where its surface touches planes, edges and corners of the cell.

use crate::common;
use crate::coverage::{quadrature_error, rounding};

use common::cuts::assert_close;
use common::sphere_quadrature::fraction_by_quadrature;
use psmrt_reference::coverage::exact_fraction;
use psmrt_reference::lattice::Vec3;
use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

/// Positions in which a plane, edge or corner of the cell touches the surface or meets the centre.
fn degenerate_positions() -> Vec<(Vec3, f64)> {
    let third = 1.0 / 3.0_f64.sqrt();
    let mut positions = Vec::new();
    for radius in [0.05, 0.3, 0.5, 1.0, 2.0, 8.0, 50.0] {
        // Touching from outside: a face, an edge, a corner.
        positions.push((Vec3::new(0.5 + radius, 0.2, 0.1), radius));
        positions.push((
            Vec3::new(0.5, 0.5, 0.0) + Vec3::new(1.0, 1.0, 0.0) * (radius * FRAC_1_SQRT_2),
            radius,
        ));
        positions.push((Vec3::repeat(0.5 + radius * third), radius));
        // Touching from inside, far away: the plane of the far face, its edge, its corner.
        positions.push((Vec3::new(radius - 0.5, 0.0, 0.0), radius));
        positions.push((Vec3::new(radius - 0.5, 0.5, 0.5), radius));
        positions.push((
            Vec3::new(radius * FRAC_1_SQRT_2 - 0.5, radius * FRAC_1_SQRT_2 - 0.5, 0.3),
            radius,
        ));
        positions.push((Vec3::repeat(radius * third - 0.5), radius));
        // The surface passes through a near corner, and through the cell's centre.
        positions.push((Vec3::new(0.5, 0.5, 0.5 + radius), radius));
        positions.push((Vec3::new(0.0, 0.0, radius), radius));
        positions.push((Vec3::new(0.6, 0.8, 0.0) * radius, radius));
        // The centre in the plane of a face, on the line of an edge, on a corner.
        positions.push((Vec3::new(0.5, 0.1 + radius, 0.2), radius));
        positions.push((Vec3::new(0.5, 0.5, 0.3 + radius), radius));
        positions.push((Vec3::new(0.5, -0.5, radius), radius));
    }
    // The centre on a face, an edge, a corner, in the middle; the surface through or along others.
    for radius in
        [0.05, 0.25, 0.5, FRAC_1_SQRT_2, 0.75_f64.sqrt(), 1.0, 1.25_f64.sqrt(), 1.2, SQRT_2, 1.5]
    {
        positions.push((Vec3::zeros(), radius));
        positions.push((Vec3::new(0.5, 0.0, 0.0), radius));
        positions.push((Vec3::new(0.5, 0.5, 0.0), radius));
        positions.push((Vec3::new(0.5, 0.5, 0.5), radius));
        positions.push((Vec3::new(0.5, 0.2, 0.1), radius));
        positions.push((Vec3::new(0.5, 0.5, 0.2), radius));
    }
    positions
}

#[test]
fn degenerate_positions_agree_with_the_quadrature() {
    for (centre, radius) in degenerate_positions() {
        let expected = fraction_by_quadrature(&centre, radius);
        assert_close(exact_fraction(&centre, radius), expected, quadrature_error(radius));
    }
}

#[test]
fn fraction_is_continuous_about_degenerate_positions() {
    for (centre, radius) in degenerate_positions() {
        let fraction = exact_fraction(&centre, radius);
        for step in (3..=17).map(|digits| 10.0_f64.powi(-digits)).flat_map(|step| [step, -step]) {
            // Why: see `fraction_moves_with_the_centre` and `fraction_grows_with_the_radius` in `coverage.rs`.
            let place = 2.0 * rounding(radius);
            for axis in 0..3 {
                let mut moved = centre;
                moved[axis] += step;
                let shifted = exact_fraction(&moved, radius);
                assert_close(shifted, fraction, step.abs() + place);
            }
            let grown = exact_fraction(&centre, radius + step);
            assert_close(grown, fraction, 6.0 * step.abs() + place);
        }
    }
}
