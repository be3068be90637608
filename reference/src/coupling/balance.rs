//! Gravity without acceleration of the whole: what balances the weight of grains in a domain that is periodic along gravity.
//!
//! No face of such a domain carries the grains' net weight: fluid and grains accelerate together. In a
//! long vessel a mean pressure gradient balances it: a uniform force per
//! volume on fluid and grains,
//!
//! ```text
//!   G = -1/V Σ_s (m_s - m_f) g
//! ```
//!
//! As the fluid's body force it acts with weight `1 - B` only (`cell_collision.rs`), so that each grain
//! gets what is missing in its cells, `G Σ B_s` (the buoyancy in the pressure gradient). Together that is
//! `V G` in each step, minus the net weight, to round-off: the momentum `Q` (`mod.rs`) stays what it was.

use crate::domain::Domain;
use crate::grains::grain::{Grain, sphere_volume};
use crate::lattice::Vec3;
use crate::solids::Load;

use super::free_grains::mirrors_through;

/// The body force that carries the net weight of all `grains` under `acceleration`: the fluid's set-up must
/// have it, with [`super::Gravity::Balanced`]. Of grains cut by mirror planes the domain holds a part.
pub fn balancing_force(
    domain: &Domain,
    grains: &[Grain],
    fluid_density: f64,
    acceleration: Vec3,
) -> Vec3 {
    let net_mass = |grain: &Grain| {
        let halvings = (0..3).filter(|&axis| mirrors_through(domain, grain, axis)).count();
        let part = [1.0, 0.5, 0.25, 0.125][halvings];
        part * (grain.mass - fluid_density * sphere_volume(grain.radius))
    };
    // G = -1/V Σ_s (m_s - m_f) g
    -grains.iter().map(net_mass).sum::<f64>() / domain.cell_count() as f64 * acceleration
}

/// The loads with the part of the body force that the grains' cells lack; `displaced` is `Σ B_s` of each.
pub fn with_displaced(loads: &[Load], displaced: &[f64], body_force: Vec3) -> Vec<Load> {
    // F_s + G Σ B_s
    let whole =
        |(load, volume): (&Load, &f64)| Load { force: load.force + *volume * body_force, ..*load };
    loads.iter().zip(displaced).map(whole).collect()
}
