//! Cells that solids fill in part as fluid of graded viscosity (`reference/src/graded_viscosity.rs`): the fluid's collision,
//! with rates and a force of each cell's own.

use super::pairs::Change;
use super::{Cell, Collider, scaled};
use crate::lanes::Lanes;

impl<V: Lanes> Collider<V> {
    /// The change of cells of which solids fill `epsilon` in all and move with `solid_velocity` there, `None` if they are
    /// at rest. Where nothing is filled it is that of the fluid, to the last bit.
    #[inline(always)]
    pub(super) fn graded(
        &self,
        cell: &Cell<V>,
        epsilon: V,
        weight: V,
        solid_velocity: Option<[V; 3]>,
    ) -> Change<V> {
        let force = self.force_in_cut_cells(cell, weight, solid_velocity);
        let (relax, drive) = self.factors(epsilon);
        let driven = self.half_way(cell, force);
        let moments = self.relaxed(cell, driven, &relax);
        self.back(&self.driven(&moments, force, driven, cell.inverse, &drive))
    }

    /// `(1 - B) G + 2 B (ρ u_p - j)`
    #[inline(always)]
    fn force_in_cut_cells(
        &self,
        cell: &Cell<V>,
        weight: V,
        solid_velocity: Option<[V; 3]>,
    ) -> [V; 3] {
        let twice = self.two * weight;
        let [jx, jy, jz] = scaled(cell.sums.j, -twice);
        let [jx, jy, jz] = match solid_velocity {
            None => [jx, jy, jz],
            Some([x, y, z]) => {
                let mass = cell.rho * twice;
                [mass.mul_add(x, jx), mass.mul_add(y, jy), mass.mul_add(z, jz)]
            }
        };
        match self.force {
            None => [jx, jy, jz],
            Some([gx, gy, gz]) => {
                let open = self.one - weight;
                [open.mul_add(gx, jx), open.mul_add(gy, jy), open.mul_add(gz, jz)]
            }
        }
    }

    /// `-s/|row|²` and `(1 - s/2)/|row|²` of cut cells.
    #[inline(always)]
    fn factors(&self, epsilon: V) -> ([V; 9], [V; 9]) {
        let open = self.one - epsilon.min(self.one);
        // even moments: 1/s - 1/2 = (τ - 1/2)/(1 - ε);  odd ones: 1/s - 1/2 = Λ_c (1 - ε)/(τ - 1/2)
        let even = open.over(self.half.mul_add(open, self.excess));
        let odd = self.one.over(self.odd_in_cut_cells.mul_add(open, self.half));
        let (even_drive, odd_drive) = (self.one - self.half * even, self.one - self.half * odd);
        // 1 where something is filled, 0 where nothing is
        let is_cut = (epsilon * self.huge).min(self.one);
        let (mut relax, mut drive) = (self.relax, self.drive);
        for row in 0..9 {
            let (s, rest) = if row < 7 { (even, even_drive) } else { (odd, odd_drive) };
            let unit = self.unit[row];
            relax[row] = is_cut.mul_add(-(s * unit) - relax[row], relax[row]);
            drive[row] = is_cut.mul_add(rest * unit - drive[row], drive[row]);
        }
        (relax, drive)
    }
}
