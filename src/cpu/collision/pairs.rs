//! Populations as pairs of opposite directions: the sum of two opposite ones holds what is even in `c_a`, their
//! difference what is odd.

use psmrt_reference::directions::Q;

use crate::lanes::Lanes;

/// One value for each pair of opposite directions, named by the first: `xy` is (1, 1, 0), `x_y` (1, -1, 0).
#[derive(Clone, Copy)]
pub(super) struct Pair<V> {
    pub(super) x: V,
    pub(super) y: V,
    pub(super) z: V,
    pub(super) xy: V,
    pub(super) x_y: V,
    pub(super) xz: V,
    pub(super) x_z: V,
    pub(super) yz: V,
    pub(super) y_z: V,
}

impl<V: Lanes> Pair<V> {
    /// `f_a + f_-a`
    #[inline(always)]
    fn sums(f: &[V; Q]) -> Self {
        Pair {
            x: f[1] + f[2],
            y: f[3] + f[4],
            z: f[5] + f[6],
            xy: f[7] + f[10],
            x_y: f[9] + f[8],
            xz: f[11] + f[14],
            x_z: f[13] + f[12],
            yz: f[15] + f[18],
            y_z: f[17] + f[16],
        }
    }

    /// `f_a - f_-a`
    #[inline(always)]
    fn differences(f: &[V; Q]) -> Self {
        Pair {
            x: f[1] - f[2],
            y: f[3] - f[4],
            z: f[5] - f[6],
            xy: f[7] - f[10],
            x_y: f[9] - f[8],
            xz: f[11] - f[14],
            x_z: f[13] - f[12],
            yz: f[15] - f[18],
            y_z: f[17] - f[16],
        }
    }

    /// `c_a·v`
    #[inline(always)]
    pub(super) fn along([x, y, z]: [V; 3]) -> Self {
        Pair { x, y, z, xy: x + y, x_y: x - y, xz: x + z, x_z: x - z, yz: y + z, y_z: y - z }
    }

    /// `self + values * factor`, with one factor for the faces of the cube and one for its edges.
    #[inline(always)]
    pub(super) fn plus(&self, values: &Self, face: V, edge: V) -> Self {
        Pair {
            x: values.x.mul_add(face, self.x),
            y: values.y.mul_add(face, self.y),
            z: values.z.mul_add(face, self.z),
            xy: values.xy.mul_add(edge, self.xy),
            x_y: values.x_y.mul_add(edge, self.x_y),
            xz: values.xz.mul_add(edge, self.xz),
            x_z: values.x_z.mul_add(edge, self.x_z),
            yz: values.yz.mul_add(edge, self.yz),
            y_z: values.y_z.mul_add(edge, self.y_z),
        }
    }

    /// Products of the values of each pair.
    #[inline(always)]
    pub(super) fn by(&self, other: &Self) -> Self {
        Pair {
            x: self.x * other.x,
            y: self.y * other.y,
            z: self.z * other.z,
            xy: self.xy * other.xy,
            x_y: self.x_y * other.x_y,
            xz: self.xz * other.xz,
            x_z: self.x_z * other.x_z,
            yz: self.yz * other.yz,
            y_z: self.y_z * other.y_z,
        }
    }

    /// Less one number for the faces of the cube and one for its edges.
    #[inline(always)]
    pub(super) fn less(&self, face: V, edge: V) -> Self {
        Pair {
            x: self.x - face,
            y: self.y - face,
            z: self.z - face,
            xy: self.xy - edge,
            x_y: self.x_y - edge,
            xz: self.xz - edge,
            x_z: self.x_z - edge,
            yz: self.yz - edge,
            y_z: self.y_z - edge,
        }
    }
}

/// A change of the populations: of the one at rest, and of each pair `even + odd` and `even - odd`.
#[derive(Clone, Copy)]
pub(super) struct Change<V> {
    pub(super) rest: V,
    pub(super) even: Pair<V>,
    pub(super) odd: Pair<V>,
}

impl<V: Lanes> Change<V> {
    /// The populations `f` with this change.
    #[inline(always)]
    pub(super) fn added_to(&self, f: &[V; Q]) -> [V; Q] {
        let Change { rest, even, odd } = self;
        [
            f[0] + *rest,
            f[1] + (even.x + odd.x),
            f[2] + (even.x - odd.x),
            f[3] + (even.y + odd.y),
            f[4] + (even.y - odd.y),
            f[5] + (even.z + odd.z),
            f[6] + (even.z - odd.z),
            f[7] + (even.xy + odd.xy),
            f[8] + (even.x_y - odd.x_y),
            f[9] + (even.x_y + odd.x_y),
            f[10] + (even.xy - odd.xy),
            f[11] + (even.xz + odd.xz),
            f[12] + (even.x_z - odd.x_z),
            f[13] + (even.x_z + odd.x_z),
            f[14] + (even.xz - odd.xz),
            f[15] + (even.yz + odd.yz),
            f[16] + (even.y_z - odd.y_z),
            f[17] + (even.y_z + odd.y_z),
            f[18] + (even.yz - odd.yz),
        ]
    }
}

/// Sums of the populations of a cell.
pub(super) struct Sums<V> {
    pub(super) f0: V,
    /// `f_a + f_-a`
    pub(super) even: Pair<V>,
    /// `f_a - f_-a`
    pub(super) odd: Pair<V>,
    /// Sums over the four edges in the planes xy, xz and yz.
    pub(super) planes: [V; 3],
    pub(super) faces: V,
    pub(super) edges: V,
    /// `ρ - 1`
    pub(super) excess: V,
    /// Momentum, and the part of it that edges carry.
    pub(super) j: [V; 3],
    pub(super) along_edges: [V; 3],
    /// `m_x, m_y, m_z`
    pub(super) third: [V; 3],
}

impl<V: Lanes> Sums<V> {
    #[inline(always)]
    pub(super) fn of(f: &[V; Q]) -> Self {
        let (even, odd) = (Pair::sums(f), Pair::differences(f));
        let (exy, exz, eyz) = (even.xy + even.x_y, even.xz + even.x_z, even.yz + even.y_z);
        let faces = even.x + even.y + even.z;
        let edges = exy + exz + eyz;
        // The parts of the momentum that the edges carry, plane by plane.
        let (x_xy, y_xy) = (odd.xy + odd.x_y, odd.xy - odd.x_y);
        let (x_xz, z_xz) = (odd.xz + odd.x_z, odd.xz - odd.x_z);
        let (y_yz, z_yz) = (odd.yz + odd.y_z, odd.yz - odd.y_z);
        let [kx, ky, kz] = [x_xy + x_xz, y_xy + y_yz, z_xz + z_yz];
        Sums {
            f0: f[0],
            even,
            odd,
            planes: [exy, exz, eyz],
            faces,
            edges,
            excess: f[0] + faces + edges,
            j: [odd.x + kx, odd.y + ky, odd.z + kz],
            along_edges: [kx, ky, kz],
            third: [x_xy - x_xz, y_yz - y_xy, z_xz - z_yz],
        }
    }
}
