//! What the collision of every cell needs to know: lattice weights, rates, body force and the rules for solids.

use psmrt_reference::collision::Collision;
use psmrt_reference::graded_viscosity::CUT_MAGIC;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::rates::Rates;

/// Lattice weights of the rest direction, of the six to faces of the cube and of the twelve to its edges.
pub(super) const REST: f64 = 1.0 / 3.0;
pub(super) const FACE: f64 = 1.0 / 18.0;
pub(super) const EDGE: f64 = 1.0 / 36.0;

/// Lattice weight of direction `a`.
pub(in crate::cpu) fn weight(a: usize) -> f64 {
    match a {
        0 => REST,
        1..=6 => FACE,
        _ => EDGE,
    }
}

/// What the collision of every cell needs to know.
#[derive(Clone, Copy, Debug)]
pub(in crate::cpu) struct Rules {
    pub(super) rates: Rates,
    pub(super) body_force: Option<Vec3>,
    pub(super) operator: SolidOperator,
    pub(super) weighting: Weighting,
}

impl Rules {
    /// `operator` and `weighting` are of no account where no cell has solid in it.
    pub(in crate::cpu) fn new(
        collision: &Collision,
        body_force: Option<Vec3>,
        operator: SolidOperator,
        weighting: Weighting,
    ) -> Self {
        let rates = match *collision {
            Collision::Srt { tau } => {
                let s = 1.0 / tau;
                Rates { e: s, eps: s, q: s, nu: s, pi: s, m: s }
            }
            Collision::Mrt { rates } => rates,
        };
        Rules { rates, body_force, operator, weighting }
    }

    /// Whether the solid's part is quadratic in its velocity.
    pub(in crate::cpu) fn has_squares(&self) -> bool {
        match self.operator {
            SolidOperator::NonEquilibriumBounceBack | SolidOperator::Superposition => true,
            SolidOperator::FullBounceBack | SolidOperator::GradedViscosity => false,
        }
    }

    /// Whether a collision in a cell that a solid at rest fills is nothing but an exchange of opposite populations.
    pub(in crate::cpu) fn leaves_filled(&self) -> bool {
        !self.has_squares()
    }

    /// What the solid takes of the momentum, over `B (j - ρ u_s)`.
    pub(in crate::cpu) fn gain(&self) -> f64 {
        match self.operator {
            SolidOperator::NonEquilibriumBounceBack | SolidOperator::Superposition => 1.0,
            SolidOperator::FullBounceBack | SolidOperator::GradedViscosity => 2.0,
        }
    }

    /// `k` in `B/(1 - B) = k ε/(1 - ε)` of graded viscosity.
    pub(super) fn graded_drag(&self) -> f64 {
        let excess = self.rates.tau() - 0.5;
        0.25 * excess * excess / (excess + 0.1)
    }

    /// `(1/s - 1/2)/(1 - ε)` of odd moments in cut cells of graded viscosity.
    pub(super) fn odd_in_cut_cells(&self) -> f64 {
        CUT_MAGIC / (self.rates.tau() - 0.5)
    }

    /// The weight `B` of a cell of total solid fraction `epsilon`.
    pub(in crate::cpu) fn weight_of(&self, epsilon: f64) -> f64 {
        match self.weighting {
            Weighting::SolidFraction => epsilon,
            Weighting::NobleTorczynski => {
                let excess = self.rates.tau() - 0.5;
                epsilon * excess / ((1.0 - epsilon) + excess)
            }
            Weighting::Graded => {
                let solid = self.graded_drag() * epsilon;
                solid / ((1.0 - epsilon) + solid)
            }
        }
    }
}
