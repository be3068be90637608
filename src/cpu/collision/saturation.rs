//! Cells that solids fill in part: the weight of the solid's part, and what it does.

use psmrt_reference::directions::Q;
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};

use super::pairs::{Change, Pair};
use super::relaxation::Moments;
use super::{Cell, Collider, scaled};
use crate::lanes::Lanes;

impl<V: Lanes> Collider<V> {
    /// Post-collision populations of cells of which solids fill `epsilon` in all, with the sum of their velocities,
    /// each times what it fills (`None` if all are at rest); and what loads are made of: density and momentum before
    /// the collision, times the weight per solid fraction, `B/Σ ε_s`, and that itself.
    #[inline(always)]
    pub(in crate::cpu) fn saturated(
        &self,
        f: &[V; Q],
        epsilon: V,
        motion: Option<[V; 3]>,
    ) -> ([V; Q], [V; 5]) {
        let cell = self.cell(f);
        let inverse = self.one.over(epsilon.max(self.tiny));
        // The mean by what each fills.
        #[expect(clippy::manual_map, reason = "a closure may be compiled without the vectors")]
        let solid_velocity = match motion {
            None => None,
            Some(sum) => Some(scaled(sum, inverse)),
        };
        let weight = self.weight_of(epsilon);
        let change = if self.operator == SolidOperator::GradedViscosity {
            self.graded(&cell, epsilon, weight, solid_velocity)
        } else {
            let moments = self.moments_beside_solid(&cell, weight);
            self.with_solid(&self.back(&moments), &cell, weight, solid_velocity)
        };
        let share = weight * inverse;
        let [jx, jy, jz] = scaled(cell.sums.j, share);
        (change.added_to(f), [cell.rho * share, jx, jy, jz, share])
    }

    /// What loads are made of in cells of which solids fill `epsilon` in all, as [`Self::saturated`] gives it.
    #[inline(always)]
    pub(in crate::cpu) fn shared(&self, f: &[V; Q], epsilon: V) -> [V; 5] {
        let [excess, jx, jy, jz] = Self::sums(f);
        let share = self.weight_of(epsilon) * self.one.over(epsilon.max(self.tiny));
        let [jx, jy, jz] = scaled([jx, jy, jz], share);
        [(excess + self.one) * share, jx, jy, jz, share]
    }

    /// The fluid's part: the change of the moments in `f* - f = (1 - B) Ω + B Λ` but for that by `Λ`, of which the Ω in it
    /// is taken in.
    #[inline(always)]
    fn moments_beside_solid(&self, cell: &Cell<V>, weight: V) -> Moments<V> {
        match (self.operator, self.force) {
            // Λ holds an Ω as well: that of the bare velocity, the same if no force acts.
            (SolidOperator::Superposition, None) => self.moments(cell),
            (SolidOperator::Superposition, Some(_)) => {
                let driven = self.moments(cell).times(self.one - weight);
                self.relaxed(cell, cell.sums.j, &self.relax).times_plus(weight, &driven)
            }
            // What bounces back has not relaxed.
            _ => self.moments(cell).times(self.one - weight),
        }
    }

    /// `B(min(1, epsilon))`
    #[inline(always)]
    fn weight_of(&self, epsilon: V) -> V {
        let epsilon = epsilon.min(self.one);
        match self.weighting {
            Weighting::SolidFraction => epsilon,
            // B = ε (τ - 1/2) / [(1 - ε) + (τ - 1/2)]
            Weighting::NobleTorczynski => {
                (epsilon * self.excess).over((self.one - epsilon) + self.excess)
            }
            // B = k ε / [(1 - ε) + k ε]
            Weighting::Graded => {
                let solid = epsilon * self.graded_drag;
                solid.over((self.one - epsilon) + solid)
            }
        }
    }

    /// `change + B Λ`, but for the Ω in it, of solids that move with `solid_velocity` here, `None` if they are at rest.
    ///
    /// Λ is linear in the equilibrium of each solid's velocity; what their squares add to that of the mean is put in
    /// afterwards, cell by cell (`fields.rs`).
    #[inline(always)]
    fn with_solid(
        &self,
        change: &Change<V>,
        cell: &Cell<V>,
        weight: V,
        solid_velocity: Option<[V; 3]>,
    ) -> Change<V> {
        // w_a ρ B of faces and edges of the cube
        let rho = cell.rho * weight;
        let (face, edge) = (self.face * rho, self.edge * rho);
        let (face_3, edge_3) = (self.three * face, self.three * edge);
        if self.operator == SolidOperator::FullBounceBack {
            // Λ_a = f_-a - f_-a^eq(u_p) + f_a^eq(u_p) - f_a, all odd in c_a: -(f_a - f_-a) + 6 w ρ c·u_p
            let odd = change.odd.plus(&cell.sums.odd, -weight, -weight);
            let odd = match solid_velocity {
                None => odd,
                Some(u_p) => odd.plus(&Pair::along(u_p), self.two * face_3, self.two * edge_3),
            };
            return Change { odd, ..*change };
        }
        // Sum and difference of the velocities of solid and fluid.
        let [ux, uy, uz] = scaled(cell.sums.j, cell.inverse);
        let (sum, difference) = match solid_velocity {
            None => ([ux, uy, uz], [-ux, -uy, -uz]),
            Some([x, y, z]) => ([x + ux, y + uy, z + uz], [x - ux, y - uy, z - uz]),
        };
        let (sum, difference) = (Pair::along(sum), Pair::along(difference));
        // f_eq(u_p) - f_eq(u), what is even in c_a: w ρ [9/2 (c·(u_p + u)) (c·(u_p - u)) - 3/2 (u_p² - u²)]
        let products = sum.by(&difference);
        let square = products.x + products.y + products.z;
        let drop = self.half * square;
        let even = change
            .even
            .plus(&products, self.four_and_half * face, self.four_and_half * edge)
            .less(face_3 * drop, edge_3 * drop);
        let rest = (self.rest_drop * rho).mul_add(square, change.rest);
        let odd = match self.operator {
            // Λ_a = f_a^eq(u_p) - f_a^eq(u) + Ω_a
            SolidOperator::Superposition => change.odd.plus(&difference, face_3, edge_3),
            // Λ_a = f_-a - f_-a^eq(u) + f_a^eq(u_p) - f_a, what is odd in c_a: -(f_a - f_-a) + 3 w ρ c·(u + u_p)
            _ => change.odd.plus(&cell.sums.odd, -weight, -weight).plus(&sum, face_3, edge_3),
        };
        Change { rest, even, odd }
    }
}
