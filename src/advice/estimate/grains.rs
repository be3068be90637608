//! What can be told about free grains before they move.

use std::f64::consts::PI;

use psmrt_reference::coupling::{Gravity, InternalFluid, is_implicit};
use psmrt_reference::domain::{FACE_NAMES, Face};
use psmrt_reference::grains::grain::{Grain, sphere_volume};
use psmrt_reference::grains::motion::Substeps;
use psmrt_reference::lattice::{Vec3, viscosity};

use super::contacts;
use super::number::{Number, number};
use crate::scene::check::hardness::{Burden, Overlaps};
use crate::scene::{FreePart, Scene};

/// Gravity, and what of a grain's mass it acts on.
fn pull(part: &FreePart) -> Vec3 {
    part.settings.gravity.map_or_else(Vec3::zeros, |gravity| gravity.acceleration())
}

/// Weight less buoyancy, lattice units.
fn buoyant_weight(part: &FreePart, grain: &Grain) -> f64 {
    (grain.mass - sphere_volume(grain.radius)).abs() * pull(part).norm()
}

/// The grains that move.
pub(crate) fn free(part: &FreePart) -> impl Iterator<Item = &Grain> {
    part.grains.iter().filter(|grain| !grain.held)
}

/// The largest velocity at which a free grain would settle by Stokes' law alone in the fluid, cells per time step, and
/// that grain's radius; `None` without gravity.
pub(super) fn stokes_velocity(scene: &Scene) -> Option<(f64, f64)> {
    let part = scene.free.as_ref()?;
    let nu = viscosity(scene.setup.collision.tau());
    // (m_s - m_f) g = 6 π ν ρ a v
    let velocity = |grain: &Grain| buoyant_weight(part, grain) / (6.0 * PI * nu * grain.radius);
    let all = free(part).map(|grain| (velocity(grain), grain.radius));
    all.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(velocity, _)| *velocity > 0.0)
}

/// What weight and impacts do to the contacts.
pub(super) fn burden(scene: &Scene, part: &FreePart) -> Burden {
    Burden::new(&part.grains, &pull(part), &scene.setup.domain, scene.around())
}

/// The derived numbers.
pub(super) fn numbers(scene: &Scene) -> Vec<Number> {
    let Some(part) = &scene.free else { return Vec::new() };
    let units = &scene.units;
    let ratio = |grain: &Grain| grain.mass / sphere_volume(grain.radius);
    let (low, high) = free(part)
        .map(ratio)
        .fold((f64::INFINITY, 0.0_f64), |(low, high), ratio| (low.min(ratio), high.max(ratio)));
    let note = if high > low { format!("the heaviest has {high:.3}") } else { String::new() };
    let count = free(part).count();
    let substeps = part.substeps().unwrap_or(0);
    let chosen = match part.setup.substeps {
        Substeps::Automatic => "25 in the shortest contact",
        Substeps::Fixed(_) => "as given",
    };
    let mut numbers =
        vec![number("free grains", count as f64, "", format!("of {}", part.grains.len()))];
    if !scene.is_dry {
        numbers.push(number("density ratio", low, "", note));
    }
    numbers.extend(contacts::numbers(scene, part, burden(scene, part).speed()));
    numbers.push(number("sub-steps", f64::from(substeps), "", format!("in a time step; {chosen}")));
    if let Some((settle, _)) = stokes_velocity(scene).filter(|_| !scene.is_dry) {
        let note = format!(
            "{settle:.2e} cells per time step; of the fastest grain, alone and without inertia"
        );
        numbers.push(number("Stokes velocity", settle * units.si_velocity(), "m/s", note));
    }
    let burden = burden(scene, part);
    if burden.stiffness() > 0.0 {
        let Overlaps { in_bed, one_on_one, in_impact } = burden.overlaps(&part.setup.law);
        let note = "of a diameter: the heaviest grain at rest on the smallest";
        numbers.push(number("overlap", one_on_one, "", note));
        let note = "of a diameter: the mean, at the bottom of a bed of all free grains";
        numbers.push(number("overlap in a bed", in_bed, "", note));
        let note = "of the smallest diameter: the heaviest grain falls on the smallest";
        numbers.push(number("overlap of impact", in_impact, "", note));
    }
    numbers
}

/// The models that are on, with the keys that say so.
pub(super) fn models(scene: &Scene) -> Vec<String> {
    let Some(part) = &scene.free else { return Vec::new() };
    let settings = &part.settings;
    let inertia = match settings.internal_fluid {
        InternalFluid::Lagged => "added back with a lag of one step",
        InternalFluid::Kept => "retained",
    };
    let averaged = if settings.average_loads { ", mean force of two steps" } else { "" };
    let solved = if is_implicit(&scene.setup) {
        "; their velocity in a collision is solved for before it (solid.operator = \"full_bounce_back\")"
    } else {
        ""
    };
    let mut models = vec![if scene.is_dry {
        "free grains: DEM (motion = \"free\"), alone: the scene has no fluid".to_owned()
    } else {
        format!("free grains: DEM (motion = \"free\"); internal mass {inertia}{averaged}{solved}")
    }];
    models.push(contacts::model(scene, part));
    if let Some(lubrication) = part.setup.lubrication {
        models.push(format!(
            "lubrication: between gaps of {:.3e} and {:.3e} m{} (lubrication)",
            lubrication.smallest_gap * scene.units.si_dx,
            lubrication.cutoff_gap * scene.units.si_dx,
            if lubrication.while_touching { "" } else { ", not in contacts" }
        ));
    }
    match settings.gravity {
        Some(Gravity::Reduced { .. }) if scene.is_dry => {
            models.push("gravity: all of its weight acts on a grain".to_owned());
        }
        Some(Gravity::Reduced { .. }) => {
            models
                .push("gravity: reduced pressure, weight less buoyancy acts on grains".to_owned());
        }
        Some(Gravity::Balanced { .. }) => {
            models.push(
                "gravity: reduced pressure, the net weight of all grains carried by a uniform pressure gradient"
                    .to_owned(),
            );
        }
        Some(Gravity::OnFluidToo { .. }) => {
            models.push("gravity: as a body force on the fluid, and on the grains".to_owned());
        }
        None => {}
    }
    for axis in 0..3 {
        for side in 0..2 {
            if is_sieve(&scene.setup.domain.faces().axis(axis)[side]) {
                let name = FACE_NAMES[axis][side];
                models
                    .push(format!("face {name}: holds grains back as a sieve (open to the fluid)"));
            }
        }
    }
    models
}

fn is_sieve(face: &Face) -> bool {
    matches!(face, Face::VelocityInlet { .. } | Face::FreeOutflow) || face.held_density().is_some()
}
