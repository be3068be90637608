//! Solid fraction of a sphere in a cell, by sample points.

use std::ops::RangeInclusive;

/// As [`super::rows_of_fractions`].
pub(super) fn rows(
    centre: [f64; 3],
    radius: f64,
    n: usize,
    cells: &[RangeInclusive<i64>; 3],
    mut tell: impl FnMut([i64; 3], &[f64]),
) {
    let [x_range, y_range, z_range] = cells;
    for z in z_range.clone() {
        for y in y_range.clone() {
            for x in x_range.clone() {
                let middle = [x, y, z].map(|low| low as f64 + 0.5);
                let from = std::array::from_fn(|axis| centre[axis] - middle[axis]);
                let epsilon = sampled_fraction(from, radius, n);
                if epsilon > 0.0 {
                    tell([x, y, z], &[epsilon]);
                }
            }
        }
    }
}

/// The share of `n`³ points of the cell `-1/2..1/2`³, the midpoints of its `n`³ parts, that lie in the ball.
pub fn sampled_fraction(centre: [f64; 3], radius: f64, n: usize) -> f64 {
    let offsets: Vec<f64> =
        (0..n).map(|i| (2.0 * i as f64 + 1.0) / (2.0 * n as f64) - 0.5).collect();
    let squares = |c: f64| offsets.iter().map(move |x| (x - c) * (x - c));
    let mut inside = 0_u32;
    for x2 in squares(centre[0]) {
        for y2 in squares(centre[1]) {
            let room = radius * radius - x2 - y2;
            inside += squares(centre[2]).map(|z2| u32::from(z2 <= room)).sum::<u32>();
        }
    }
    f64::from(inside) / (n * n * n) as f64
}
