//! The faces of the domain: the populations that enter through them.
//!
//! Which rule a link obeys depends on its direction and on the faces that it crosses. The links of one direction that
//! cross the same faces start from the cells of a box: on a face, along an edge or in a corner. Each such box is a
//! [`Region`]; after a collision all are filled, and before the next what they hold is put in its place, by the
//! thread that collides the cells.
//!
//! A face across x has one cell of each row: what enters there is worked out row by row, by the thread that has just
//! collided the row, while its populations are still in the cache. It is a matter of the row that it comes from, so
//! it is kept by that row ([`Column`]); the row that it enters is one of the eight about it, or the same.

use std::ops::Range;

use psmrt_reference::directions::{C, OPPOSITE, Q, number_of};
use psmrt_reference::domain::{Domain, Face};
use psmrt_reference::lattice::Vec3;
use rayon::prelude::*;

use super::collision::weight;
use super::grid::Grid;
use crate::lanes::Real;

/// Below this many cells a step is over before a second thread has woken up.
const SERIAL_CELLS: usize = 40_000;

/// Axis (0 to 2) and side (0: low, 1: high) of a face.
type Side = (usize, usize);

/// What enters along one direction through the same faces: a value for each cell of a box, x fastest.
#[derive(Clone, Debug)]
struct Region<T> {
    direction: usize,
    low: [usize; 3],
    high: [usize; 3],
    rule: Rule,
    values: Vec<T>,
}

/// Where what enters a cell comes from. `shift` leads from the cell to the one whose populations are looked at.
#[derive(Clone, Debug)]
enum Rule {
    /// `f*` of another direction or cell: periodic faces, mirrors, free outflow.
    Copy { direction: usize, shift: isize },
    /// Half-way bounce-back with the sum of the velocities at these faces.
    BounceBack { faces: Vec<Side> },
    /// Anti-bounce-back at the density of this face.
    AntiBounceBack { face: Side },
    /// Non-equilibrium extrapolation at the mean density of these faces.
    CarriedOver { direction: usize, shift: isize, faces: Vec<Side> },
}

/// What enters along one direction through a face across x alone.
#[derive(Clone, Debug)]
struct Column {
    direction: usize,
    /// The cell of a row that it enters, and the rows.
    at: usize,
    low: [usize; 2],
    high: [usize; 2],
    rule: Rule,
    /// The cell of a row that it comes from, and how many rows on from the row that it enters.
    from: usize,
    rows_on: isize,
}

/// What the columns hold for each row that it comes from.
type Values<T> = Vec<Vec<T>>;

