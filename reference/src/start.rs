//! How the fluid starts: in equilibrium, and where solids are, with the solids.
//!
//! The fluid in the cells that a solid covers is made to follow the solid by the PS term. Were it to start with
//! the fluid's motion, a free grain would have to set `m_f = rho_f V` in motion out of its own momentum,
//! and would lose `rho_f/rho_s` of it within a few steps. So a cell starts with the mean velocity of what
//! fills it, by volume: the momentum in the covered part of all cells is then `m_f v`, and that of fluid
//! and grain together what the grain's mass and the fluid around it make it (`coupling/mod.rs`).
//!
//! Where the operator turns populations back, cells start with their solid even if it is at rest: between full cells nothing
//! is ever lost, and what they start with would make the force on the solid swing from step to step for ever
//! (`tests/oracle/momentum_balance.rs`). With the paper's operator such momentum is gone after a step.
//!
//! A scene says thereby: at the start the grain has its velocity and the fluid outside its own, up to the
//! surface. Both are only possible for a moment. Fluid that has to give way takes up its share of the
//! momentum by sound, within a few `a/c_s`: a lone sphere keeps `r/(r + 1/2)` of its velocity, with `r`
//! its density over the fluid's; spinning, it keeps all (`tests/oracle/free_start.rs`).

use crate::coverage::Coverage;
use crate::equilibrium::equilibrium;
use crate::lattice::{Populations, Vec3};
use crate::setup::{Setup, SolidPhase};

/// Puts each cell into the equilibrium of the density and velocity `state(centre)` of the fluid there and,
/// where `coverage` says that solids cover it, of their velocity.
pub fn fill(
    f: &mut [Populations],
    setup: &Setup,
    coverage: Option<&Coverage>,
    state: impl Fn(Vec3) -> (f64, Vec3),
) {
    let solids = setup.solid_phase.as_ref().zip(coverage);
    let body_force = setup.body_force.unwrap_or_else(Vec3::zeros);
    for (cell, f) in f.iter_mut().enumerate() {
        let (rho, u) = state(setup.domain.centre(setup.domain.coordinates(cell)));
        // With a body force the momentum before a collision is half a step behind.
        let u = u - body_force * (0.5 / rho);
        let u = solids.map_or(u, |(phase, coverage)| mean_velocity(phase, coverage, cell, u));
        *f = equilibrium(rho, &u);
    }
}

/// Velocity of a cell by volume: of its solids where these are, of the fluid, `u`, in the rest.
fn mean_velocity(phase: &SolidPhase, coverage: &Coverage, cell: usize, u: Vec3) -> Vec3 {
    let shares = coverage.shares(cell);
    if shares.is_empty() {
        return u;
    }
    let sum: f64 = shares.iter().map(|share| share.epsilon).sum();
    let total = sum.min(1.0);
    // (1 - ε_t) u + Σ_s (ε_t ε_s/Σ ε_s) u_s
    shares.iter().fold((1.0 - total) * u, |mean, share| {
        let u_s = phase.solids[share.solid].velocity_at(&share.arm);
        mean + total * (share.epsilon / sum) * u_s
    })
}
