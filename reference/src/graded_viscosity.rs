//! Cells that solids fill in part as fluid of graded viscosity: the operator [`SolidOperator::GradedViscosity`].
//!
//! [`SolidOperator::GradedViscosity`]: crate::partial_saturation::SolidOperator::GradedViscosity
//!
//! It is ours, made for beds of fixed grains. A cell of solid fraction `epsilon` is taken for fluid that is
//! `1/(1 - epsilon)` times as viscous, with a weak drag towards the solid; a full cell turns every population back:
//!
//! ```text
//! F  = (1 - B) G + Σ_s 2 B_s (ρ u_s - j),        B/(1 - B) = k ε/(1 - ε),   k = (τ - 1/2)²/(4 (τ - 1/2) + 0.4)
//! u  = (j + F/2)/ρ
//! f* = f + M⁻¹ [Ŝ_ε (m_eq(ρ, u) - m) + (I - Ŝ_ε/2) M F_a(u, F)]
//! even moments:  1/s - 1/2 = (τ - 1/2)/(1 - ε)
//! odd moments:   1/s - 1/2 = Λ_c (1 - ε)/(τ - 1/2),   Λ_c = 0.002
//! ```
//!
//! Why so:
//!
//! * A shear stress crosses a layer that is filled to `epsilon` and stands still behind it as it crosses `1 - epsilon`
//!   cells of fluid, if the layer has the viscosity `ν/(1 - ε)`: the velocity vanishes where the solid begins. For planes
//!   at 45 degrees to the lattice that is exact, for others it is so to first order. A drag does the same for planes of one
//!   direction only, so that as little of it is used as makes a full cell stand still.
//! * In steady creeping flow the populations depend on `tau` by the product of the two `1/s - 1/2` alone, if forces go with
//!   the viscosity (Ginzburg, Verhaeghe & d'Humières, Commun. Comput. Phys. 3, 427 (2008)). In cut cells the product is `Λ_c`
//!   at every `tau`. It is small because the place of a wall between cells hangs on it; 0 would leave the odd moments undamped.
//! * `k` and `Λ_c` are fitted to the drag on arrays of spheres (Zick & Homsy 1982) with 13.9 and 15.8 cells per diameter. `k`
//!   adds an error of first order: it puts walls up to 0.07 cells into the fluid (`tests/oracle/tight_solids.rs`);
//!   `golden/tradeoff/operators.csv` and `golden/operators` have other arrays, grids and Reynolds numbers.
//!
//! What it is not good for: cut cells hold the fluid by their viscosity alone. Where it crosses a cell fast, `U dx/ν` above
//! about 2, they let it in: in a dense bed of 10 cells per diameter at Re = 130 the drag is 10 % too small. And a cell that a
//! moving grain has just filled keeps the fluid's momentum relative to it, which goes to and fro from step to step: the force
//! on a towed grain has noise of about 1 % (`golden/operators`).

use std::sync::LazyLock;

use crate::directions::Q;
use crate::equilibrium::equilibrium_moments;
use crate::forcing::{forced_velocity, source_moments};
use crate::lattice::{Populations, Vec3};
use crate::moments::{CellMatrix, Moments, inverse_moment_matrix, moment_matrix};
use crate::rates::Rates;

/// `Λ_c`, the product of `1/s - 1/2` of even and odd moments in a cut cell.
pub const CUT_MAGIC: f64 = 0.002;

/// `k` in `B/(1 - B) = k epsilon/(1 - epsilon)`.
pub fn drag_factor(tau: f64) -> f64 {
    // k = (τ - 1/2)²/(4 (τ - 1/2) + 0.4)
    let excess = tau - 0.5;
    excess * excess / (4.0 * excess + 0.4)
}

/// `M` and `M⁻¹`
static MATRICES: LazyLock<[CellMatrix; 2]> = LazyLock::new(|| {
    [moment_matrix(), inverse_moment_matrix()].map(|matrix| CellMatrix::from_faer(&matrix))
});

/// The rates of a cell of solid fraction `epsilon`, 0 to 1. Those of a full cell are 0 and 2, beyond what a fluid may have.
pub fn rates(epsilon: f64, tau: f64) -> Rates {
    let open = 1.0 - epsilon;
    // 1/s - 1/2 = (τ - 1/2)/(1 - ε), times (1 - ε)
    let even = open / (0.5 * open + (tau - 0.5));
    // 1/s - 1/2 = Λ_c (1 - ε)/(τ - 1/2)
    let odd = 1.0 / (0.5 + CUT_MAGIC * open / (tau - 0.5));
    Rates { e: even, eps: even, nu: even, pi: even, q: odd, m: odd }
}

/// Post-collision populations of a cell of solid fraction `epsilon` with the momentum `j`, on which `force` acts, that of
/// the solids included.
pub fn collide(
    f: &Populations,
    (rho, j): (f64, Vec3),
    force: &Vec3,
    epsilon: f64,
    tau: f64,
) -> Populations {
    let [to_moments, to_populations] = &*MATRICES;
    let u = forced_velocity(rho, &j, force);
    let (m, m_eq) = (to_moments.times(f), equilibrium_moments(rho, &u));
    let (s, source): (Moments, Moments) =
        (rates(epsilon, tau).diagonal(), source_moments(&u, force));
    let mut change = [0.0; Q];
    for k in 0..Q {
        // Ŝ_ε (m_eq - m) + (I - Ŝ_ε/2) M F
        change[k] = s[k] * (m_eq[k] - m[k]) + (1.0 - 0.5 * s[k]) * source[k];
    }
    let change = to_populations.times(&change);
    std::array::from_fn(|a| f[a] + change[a])
}
