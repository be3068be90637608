//! Solid fractions of a sphere in the cells of whole rows: the sum of `exact.rs` in vectors. Cells that share a corner share
//! its volume, and corners on a line or in a plane share the parts of it that depend on two axes or on one.

use std::f64::consts::PI;
use std::ops::RangeInclusive;

use pulp::{Arch, Simd, WithSimd};

use crate::lanes::{Doubles, Lanes};

/// As [`super::rows_of_fractions`]. A row is worked out whole: to tell which of its cells are cut takes longer than to
/// cut them all.
pub(super) fn rows(
    centre: [f64; 3],
    radius: f64,
    cells: &[RangeInclusive<i64>; 3],
    tell: impl FnMut([i64; 3], &[f64]),
) {
    Arch::new().dispatch(Rows { centre, radius, cells, tell });
}

/// The rows of a ball.
struct Rows<'a, F> {
    centre: [f64; 3],
    radius: f64,
    cells: &'a [RangeInclusive<i64>; 3],
    tell: F,
}

impl<F: FnMut([i64; 3], &[f64])> WithSimd for Rows<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, token: S) {
        let all = |value: f64| Doubles::<S>::splat(token, value);
        let (a, r2) = (self.radius, self.radius * self.radius);
        let [nx, ny, nz] = self.cells.each_ref().map(nodes);
        // All in one piece of memory: for small balls it takes as long to ask for some as to use it.
        let tables = Nodes::TABLES * (nx + ny + nz) + nx * ny + nx * nz + ny * nz;
        let mut memory = vec![0.0; tables + 2 * nx * ny + (nx + WHOLE) + nx];
        let mut memory = memory.as_mut_slice();
        // One by one: a closure may be compiled without the vectors.
        let (centre, cells) = (self.centre, self.cells);
        let mut tables = |count: usize| taken(&mut memory, Nodes::TABLES * count);
        let (in_x, in_y, in_z) = (tables(nx), tables(ny), tables(nz));
        let x = &Nodes::along(token, centre[0], a, &cells[0], in_x);
        let y = &Nodes::along(token, centre[1], a, &cells[1], in_y);
        let z = &Nodes::along(token, centre[2], a, &cells[2], in_z);
        let xy = half_wedges(token, a, x, y, taken(&mut memory, nx * ny));
        let xz = half_wedges(token, a, x, z, taken(&mut memory, nx * nz));
        let yz = half_wedges(token, a, y, z, taken(&mut memory, ny * nz));
        let (mut lower, mut upper) = (taken(&mut memory, nx * ny), taken(&mut memory, nx * ny));
        let sums = taken(&mut memory, nx + WHOLE);
        let fractions = taken(&mut memory, nx);
        let (zero, one, limit) = (all(0.0), all(1.0), all(r2));
        for plane in 0..=z.cells {
            std::mem::swap(&mut lower, &mut upper);
            volumes(token, a, [x, y, z], [xy, xz, yz], plane, upper);
            let Some(k) = plane.checked_sub(1) else { continue };
            for j in 0..y.cells {
                let (near, far) = (y.near2[j] + z.near2[k], y.far2[j] + z.far2[k]);
                if near >= r2 {
                    continue;
                }
                let s0 = all(y.signs[j] * z.signs[k]);
                let s1 = all(-y.signs[j + 1] * z.signs[k]);
                let s2 = all(-y.signs[j] * z.signs[k + 1]);
                let s3 = all(y.signs[j + 1] * z.signs[k + 1]);
                let (at, next) = (j * nx..(j + 1) * nx, (j + 1) * nx..(j + 2) * nx);
                let v0 = split::<S>(&lower[at.clone()]);
                let v1 = split::<S>(&lower[next.clone()]);
                let (v2, v3) = (split::<S>(&upper[at]), split::<S>(&upper[next]));
                let ends = Doubles::<S>::split_mut(&mut sums[..nx]).0.iter_mut();
                let volumes = v0.iter().zip(v1).zip(v2.iter().zip(v3));
                for ((to, sign), ((v0, v1), (v2, v3))) in ends.zip(split::<S>(x.signs)).zip(volumes)
                {
                    let sign = Doubles::<S>::load(token, *sign);
                    let (v0, v1) = (Doubles::load(token, *v0), Doubles::load(token, *v1));
                    let (v2, v3) = (Doubles::load(token, *v2), Doubles::load(token, *v3));
                    *to = (sign * ((s0 * v0 + s1 * v1) + (s2 * v2 + s3 * v3))).raw();
                }
                let (near, far) = (all(near), all(far));
                let ends = split::<S>(&sums[..nx]).iter().zip(split::<S>(&sums[1..=nx]));
                let distances = split::<S>(x.near2).iter().zip(split::<S>(x.far2));
                let to = Doubles::<S>::split_mut(fractions).0;
                for ((to, (start, end)), (x_near, x_far)) in to.iter_mut().zip(ends).zip(distances)
                {
                    let (start, end) =
                        (Doubles::<S>::load(token, *start), Doubles::load(token, *end));
                    let (x_near, x_far) =
                        (Doubles::<S>::load(token, *x_near), Doubles::load(token, *x_far));
                    let cut = (end - start).max(zero).min(one);
                    let touched = (x_far + far).at_most(limit, one, cut);
                    *to = limit.at_most(x_near + near, zero, touched).raw();
                }
                let of_row = &fractions[..x.cells];
                let Some(start) = of_row.iter().position(|fraction| *fraction > 0.0) else {
                    continue;
                };
                let touched = &of_row[start..];
                let count = touched.iter().take_while(|fraction| **fraction > 0.0).count();
                let at = [x.first + start as i64, y.first + j as i64, z.first + k as i64];
                (self.tell)(at, &touched[..count]);
            }
        }
    }
}

