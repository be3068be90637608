//! The partially saturated (PS) term: how a solid acts on the fluid that shares its cells.
//!
//! The literature calls the method the partially saturated method (PSM) or partially saturated cells method, and
//! counts it among the immersed moving boundary (IMB) methods. Its solid operators are numbered there: SC1 is
//! [`SolidOperator::NonEquilibriumBounceBack`], SC2 [`SolidOperator::Superposition`], SC3
//! [`SolidOperator::FullBounceBack`]. [`SolidOperator::GradedViscosity`] is ours.
//!
//! Source: Noble & Torczynski, Int. J. Mod. Phys. C 9, 1189 (1998), the paper's reference 5, as the
//! paper uses it in Eqs. 4 to 6; see `ERRATA.md` for what is misprinted there. Inside this term the
//! velocity of the fluid is the bare `j/rho`, also where a body force acts.

use crate::collision::CollisionOperator;
use crate::directions::{OPPOSITE, Q};
use crate::equilibrium::equilibrium;
use crate::graded_viscosity;
use crate::lattice::{Populations, Vec3, c};

/// The weight `B` of a cell as a function of its solid fraction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Weighting {
    /// `B = epsilon`.
    SolidFraction,
    /// Noble and Torczynski's `B(epsilon, tau)`.
    #[default]
    NobleTorczynski,
    /// The drag of [`SolidOperator::GradedViscosity`], and of nothing else.
    Graded,
}

impl Weighting {
    /// The weight `B` in 0..=1 of a cell of solid fraction `epsilon` at relaxation time `tau`.
    pub fn weight(self, epsilon: f64, tau: f64) -> f64 {
        match self {
            Weighting::SolidFraction => epsilon,
            // B = ε (τ - 1/2) / [(1 - ε) + (τ - 1/2)]
            Weighting::NobleTorczynski => epsilon * (tau - 0.5) / ((1.0 - epsilon) + (tau - 0.5)),
            // B = k ε / [(1 - ε) + k ε]
            Weighting::Graded => {
                let solid = graded_viscosity::drag_factor(tau) * epsilon;
                solid / ((1.0 - epsilon) + solid)
            }
        }
    }
}

/// The weights of the solids in one cell.
///
/// `B` is not linear in the solid fraction, so the cell is weighed once,
/// `B_t = B(min(1, sum epsilon_s), tau)`, and shared out in proportion to the `epsilon_s`: two solids
/// that fill half a cell each weigh what one solid weighs that fills it.
/// Calls `visit(s, B_s)` for each solid and returns `B_t`.
pub fn share_weight(
    weighting: Weighting,
    tau: f64,
    epsilons: impl Iterator<Item = f64> + Clone,
    mut visit: impl FnMut(usize, f64),
) -> f64 {
    let sum: f64 = epsilons.clone().sum();
    // B_t = B(min(1, Σ ε_s), τ)
    let total = weighting.weight(sum.min(1.0), tau);
    for (s, epsilon) in epsilons.enumerate() {
        // B_s = B_t ε_s / Σ ε_s
        visit(s, total * (epsilon / sum));
    }
    total
}

/// Which collision takes place in the solid part of a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum SolidOperator {
    /// Bounce-back of the non-equilibrium part, the paper's Eq. 5 (SC1 of the literature).
    #[default]
    NonEquilibriumBounceBack,
    /// Equilibrium of the solid plus the fluid's relaxed non-equilibrium part (SC2).
    Superposition,
    /// Bounce-back of the whole populations about the solid's velocity (SC3). Solids are tight with it: no fluid passes
    /// through cells that they fill. They take twice the momentum of the first two, so that
    /// free grains are coupled implicitly (`coupling/implicit.rs`).
    FullBounceBack,
    /// Cut cells as fluid of graded viscosity ([`crate::graded_viscosity`]); full cells as under full bounce-back. The most
    /// accurate of the four for beds of fixed grains.
    GradedViscosity,
}

/// The state of a cell that the solid operators need.
pub struct CellState<'a> {
    /// Populations before the collision.
    pub f: &'a Populations,
    /// Density.
    pub rho: f64,
    /// Bare velocity `j/rho`.
    pub u: Vec3,
}

impl SolidOperator {
    /// Whether a full cell turns every population back. What moves between two full cells then goes to and fro between them
    /// for ever, and the force on the solid with it: such a cell must start with its solid (`start.rs`).
    pub fn turns_populations_back(self) -> bool {
        matches!(self, SolidOperator::FullBounceBack | SolidOperator::GradedViscosity)
    }

