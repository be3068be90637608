//! The largest velocity that can be told before a run: what `psmrt check`, `psmrt plan` and all warnings take it to be.

use std::f64::consts::PI;

use psmrt_reference::domain::Face;
use psmrt_reference::lattice::viscosity;

use super::{grains, seepage};
use crate::advice::plan::drag::{Drag, drag};
use crate::scene::Scene;
use crate::seepage::spheres::{diameters, has_image, spheres};

/// The largest velocity that the scene names or that its forces will drive, m/s, and where it comes from.
pub(crate) fn si_velocity(scene: &Scene) -> Option<(f64, String)> {
    if let Some(si_velocity) = scene.si_reference_velocity {
        return Some((si_velocity, "time.reference_velocity".to_owned()));
    }
    if let Some(exact) = &scene.exact {
        return Some((exact.si_top_velocity().abs(), "the exact solution".to_owned()));
    }
    let named = named(scene);
    let driven = if named > 0.0 { None } else { superficial(scene) };
    let (velocity, source) = match settling(scene).filter(|(velocity, _)| *velocity > named) {
        Some(settling) => settling,
        None if named > 0.0 => (named, "the fastest face, grain or start".to_owned()),
        None => driven?,
    };
    Some((velocity * scene.units.si_velocity(), source))
}

/// The fastest face, solid or start, cells per step.
fn named(scene: &Scene) -> f64 {
    let faces = scene.setup.domain.faces();
    let faces = (0..3).flat_map(|axis| faces.axis(axis)).map(|face| match face {
        Face::Wall { velocity } | Face::VelocityInlet { velocity } => velocity.norm(),
        _ => 0.0,
    });
    let solids = scene.setup.solid_phase.iter().flat_map(|phase| &phase.solids);
    let solids = solids.map(|solid| solid.top_speed(&scene.setup.domain));
    faces.chain(solids).chain([scene.initial.top_speed()]).fold(0.0, f64::max)
}

/// How fast the free grain settles that would settle fastest alone, cells per step.
fn settling(scene: &Scene) -> Option<(f64, String)> {
    let (stokes, radius) = grains::stokes_velocity(scene)?;
    let drag = drag(scene).ok()?;
    let scale = viscosity(scene.setup.collision.tau()) / (2.0 * radius);
    let velocity = scale * slowed(stokes / scale, &drag);
    let source = format!(
        "Stokes' law for the fastest grain (drag {:.2} times that, and inertia)",
        drag.factor
    );
    (velocity > 0.0).then_some((velocity, source))
}

/// The superficial velocity that a body force drives through grains that it does not move, cells per step.
pub(crate) fn superficial(scene: &Scene) -> Option<(f64, String)> {
    if has_image(&scene.setup) {
        return seepage::velocity_by_law(scene);
    }
    let (force, spheres) = (scene.setup.body_force?.norm(), spheres(scene));
    let (_, diameter) = diameters(scene)?;
    let nu = viscosity(scene.setup.collision.tau());
    let drag = drag(scene).ok()?;
    // G V = n 6π ν a U
    let resistance: f64 =
        spheres.iter().map(|(_, radius, share)| share * 6.0 * PI * nu * radius).sum();
    let stokes = force * scene.setup.domain.cell_count() as f64 / resistance;
    let velocity = nu / diameter * slowed(stokes * diameter / nu, &drag);
    let source = format!("the body force (drag {:.2} times Stokes', and inertia)", drag.factor);
    (velocity > 0.0).then_some((velocity, source))
}

/// The Reynolds number that a force drives, on the diameter and the superficial velocity, by that which it would drive
/// past a grain alone without inertia.
fn slowed(stokes: f64, drag: &Drag) -> f64 {
    let c = drag.fraction;
    // K + F_3 Re/2,  F_3 = 0.0673 + 0.212 c + 0.0232/(1 - c)^5
    //                                  (Hill, Koch & Ladd, J. Fluid Mech. 448, 243 (2001), Re on the radius there)
    let inertia = 0.0673 + 0.212 * c + 0.0232 / (1.0 - c).max(0.1).powi(5);
    // Re (K + F_3 Re/2) = Re_Stokes
    2.0 * stokes / (drag.factor + (drag.factor * drag.factor + 2.0 * inertia * stokes).sqrt())
}
