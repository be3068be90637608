//! The implicit coupling of free grains: the velocity that a grain has in a collision is solved for before it.
//!
//! Under full bounce-back (SC3) a full cell gives its solid `2 (j - ρ u_s)`: its momentum relative to the solid is turned
//! round. Let a grain of mass `M` move with `v_n` through the collision, and be pushed by what it takes afterwards (the
//! explicit coupling of `mod.rs`). With `e` the velocity of the fluid inside relative to the grain and `r = m_f/M`,
//!
//! ```text
//!   explicit:   e → -e, the grain gains 2 r e:             e_(n+1) = -(1 + 2 r) e_n         grows at any density
//!   implicit:   e and the grain's velocity of the end:     e_(n+1) = -1/(1 + 2 r) e_n       decays at any density
//! ```
//!
//! So the grain collides with a velocity `U'`, `ω'` that it would have at the end of the step if nothing but what is
//! known acted on it. As `F` and `T` are linear in it, and the cells enter by their sums ([`Grip`]), that is one system of
//! six equations for each grain:
//!
//! ```text
//!   M (U' - v_n) = F(U', ω') + E + C̃          F(U, ω) = J - m U - ω × S
//!   I (ω' - ω_n) = T(U', ω') + E_T + C̃_T      T(U, ω) = L - S × U - Θ ω
//! ```
//!
//! `E` is weight, buoyancy and the lagged inertia of the fluid inside, `C̃` what the contacts are expected to give
//! ([`LastStep`](super::LastStep)). The fluid then collides with `U'`, `ω'`, the grain receives what the fluid has lost,
//! and the DEM moves it from `v_n` on: real contacts act on it, `C̃` does not. So the balance of momentum of `mod.rs` holds
//! whatever `U'` is.
//!
//! Without `C̃` a grain that rests on another one or on a wall, which the contact holds, would be predicted to fall, and
//! would show the fluid the velocity `W/(M + m)` in each step: it would pump. With all of it, a rebound would be
//! repeated into the fluid a step after it was over; hence the bound.
//!
//! Source: ours, for the operator SC3. Implicit couplings of this kind, of particles to immersed boundaries: Kempe &
//! Fröhlich, J. Comput. Phys. 231, 3663 (2012); Tschisgale, Kempe & Fröhlich, J. Comput. Phys. 339, 432 (2017).

use nalgebra::{Matrix3, Matrix6, Vector6};
use rayon::prelude::*;

use crate::domain::Domain;
use crate::grains::contact::Motion;
use crate::grains::grain::Grain;
use crate::lattice::{Vec3, density, momentum};
use crate::partial_saturation::share_weight;
use crate::solids::{Grip, Load};
use crate::solver::Solver;

use super::free_grains::{FreeGrains, mirrors_through};

/// What full bounce-back takes of the momentum, over `B (j - ρ u_s)`.
const TAKEN: f64 = 2.0;

/// How each solid of a fluid holds it, under [`crate::partial_saturation::SolidOperator::FullBounceBack`].
pub fn grips(fluid: &Solver) -> Vec<Grip> {
    let (Some(phase), Some(coverage)) = (&fluid.setup().solid_phase, fluid.coverage()) else {
        return Vec::new();
    };
    let tau = fluid.setup().collision.tau();
    let mut grips = vec![Grip::default(); phase.solids.len()];
    for (cell, f) in fluid.populations().iter().enumerate() {
        let shares = coverage.shares(cell);
        if shares.is_empty() {
            continue;
        }
        let (rho, j) = (density(f), momentum(f));
        let epsilons = shares.iter().map(|share| share.epsilon);
        share_weight(phase.weighting, tau, epsilons, |s, weight| {
            let (grip, r) = (&mut grips[shares[s].solid], &shares[s].arm);
            let (b, b_rho) = (TAKEN * weight, TAKEN * weight * rho);
            grip.impulse += b * j;
            grip.moment += r.cross(&(b * j));
            grip.mass += b_rho;
            grip.mass_arm += b_rho * r;
            grip.inertia +=
                b_rho * (Matrix3::from_diagonal_element(r.norm_squared()) - r * r.transpose());
            grip.displaced += weight;
        });
    }
    grips
}

