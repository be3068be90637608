//! Spheres that cut a cell, at random, and the symmetries of the cube.

use super::random::Random;
use psmrt_reference::lattice::Vec3;

#[track_caller]
pub fn assert_close(value: f64, expected: f64, tolerance: f64) {
    let error = (value - expected).abs();
    assert!(error <= tolerance, "{value:e} is not {expected:e}: off by {error:e} > {tolerance:e}");
}

/// The 48 images of a position under the symmetries of the cube.
pub fn images(v: &Vec3) -> Vec<Vec3> {
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let signs = [1.0, -1.0];
    let mut images = Vec::with_capacity(48);
    for [i, j, k] in orders {
        for x in signs {
            for y in signs {
                for z in signs {
                    images.push(Vec3::new(x * v[i], y * v[j], z * v[k]));
                }
            }
        }
    }
    images
}

/// Root of the mean square of an error over some cuts of a cell.
pub fn rms(cuts: &[Vec3], error: impl Fn(&Vec3) -> f64) -> f64 {
    (cuts.iter().map(|centre| error(centre).powi(2)).sum::<f64>() / cuts.len() as f64).sqrt()
}

/// Uniform in the cube -1..1.
pub fn anywhere(random: &mut Random) -> Vec3 {
    random.vector(1.0)
}

/// A sphere whose surface cuts the cell: its centre, and a radius from 0.05 to 50.
pub fn cut(random: &mut Random) -> (Vec3, f64) {
    let radius = 0.05 * 1000.0_f64.powf(random.between(0.0, 1.0));
    (cut_of_radius(random, radius), radius)
}

/// Centre of a sphere of `radius` whose surface cuts the cell.
pub fn cut_of_radius(random: &mut Random, radius: f64) -> Vec3 {
    loop {
        let inward = anywhere(random);
        if !(0.01..1.0).contains(&inward.norm()) {
            continue; // a direction without preference for the cube's corners
        }
        let centre = inward.normalize() * (radius + random.between(-1.0, 1.0));
        let corners = images(&Vec3::repeat(0.5)).into_iter().map(|corner| (corner - centre).norm());
        let nearest = centre.map(|c| (c.abs() - 0.5).max(0.0)).norm();
        if nearest < radius && corners.fold(0.0, f64::max) > radius {
            return centre;
        }
    }
}
