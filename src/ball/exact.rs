//! Solid fraction of a sphere in a cell, by inclusion and exclusion.
//!
//! The common volume is an alternating sum, over the eight corners of the cell, of the volume that the
//! ball shares with the box between its centre and the corner. Where the corner lies in the ball that
//! is the box; where it does not, it is an eighth of the ball less what lies beyond each of the box's
//! three outer sides, what lies beyond two of them counted once.

use std::f64::consts::PI;
use std::ops::RangeInclusive;

use pulp::{Arch, Simd, WithSimd};

use crate::lanes::{Doubles, Lanes};

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

/// As [`super::rows_of_fractions`]. The same sum as [`solid_fraction`]; cells that share a corner share its volume, and
/// corners on a line or in a plane share the parts of it that depend on two axes or on one.
pub(super) fn rows(
    centre: [f64; 3],
    radius: f64,
    cells: &[RangeInclusive<i64>; 3],
    mut tell: impl FnMut([i64; 3], &[f64]),
) {
    let [x, y, z] = &[0, 1, 2].map(|axis| Nodes::along(centre[axis], radius, &cells[axis]));
    let wedges = [[x, y], [y, z], [z, x]].map(|[a, b]| {
        let mut wedges = vec![0.0; a.len() * b.len()];
        Arch::new().dispatch(HalfWedges { radius, nodes: [a, b], wedges: &mut wedges });
        wedges
    });
    let (eighth, r2) = (PI * radius * radius * radius / 6.0, radius * radius);
    let mut fractions = Vec::with_capacity(x.len());
    for k in 0..z.len() - 1 {
        for j in 0..y.len() - 1 {
            let (near, far) = (y.near2[j] + z.near2[k], y.far2[j] + z.far2[k]);
            if near >= r2 {
                continue;
            }
            // What the ball shares with the four boxes between its centre and the corners of the row at node i.
            let four = |i: usize| {
                let mut sum = 0.0;
                for (j, k, sign) in
                    [(j, k, 1.0), (j + 1, k, -1.0), (j, k + 1, -1.0), (j + 1, k + 1, 1.0)]
                {
                    let part = if x.at[i] * x.at[i] + y.at[j] * y.at[j] + z.at[k] * z.at[k] <= r2 {
                        x.at[i] * y.at[j] * z.at[k]
                    } else {
                        eighth - (x.caps[i] + y.caps[j] + z.caps[k])
                            + wedges[0][i + j * x.len()]
                            + wedges[1][j + k * y.len()]
                            + wedges[2][k + i * z.len()]
                    };
                    sum += sign * y.signs[j] * z.signs[k] * part;
                }
                x.signs[i] * sum
            };
            // The first cell, and the sum at the end of the last one that was cut.
            let (mut first, mut before) = (0, None);
            fractions.clear();
            for i in 0..x.len() - 1 {
                let fraction = if x.near2[i] + near >= r2 {
                    0.0
                } else if x.far2[i] + far <= r2 {
                    1.0
                } else {
                    let start = match before {
                        Some((node, sum)) if node == i => sum,
                        _ => four(i),
                    };
                    let end = four(i + 1);
                    before = Some((i + 1, end));
                    (end - start).clamp(0.0, 1.0)
                };
                if fraction > 0.0 {
                    if fractions.is_empty() {
                        first = i;
                    }
                    fractions.push(fraction);
                } else if !fractions.is_empty() {
                    break;
                }
            }
            if !fractions.is_empty() {
                tell([x.first + first as i64, y.first + j as i64, z.first + k as i64], &fractions);
            }
        }
    }
}

/// Corners of cells along one axis.
struct Nodes {
    /// The lowest.
    first: i64,
    /// Their distances from the centre, at most the radius, and on which side they lie.
    at: Vec<f64>,
    signs: Vec<f64>,
    /// Squares of the distances of the nearest and the farthest point of each cell from the centre.
    near2: Vec<f64>,
    far2: Vec<f64>,
    /// What of an eighth of the ball lies beyond them.
    caps: Vec<f64>,
    /// Half the chord of the ball there: `√(a² - x²)`
    chords: Vec<f64>,
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
            chords: at.iter().map(|x| (radius * radius - x * x).sqrt()).collect(),
            near2: ends(&offsets, |low, high| low.max(-high).max(0.0)),
            far2: ends(&offsets, |low, high| high.max(-low)),
            at,
        }
    }

    fn len(&self) -> usize {
        self.at.len()
    }
}

/// Squares of a distance along one axis of each cell from the centre, by its two ends.
fn ends(offsets: &[f64], distance: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    offsets.windows(2).map(|ends| distance(ends[0], ends[1]).powi(2)).collect()
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

/// [`half_wedge`] at the nodes of two axes, those of the first fastest.
struct HalfWedges<'a> {
    radius: f64,
    nodes: [&'a Nodes; 2],
    wedges: &'a mut [f64],
}

impl WithSimd for HalfWedges<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, token: S) {
        let all = |value: f64| Doubles::splat(token, value);
        let (a, [of_x, of_y]) = (self.radius, self.nodes);
        let (a2, a3) = (all(a * a), all(a * a * a / 3.0));
        let (radius, three_a2, third, sixth) =
            (all(a), all(3.0 * a * a), all(1.0 / 3.0), all(1.0 / 6.0));
        let rows = self.wedges.chunks_mut(of_x.len());
        for ((row, &y), &y_chord) in rows.zip(&of_y.at).zip(&of_y.chords) {
            let (y, y_chord) = (all(y), all(y_chord));
            let lanes = Doubles::<S>::COUNT;
            let columns = of_x.at.chunks(lanes).zip(of_x.chords.chunks(lanes));
            for (wedges, (x, x_chord)) in row.chunks_mut(lanes).zip(columns) {
                let x = Doubles::load_some(token, x);
                let x_chord = Doubles::load_some(token, x_chord);
                let s = (a2 - x * x - y * y).max(all(0.0)).sqrt();
                // The angles of atan2(s, y), atan2(s, x) and atan2(a s, x y): the third sides of their triangles are
                // chords and, of the last, the product of the two.
                let of_y = angle(token, s, y + x_chord);
                let of_x = angle(token, s, x + y_chord);
                let of_both = angle(token, radius * s, x.mul_add(y, x_chord * y_chord));
                let x_part = x * (three_a2 - x * x) * sixth * of_y;
                let y_part = y * (three_a2 - y * y) * sixth * of_x;
                let wedge = x * y * s * third - x_part - y_part + a3 * of_both;
                wedge.store_some(wedges);
            }
        }
    }
}

/// The angle between hypotenuse and adjacent side of a right-angled triangle, 0 to π/2, from its opposite side and the
/// sum of adjacent side and hypotenuse, which is not 0 unless both are.
#[inline(always)]
fn angle<S: Simd>(token: S, opposite: Doubles<S>, others: Doubles<S>) -> Doubles<S> {
    let all = |value: f64| Doubles::splat(token, value);
    // Tangents of half the angle and of a quarter of it; at most √2 - 1.
    let half = opposite.over(others.max(all(f64::MIN_POSITIVE)));
    let quarter = half.over(all(1.0) + half.mul_add(half, all(1.0)).sqrt());
    // atan t = t - t³/3 + t⁵/5 - ...: after 21 terms less than 1e-17 is missing
    let square = quarter * quarter;
    let mut series = all(1.0 / 41.0);
    let mut k = 20;
    while k > 0 {
        k -= 1;
        series = all(1.0 / f64::from(2 * k + 1)) - square * series;
    }
    all(4.0) * quarter * series
}
