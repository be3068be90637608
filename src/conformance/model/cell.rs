//! The collision of a cell.

use psmrt_reference::collision::Collision;
use psmrt_reference::directions::Q;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};

use super::super::gauged::{Gauged, Gauged3, dot, given, plus, times};
use super::super::mistakes::Mistake;
use super::super::task::Collisions;
use super::constants::{conserved, direction, product, vector};
use super::{Cell, GaugedAnswers, Model};

/// How the cells of a problem collide.
pub(super) struct Rules {
    pub(super) collision: Collision,
    pub(super) body_force: Option<Vec3>,
    /// The solid operator, and whether `B` is Noble and Torczynski's.
    pub(super) operator: Option<(SolidOperator, Weighting)>,
}

impl Rules {
    /// Whether cells with solid in them are fluid of graded viscosity.
    pub(super) fn is_graded(&self) -> bool {
        matches!(self.operator, Some((SolidOperator::GradedViscosity, _)))
    }
}

/// A solid in a cell: its fraction, and its velocity there.
pub(super) type SolidHere = (f64, Gauged3);

impl Model {
    /// Populations after the collision of a cell, and the force on each of its solids.
    pub(super) fn collide(
        &self,
        f: &Cell,
        rules: &Rules,
        solids: &[SolidHere],
    ) -> (Cell, Vec<Gauged3>) {
        if !solids.is_empty() && rules.is_graded() {
            return self.graded(f, rules, solids);
        }
        let (rho, j) = conserved(f);
        let bare = j.map(|j| j / rho);
        let g = rules.body_force.as_ref().map(vector);
        let u = g.map_or(bare, |g| self.forced_velocity(rho, j, g));
        let omega = self.relaxation(f, rho, u, rules);
        let source = g.map(|g| self.source(u, g, &rules.collision));
        let Some((operator, _)) = rules.operator.filter(|_| !solids.is_empty()) else {
            let change = source.map_or(omega, |source| plus(omega, source));
            return (plus(*f, change), Vec::new());
        };
        let tau = rules.collision.tau();
        let epsilons: Vec<f64> = solids.iter().map(|solid| solid.0).collect();
        let (weights, total) = self.share(&epsilons, |epsilon| self.weight(epsilon, tau));
        let u_solid = if self.has(Mistake::SolidWithHalfForce) { u } else { bare };
        let fluid = if self.has(Mistake::FluidPartNotWeighted) {
            1.0.into()
        } else {
            Gauged::from(1.0) - total
        };
        let mut post = plus(*f, times(omega, fluid));
        if let Some(source) = source {
            let in_full = self.has(Mistake::BodyForceNotWeighted);
            post = plus(post, if in_full { source } else { times(source, fluid) });
        }
        let mut forces = Vec::new();
        for ((_, u_p), &weight) in solids.iter().zip(&weights) {
            let lambda = self.lambda(f, (rho, u_solid), *u_p, operator, rules);
            post = plus(post, times(lambda, weight));
            let (_, gained) = conserved(&lambda);
            forces.push(self.force(gained, weight));
        }
        (post, forces)
    }

    /// Force on a solid of the weight `weight` in a cell that would gain the momentum `gained` were it full of it.
    pub(super) fn force(&self, gained: Gauged3, weight: Gauged) -> Gauged3 {
        let weight = if self.has(Mistake::ForceWithoutWeight) { 1.0.into() } else { weight };
        let sign = if self.has(Mistake::ForceSign) { 1.0 } else { -1.0 };
        gained.map(|gained| gained * weight * sign)
    }

    /// Velocity with half the body force.
    pub(super) fn forced_velocity(&self, rho: Gauged, j: Gauged3, g: Gauged3) -> Gauged3 {
        if self.has(Mistake::VelocityWithoutHalfForce) || self.has(Mistake::NaiveForce) {
            return j.map(|j| j / rho);
        }
        std::array::from_fn(|i| (j[i] + g[i] * 0.5) / rho)
    }

    /// The change `Omega` towards the equilibrium at `rho`, `u`.
    fn relaxation(&self, f: &Cell, rho: Gauged, u: Gauged3, rules: &Rules) -> Cell {
        match &rules.collision {
            Collision::Srt { tau } => {
                let printed = self.has(Mistake::Eq2WithoutTau)
                    || (self.has(Mistake::Eq4WithoutTau)
                        && rules.operator.is_some()
                        && !rules.is_graded());
                let rate = if printed { 1.0 } else { 1.0 / tau };
                let f_eq = self.equilibrium(rho, u);
                std::array::from_fn(|a| (f_eq[a] - f[a]) * rate)
            }
            Collision::Mrt { rates } => {
                let (m, m_eq) = (product(&self.columns, f), self.equilibrium_moments(rho, u));
                let s_hat = self.s_hat(rates);
                let change = std::array::from_fn(|k| (m_eq[k] - m[k]) * s_hat[k]);
                product(&self.inverse_columns, &change)
            }
        }
    }