/// What a ball of radius `a` shares with the boxes between its centre and the nodes of a plane.
#[inline(always)]
fn volumes<S: Simd>(
    token: S,
    a: f64,
    [x, y, z]: [&Nodes<'_>; 3],
    [xy, xz, yz]: [&[f64]; 3],
    k: usize,
    volumes: &mut [f64],
) {
    let all = |value: f64| Doubles::<S>::splat(token, value);
    let (nx, ny) = (x.at.len(), y.at.len());
    let (eighth, limit) = (PI * a * a * a / 6.0, all(a * a));
    for j in 0..=y.cells {
        let across = all(y.at[j] * y.at[j] + z.at[k] * z.at[k]);
        let side = all(y.at[j] * z.at[k]);
        let beyond = all(eighth - (y.caps[j] + z.caps[k]) + yz[k * ny + j]);
        let vectors = split::<S>(x.at).iter().zip(split::<S>(x.caps));
        let wedges = split::<S>(&xy[j * nx..][..nx]).iter().zip(split::<S>(&xz[k * nx..][..nx]));
        let to = Doubles::<S>::split_mut(&mut volumes[j * nx..][..nx]).0.iter_mut();
        for ((to, (x, cap)), (in_xy, in_xz)) in to.zip(vectors).zip(wedges) {
            let (x, cap) = (Doubles::<S>::load(token, *x), Doubles::load(token, *cap));
            let (in_xy, in_xz) = (Doubles::load(token, *in_xy), Doubles::load(token, *in_xz));
            let cut = (beyond - cap) + (in_xy + in_xz);
            *to = x.mul_add(x, across).at_most(limit, x * side, cut).raw();
        }
    }
}

/// As many numbers as the longest vector has: tables of nodes are filled up to whole ones.
const WHOLE: usize = 8;

/// Corners of these cells along an axis, filled up.
fn nodes(cells: &RangeInclusive<i64>) -> usize {
    let count = usize::try_from(cells.end() - cells.start() + 2).unwrap_or_default();
    count.next_multiple_of(WHOLE)
}

/// The first `count` of what is left.
fn taken<'a>(memory: &mut &'a mut [f64], count: usize) -> &'a mut [f64] {
    let (taken, left) = std::mem::take(memory).split_at_mut(count);
    *memory = left;
    taken
}

/// Whole vectors.
#[inline(always)]
fn split<S: Simd>(values: &[f64]) -> &[<Doubles<S> as Lanes>::Raw] {
    Doubles::<S>::split(values).0
}

/// Corners of cells along one axis.
struct Nodes<'a> {
    /// The lowest.
    first: i64,
    /// How many cells: one less than corners. The tables are longer.
    cells: usize,
    /// Their distances from the centre, at most the radius, and on which side they lie.
    at: &'a [f64],
    signs: &'a [f64],
    /// Squares of the distances of the nearest and the farthest point of each cell from the centre.
    near2: &'a [f64],
    far2: &'a [f64],
    /// What of an eighth of the ball lies beyond them.
    caps: &'a [f64],
    /// Half the chord of the ball there: `√(a² - x²)`
    chords: &'a [f64],
}

impl<'a> Nodes<'a> {
    const TABLES: usize = 6;

