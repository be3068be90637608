//! What enters through a face across x, row by row.

use std::ops::Range;

use super::region::Region;
use super::rule::Rule;

/// What enters along one direction through a face across x alone.
#[derive(Clone, Debug)]
pub(super) struct Column {
    pub(super) direction: usize,
    /// The cell of a row that it enters, and the rows.
    pub(super) at: usize,
    pub(super) low: [usize; 2],
    pub(super) high: [usize; 2],
    pub(super) rule: Rule,
    /// The cell of a row that it comes from, and how many rows on from the row that it enters.
    pub(super) from: usize,
    pub(super) rows_on: isize,
}

impl Column {
    pub(super) fn new<T>([nx, ..]: [usize; 3], region: Region<T>) -> Self {
        let Region { direction, low, high, rule, .. } = region;
        let (at, nx) = (low[0], nx as isize);
        // The cell that it comes from, counted from the first of the row that it enters.
        let from = at as isize + rule.shift();
        Column {
            direction,
            at,
            low: [low[1], low[2]],
            high: [high[1], high[2]],
            rule,
            from: from.rem_euclid(nx).unsigned_abs(),
            rows_on: from.div_euclid(nx),
        }
    }

    /// Calls `visit` for each stretch of rows among `rows` that it enters.
    pub(super) fn for_rows(
        &self,
        ny: usize,
        rows: Range<usize>,
        mut visit: impl FnMut(Range<usize>),
    ) {
        if rows.is_empty() {
            return;
        }
        let planes = rows.start / ny..(rows.end - 1) / ny + 1;
        for z in planes.start.max(self.low[1])..planes.end.min(self.high[1]) {
            let low = (z * ny + self.low[0]).max(rows.start);
            let high = (z * ny + self.high[0]).min(rows.end);
            if low < high {
                visit(low..high);
            }
        }
    }

    /// The row that what enters a row comes from.
    pub(super) fn source_row(&self, row: usize) -> usize {
        row.wrapping_add_signed(self.rows_on)
    }
}
