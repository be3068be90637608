//! Solid fraction of a sphere in a cell, linear in the distance of their centres:
//! `clamp(a - 1/(12 a) + 1/2 - d, 0, 1)`, as in `reference/src/coverage/linear.rs`, where the source stands.

use std::ops::{Range, RangeInclusive};

use pulp::{Arch, Simd, WithSimd};

use crate::lanes::{Doubles, Lanes};

/// As [`super::rows_of_fractions`].
pub(super) fn rows(
    centre: [f64; 3],
    radius: f64,
    cells: &[RangeInclusive<i64>; 3],
    tell: impl FnMut([i64; 3], &[f64]),
) {
    let reach = radius - 1.0 / (12.0 * radius) + 0.5;
    let offsets = [0, 1, 2].map(|axis| {
        let offset = |x: i64| x as f64 + 0.5 - centre[axis];
        cells[axis].clone().map(offset).collect()
    });
    let first = cells.each_ref().map(|range| *range.start());
    Arch::new().dispatch(Rows { reach, offsets, first, tell });
}

/// The rows of a ball.
struct Rows<F> {
    /// The distance at which the fraction has fallen to nothing.
    reach: f64,
    /// From the ball's centre to those of the cells, along each axis, and the first cell.
    offsets: [Vec<f64>; 3],
    first: [i64; 3],
    tell: F,
}

impl<F: FnMut([i64; 3], &[f64])> WithSimd for Rows<F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, token: S) {
        let [xs, ys, zs] = &self.offsets;
        let mut fractions = vec![0.0; xs.len()];
        for (k, z) in zs.iter().enumerate() {
            for (j, y) in ys.iter().enumerate() {
                let across = y * y + z * z;
                let cells = within(xs, self.reach * self.reach - across);
                if cells.is_empty() {
                    continue;
                }
                let fractions = &mut fractions[..cells.len()];
                row(token, self.reach, across, &xs[cells.clone()], fractions);
                let [x0, y0, z0] = self.first;
                (self.tell)([x0 + cells.start as i64, y0 + j as i64, z0 + k as i64], fractions);
            }
        }
    }
}

/// Those of evenly spaced numbers whose squares are below `limit`.
#[inline(always)]
fn within(numbers: &[f64], limit: f64) -> Range<usize> {
    let is_out = |x: &&f64| **x * **x >= limit;
    let start = numbers.iter().take_while(is_out).count();
    let end = numbers.len() - numbers.iter().rev().take_while(is_out).count();
    start..end.max(start)
}

/// The fractions of cells at `xs` along a row whose distance from the centre, squared, is `across`.
#[inline(always)]
fn row<S: Simd>(token: S, reach: f64, across: f64, xs: &[f64], fractions: &mut [f64]) {
    let all = |value: f64| Doubles::<S>::splat(token, value);
    let [reach, across, nothing, one] = [reach, across, 0.0, 1.0].map(all);
    let fraction = |x: Doubles<S>| (reach - x.mul_add(x, across).sqrt()).max(nothing).min(one);
    let (bodies, tail) = Doubles::<S>::split(xs);
    let (to, to_tail) = Doubles::<S>::split_mut(fractions);
    for (x, to) in bodies.iter().zip(to) {
        *to = fraction(Doubles::load(token, *x)).raw();
    }
    if !tail.is_empty() {
        fraction(Doubles::load_some(token, tail)).store_some(to_tail);
    }
}