    #[inline(always)]
    fn along<S: Simd>(
        token: S,
        centre: f64,
        radius: f64,
        cells: &RangeInclusive<i64>,
        tables: &'a mut [f64],
    ) -> Self {
        let all = |value: f64| Doubles::<S>::splat(token, value);
        let count = tables.len() / Self::TABLES;
        let mut rest = tables;
        let mut table = || taken(&mut rest, count);
        let (at, signs, near2) = (table(), table(), table());
        let (far2, caps, chords) = (table(), table(), table());
        let first = *cells.start();
        for (number, offset) in at.iter_mut().enumerate() {
            *offset = (first + number as i64) as f64 - centre;
        }
        let (zero, one, twelfth) = (all(0.0), all(1.0), all(PI / 12.0));
        let (a, a2, two_a) = (all(radius), all(radius * radius), all(2.0 * radius));
        for i in (0..count).step_by(Doubles::<S>::COUNT) {
            let low = Doubles::<S>::load_some(token, &at[i..]);
            let high = low + one;
            let x = low.max(-low).min(a);
            x.store_some(&mut at[i..]);
            low.at_most(zero, -one, one).store_some(&mut signs[i..]);
            let (nearest, farthest) = (low.max(-high).max(zero), high.max(-low));
            (nearest * nearest).store_some(&mut near2[i..]);
            (farthest * farthest).store_some(&mut far2[i..]);
            // Of an eighth of the ball: V = π/12 (a - x)² (2a + x)
            (twelfth * (a - x) * (a - x) * (two_a + x)).store_some(&mut caps[i..]);
            (a2 - x * x).sqrt().store_some(&mut chords[i..]);
        }
        let cells = usize::try_from(cells.end() - first + 1).unwrap_or_default();
        Nodes { first, cells, at, signs, near2, far2, caps, chords }
    }
}

/// `half_wedge` of `exact.rs` at the nodes of two axes, those of the first fastest.
#[inline(always)]
fn half_wedges<'a, S: Simd>(
    token: S,
    radius: f64,
    of_x: &Nodes<'_>,
    of_y: &Nodes<'_>,
    wedges: &'a mut [f64],
) -> &'a [f64] {
    let all = |value: f64| Doubles::<S>::splat(token, value);
    let a = radius;
    let (zero, third, sixth) = (all(0.0), all(1.0 / 3.0), all(1.0 / 6.0));
    let (a1, a2, three_a2, a3) = (all(a), all(a * a), all(3.0 * a * a), all(a * a * a / 3.0));
    let rows = wedges.chunks_exact_mut(of_x.at.len());
    for ((row, &y), &y_chord) in rows.zip(of_y.at).zip(of_y.chords).take(of_y.cells + 1) {
        let (y, y_chord) = (all(y), all(y_chord));
        let columns = split::<S>(of_x.at).iter().zip(split::<S>(of_x.chords));
        for (to, (x, x_chord)) in Doubles::<S>::split_mut(row).0.iter_mut().zip(columns) {
            let (x, x_chord) = (Doubles::load(token, *x), Doubles::load(token, *x_chord));
            let s = (a2 - x * x - y * y).max(zero).sqrt();
            // The angles of atan2(s, y), atan2(s, x) and atan2(a s, x y): the third sides of their triangles are
            // chords and, of the last, the product of the two.
            let of_y = angle(token, s, y + x_chord);
            let of_x = angle(token, s, x + y_chord);
            let of_both = angle(token, a1 * s, x.mul_add(y, x_chord * y_chord));
            let x_part = x * (three_a2 - x * x) * sixth * of_y;
            let y_part = y * (three_a2 - y * y) * sixth * of_x;
            *to = (x * y * s * third - x_part - y_part + a3 * of_both).raw();
        }
    }
    wedges
}

/// The angle between hypotenuse and adjacent side of a right-angled triangle, 0 to π/2, from its opposite side and the
/// sum of adjacent side and hypotenuse, which is not 0 unless both are.
#[inline(always)]
fn angle<S: Simd>(token: S, opposite: Doubles<S>, others: Doubles<S>) -> Doubles<S> {
    let all = |value: f64| Doubles::<S>::splat(token, value);
    // The tangent of half the angle is opposite/others; that of a quarter of it, t/(1 + √(1 + t²)), is at most √2 - 1.
    let hypotenuse = opposite.mul_add(opposite, others * others).sqrt();
    let quarter = opposite.over((others + hypotenuse).max(all(f64::MIN_POSITIVE)));
    let square = quarter * quarter;
    let (above, below) = (polynomial(token, &ATAN.0, square), polynomial(token, &ATAN.1, square));
    all(4.0) * quarter * above.over(below)
}

/// The polynomial with these coefficients, that of the lowest power first.
#[inline(always)]
fn polynomial<S: Simd, const N: usize>(token: S, of: &[f64; N], x: Doubles<S>) -> Doubles<S> {
    let mut sum = Doubles::splat(token, of[N - 1]);
    for power in (0..N - 1).rev() {
        sum = sum.mul_add(x, Doubles::splat(token, of[power]));
    }
    sum
}

/// `atan t / t` up to `t` = √2 - 1 as a fraction of two polynomials in `t²`: Gauss's continued fraction
/// `1/(1 + t²/(3 + 4t²/(5 + 9t²/(7 + ...))))` (Abramowitz & Stegun, Handbook of Mathematical Functions, 4.4.43) down to
/// the 12th term, `121 t²/23`, multiplied out. What is left off is 2.3e-17 of it.
const ATAN: ([f64; 6], [f64; 7]) = (
    [2342475135.0, 5941060125.0, 5429886462.0, 2146898754.0, 341536195.0, 14928225.0],
    [2342475135.0, 6721885170.0, 7202019825.0, 3537834300.0, 780404625.0, 62432370.0, 800415.0],
);
