//! The viscosity of water with grains in it, by the shear stress on two walls that move against each other.

use psmrt_reference::domain::{Domain, Face};
use psmrt_reference::lattice::{Vec3, viscosity};
use serde_json::json;

use super::conclusion::{Conclusion, is_steady, steady_words};
use crate::engine::Coupled;
use crate::output::walls;
use crate::run::End;
use crate::scene::{Scene, What};
use crate::seepage::spheres::{diameters, solid_fraction};

/// Of a record of `walls` along whose axis a shear is held.
pub(super) fn viscosity_of_mixture(
    scene: &Scene,
    engine: &Coupled,
    end: End,
) -> Option<Conclusion> {
    scene.records.iter().find(|record| record.what == What::Walls)?;
    let fraction = solid_fraction(scene);
    let (axis, [low, high]) = sheared_axis(&scene.setup.domain)?;
    if fraction == 0.0 || scene.drives.is_some() || scene.setup.body_force.is_some() {
        return None;
    }
    let (units, domain) = (&scene.units, &scene.setup.domain);
    let lengths = domain.cells().map(|n| n as f64 * units.si_dx);
    let along = (high - low).normalize();
    let forces = walls::forces(scene, engine);
    // Fluid and grains along the shear, N.
    let on = |face: &str| -> Option<f64> {
        let found = forces.iter().find(|forces| forces.face == face)?;
        Some((Vec3::from(found.fluid) + Vec3::from(found.grains)).dot(&along))
    };
    let name = ["x", "y", "z"][axis];
    let (on_low, on_high) = (on(&format!("{name}_low"))?, on(&format!("{name}_high"))?);
    let si_area = lengths.iter().product::<f64>() / lengths[axis];
    let si_stress = 0.5 * (on_low - on_high) / si_area;
    let si_rate = (high - low).norm() * units.si_velocity() / lengths[axis];
    let si_viscosity = viscosity(scene.setup.collision.tau()) * units.si_viscosity();
    // η/η₀ = τ/(η₀ γ̇)
    let relative = si_stress / (units.si_density * si_viscosity * si_rate);
    let intrinsic = (relative - 1.0) / fraction;
    let (_, largest) = diameters(scene)?;
    let si_diameter = largest * units.si_dx;
    let re = si_rate * si_diameter * si_diameter / si_viscosity;
    let balance = (on_low + on_high).abs() / on_low.abs().max(on_high.abs());
    let text = format!(
        "viscosity of the mixture: {relative:.5} times the fluid's (shear stress {si_stress:.4e} Pa on the walls along {name}, which \
         differ by {:.1e} of it; shear rate {si_rate:.4e} 1/s); solid fraction {fraction:.4}, intrinsic viscosity \
         {intrinsic:.3} (Einstein: 2.5, dilute, without inertia, far from walls); Re of the grains {re:.2e}; {}",
        balance,
        steady_words(end)
    );
    let json = json!({
        "what": "viscosity", "relative_viscosity": relative, "intrinsic_viscosity": intrinsic, "solid_fraction": fraction,
        "shear_stress_Pa": si_stress, "shear_rate_per_s": si_rate, "imbalance": balance, "reynolds": re,
        "steady": is_steady(end),
    });
    Some(Conclusion { text, json })
}

/// The only axis along which the domain is not periodic, if its faces are walls with different velocities: with these.
fn sheared_axis(domain: &Domain) -> Option<(usize, [Vec3; 2])> {
    let mut closed = (0..3).filter(|&axis| !domain.is_periodic(axis));
    let (Some(axis), None) = (closed.next(), closed.next()) else { return None };
    match domain.faces().axis(axis) {
        [Face::Wall { velocity: low }, Face::Wall { velocity: high }] if low != high => {
            Some((axis, [low, high]))
        }
        _ => None,
    }
}
