//! Cells with solid in them as fluid of graded viscosity.

use psmrt_reference::collision::Collision;
use psmrt_reference::directions::Q;

use super::super::gauged::{Gauged, Gauged3, plus, times};
use super::super::mistakes::Mistake;
use super::cell::{Rules, SolidHere};
use super::constants::{conserved, product, vector};
use super::{Cell, Model};

/// Product of `1/s - 1/2` of even and odd moments in a cut cell.
const PRODUCT: f64 = 0.002;

impl Model {
    /// As `collide`, of a cell with solid in it.
    pub(super) fn graded(
        &self,
        f: &Cell,
        rules: &Rules,
        solids: &[SolidHere],
    ) -> (Cell, Vec<Gauged3>) {
        let tau = rules.collision.tau();
        let epsilons: Vec<f64> = solids.iter().map(|solid| solid.0).collect();
        let filled = epsilons.iter().sum::<f64>().min(1.0);
        let (weights, total) = self.share(&epsilons, |epsilon| self.graded_weight(epsilon, tau));
        let (rho, j) = conserved(f);
        // F = (1 - B) G + Σ 2 B_s (ρ u_p - j)
        let g = rules.body_force.as_ref().map(vector).unwrap_or_default();
        let in_full = self.has(Mistake::BodyForceNotWeighted);
        let mut force = if in_full { g } else { times(g, Gauged::from(1.0) - total) };
        let mut forces = Vec::new();
        let twice = if self.has(Mistake::GradedDragWithoutTwo) { 1.0 } else { 2.0 };
        for ((_, u_p), &weight) in solids.iter().zip(&weights) {
            let gained = std::array::from_fn(|i| (u_p[i] * rho - j[i]) * twice);
            force = plus(force, times(gained, weight));
            forces.push(self.force(gained, weight));
        }
        let u = self.forced_velocity(rho, j, force);
        let (m, m_eq) = (product(&self.columns, f), self.equilibrium_moments(rho, u));
        let source = product(&self.columns, &self.unscaled_source(u, force));
        let rates = self.graded_rates(filled.into(), &rules.collision);
        let change: Cell = std::array::from_fn(|k| {
            let left =
                if self.scales_source() { Gauged::from(1.0) - rates[k] * 0.5 } else { 1.0.into() };
            (m_eq[k] - m[k]) * rates[k] + source[k] * left
        });
        let post = plus(*f, product(&self.inverse_columns, &change));
        if self.has(Mistake::GradedFullCellKept) && filled == 1.0 {
            // What has come from cut cells brings their round-off along: the gauge is that of a collision.
            let kept = |a: usize| Gauged { value: f[a].value, gauge: post[a].gauge };
            return (std::array::from_fn(kept), vec![Gauged3::default(); solids.len()]);
        }
        (post, forces)
    }

    /// The weight `B` of the drag.
    fn graded_weight(&self, epsilon: Gauged, tau: f64) -> Gauged {
        if self.has(Mistake::GradedDragOfNobleTorczynski) {
            return self.weight(epsilon, tau);
        }
        let half = if self.has(Mistake::GradedDragWithTau) { 0.0 } else { 0.5 };
        let beyond = Gauged::from(tau) - half.into();
        // B/(1 - B) = k ε/(1 - ε)
        let k = beyond * beyond / (beyond * 4.0 + 0.4.into());
        let solid = k * epsilon;
        solid / (Gauged::from(1.0) - epsilon + solid)
    }

    /// The rates of all moments.
    fn graded_rates(&self, epsilon: Gauged, collision: &Collision) -> [Gauged; Q] {
        let (half, open) = (Gauged::from(0.5), Gauged::from(1.0) - epsilon);
        let fluid = match collision {
            Collision::Srt { tau } => [1.0 / tau; 3],
            Collision::Mrt { rates } => [rates.nu, rates.q, rates.m],
        }
        .map(Gauged::from);
        let beyond = Gauged::from(collision.tau()) - half;
        let even = if self.has(Mistake::GradedViscosityOfFluid) {
            fluid[0]
        } else {
            open / (open * 0.5 + beyond)
        };
        let [q, m] = if self.has(Mistake::GradedOddRateOfFluid) {
            [fluid[1], fluid[2]]
        } else {
            let share = if self.has(Mistake::GradedOddRateWithoutOpen) { 1.0.into() } else { open };
            [Gauged::from(1.0) / (half + share * PRODUCT / beyond); 2]
        };
        self.diagonal([even, even, q, even, even, m])
    }
}
