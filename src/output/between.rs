//! Values between the centres of cells: linear from the two nearest ones along each axis, so that a field that is
//! linear in the coordinates comes out exactly, up to the faces.

use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;

use crate::engine::{Block, CellState, Coupled};

/// A line or plane of points: its place along each axis in cells, `None` along the axes where it is as the cells
/// are.
pub type Place = [Option<f64>; 3];

/// The place of a line along `axis` through a point.
pub fn line(axis: usize, through: [f64; 3]) -> Place {
    std::array::from_fn(|other| (other != axis).then_some(through[other]))
}

/// The place of a plane normal to `axis`.
pub fn plane(axis: usize, at: f64) -> Place {
    std::array::from_fn(|other| (other == axis).then_some(at))
}

/// The state at `place`, for each cell along the axes where it is as the cells are, x fastest. Cells that grains cover
/// count like all others: the fluid in them moves with the grain.
pub fn states(engine: &Coupled, domain: &Domain, place: Place) -> Vec<CellState> {
    let corners = corners(domain, place);
    let block = |corner: &[Option<usize>; 3]| Block {
        low: corner.map(|cell| cell.unwrap_or(0)),
        size: std::array::from_fn(|axis| corner[axis].map_or(domain.cells()[axis], |_| 1)),
    };
    let found: Vec<_> = corners.iter().map(|(corner, _)| engine.cells(block(corner))).collect();
    let count = found.first().map_or(0, Vec::len);
    let at = |cell: usize| found.iter().map(move |states| states[cell]);
    (0..count).map(|cell| weighted(at(cell), &corners)).collect()
}

type Corner = ([Option<usize>; 3], f64);

fn weighted(mut states: impl Iterator<Item = CellState>, corners: &[Corner]) -> CellState {
    let mut sum = CellState { density: 0.0, velocity: Vec3::zeros(), solid_fraction: 0.0 };
    // One cell is itself, to the last bit.
    if corners.len() == 1 {
        return states.next().unwrap_or(sum);
    }
    for (state, (_, weight)) in states.zip(corners) {
        sum.density += weight * state.density;
        sum.velocity += *weight * state.velocity;
        sum.solid_fraction += weight * state.solid_fraction;
    }
    sum
}

/// The lines or planes of cells around a place, with their weights.
fn corners(domain: &Domain, place: Place) -> Vec<Corner> {
    let mut corners = vec![([None; 3], 1.0)];
    for axis in 0..3 {
        let Some(at) = place[axis] else { continue };
        let pair = nearest(domain.cells()[axis], domain.is_periodic(axis), at);
        let with = |(corner, weight): &Corner| -> Vec<Corner> {
            let one = |&(cell, share): &(usize, f64)| {
                let mut corner = *corner;
                corner[axis] = Some(cell);
                (corner, weight * share)
            };
            pair.iter().map(one).collect()
        };
        corners = corners.iter().flat_map(with).collect();
    }
    corners
}

/// Places closer than this to a centre, in cells, are the centre: a point in metres is rounded.
const AT_CENTRE: f64 = 1e-9;

/// The cells of a row of `n` whose centres are nearest to `at`, on either side, and their weights. Across a
/// periodic face the row goes on; within half a cell of any other one the last two cells are continued: what
/// is linear is right there too, and a wall's own velocity comes out at the wall.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells from 0 to n")]
pub(super) fn nearest(n: usize, periodic: bool, at: f64) -> Vec<(usize, f64)> {
    // Centres lie at 1/2, 3/2, ...
    let from_first = at - 0.5;
    let nearest = from_first.round();
    if n == 1 || ((from_first - nearest).abs() < AT_CENTRE && (0.0..n as f64).contains(&nearest)) {
        return vec![((nearest.max(0.0) as usize).min(n - 1), 1.0)];
    }
    let below = from_first.floor();
    let below = if periodic { below } else { below.clamp(0.0, n as f64 - 2.0) };
    let share = from_first - below;
    let wrapped = |cell: f64| cell.rem_euclid(n as f64) as usize;
    vec![(wrapped(below), 1.0 - share), (wrapped(below + 1.0), share)]
}
