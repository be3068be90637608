//! Solid fraction of a sphere in a cell, by inclusion and exclusion.
//!
//! The common volume is an alternating sum, over the eight corners of the cell, of the volume that the
//! ball shares with the box between its centre and the corner. Where the corner lies in the ball that
//! is the box; where it does not, it is an eighth of the ball less what lies beyond each of the box's
//! three outer sides, what lies beyond two of them counted once.

use std::f64::consts::PI;
use std::ops::RangeInclusive;

/// Solid fraction, 0 to 1, of the cell `-1/2..1/2`³ in a ball of `radius` cells about `centre`. Its
/// error is a few times `1e-16 (1 + radius³)`, far below the single precision that it is used in.
pub fn solid_fraction(centre: [f64; 3], radius: f64) -> f64 {
    let near = centre.map(|c| (c.abs() - 0.5).max(0.0));
    let far = centre.map(|c| c.abs() + 0.5);
    if square(near) >= radius * radius {
        return 0.0;
    }
    if square(far) <= radius * radius {
        return 1.0;
    }
    let ends = centre.map(|c| [-0.5 - c, 0.5 - c]);
    let mut volume = 0.0;
    for corner in 0..8_usize {
        let at: [f64; 3] = std::array::from_fn(|axis| ends[axis][corner >> axis & 1]);
        // The box from the centre to the corner counts as negative as often as the corner is a lower
        // end or lies below the centre.
        let lower = 3 - corner.count_ones() as usize + at.iter().filter(|x| **x < 0.0).count();
        let part = corner_volume(at.map(f64::abs), radius);
        volume += if lower.is_multiple_of(2) { part } else { -part };
    }
    volume.clamp(0.0, 1.0)
}

/// The cells along each axis, by their lowest corners, among which are all that a ball touches.
pub fn cells_about(centre: [f64; 3], radius: f64) -> [RangeInclusive<i64>; 3] {
    centre.map(|c| floor(c - radius)..=floor(c + radius))
}

/// The cell of a coordinate.
#[expect(clippy::cast_possible_truncation, reason = "beyond 2^63 it saturates")]
fn floor(coordinate: f64) -> i64 {
    coordinate.floor() as i64
}

/// Tells the solid fraction of each of `cells` that a ball of `radius` about `centre` touches, by the cell's
/// lowest corner. The same sum as [`solid_fraction`]; cells that share a corner share its volume, and
/// corners on a line or in a plane share the parts of it that depend on two axes or on one.
pub fn solid_fractions(
    centre: [f64; 3],
    radius: f64,
    cells: &[RangeInclusive<i64>; 3],
    mut tell: impl FnMut([i64; 3], f64),
) {
    if cells.iter().any(RangeInclusive::is_empty) {
        return;
    }
    let [x, y, z] = &[0, 1, 2].map(|axis| Nodes::along(centre[axis], radius, &cells[axis]));
    let wedges = [[x, y], [y, z], [z, x]].map(|[a, b]| {
        let wedge = |i: usize| half_wedge(a.at[i % a.len()], b.at[i / a.len()], radius);
        (0..a.len() * b.len()).map(wedge).collect::<Vec<f64>>()
    });
    let eighth = PI * radius * radius * radius / 6.0;
    let volume = |i: usize, j: usize, k: usize| {
        let at = [x.at[i], y.at[j], z.at[k]];
        let part = if square(at) <= radius * radius {
            at[0] * at[1] * at[2]
        } else {
            eighth - (x.caps[i] + y.caps[j] + z.caps[k])
                + wedges[0][i + j * x.len()]
                + wedges[1][j + k * y.len()]
                + wedges[2][k + i * z.len()]
        };
        x.signs[i] * y.signs[j] * z.signs[k] * part
    };
    let mut volumes = Vec::with_capacity(x.len() * y.len() * z.len());
    for k in 0..z.len() {
        for j in 0..y.len() {
            volumes.extend((0..x.len()).map(|i| volume(i, j, k)));
        }
    }
    let (row, plane) = (x.len(), x.len() * y.len());
    for k in 0..z.len() - 1 {
        for j in 0..y.len() - 1 {
            for i in 0..x.len() - 1 {
                let ends = [(x, i), (y, j), (z, k)].map(|(nodes, i)| nodes.ends(i));
                if square(ends.map(|(near, _)| near)) >= radius * radius {
                    continue;
                }
                let cell = [x.first + i as i64, y.first + j as i64, z.first + k as i64];
                if square(ends.map(|(_, far)| far)) <= radius * radius {
                    tell(cell, 1.0);
                    continue;
                }
                let at = i + j * row + k * plane;
                let edge = |at: usize| volumes[at + 1] - volumes[at];
                let fraction =
                    (edge(at + row + plane) - edge(at + plane)) - (edge(at + row) - edge(at));
                if fraction > 0.0 {
                    tell(cell, fraction.min(1.0));
                }
            }
        }
    }
}

