//! The faces of the domain: the populations that enter through them.
//!
//! Which rule a link obeys depends on its direction and on the faces that it crosses. The links of one direction that
//! cross the same faces start from the cells of a box: on a face, along an edge or in a corner. Each such box is a
//! [`region::Region`]; after a collision all are filled, and before the next what they hold is put in its place, by the
//! thread that collides the cells.
//!
//! A face across x has one cell of each row: what enters there is worked out row by row, by the thread that has just
//! collided the row, while its populations are still in the cache. It is a matter of the row that it comes from, so
//! it is kept by that row ([`column::Column`]); the row that it enters is one of the eight about it, or the same.

//!
//! | file | what it does |
//! |---|---|
//! | `rule.rs` | by which rule a population enters |
//! | `region.rs` | the box of cells that are entered along one direction through the same faces |
//! | `column.rs` | the same for a face across x |
//! | `states.rs` | the faces, their cells, and density and velocity there |

mod column;
mod region;
mod rule;
mod states;

use psmrt_reference::directions::{OPPOSITE, Q};
use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;
use rayon::prelude::*;

use self::column::Column;
use self::region::{Region, copy, regions_of};
use self::rule::{Rule, SlowMeans};
use self::states::{FaceStates, Near, Side, cells_at, non_reflecting};
use super::grid::Grid;
use crate::lanes::Real;

/// Below this many cells a step is over before a second thread has woken up.
const SERIAL_CELLS: usize = 40_000;

/// What the columns hold for each row that it comes from.
type Values<T> = Vec<Vec<T>>;

/// What enters through the six faces.
#[derive(Clone, Debug)]
pub(in crate::cpu) struct Entering<T> {
    cells: [usize; 3],
    columns: Vec<Column>,
    /// What enters before the next collision, and after it.
    now: Values<T>,
    next: Values<T>,
    /// The regions of each direction, but for those of the columns.
    regions: [Vec<Region<T>>; Q],
    /// Whether they hold what enters next.
    is_filled: bool,
    slow_means: Vec<SlowMeans>,
}

impl<T: Real> Entering<T> {
    /// The regions of a domain, empty. The slow means start from the velocities of `grid`.
    pub(in crate::cpu) fn new(domain: &Domain, grid: &Grid<T>) -> Self {
        let (mut regions, mut columns) = (std::array::from_fn(|_| Vec::new()), Vec::new());
        for a in 0..Q {
            for (crossed, region) in regions_of(domain, grid, a) {
                if crossed == [0] {
                    columns.push(Column::new(domain.cells(), region));
                } else {
                    regions[a].push(region);
                }
            }
        }
        let rows = domain.cells()[1] * domain.cells()[2];
        let values = vec![vec![T::default(); rows]; columns.len()];
        let slow_means = non_reflecting(domain)
            .map(|(face, _)| {
                let outward =
                    |cell: usize| Near::of(|a| grid.before(a)[cell].to_f64()).outward(face);
                SlowMeans { face, values: cells_at(domain, face).map(outward).collect() }
            })
            .collect();
        Entering {
            cells: domain.cells(),
            columns,
            next: values.clone(),
            now: values,
            regions,
            is_filled: false,
            slow_means,
        }
    }

    /// The slow means, face by face in the order -x, +x, -y, ...
    pub(in crate::cpu) fn slow_means(&self) -> impl Iterator<Item = &f64> {
        self.slow_means.iter().flat_map(|face| &face.values)
    }

    /// The same, to be replaced.
    pub(in crate::cpu) fn slow_means_mut(&mut self) -> impl Iterator<Item = &mut f64> {
        self.slow_means.iter_mut().flat_map(|face| &mut face.values)
    }

    /// What the regions hold is of no use any more: all populations have been replaced.
    pub(in crate::cpu) fn forget(&mut self) {
        self.is_filled = false;
    }

