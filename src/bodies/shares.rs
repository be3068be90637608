//! The share of each cell that a body fills, exactly: the volume that the cell and a polyhedron have in common.
//!
//! A body lies below the triangles that face up and above those that face down. So the volume of it in a cell is the sum over
//! all triangles of the volume of the cell below the triangle, with the sign of the triangle's `n_z`. Each triangle is cut along the
//! sides of the columns of cells that it lies over, and each piece along the planes between the cells of a column:
//!
//! ```text
//!   of the cell that holds the piece      ∫ (z - z_cell) dA = A (z̄ - z_cell)
//!   of each cell of the column below it   A
//! ```
//!
//! with `A` the area of the piece seen from above, counted negative where it faces down, and `z̄` its mean height.

use std::ops::Range;

use psmrt_reference::lattice::Vec3;
use rayon::prelude::*;
use thiserror::Error;

use super::mesh::Mesh;

/// A share so near to 0 or 1 is that: what rounding leaves of a sum.
const ROUNDING: f64 = 1e-10;

/// A share so far beyond 0 or 1 is no rounding: parts of the surface overlap, or face inward.
const WRONG: f64 = 1e-6;

/// A surface that fills more than all of a cell, or less than nothing.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error(
    "its surface fills {share:.4} of the cell [{}, {}, {}]: parts of it overlap each other, or one faces inward and is no cavity of \
     another", .cell[0], .cell[1], .cell[2]
)]
pub struct WrongShare {
    /// Coordinates of the cell.
    pub cell: [usize; 3],
    /// What is filled of it.
    pub share: f64,
}

/// Cells of a domain of `cells` (x, y, z) that a body, in cells, fills in part: by number (x fastest), with their share in
/// (0, 1]. What lies outside of the domain is left out. Sums are taken in the order of the triangles, whatever the number of
/// threads. Errors if a share lies outside of 0 to 1.
pub fn solid_shares(body: &Mesh, cells: [usize; 3]) -> Result<Vec<(usize, f64)>, WrongShare> {
    let Some(about) = About::of(body, cells) else { return Ok(Vec::new()) };
    let corners: Vec<[Vec3; 3]> = body.corners().collect();
    // The triangles that reach into each plane of cells across x.
    let mut planes = vec![Vec::new(); about.size[0]];
    for (number, corners) in corners.iter().enumerate() {
        for i in about.range(corners, 0) {
            planes[i].push(number);
        }
    }
    let shares = planes.into_par_iter().enumerate().map(|(i, numbers)| {
        let mut plane = Plane::empty(&about, i);
        for number in numbers {
            plane.add(&corners[number]);
        }
        plane.shares(cells)
    });
    let shares: Result<Vec<_>, _> = shares.collect();
    let mut shares = shares?.concat();
    shares.par_sort_unstable_by_key(|&(cell, _)| cell);
    Ok(shares)
}

/// The cells about a body.
struct About {
    /// The first along each axis.
    first: [i64; 3],
    size: [usize; 3],
}

impl About {
    /// Nothing if the body lies outside of the domain.
    fn of(body: &Mesh, cells: [usize; 3]) -> Option<Self> {
        let [low, high] = body.bounds();
        let (mut first, mut size) = ([0; 3], [0; 3]);
        for axis in 0..3 {
            let last = i64::try_from(cells[axis]).unwrap_or(i64::MAX) - 1;
            first[axis] = floor(low[axis]).max(0);
            let end = floor(high[axis]).min(last);
            size[axis] = usize::try_from(end - first[axis] + 1).ok().filter(|&size| size > 0)?;
        }
        Some(About { first, size })
    }

    /// Low edge of cell `number` of these along an axis.
    fn edge(&self, axis: usize, number: usize) -> f64 {
        self.first[axis] as f64 + number as f64
    }

    /// Numbers of the cells of these that a piece reaches into along an axis.
    fn range(&self, piece: &[Vec3], axis: usize) -> Range<usize> {
        let [low, high] = ends(piece, axis);
        let place = |x: f64| usize::try_from((floor(x) - self.first[axis]).max(0)).unwrap_or(0);
        if piece.is_empty() || high < self.first[axis] as f64 {
            return 0..0;
        }
        place(low)..(place(high) + 1).min(self.size[axis])
    }
}

/// The cells of these in one plane across x, z fastest.
struct Plane<'a> {
    about: &'a About,
    number: usize,
    /// The volume in each cell that is below pieces of triangles in it.
    inside: Vec<f64>,
    /// The area of pieces in each cell, and behind those of a column that of pieces above them all.
    above: Vec<f64>,
    scratch: [Piece; 4],
}

