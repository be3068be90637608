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

use psmrt_reference::lattice::Vec3;

use super::mesh::Mesh;

/// A share so near to 0 or 1 is that: what rounding leaves of a sum.
const ROUNDING: f64 = 1e-10;

/// Cells of a domain of `cells` (x, y, z) that a body, in cells, fills in part: by number (x fastest), with their share in
/// (0, 1]. What lies outside of the domain is left out.
pub fn solid_shares(body: &Mesh, cells: [usize; 3]) -> Vec<(usize, f64)> {
    let Some(mut grid) = Grid::about(body, cells) else { return Vec::new() };
    for corners in body.corners() {
        grid.add(corners);
    }
    grid.shares(cells)
}

/// The cells about a body.
struct Grid {
    /// The first along each axis.
    first: [i64; 3],
    size: [usize; 3],
    /// The volume in each cell that is below pieces of triangles in it, z fastest.
    inside: Vec<f64>,
    /// The area of pieces over each cell that lie in the next one, z fastest: one more a column than there are cells.
    above: Vec<f64>,
}

/// The corners of a piece of a triangle.
type Piece = Vec<Vec3>;

impl Grid {
    /// Nothing if the body lies outside of the domain.
    fn about(body: &Mesh, cells: [usize; 3]) -> Option<Self> {
        let [low, high] = body.bounds();
        let (mut first, mut size) = ([0; 3], [0; 3]);
        for axis in 0..3 {
            let last = i64::try_from(cells[axis]).unwrap_or(i64::MAX) - 1;
            first[axis] = floor(low[axis]).max(0);
            let end = floor(high[axis]).min(last);
            size[axis] = usize::try_from(end - first[axis] + 1).ok().filter(|&size| size > 0)?;
        }
        let columns = size[0] * size[1];
        let (inside, above) = (vec![0.0; columns * size[2]], vec![0.0; columns * (size[2] + 1)]);
        Some(Grid { first, size, inside, above })
    }

    fn add(&mut self, corners: [Vec3; 3]) {
        let whole: Piece = corners.to_vec();
        let (mut row, mut column, mut slab) = (Piece::new(), Piece::new(), Piece::new());
        let mut scratch = Piece::new();
        for i in self.range(&whole, 0) {
            cut(&whole, 0, self.edge(0, i), &mut scratch, &mut row);
            for j in self.range(&row, 1) {
                cut(&row, 1, self.edge(1, j), &mut scratch, &mut column);
                let at = j + self.size[1] * i;
                let (nz, lowest) = (self.size[2], self.first[2] as f64);
                let heights = column.iter().map(|corner| corner.z - lowest);
                let (low, high) = heights
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(z), h.max(z)));
                // All of it over the column, or some of it.
                if high >= nz as f64 {
                    clip(&column, 2, lowest + nz as f64, 1.0, &mut slab);
                    self.above[at * (nz + 1) + nz] += area_and_moment(&slab).0;
                }
                if high < 0.0 || low > nz as f64 {
                    continue;
                }
                for k in self.range(&column, 2) {
                    cut(&column, 2, self.edge(2, k), &mut scratch, &mut slab);
                    let (area, moment) = area_and_moment(&slab);
                    self.inside[at * nz + k] += moment - area * self.edge(2, k);
                    self.above[at * (nz + 1) + k] += area;
                }
            }
        }
    }

    /// Low edge of cell `number` of the grid along an axis.
    fn edge(&self, axis: usize, number: usize) -> f64 {
        self.first[axis] as f64 + number as f64
    }

    /// Numbers of the cells of the grid that a piece reaches into along an axis.
    fn range(&self, piece: &Piece, axis: usize) -> std::ops::Range<usize> {
        let places = piece.iter().map(|corner| corner[axis]);
        let (low, high) =
            places.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let place = |x: f64| usize::try_from((floor(x) - self.first[axis]).max(0)).unwrap_or(0);
        if piece.is_empty() || high < self.first[axis] as f64 {
            return 0..0;
        }
        place(low)..(place(high) + 1).min(self.size[axis])
    }

    /// Shares by the numbers of cells of the domain.
    fn shares(&self, cells: [usize; 3]) -> Vec<(usize, f64)> {
        let [nx, ny, nz] = self.size;
        let mut all = Vec::new();
        for i in 0..nx {
            for j in 0..ny {
                let at = j + ny * i;
                let mut over = self.above[at * (nz + 1) + nz];
                for k in (0..nz).rev() {
                    let share = self.inside[at * nz + k] + over;
                    over += self.above[at * (nz + 1) + k];
                    if share > ROUNDING {
                        let share = if share > 1.0 - ROUNDING { 1.0 } else { share };
                        let place = [i, j, k].map(|n| n as i64);
                        let [x, y, z] = [0, 1, 2].map(|axis| {
                            usize::try_from(place[axis] + self.first[axis]).unwrap_or(0)
                        });
                        all.push((x + cells[0] * (y + cells[1] * z), share));
                    }
                }
            }
        }
        all.sort_unstable_by_key(|&(cell, _)| cell);
        all
    }
}

/// The part of a piece that lies between an edge and the next along an axis.
fn cut(piece: &Piece, axis: usize, low: f64, scratch: &mut Piece, part: &mut Piece) {
    clip(piece, axis, low, 1.0, scratch);
    clip(scratch, axis, low + 1.0, -1.0, part);
}

/// The part of a convex piece on the upper (`side` 1) or lower (-1) side of a plane across an axis.
fn clip(piece: &Piece, axis: usize, plane: f64, side: f64, part: &mut Piece) {
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
fn area_and_moment(piece: &Piece) -> (f64, f64) {
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
