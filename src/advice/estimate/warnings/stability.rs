//! Warnings of scenes beyond what the stability maps (`golden/stability`) found to be stable or accurate.

use psmrt_reference::collision::Preset;
use psmrt_reference::domain::Face;

use super::warning;
use crate::advice::estimate::bed::{DENSE, bed};
use crate::advice::estimate::spheres::solid_fraction;
use crate::advice::estimate::velocity::superficial;
use crate::advice::estimate::{Warning, si_velocity};
use crate::advice::stability::limits::Measured;
use crate::scene::Scene;

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

/// What looks risky.
pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let Some((measured, flow, speed, source)) = mapped(scene) else { return Vec::new() };
    let (collision, tau) = (&scene.setup.collision, scene.setup.collision.tau());
    let Some(limit) = measured.limit(collision) else { return Vec::new() };
    let word = match limit.right.filter(|&right| speed > right && speed <= limit.lives) {
        _ if speed > limit.lives => format!("was stable only up to {}", limit.lives),
        Some(right) => {
            format!("was accurate only up to {right} (and stable up to {})", limit.lives)
        }
        None => return Vec::new(),
    };
    let reason = format!(
        "the velocity from {source} is {speed:.3} cells per time step; at tau = {tau:.4} {flow} with this \
         collision {word} (golden/stability)"
    );
    let other = measured.limit_of(Preset::DHumieres, tau).filter(|other| other.lives > limit.lives);
    let remedy = match other {
        Some(other) => format!(
            "use MRT with d'Humieres' rates (stable up to {}), a finer grid, or a smaller velocity",
            other.lives
        ),
        None => "use a finer grid, or a shorter time step with tau further from 1/2 (a higher viscosity), or \
                 a smaller velocity"
            .to_owned(),
    };
    vec![warning(reason, remedy)]
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