/// What enters through the six faces.
#[derive(Clone, Debug)]
pub(super) struct Entering<T> {
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

/// The slow mean of the outward velocity in each cell at a non-reflecting face, x before y before z.
#[derive(Clone, Debug)]
struct SlowMeans {
    face: Side,
    values: Vec<f64>,
}

impl<T: Real> Entering<T> {
    /// The regions of a domain, empty. The slow means start from the velocities of `grid`.
    pub(super) fn new(domain: &Domain, grid: &Grid<T>) -> Self {
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
    pub(super) fn slow_means(&self) -> impl Iterator<Item = &f64> {
        self.slow_means.iter().flat_map(|face| &face.values)
    }

    /// The same, to be replaced.
    pub(super) fn slow_means_mut(&mut self) -> impl Iterator<Item = &mut f64> {
        self.slow_means.iter_mut().flat_map(|face| &mut face.values)
    }

    /// What the regions hold is of no use any more: all populations have been replaced.
    pub(super) fn forget(&mut self) {
        self.is_filled = false;
    }

    /// Where the threads that collide runs of `rows` rows leave what enters the columns next, and what they need for it.
    pub(super) fn split(&mut self, rows: usize) -> (EnteringNow<'_, T>, Vec<Vec<&mut [T]>>) {
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
    pub(super) fn now(&self) -> EnteringNow<'_, T> {
        let Entering { cells, columns, now, regions, is_filled, slow_means, .. } = self;
        EnteringNow { cells: *cells, columns, now, regions, is_filled: *is_filled, slow_means }
    }

    /// Works out what enters after a collision, but for the columns, which have been.
    pub(super) fn fill(&mut self, domain: &Domain, grid: &Grid<T>) {
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
pub(super) struct EnteringNow<'a, T> {
    cells: [usize; 3],
    columns: &'a [Column],
    now: &'a Values<T>,
    regions: &'a [Vec<Region<T>>; Q],
    is_filled: bool,
    slow_means: &'a [SlowMeans],
}

impl<T: Real> EnteringNow<'_, T> {
    /// Puts what enters a run of whole rows, the first of which has the number `first_row`, in its place.
    pub(super) fn put(&self, first_row: usize, run: &mut [&mut [T]; Q]) {
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
    pub(super) fn take(
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
            if let Rule::Copy { direction, .. } = &column.rule {
                let from = run[OPPOSITE[*direction]][column.from..].iter().step_by(nx);
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
    pub(super) fn value(&self, a: usize, cell: [usize; 3]) -> Option<T> {
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

impl Column {
    fn new<T>([nx, ..]: [usize; 3], region: Region<T>) -> Self {
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
    fn for_rows(&self, ny: usize, rows: Range<usize>, mut visit: impl FnMut(Range<usize>)) {
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
    fn source_row(&self, row: usize) -> usize {
        row.wrapping_add_signed(self.rows_on)
    }
}

impl Rule {
    /// From the cell that is entered to the one whose populations are looked at.
    fn shift(&self) -> isize {
        match self {
            Rule::Copy { shift, .. } | Rule::CarriedOver { shift, .. } => *shift,
            Rule::BounceBack { .. } | Rule::AntiBounceBack { .. } => 0,
        }
    }

    /// Whether it asks for density and velocity of the cell that it comes from.
    fn asks_for_state(&self, domain: &Domain) -> bool {
        match self {
            Rule::Copy { .. } => false,
            Rule::BounceBack { faces } => {
                faces.iter().any(|&face| velocity_at(domain, face) != Vec3::zeros())
            }
            Rule::AntiBounceBack { .. } | Rule::CarriedOver { .. } => true,
        }
    }

    /// What enters along `a` from cell `from`, `f` and `near` being its populations and its state after the collision.
    fn enters<T: Real>(
        &self,
        domain: &Domain,
        slow_means: &[SlowMeans],
        a: usize,
        from: usize,
        f: impl Fn(usize) -> T,
        near: &Near,
    ) -> T {
        let back = f(OPPOSITE[a]);
        match self {
            Rule::Copy { direction, .. } => f(*direction),
            Rule::BounceBack { faces } => {
                let wall: Vec3 = faces.iter().map(|&face| velocity_at(domain, face)).sum();
                // f_a(x, t+1) = f*_-a(x, t) + 2 w_a ρ (c_a·u_w)/c_s²
                let gain = 6.0 * weight(a) * along(a, &wall);
                if gain == 0.0 {
                    return back;
                }
                T::from_f64(back.to_f64() + gain * (1.0 + near.excess))
            }
            Rule::AntiBounceBack { face } => {
                let rho_w = density_at(domain, *face);
                // f_a(x, t+1) = -f*_-a(x, t) + 2 w_a ρ_w [1 + 9/2 (c_a·u)² - 3/2 u²]
                let gain = (rho_w - 1.0) + rho_w * near.squares(a);
                T::from_f64(2.0 * weight(a) * gain - back.to_f64())
            }
            Rule::CarriedOver { direction: b, faces, .. } => {
                let excess =
                    faces.iter().map(|&face| face_excess(domain, face, slow_means, from, near));
                let excess = excess.sum::<f64>() / faces.len() as f64;
                // f_a(x, t+1) = f*_a(x') + f_a^eq(2 ρ_w - ρ', u') - f_a^eq(ρ', u')
                let gain = 2.0 * (excess - near.excess) * weight(*b) * near.equilibrium(*b);
                T::from_f64(f(*b).to_f64() + gain)
            }
        }
    }
}

impl<T: Real> Region<T> {
    /// Calls `visit(row, values)` for each of its rows among `rows`.
    fn for_rows(
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

    fn fill(
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
        let mut rows = values.chunks_mut(width.max(1));
        for z in low[2]..high[2] {
            for y in low[1]..high[1] {
                let Some(row) = rows.next() else { return };
                let first = low[0] + nx * (y + ny * z);
                let from = first.wrapping_add_signed(rule.shift());
                if let Rule::Copy { direction, .. } = rule {
                    copy(&grid.after(*direction)[from..from + width], row);
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
fn copy<T: Copy>(from: &[T], to: &mut [T]) {
    match (from, to) {
        ([from], [to]) => *to = *from,
        (from, to) => to.copy_from_slice(from),
    }
}

/// The regions of direction `a`: for each choice of the axes along which it comes from outside.
fn regions_of<T: Real>(domain: &Domain, grid: &Grid<T>, a: usize) -> Vec<(Vec<usize>, Region<T>)> {
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

/// The rule of the links of direction `a` that come from outside along the axes `crossed`: a wall or an inlet comes
/// before a face of given pressure, this before one that carries the flow over; the others wrap, mirror or clamp.
fn rule<T: Real>(domain: &Domain, grid: &Grid<T>, a: usize, crossed: &[usize]) -> Rule {
    let mut shift = -grid.stride(a);
    let mut direction = C[a];
    let (mut walls, mut pressure, mut carried) = (Vec::new(), None, Vec::new());
    for &axis in crossed {
        let c = C[a][axis];
        let face = (axis, usize::from(c < 0));
        let step = [1, domain.cells()[0], domain.cells()[0] * domain.cells()[1]][axis] as isize;
        let across = domain.cells()[axis] as isize * step;
        // Back to the cell's own coordinate, or to the far end of the axis.
        match face_at(domain, face) {
            Face::Periodic => shift += c as isize * across,
            other => {
                shift += c as isize * step;
                match other {
                    Face::FreeSlip => direction[axis] = -c,
                    Face::Wall { .. } | Face::VelocityInlet { .. } => walls.push(face),
                    Face::Pressure { .. } => pressure = Some(face),
                    Face::DevelopedPressure { .. } | Face::NonReflectingPressure { .. } => {
                        carried.push(face);
                    }
                    Face::FreeOutflow | Face::Periodic => {}
                }
            }
        }
    }
    let direction = number_of(direction);
    match (walls.is_empty(), pressure) {
        (false, _) => Rule::BounceBack { faces: walls },
        (true, Some(face)) => Rule::AntiBounceBack { face },
        (true, None) if carried.is_empty() => Rule::Copy { direction, shift },
        (true, None) => Rule::CarriedOver { direction, shift, faces: carried },
    }
}

fn face_at(domain: &Domain, (axis, side): Side) -> Face {
    domain.faces().axis(axis)[side]
}

fn velocity_at(domain: &Domain, face: Side) -> Vec3 {
    match face_at(domain, face) {
        Face::Wall { velocity } | Face::VelocityInlet { velocity } => velocity,
        _ => Vec3::zeros(),
    }
}

fn density_at(domain: &Domain, face: Side) -> f64 {
    face_at(domain, face).held_density().unwrap_or(1.0)
}

/// Density less 1 at a developed or non-reflecting face whose cell holds `near`.
fn face_excess(
    domain: &Domain,
    face: Side,
    slow_means: &[SlowMeans],
    cell: usize,
    near: &Near,
) -> f64 {
    let held = density_at(domain, face) - 1.0;
    match slow_means.iter().find(|means| means.face == face) {
        None => held,
        Some(means) => {
            let at = place_at(domain, face.0, domain.coordinates(cell));
            // ρ_w = ρ_0 + ρ/c_s (u_n - m)
            held + (1.0 + near.excess) * 3.0_f64.sqrt() * (near.outward(face) - means.values[at])
        }
    }
}

/// Density and velocity of the cells at a face after the collision, x before y before z.
struct FaceStates {
    face: Side,
    near: Vec<Near>,
}

impl FaceStates {
    /// Those of a cell, if it lies at the face.
    fn of(&self, domain: &Domain, cell: usize) -> Option<&Near> {
        let at = domain.coordinates(cell);
        let (axis, side) = self.face;
        let outermost = if side == 0 { 0 } else { domain.cells()[axis] - 1 };
        if at[axis] == outermost { self.near.get(place_at(domain, axis, at)) } else { None }
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

/// The number of a cell among those at a face across `axis`.
fn place_at(domain: &Domain, axis: usize, [x, y, z]: [usize; 3]) -> usize {
    let [nx, ny, _] = domain.cells();
    match axis {
        0 => y + ny * z,
        1 => x + nx * z,
        _ => x + nx * y,
    }
}

/// The non-reflecting faces and their memories.
fn non_reflecting(domain: &Domain) -> impl Iterator<Item = (Side, f64)> + '_ {
    (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]).filter_map(|face| match face_at(domain, face) {
        Face::NonReflectingPressure { memory, .. } => Some((face, memory)),
        _ => None,
    })
}

/// The numbers of the cells at a face, x before y before z.
fn cells_at(domain: &Domain, (axis, side): Side) -> impl Iterator<Item = usize> {
    let [nx, ny, nz] = domain.cells();
    let outermost = if side == 0 { 0 } else { domain.cells()[axis] - 1 };
    let (along, across) = [(ny, nz), (nx, nz), (nx, ny)][axis];
    (0..along * across).map(move |number| {
        let (i, j) = (number % along, number / along);
        let [x, y, z] = [[outermost, i, j], [i, outermost, j], [i, j, outermost]][axis];
        x + nx * (y + ny * z)
    })
}

/// `c_a·v`
fn along(a: usize, v: &Vec3) -> f64 {
    (0..3).map(|axis| f64::from(C[a][axis]) * v[axis]).sum()
}

/// Density and velocity of a cell.
struct Near {
    /// Density less 1.
    excess: f64,
    velocity: Vec3,
}

impl Near {
    fn of(f: impl Fn(usize) -> f64) -> Self {
        let (mut excess, mut j) = (0.0, Vec3::zeros());
        for a in 0..Q {
            let value = f(a);
            excess += value;
            for axis in 0..3 {
                j[axis] += f64::from(C[a][axis]) * value;
            }
        }
        Near { excess, velocity: j / (1.0 + excess) }
    }

    /// Velocity out of the domain through a face.
    fn outward(&self, (axis, side): Side) -> f64 {
        if side == 0 { -self.velocity[axis] } else { self.velocity[axis] }
    }

    /// `9/2 (c_a·u)² - 3/2 u²`
    fn squares(&self, a: usize) -> f64 {
        let cu = along(a, &self.velocity);
        4.5 * cu * cu - 1.5 * self.velocity.norm_squared()
    }

    /// `1 + 3 c_a·u + 9/2 (c_a·u)² - 3/2 u²`
    fn equilibrium(&self, a: usize) -> f64 {
        1.0 + 3.0 * along(a, &self.velocity) + self.squares(a)
    }
}
