//! The faces, their cells, and density and velocity there.

use psmrt_reference::directions::{C, Q};
use psmrt_reference::domain::{Domain, Face};
use psmrt_reference::lattice::Vec3;

/// Axis (0 to 2) and side (0: low, 1: high) of a face.
pub(super) type Side = (usize, usize);

/// Density and velocity of the cells at a face after the collision, x before y before z.
pub(super) struct FaceStates {
    pub(super) face: Side,
    pub(super) near: Vec<Near>,
}

impl FaceStates {
    /// Those of a cell, if it lies at the face.
    pub(super) fn of(&self, domain: &Domain, cell: usize) -> Option<&Near> {
        let at = domain.coordinates(cell);
        let (axis, side) = self.face;
        let outermost = if side == 0 { 0 } else { domain.cells()[axis] - 1 };
        if at[axis] == outermost { self.near.get(place_at(domain, axis, at)) } else { None }
    }
}

/// The number of a cell among those at a face across `axis`.
pub(super) fn place_at(domain: &Domain, axis: usize, [x, y, z]: [usize; 3]) -> usize {
    let [nx, ny, _] = domain.cells();
    match axis {
        0 => y + ny * z,
        1 => x + nx * z,
        _ => x + nx * y,
    }
}

/// The non-reflecting faces and their memories.
pub(super) fn non_reflecting(domain: &Domain) -> impl Iterator<Item = (Side, f64)> + '_ {
    (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]).filter_map(|face| match face_at(domain, face) {
        Face::NonReflectingPressure { memory, .. } => Some((face, memory)),
        _ => None,
    })
}

/// The numbers of the cells at a face, x before y before z.
pub(super) fn cells_at(domain: &Domain, (axis, side): Side) -> impl Iterator<Item = usize> {
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
pub(super) fn along(a: usize, v: &Vec3) -> f64 {
    (0..3).map(|axis| f64::from(C[a][axis]) * v[axis]).sum()
}

/// Density and velocity of a cell.
pub(super) struct Near {
    /// Density less 1.
    pub(super) excess: f64,
    pub(super) velocity: Vec3,
}

impl Near {
    pub(super) fn of(f: impl Fn(usize) -> f64) -> Self {
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
    pub(super) fn outward(&self, (axis, side): Side) -> f64 {
        if side == 0 { -self.velocity[axis] } else { self.velocity[axis] }
    }

    /// `9/2 (c_a·u)² - 3/2 u²`
    pub(super) fn squares(&self, a: usize) -> f64 {
        let cu = along(a, &self.velocity);
        4.5 * cu * cu - 1.5 * self.velocity.norm_squared()
    }

    /// `1 + 3 c_a·u + 9/2 (c_a·u)² - 3/2 u²`
    pub(super) fn equilibrium(&self, a: usize) -> f64 {
        1.0 + 3.0 * along(a, &self.velocity) + self.squares(a)
    }
}

pub(super) fn face_at(domain: &Domain, (axis, side): Side) -> Face {
    domain.faces().axis(axis)[side]
}

pub(super) fn velocity_at(domain: &Domain, face: Side) -> Vec3 {
    match face_at(domain, face) {
        Face::Wall { velocity } | Face::VelocityInlet { velocity } => velocity,
        _ => Vec3::zeros(),
    }
}

pub(super) fn density_at(domain: &Domain, face: Side) -> f64 {
    face_at(domain, face).held_density().unwrap_or(1.0)
}
