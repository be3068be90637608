//! Which map of stability (`golden/stability`) a scene is compared with, and how fast it is there.

use psmrt_reference::domain::Face;

use super::velocity::{si_velocity, superficial};
use crate::advice::stability::limits::Measured;
use crate::scene::Scene;
use crate::seepage::bed::{DENSE, bed};
use crate::seepage::spheres::solid_fraction;

/// The flow of the maps that a scene is compared with, in words too, and how fast it is: cells per step, and where
/// that comes from. `None` if no velocity is known.
pub(crate) fn mapped(scene: &Scene) -> Option<(Measured, &'static str, f64, String)> {
    // Grains that fill more than a part of the domain make a bed: what flows between them is several times as
    // fast as the superficial velocity, and the ordered bed says more than the shear layer.
    let fraction = match bed(scene).filter(|_| scene.free.is_none()) {
        Some(bed) => bed.fraction,
        None => solid_fraction(scene),
    };
    let phase = scene.setup.solid_phase.as_ref();
    match phase.filter(|_| fraction >= DENSE) {
        Some(phase) => {
            let (speed, source) = superficial_velocity(scene)?;
            Some((Measured::Bed(phase.weighting), "an ordered bed of fixed grains", speed, source))
        }
        None => {
            let (si_speed, source) = si_velocity(scene)?;
            let speed = si_speed / scene.units.si_velocity();
            Some((Measured::Fluid, "a shear layer", speed, source))
        }
    }
}

/// The superficial velocity through a bed, cells per step, and where it comes from: that of an inlet, or
/// what the body force drives.
fn superficial_velocity(scene: &Scene) -> Option<(f64, String)> {
    let faces = scene.setup.domain.faces();
    let inlets = (0..3).flat_map(|axis| faces.axis(axis).map(|face| (axis, face)));
    let fastest = inlets
        .filter_map(|(axis, face)| match face {
            Face::VelocityInlet { velocity } => Some(velocity[axis].abs()),
            _ => None,
        })
        .fold(0.0, f64::max);
    if fastest > 0.0 { Some((fastest, "the inlet".to_owned())) } else { superficial(scene) }
}