    /// Guo's source before it is scaled.
    pub(super) fn unscaled_source(&self, u: Gauged3, g: Gauged3) -> Cell {
        let naive = self.has(Mistake::NaiveForce);
        std::array::from_fn(|a| {
            let c = direction(a);
            let linear = dot(c, g) * 3.0;
            let rest = dot(c, u) * dot(c, g) * 9.0 - dot(u, g) * 3.0;
            (if naive { linear } else { linear + rest }) * self.weights[a]
        })
    }

    /// Whether the source is scaled to go with the relaxation.
    pub(super) fn scales_source(&self) -> bool {
        !self.has(Mistake::NaiveForce) && !self.has(Mistake::SourceWithoutHalfRate)
    }

    /// Guo's source, scaled to go with the relaxation.
    fn source(&self, u: Gauged3, g: Gauged3, collision: &Collision) -> Cell {
        let source = self.unscaled_source(u, g);
        if !self.scales_source() {
            return source;
        }
        match collision {
            Collision::Srt { tau } => {
                let rate = if self.has(Mistake::Eq2WithoutTau) { 1.0 } else { 1.0 / tau };
                source.map(|value| value * (1.0 - 0.5 * rate))
            }
            Collision::Mrt { rates } => {
                let (m, s_hat) = (product(&self.columns, &source), self.s_hat(rates));
                product(
                    &self.inverse_columns,
                    &std::array::from_fn(|k| m[k] * (1.0 - 0.5 * s_hat[k])),
                )
            }
        }
    }

    /// The change `Lambda` in a cell full of a solid that moves with `u_p`.
    fn lambda(
        &self,
        f: &Cell,
        (rho, u): (Gauged, Gauged3),
        u_p: Gauged3,
        operator: SolidOperator,
        rules: &Rules,
    ) -> Cell {
        let u_p = if self.has(Mistake::SolidAtRest) { Gauged3::default() } else { u_p };
        let (f_eq, solid) = (self.equilibrium(rho, u), self.equilibrium(rho, u_p));
        let superposition =
            (operator == SolidOperator::Superposition) != self.has(Mistake::OtherOperator);
        if superposition {
            if let (true, Collision::Mrt { rates }) =
                (self.has(Mistake::SuperpositionTau), &rules.collision)
            {
                let left = 1.0 - rates.nu;
                return std::array::from_fn(|a| solid[a] - f[a] + (f[a] - f_eq[a]) * left);
            }
            let omega = self.relaxation(f, rho, u, rules);
            return std::array::from_fn(|a| solid[a] - f_eq[a] + omega[a]);
        }
        let is_whole = operator == SolidOperator::FullBounceBack
            && !self.has(Mistake::Eq5ForFullBounceBack)
            || self.has(Mistake::FullBounceBack);
        if is_whole {
            let half = operator == SolidOperator::FullBounceBack
                && self.has(Mistake::FullBounceBackHalfVelocity);
            let share = if half { 0.5 } else { 1.0 };
            return std::array::from_fn(|a| {
                let b = self.opposite[a];
                f[b] - f[a] + (solid[a] - solid[b]) * share
            });
        }
        std::array::from_fn(|a| {
            let b = self.opposite[a];
            let turned = if self.has(Mistake::Eq5Sign) {
                f[b] + f_eq[b]
            } else if self.has(Mistake::EquilibriumNotReversed) {
                f[b] - f_eq[a]
            } else {
                f[b] - f_eq[b]
            };
            turned + solid[a] - f[a]
        })
    }

    pub(super) fn collisions(&self, problem: &Collisions) -> GaugedAnswers {
        let (mut post, mut forces) = (Vec::new(), Vec::new());
        for cell in &problem.cells {
            let rules = Rules {
                collision: cell.collision,
                body_force: cell.body_force,
                operator: cell.solid.map(|_| (problem.operator, problem.weighting)),
            };
            let here = cell.solid.filter(|solid| solid.0 > 0.0).map(|(e, u_p)| (e, vector(&u_p)));
            let (after, force) = self.collide(&given(cell.f), &rules, here.as_slice());
            post.push(after);
            forces.push(force.first().copied().unwrap_or_default());
        }
        let n = problem.cells.len();
        let answers = GaugedAnswers::default().with("post", &[n, Q], post.as_flattened());
        if problem.cells.iter().all(|cell| cell.solid.is_none()) {
            return answers;
        }
        answers.with("force", &[n, 3], forces.as_flattened())
    }
}