/// The grips with the part of the body force that the grains' cells lack ([`super::with_displaced`]).
pub fn grips_with_displaced(mut grips: Vec<Grip>, body_force: Vec3) -> Vec<Grip> {
    for grip in &mut grips {
        // J + G Σ B_s
        grip.impulse += grip.displaced * body_force;
    }
    grips
}

impl FreeGrains {
    /// The motion with which each grain is to collide with a fluid that it holds by its grip. `grips` are in the order of
    /// the grains.
    pub fn motion_in_collision(&self, grips: &[Grip]) -> Vec<Motion> {
        let grains = self.system().grains();
        // E: what acts besides contacts, but for the load.
        let known = self.outside_loads(&vec![Load::default(); grains.len()]);
        let each = grains.par_iter().zip(known).zip(self.last_steps()).zip(grips);
        each.map(|(((grain, mut known), last), grip)| {
            let contacts = last.expected_contacts();
            known.force += contacts.force;
            known.torque += contacts.torque;
            solve(grain, &mirrored(self.domain(), grain, grip), &known)
        })
        .collect()
    }
}

/// `U'` and `ω'` of a grain on which `known` acts besides the load.
fn solve(grain: &Grain, grip: &Grip, known: &Load) -> Motion {
    let before = Motion { velocity: grain.velocity, angular_velocity: grain.angular_velocity };
    if grain.held {
        return before;
    }
    let load = load_by_grip(grip, &before);
    let (force, torque) = (load.force + known.force, load.torque + known.torque);
    // For δ = U' - v_n and φ = ω' - ω_n:
    //   (M + m) δ - S × φ = F(v_n, ω_n) + E + C̃
    //   S × δ + (I + Θ) φ = T(v_n, ω_n) + E_T + C̃_T
    let across = grip.mass_arm.cross_matrix();
    let mut matrix = Matrix6::zeros();
    matrix
        .fixed_view_mut::<3, 3>(0, 0)
        .copy_from(&Matrix3::from_diagonal_element(grain.mass + grip.mass));
    matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&-across);
    matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&across);
    matrix
        .fixed_view_mut::<3, 3>(3, 3)
        .copy_from(&(Matrix3::from_diagonal_element(grain.inertia) + grip.inertia));
    let right = Vector6::new(force.x, force.y, force.z, torque.x, torque.y, torque.z);
    // Symmetric, and positive definite as long as densities are: else the guard is about to stop the run.
    let Some(factors) = matrix.cholesky() else { return before };
    let change = factors.solve(&right);
    Motion {
        velocity: before.velocity + Vec3::new(change[0], change[1], change[2]),
        angular_velocity: before.angular_velocity + Vec3::new(change[3], change[4], change[5]),
    }
}

/// The load on a solid that holds the fluid by `grip` and moves so.
pub fn load_by_grip(grip: &Grip, motion: &Motion) -> Load {
    let Motion { velocity: u, angular_velocity: w } = motion;
    Load {
        // F(U, ω) = J - m U - ω × S
        force: grip.impulse - grip.mass * u - w.cross(&grip.mass_arm),
        // T(U, ω) = L - S × U - Θ ω
        torque: grip.moment - grip.mass_arm.cross(u) - grip.inertia * w,
    }
}

/// The grip of a grain whose centre lies on mirror planes, of which the fluid holds a part: with the mirror images of that
/// part.
fn mirrored(domain: &Domain, grain: &Grain, grip: &Grip) -> Grip {
    let mut grip = *grip;
    for axis in (0..3).filter(|&axis| mirrors_through(domain, grain, axis)) {
        // Of vectors the part along the normal cancels, of axial vectors the part across it, and of tensors what is
        // mixed.
        let along = |i: usize| if i == axis { 1.0 } else { 0.0 };
        let across = |i: usize| 1.0 - along(i);
        let mixed = |i: usize, j: usize| (i == axis) != (j == axis);
        grip.impulse = Vec3::from_fn(|i, _| 2.0 * across(i) * grip.impulse[i]);
        grip.mass_arm = Vec3::from_fn(|i, _| 2.0 * across(i) * grip.mass_arm[i]);
        grip.moment = Vec3::from_fn(|i, _| 2.0 * along(i) * grip.moment[i]);
        grip.mass *= 2.0;
        grip.inertia =
            Matrix3::from_fn(|i, j| if mixed(i, j) { 0.0 } else { 2.0 * grip.inertia[(i, j)] });
        grip.displaced *= 2.0;
    }
    grip
}
