//! The velocity of a solid in the cells of a row.

use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Solid;

/// Cells of a row that are worked on together, whatever the width of the vectors, so that sums are the same.
pub(super) const EIGHT: usize = 8;

/// The motion of a solid.
pub(super) struct Rigid {
    velocity: [f64; 3],
    angular: [f64; 3],
}

/// Its velocity along a row of cells: linear in x.
#[derive(Clone, Copy)]
pub(super) struct Along {
    first: [f64; 3],
    per_cell: [f64; 3],
}

impl Rigid {
    pub(super) fn of(solid: &Solid) -> Self {
        Rigid { velocity: solid.velocity.into(), angular: solid.angular_velocity.into() }
    }

    /// Along the row whose first cell is at `arm` from the centre.
    #[inline]
    pub(super) fn along(&self, arm: &Vec3) -> Along {
        let [wx, wy, wz] = self.angular;
        let [ux, uy, uz] = self.velocity;
        // u_s = U + ω × r
        Along {
            first: [
                ux + (wy * arm.z - wz * arm.y),
                uy + (wz * arm.x - wx * arm.z),
                uz + (wx * arm.y - wy * arm.x),
            ],
            per_cell: [0.0, wz, -wy],
        }
    }
}

impl Along {
    /// The same from cell `x` of the row on.
    #[inline(always)]
    pub(super) fn from(&self, x: usize) -> Self {
        let (first, x) = (self.first, x as f64);
        let [a, b, c] = first;
        let [p, q, r] = self.per_cell;
        Along { first: [a + p * x, b + q * x, c + r * x], ..*self }
    }

    /// The velocities of eight cells, component by component.
    #[inline(always)]
    pub(super) fn eight(&self) -> [[f64; EIGHT]; 3] {
        let mut u_s = [[0.0; EIGHT]; 3];
        for axis in 0..3 {
            for x in 0..EIGHT {
                u_s[axis][x] = self.first[axis] + self.per_cell[axis] * x as f64;
            }
        }
        u_s
    }
}