    /// Where the threads that collide runs of `rows` rows leave what enters the columns next, and what they need for it.
    pub(in crate::cpu) fn split(
        &mut self,
        rows: usize,
    ) -> (EnteringNow<'_, T>, Vec<Vec<&mut [T]>>) {
        let Entering { cells, columns, now, next, regions, is_filled, slow_means } = self;
        let now =
            EnteringNow { cells: *cells, columns, now, regions, is_filled: *is_filled, slow_means };
        let count = (cells[1] * cells[2]).div_ceil(rows);
        let mut runs: Vec<_> = (0..count).map(|_| Vec::with_capacity(next.len())).collect();
        for values in next {
            for (run, values) in runs.iter_mut().zip(values.chunks_mut(rows)) {
                run.push(values);
            }
        }
        (now, runs)
    }

    /// What enters before the next collision.
    pub(in crate::cpu) fn now(&self) -> EnteringNow<'_, T> {
        let Entering { cells, columns, now, regions, is_filled, slow_means, .. } = self;
        EnteringNow { cells: *cells, columns, now, regions, is_filled: *is_filled, slow_means }
    }

    /// Works out what enters after a collision, but for the columns, which have been.
    pub(in crate::cpu) fn fill(&mut self, domain: &Domain, grid: &Grid<T>) {
        let slow_means = &self.slow_means;
        let states = &face_states(domain, grid, self.regions.iter().flatten());
        let fill = |regions: &mut Vec<Region<T>>| {
            for region in regions {
                region.fill(domain, grid, slow_means, states);
            }
        };
        if domain.cell_count() < SERIAL_CELLS {
            self.regions.iter_mut().for_each(fill);
        } else {
            self.regions.par_iter_mut().for_each(fill);
        }
        std::mem::swap(&mut self.now, &mut self.next);
        self.is_filled = true;
        let mut memories = non_reflecting(domain).map(|(_, memory)| memory);
        for means in &mut self.slow_means {
            let memory = memories.next().unwrap_or(f64::INFINITY);
            let face = means.face;
            for (m, cell) in means.values.iter_mut().zip(cells_at(domain, face)) {
                let u_n = Near::of(|a| grid.after(a)[cell].to_f64()).outward(face);
                // m(t+1) = m(t) + (u_n(t) - m(t))/T
                *m += (u_n - *m) / memory;
            }
        }
    }
}

/// What enters before the next collision.
#[derive(Clone, Copy)]
pub(in crate::cpu) struct EnteringNow<'a, T> {
    cells: [usize; 3],
    columns: &'a [Column],
    now: &'a Values<T>,
    regions: &'a [Vec<Region<T>>; Q],
    is_filled: bool,
    slow_means: &'a [SlowMeans],
}