/// Corners of cells along one axis.
struct Nodes {
    /// The lowest.
    first: i64,
    /// Their places against the centre.
    offsets: Vec<f64>,
    /// Their distances from the centre, at most the radius, and on which side they lie.
    at: Vec<f64>,
    signs: Vec<f64>,
    /// What of an eighth of the ball lies beyond them.
    caps: Vec<f64>,
}

impl Nodes {
    fn along(centre: f64, radius: f64, cells: &RangeInclusive<i64>) -> Self {
        let corners = *cells.start()..=*cells.end() + 1;
        let offsets: Vec<f64> = corners.map(|i| i as f64 - centre).collect();
        let at: Vec<f64> = offsets.iter().map(|x| x.abs().min(radius)).collect();
        Nodes {
            first: *cells.start(),
            signs: offsets.iter().map(|x| x.signum()).collect(),
            caps: at.iter().map(|&x| quarter_cap(x, radius)).collect(),
            offsets,
            at,
        }
    }

    fn len(&self) -> usize {
        self.offsets.len()
    }

    /// Distances of the nearest and of the farthest point of a cell from the centre, along this axis.
    fn ends(&self, i: usize) -> (f64, f64) {
        let (low, high) = (self.offsets[i], self.offsets[i + 1]);
        (low.max(-high).max(0.0), high.max(-low))
    }
}

fn square([x, y, z]: [f64; 3]) -> f64 {
    x * x + y * y + z * z
}

/// Volume that the ball of radius `a` about the origin shares with the box from there to `corner`, whose
/// components are not negative.
fn corner_volume(corner: [f64; 3], a: f64) -> f64 {
    let [x, y, z] = corner.map(|c| c.min(a));
    if x * x + y * y + z * z <= a * a {
        return x * y * z;
    }
    let beyond_one = quarter_cap(x, a) + quarter_cap(y, a) + quarter_cap(z, a);
    let beyond_two = half_wedge(x, y, a) + half_wedge(y, z, a) + half_wedge(z, x, a);
    // Nothing lies beyond all three: the corner is outside.
    PI * a * a * a / 6.0 - beyond_one + beyond_two
}

/// Volume of the part of an eighth of the ball that lies beyond the plane at distance `x`.
fn quarter_cap(x: f64, a: f64) -> f64 {
    // V = π/12 (a - x)² (2a + x)
    PI / 12.0 * (a - x) * (a - x) * (2.0 * a + x)
}

/// Volume of the part of an eighth of the ball that lies beyond the planes at distances `x` and `y`
/// across two axes.
fn half_wedge(x: f64, y: f64, a: f64) -> f64 {
    let s2 = a * a - x * x - y * y;
    if s2 <= 0.0 {
        return 0.0;
    }
    let s = s2.sqrt();
    // V = ∫∫ √(a² - X² - Y²) dX dY over X > x, Y > y
    //   = x y s/3 - x (3a² - x²)/6 atan(s/y) - y (3a² - y²)/6 atan(s/x) + a³/3 atan(a s/(x y))
    x * y * s / 3.0
        - x * (3.0 * a * a - x * x) / 6.0 * s.atan2(y)
        - y * (3.0 * a * a - y * y) / 6.0 * s.atan2(x)
        + a * a * a / 3.0 * (a * s).atan2(x * y)
}

/// The share of `n`³ points of the cell, the midpoints of its `n`³ parts, that lie in the ball.
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
