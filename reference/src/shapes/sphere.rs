//! A sphere.

use std::f64::consts::PI;

use super::Covered;
use crate::coverage::rule::CoverageRule;
use crate::domain::Domain;
use crate::lattice::Vec3;

/// Half of a cell's diagonal: a cell that a sphere touches has its centre no further than this from its surface.
const HALF_DIAGONAL: f64 = 0.867;

pub(super) fn volume(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius.powi(3)
}

/// Diameter of the sphere of this volume.
pub(super) fn diameter_of(volume: f64) -> f64 {
    (6.0 * volume / PI).cbrt()
}

pub(super) fn bounds(centre: &Vec3, radius: f64) -> [Vec3; 2] {
    [centre.add_scalar(-radius), centre.add_scalar(radius)]
}

/// The cells that it touches have their centres in a sphere that is larger by half a cell's diagonal.
pub(super) fn most_cells(radius: f64) -> f64 {
    volume(radius + HALF_DIAGONAL)
}

pub(super) fn covered(
    domain: &Domain,
    centre: &Vec3,
    radius: f64,
    rule: CoverageRule,
) -> Vec<Covered> {
    let mut covered = Vec::new();
    let range = |axis: usize| {
        domain.within(axis, cell_at(centre[axis] - radius)..=cell_at(centre[axis] + radius))
    };
    for z in range(2) {
        for y in range(1) {
            for x in range(0) {
                let Some(inside) = domain.locate([x, y, z]) else { continue };
                // The cell's centre before wrapping: the arm is that of this image.
                let cell_centre = Vec3::new(x as f64, y as f64, z as f64).add_scalar(0.5);
                let arm = cell_centre - centre;
                let epsilon = rule.fraction(&-arm, radius);
                if epsilon > 0.0 {
                    covered.push(Covered { cell: domain.index(inside), epsilon, arm });
                }
            }
        }
    }
    covered
}

/// The cell that contains a coordinate along an axis.
#[expect(clippy::cast_possible_truncation, reason = "beyond 2^63 it saturates")]
fn cell_at(coordinate: f64) -> i64 {
    coordinate.floor() as i64
}