impl<T: Real> EnteringNow<'_, T> {
    /// Puts what enters a run of whole rows, the first of which has the number `first_row`, in its place.
    pub(in crate::cpu) fn put(&self, first_row: usize, run: &mut [&mut [T]; Q]) {
        if !self.is_filled {
            return;
        }
        let nx = self.cells[0];
        let rows = first_row..first_row + run[0].len() / nx;
        for (column, values) in self.columns.iter().zip(self.now) {
            let to = &mut *run[column.direction];
            column.for_rows(self.cells[1], rows.clone(), |rows| {
                let from = &values[column.source_row(rows.start)..][..rows.len()];
                let to = &mut to[(rows.start - first_row) * nx..(rows.end - first_row) * nx];
                for (to, value) in to[column.at..].iter_mut().step_by(nx).zip(from) {
                    *to = *value;
                }
            });
        }
        for (a, regions) in self.regions.iter().enumerate() {
            for region in regions {
                region.for_rows(self.cells, rows.clone(), |row, values| {
                    let at = (row - first_row) * nx + region.low[0];
                    copy(values, &mut run[a][at..at + values.len()]);
                });
            }
        }
    }

    /// Works out what enters the columns from a run that has been collided: where `f_a` was, there is now `f*_-a`.
    pub(in crate::cpu) fn take(
        &self,
        domain: &Domain,
        first_row: usize,
        run: &[&mut [T]; Q],
        next: &mut [&mut [T]],
    ) {
        let nx = self.cells[0];
        // The states of the outermost cells of each row, which several columns may ask for.
        let asked = |at: usize| {
            let mut columns = self.columns.iter().filter(|column| column.from == at);
            columns.any(|column| column.rule.asks_for_state(domain))
        };
        let states = [0, nx - 1].map(|at| {
            let rows = if asked(at) { run[0].len() / nx } else { 0 };
            let state = |row: usize| Near::of(|a| run[OPPOSITE[a]][at + row * nx].to_f64());
            (at, (0..rows).map(state).collect::<Vec<Near>>())
        });
        let unasked = Near { excess: 0.0, velocity: Vec3::zeros() };
        for (column, values) in self.columns.iter().zip(next) {
            if let Some(direction) = column.rule.copied(domain, column.direction) {
                let from = run[OPPOSITE[direction]][column.from..].iter().step_by(nx);
                values.iter_mut().zip(from).for_each(|(value, from)| *value = *from);
                continue;
            }
            let states = states.iter().find(|(at, _)| *at == column.from).map(|(_, states)| states);
            for (row, value) in values.iter_mut().enumerate() {
                let cell = column.from + row * nx;
                let near = states.and_then(|states| states.get(row)).unwrap_or(&unasked);
                let here = |a: usize| run[OPPOSITE[a]][cell];
                let (a, place) = (column.direction, first_row * nx + cell);
                *value = column.rule.enters(domain, self.slow_means, a, place, here, near);
            }
        }
    }

    /// `f_a` that enters a cell, if its link along `a` comes from outside.
    pub(in crate::cpu) fn value(&self, a: usize, cell: [usize; 3]) -> Option<T> {
        if !self.is_filled {
            return None;
        }
        let [x, y, z] = cell;
        let is_column = |column: &Column| {
            let is_row = (column.low[0]..column.high[0]).contains(&y)
                && (column.low[1]..column.high[1]).contains(&z);
            column.direction == a && column.at == x && is_row
        };
        if let Some(number) = self.columns.iter().position(is_column) {
            let row = self.columns[number].source_row(y + self.cells[1] * z);
            return Some(self.now[number][row]);
        }
        let is_in = |region: &&Region<T>| {
            (0..3).all(|axis| (region.low[axis]..region.high[axis]).contains(&cell[axis]))
        };
        let Region { low, high, values, .. } = self.regions[a].iter().find(is_in)?;
        let [x, y, z] = std::array::from_fn(|axis| cell[axis] - low[axis]);
        let [width, height] = [0, 1].map(|axis| high[axis] - low[axis]);
        Some(values[x + width * (y + height * z)])
    }
}

/// Those at the faces about which `regions` ask.
fn face_states<'a, T: Real>(
    domain: &Domain,
    grid: &Grid<T>,
    regions: impl Iterator<Item = &'a Region<T>>,
) -> Vec<FaceStates> {
    let mut faces: Vec<Side> = Vec::new();
    for region in regions.filter(|region| region.rule.asks_for_state(domain)) {
        let of_rule = match &region.rule {
            Rule::Copy { .. } => &[][..],
            Rule::AntiBounceBack { face } => std::slice::from_ref(face),
            Rule::BounceBack { faces } | Rule::CarriedOver { faces, .. } => faces,
        };
        // The cell that it comes from lies at all of them.
        faces.extend(of_rule.iter().max().filter(|face| !faces.contains(face)).copied().as_slice());
    }
    let states = |&face: &Side| {
        let cells: Vec<usize> = cells_at(domain, face).collect();
        let near = |&cell: &usize| Near::of(|a| grid.after(a)[cell].to_f64());
        FaceStates {
            face,
            near: cells.par_iter().with_min_len(SERIAL_CELLS / 8).map(near).collect(),
        }
    };
    faces.iter().map(states).collect()
}
