//! The collision of one cell, fluid and solid part together: Eqs. 2, 3, 4 and 6, corrected.
//!
//! The relaxation time in the weight `B(epsilon, tau)` is that of the stress, under MRT too.

use crate::collision::CollisionOperator;
use crate::coverage::{Coverage, Share};
use crate::directions::Q;
use crate::forcing::forced_velocity;
use crate::graded_viscosity;
use crate::lattice::{Populations, Vec3, density, momentum};
use crate::partial_saturation::{BeforeCollision, force, share_weight};
use crate::setup::{Setup, SolidPhase};

/// Momentum that one cell gives to one solid in one step.
#[derive(Clone, Copy, Debug)]
pub struct Impulse {
    /// Number of the solid.
    pub solid: usize,
    /// Force on the solid.
    pub force: Vec3,
    /// From the solid's centre to the cell.
    pub arm: Vec3,
}

/// What the collision of any cell needs to know.
pub struct CellCollision<'a> {
    operator: &'a CollisionOperator,
    tau: f64,
    body_force: Option<Vec3>,
    solids: Option<(&'a SolidPhase, &'a Coverage)>,
}

impl<'a> CellCollision<'a> {
    /// Gathers it. `coverage` must be that of the set-up's solids.
    pub fn new(
        setup: &'a Setup,
        operator: &'a CollisionOperator,
        coverage: Option<&'a Coverage>,
    ) -> Self {
        CellCollision {
            operator,
            tau: setup.collision.tau(),
            body_force: setup.body_force,
            solids: setup.solid_phase.as_ref().zip(coverage),
        }
    }

    /// Post-collision populations of cell number `cell`; what its solids receive is added to
    /// `impulses`.
    pub fn collide(
        &self,
        cell: usize,
        f: &Populations,
        impulses: &mut Vec<Impulse>,
    ) -> Populations {
        match self.solids.map(|(phase, coverage)| (phase, coverage.shares(cell))) {
            None | Some((_, [])) => sum(f, &self.fluid_change(f)),
            Some((phase, shares)) => self.saturated(f, phase, shares, impulses),
        }
    }

    /// The change of a cell full of fluid: relaxation (Eq. 2 or 3) and body force.
    fn fluid_change(&self, f: &Populations) -> Populations {
        let (rho, j) = (density(f), momentum(f));
        match self.body_force {
            None => self.operator.relaxation(f, rho, &(j / rho)),
            Some(g) => {
                let u = forced_velocity(rho, &j, &g);
                sum(&self.operator.relaxation(f, rho, &u), &self.operator.source(&u, &g))
            }
        }
    }

    /// Post-collision populations of a cell with solids in it.
    fn saturated(
        &self,
        f: &Populations,
        phase: &SolidPhase,
        shares: &[Share],
        impulses: &mut Vec<Impulse>,
    ) -> Populations {
        let (rho, j) = (density(f), momentum(f));
        let cell = BeforeCollision { f, rho, u: j / rho };
        let Some(solid) = phase.operator.prepare(&cell, self.operator) else {
            return self.graded(f, (rho, j), phase, shares, impulses);
        };
        let mut solid_change = [0.0; Q];
        let epsilons = shares.iter().map(|share| share.epsilon);
        let weight = share_weight(phase.weighting, self.tau, epsilons, |s, weight| {
            let Share { solid: number, arm, .. } = shares[s];
            let lambda = solid.lambda(&phase.solids[number].velocity_at(&arm));
            for a in 0..Q {
                solid_change[a] += weight * lambda[a];
            }
            impulses.push(Impulse { solid: number, force: force(weight, &lambda), arm });
        });
        let fluid_change = self.fluid_change(f);
        let mut post = [0.0; Q];
        for a in 0..Q {
            // f* = f + (1 - B_t) Ω + Σ_s B_s Λ_s          (Eq. 4 for SRT, Eq. 6 for MRT, corrected)
            post[a] = f[a] + (1.0 - weight) * fluid_change[a] + solid_change[a];
        }
        post
    }

    /// The same as fluid of graded viscosity.
    fn graded(
        &self,
        f: &Populations,
        (rho, j): (f64, Vec3),
        phase: &SolidPhase,
        shares: &[Share],
        impulses: &mut Vec<Impulse>,
    ) -> Populations {
        let mut drag = Vec3::zeros();
        let epsilons = shares.iter().map(|share| share.epsilon);
        let epsilon: f64 = epsilons.clone().sum();
        let weight = share_weight(phase.weighting, self.tau, epsilons, |s, weight| {
            let Share { solid: number, arm, .. } = shares[s];
            // 2 B_s (ρ u_s - j)
            let u_s = phase.solids[number].velocity_at(&arm);
            let of_solid = 2.0 * weight * (rho * u_s - j);
            drag += of_solid;
            impulses.push(Impulse { solid: number, force: -of_solid, arm });
        });
        // F = (1 - B) G + Σ_s 2 B_s (ρ u_s - j)
        let body_force = self.body_force.unwrap_or_else(Vec3::zeros);
        let force = (1.0 - weight) * body_force + drag;
        graded_viscosity::collide(f, (rho, j), &force, epsilon.min(1.0), self.tau)
    }
}

/// The sum of two sets of values.
fn sum(first: &Populations, second: &Populations) -> Populations {
    std::array::from_fn(|a| first[a] + second[a])
}
