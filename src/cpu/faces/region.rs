//! What enters along one direction through the same faces: a box of cells on a face, along an edge or in a corner.

use std::ops::Range;

use psmrt_reference::directions::C;
use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;

use super::rule::{Rule, SlowMeans, rule};
use super::states::{FaceStates, Near};
use crate::cpu::grid::Grid;
use crate::lanes::Real;

/// What enters along one direction through the same faces: a value for each cell of a box, x fastest.
#[derive(Clone, Debug)]
pub(super) struct Region<T> {
    pub(super) direction: usize,
    pub(super) low: [usize; 3],
    pub(super) high: [usize; 3],
    pub(super) rule: Rule,
    pub(super) values: Vec<T>,
}

impl<T: Real> Region<T> {
    /// Calls `visit(row, values)` for each of its rows among `rows`.
    pub(super) fn for_rows(
        &self,
        [_, ny, _]: [usize; 3],
        rows: Range<usize>,
        mut visit: impl FnMut(usize, &[T]),
    ) {
        if rows.is_empty() {
            return;
        }
        let [width, height] = [0, 1].map(|axis| self.high[axis] - self.low[axis]);
        let (first, last) = (rows.start / ny, (rows.end - 1) / ny);
        for z in self.low[2].max(first)..self.high[2].min(last + 1) {
            let low = self.low[1].max(rows.start.saturating_sub(z * ny));
            let high = self.high[1].min(rows.end - z * ny);
            for y in low..high {
                let at = width * ((y - self.low[1]) + height * (z - self.low[2]));
                visit(y + ny * z, &self.values[at..at + width]);
            }
        }
    }

    pub(super) fn fill(
        &mut self,
        domain: &Domain,
        grid: &Grid<T>,
        slow_means: &[SlowMeans],
        states: &[FaceStates],
    ) {
        let unasked = Near { excess: 0.0, velocity: Vec3::zeros() };
        let Region { direction, low, high, rule, values } = self;
        let (a, [nx, ny, _]) = (*direction, domain.cells());
        let width = high[0] - low[0];
        let copied = rule.copied(domain, a);
        let mut rows = values.chunks_mut(width.max(1));
        for z in low[2]..high[2] {
            for y in low[1]..high[1] {
                let Some(row) = rows.next() else { return };
                let first = low[0] + nx * (y + ny * z);
                let from = first.wrapping_add_signed(rule.shift());
                if let Some(direction) = copied {
                    copy(&grid.after(direction)[from..from + width], row);
                    continue;
                }
                for (x, value) in row.iter_mut().enumerate() {
                    let cell = from + x;
                    let after = |b: usize| grid.after(b)[cell];
                    let near = states.iter().find_map(|states| states.of(domain, cell));
                    *value =
                        rule.enters(domain, slow_means, a, cell, after, near.unwrap_or(&unasked));
                }
            }
        }
    }
}

/// Copies a row. At edges along y and z rows have a single cell, for which a call takes longer than the copy.
#[inline]
pub(super) fn copy<T: Copy>(from: &[T], to: &mut [T]) {
    match (from, to) {
        ([from], [to]) => *to = *from,
        (from, to) => to.copy_from_slice(from),
    }
}

/// The regions of direction `a`: for each choice of the axes along which it comes from outside.
pub(super) fn regions_of<T: Real>(
    domain: &Domain,
    grid: &Grid<T>,
    a: usize,
) -> Vec<(Vec<usize>, Region<T>)> {
    let cells = domain.cells();
    let axes: Vec<usize> = (0..3).filter(|&axis| C[a][axis] != 0).collect();
    let mut regions = Vec::new();
    for choice in 1..1_usize << axes.len() {
        let crossed: Vec<usize> = axes
            .iter()
            .enumerate()
            .filter(|(bit, _)| choice >> bit & 1 == 1)
            .map(|(_, &axis)| axis)
            .collect();
        let (mut low, mut high) = ([0; 3], cells);
        for &axis in &axes {
            let (n, enters_low) = (cells[axis], C[a][axis] > 0);
            (low[axis], high[axis]) = match (crossed.contains(&axis), enters_low) {
                (true, true) => (0, 1),
                (true, false) => (n - 1, n),
                (false, true) => (1, n),
                (false, false) => (0, n - 1),
            };
        }
        let count = (0..3).map(|axis| high[axis] - low[axis]).product();
        if count > 0 {
            let rule = rule(domain, grid, a, &crossed);
            // A column has its values elsewhere.
            let values = vec![T::default(); if crossed == [0] { 0 } else { count }];
            regions.push((crossed, Region { direction: a, low, high, rule, values }));
        }
    }
    regions
}