    /// Whether the velocity that a free grain has in a collision is solved for before it (`coupling/implicit.rs`): with
    /// the one that it has come with, this operator is unstable.
    pub fn asks_for_implicit_coupling(self) -> bool {
        self == SolidOperator::FullBounceBack
    }

    /// The change `Lambda` of the populations in a cell full of solid that moves with `u_p`, as a
    /// function of `u_p`: what does not depend on the solid is worked out once for all solids in
    /// the cell. `None` for an operator that is no sum of a fluid and a solid part.
    pub fn prepare(self, cell: &CellState<'_>, fluid: &CollisionOperator) -> Option<PreparedSolid> {
        let fixed = match self {
            SolidOperator::NonEquilibriumBounceBack => bounce_back(cell),
            SolidOperator::Superposition => superposition(cell, fluid),
            SolidOperator::FullBounceBack => reflection(cell),
            SolidOperator::GradedViscosity => return None,
        };
        let turns = self == SolidOperator::FullBounceBack;
        Some(PreparedSolid { fixed, rho: cell.rho, turns })
    }
}

/// A solid operator with the state of its cell put in.
pub struct PreparedSolid {
    /// `Lambda - f_eq(rho, u_p)`, and `+ f_-a^eq(rho, u_p)` if it `turns` the solid's equilibrium too.
    fixed: Populations,
    rho: f64,
    turns: bool,
}

impl PreparedSolid {
    /// `Lambda` for a solid that moves with `u_p` here.
    pub fn lambda(&self, u_p: &Vec3) -> Populations {
        let f_eq_solid = equilibrium(self.rho, u_p);
        let mut lambda = [0.0; Q];
        for a in 0..Q {
            lambda[a] = f_eq_solid[a] + self.fixed[a];
            if self.turns {
                lambda[a] -= f_eq_solid[OPPOSITE[a]];
            }
        }
        lambda
    }
}

/// Eq. 5 of the paper (sign corrected) less its term `f_a^eq(rho, u_p)`.
fn bounce_back(cell: &CellState<'_>) -> Populations {
    let f = cell.f;
    let f_eq = equilibrium(cell.rho, &cell.u);
    let mut fixed = [0.0; Q];
    for a in 0..Q {
        // Λ_a = f_-a - f_-a^eq(ρ, u) + f_a^eq(ρ, u_p) - f_a                    (Eq. 5, corrected)
        fixed[a] = f[OPPOSITE[a]] - f_eq[OPPOSITE[a]] - f[a];
    }
    fixed
}

/// Full bounce-back less its terms in `u_p`.
///
/// Source: Holdych (2003); as SC3 in waLBerla and lbmpy: `f_-a - f_-a^eq(ρ, u_p) + f_a^eq(ρ, u_p) - f_a`. Of the solid's
/// equilibrium only the part that is odd in `c_a` is left, and of the populations too.
fn reflection(cell: &CellState<'_>) -> Populations {
    let f = cell.f;
    let mut fixed = [0.0; Q];
    for a in 0..Q {
        // Λ_a = f_-a - f_-a^eq(ρ, u_p) + f_a^eq(ρ, u_p) - f_a
        fixed[a] = f[OPPOSITE[a]] - f[a];
    }
    fixed
}

/// The superposition operator less its term `f_a^eq(rho, u_p)`.
///
/// Source: Holdych, PhD thesis, Univ. Illinois (2003); Strack & Cook, Int. J. Numer. Meth. Fluids
/// 55, 103 (2007), who write `f_eq(rho, u_p) - f + (1 - 1/tau)(f - f_eq(rho, u))`. The last term is
/// the non-equilibrium part that the fluid's own collision leaves: under MRT it is
/// `(I - M⁻¹ S-hat M)(f - f_eq) = f - f_eq + Omega`, each moment with its own rate.
fn superposition(cell: &CellState<'_>, fluid: &CollisionOperator) -> Populations {
    let f_eq = equilibrium(cell.rho, &cell.u);
    let omega = fluid.relaxation(cell.f, cell.rho, &cell.u);
    let mut fixed = [0.0; Q];
    for a in 0..Q {
        // Λ_a = f_a^eq(ρ, u_p) - f_a + [f_a - f_a^eq(ρ, u) + Ω_a]
        fixed[a] = omega[a] - f_eq[a];
    }
    fixed
}

/// Force on a solid from its part `weight * lambda` of a collision: the momentum that the fluid
/// loses.
pub fn force(weight: f64, lambda: &Populations) -> Vec3 {
    // F_s = -B_s Σ_a Λ_a c_a
    let gained: Vec3 = (0..Q).map(|a| lambda[a] * c(a)).sum();
    -weight * gained
}