/// The corners of a piece of a triangle.
type Piece = Vec<Vec3>;

impl<'a> Plane<'a> {
    fn empty(about: &'a About, number: usize) -> Self {
        let [_, ny, nz] = about.size;
        let (inside, above) = (vec![0.0; ny * nz], vec![0.0; ny * (nz + 1)]);
        Plane { about, number, inside, above, scratch: Default::default() }
    }

    fn add(&mut self, corners: &[Vec3; 3]) {
        let Plane { about, number, inside, above, scratch } = self;
        let [half, row, column, slab] = scratch;
        let nz = about.size[2];
        let top = about.edge(2, nz);
        cut(corners, 0, about.edge(0, *number), half, row);
        for j in about.range(row, 1) {
            cut(row, 1, about.edge(1, j), half, column);
            // What lies above all of these cells.
            if ends(column, 2)[1] >= top {
                clip(column, 2, top, 1.0, slab);
                above[j * (nz + 1) + nz] += area_and_moment(slab).0;
            }
            for k in about.range(column, 2) {
                cut(column, 2, about.edge(2, k), half, slab);
                let (area, moment) = area_and_moment(slab);
                inside[j * nz + k] += moment - area * about.edge(2, k);
                above[j * (nz + 1) + k] += area;
            }
        }
    }

    /// Shares by the numbers of cells of the domain.
    fn shares(&self, cells: [usize; 3]) -> Result<Vec<(usize, f64)>, WrongShare> {
        let [_, ny, nz] = self.about.size;
        let mut all = Vec::new();
        for j in 0..ny {
            let mut over = self.above[j * (nz + 1) + nz];
            for k in (0..nz).rev() {
                let share = self.inside[j * nz + k] + over;
                over += self.above[j * (nz + 1) + k];
                let place = [self.number, j, k].map(|n| n as i64);
                let at = [0, 1, 2]
                    .map(|axis| usize::try_from(place[axis] + self.about.first[axis]).unwrap_or(0));
                if !(-WRONG..=1.0 + WRONG).contains(&share) {
                    return Err(WrongShare { cell: at, share });
                }
                if share > ROUNDING {
                    let share = if share > 1.0 - ROUNDING { 1.0 } else { share };
                    all.push((at[0] + cells[0] * (at[1] + cells[1] * at[2]), share));
                }
            }
        }
        Ok(all)
    }
}

/// The lowest and the highest place of a piece along an axis.
fn ends(piece: &[Vec3], axis: usize) -> [f64; 2] {
    let places = piece.iter().map(|corner| corner[axis]);
    places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

/// The part of a piece that lies between an edge and the next along an axis.
fn cut(piece: &[Vec3], axis: usize, low: f64, scratch: &mut Piece, part: &mut Piece) {
    clip(piece, axis, low, 1.0, scratch);
    clip(scratch, axis, low + 1.0, -1.0, part);
}

/// The part of a convex piece on the upper (`side` 1) or lower (-1) side of a plane across an axis.
fn clip(piece: &[Vec3], axis: usize, plane: f64, side: f64, part: &mut Piece) {
    part.clear();
    for (number, here) in piece.iter().enumerate() {
        let next = &piece[(number + 1) % piece.len()];
        let [at_here, at_next] = [here, next].map(|corner| side * (corner[axis] - plane));
        if at_here >= 0.0 {
            part.push(*here);
        }
        if (at_here > 0.0 && at_next < 0.0) || (at_here < 0.0 && at_next > 0.0) {
            let mut on_plane = here + (next - here) * (at_here / (at_here - at_next));
            on_plane[axis] = plane;
            part.push(on_plane);
        }
    }
}

/// Area of a piece seen from above, negative if it faces down, and the integral of its height over it.
fn area_and_moment(piece: &[Vec3]) -> (f64, f64) {
    let Some((a, rest)) = piece.split_first() else { return (0.0, 0.0) };
    let fan = rest.windows(2).map(|pair| {
        let (b, c) = (&pair[0], &pair[1]);
        let area = 0.5 * ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
        (area, area * (a.z + b.z + c.z) / 3.0)
    });
    fan.fold((0.0, 0.0), |(area, moment), (one, height)| (area + one, moment + height))
}

/// The cell that contains a coordinate.
#[expect(clippy::cast_possible_truncation, reason = "beyond 2^63 it saturates")]
fn floor(coordinate: f64) -> i64 {
    coordinate.floor() as i64
}
