//! Warnings of forces that do not act on fluid and free grains alike, and of those that nothing balances.

use psmrt_reference::coupling::Gravity;
use psmrt_reference::domain::Face;
use psmrt_reference::grains::grain::sphere_volume;
use psmrt_reference::lattice::Vec3;

use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::Scene;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    unequal(scene).into_iter().chain(endless_fall(scene)).collect()
}

/// Forces that do not act on fluid and free grains alike.
fn unequal(scene: &Scene) -> Vec<Warning> {
    let Some(part) = &scene.free else { return Vec::new() };
    if let Some(Gravity::OnFluidToo { .. }) = part.settings.gravity {
        let reason = "gravity as a body force: the fluid displaced is the sum of the weights B, so that \
                      the buoyancy is only 58, 80 and 92 % of V g at 4, 8 and 16 cells per diameter";
        return vec![warning(reason, "use `form = \"reduced\"`, with which hydrostatics is exact")];
    }
    let is_balanced = matches!(part.settings.gravity, Some(Gravity::Balanced { .. }));
    if scene.setup.body_force.is_some() && !is_balanced {
        let reason = "a body force on the fluid does not act on the grains as the pressure gradient that \
                      it stands for would: V grad p is missing";
        return vec![warning(
            reason,
            "drive the flow by pressure faces, or add the force to [gravity]",
        )];
    }
    Vec::new()
}

/// A net force along an axis along which nothing holds back fluid and grains.
fn endless_fall(scene: &Scene) -> Option<Warning> {
    let (domain, free) = (&scene.setup.domain, scene.free.as_ref());
    let gravity = free.and_then(|part| part.settings.gravity);
    if matches!(gravity, Some(Gravity::Balanced { .. })) {
        return None;
    }
    let holds = |face: &Face| !matches!(face, Face::Periodic | Face::FreeSlip);
    let solids = scene.setup.solid_phase.iter().any(|phase| !phase.solids.is_empty());
    let all_free = free.map_or(!solids, |part| part.grains.iter().all(|grain| !grain.held));
    if (0..3).any(|axis| domain.faces().axis(axis).iter().any(holds)) || !all_free {
        return None;
    }
    let mut force = scene.setup.body_force.unwrap_or_else(Vec3::zeros) * domain.cell_count() as f64;
    let mut scale = force.norm();
    if let (Some(part), Some(gravity)) = (free, gravity) {
        for grain in &part.grains {
            let fluid = part.settings.fluid_density * sphere_volume(grain.radius);
            let weight = (grain.mass - fluid) * gravity.acceleration();
            (force, scale) = (force + weight, scale + weight.norm());
        }
    }
    let axis = (0..3).find(|&axis| {
        // Forces that cancel to round-off are none.
        domain.is_periodic(axis) && force[axis].abs() > 1e-9 * scale
    })?;
    let name = ["x", "y", "z"][axis];
    let reason = format!(
        "the domain is periodic along {name}, a net force acts along it, and no wall or fixed grain balances \
         it: fluid and grains accelerate together, there is no steady state"
    );
    let remedy = if gravity.is_some() {
        "let a pressure gradient balance the weight (`balance = true` in [gravity]), or close the domain \
         (`kind = \"wall\"`) or fix grains"
    } else {
        "add walls or fixed grains, or remove [body_force]"
    };
    Some(warning(reason, remedy))
}
