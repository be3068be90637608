//! Warnings of contacts that are too soft or too expensive.

use psmrt_reference::grains::hold::DEEPEST;
use psmrt_reference::grains::laws::Law;

use crate::advice::estimate::grains::burden;
use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::check::hardness::{ONE_ON_ONE, Overlaps};
use crate::scene::{FreePart, Scene};

/// An impact that goes deeper, in diameters, is soft.
const DEEP_IMPACT: f64 = 0.1;

/// More sub-steps than this in a time step begin to cost as much as the fluid.
const MANY: u32 = 100;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let Some(part) = &scene.free else { return Vec::new() };
    let mut warnings: Vec<Warning> = softness(scene, part).into_iter().collect();
    if let Some(count) = part.substeps().ok().filter(|&count| count > MANY && !scene.is_dry) {
        let reason = format!(
            "the grains make {count} sub-steps in a time step: they may cost more than the fluid"
        );
        let remedy = match part.setup.law {
            Law::Linear(_) => {
                "a shorter time step needs fewer of them, and so do longer contacts (contact.duration)"
            }
            Law::Hertz(_) => {
                "a shorter time step needs fewer of them, and so does a softer modulus (contact.youngs_modulus)"
            }
        };
        warnings.push(warning(reason, remedy));
    }
    warnings
}

/// What happens to grains whose contacts are too soft, and what to do.
fn softness(scene: &Scene, part: &FreePart) -> Option<Warning> {
    let burden = burden(scene, part);
    let Overlaps { in_bed, one_on_one, in_impact } = burden.overlaps(&part.setup.law);
    let at_rest = in_bed.max(one_on_one);
    // Of a diameter here, of a radius there.
    let lost = 0.5 * DEEPEST;
    let reason = if at_rest > lost {
        format!(
            "weight makes grains overlap by {at_rest:.1e} of a diameter: the contacts are too soft for it, and the \
             run stops when a grain overlaps another or a face by {lost} of its diameter"
        )
    } else if at_rest > 1.01 * ONE_ON_ONE {
        format!("weight makes grains overlap by {at_rest:.1e} of a diameter")
    } else if in_impact > lost {
        format!(
            "a grain that falls on the smallest one overlaps it by {in_impact:.1e} of its diameter; the run stops at \
             {lost}"
        )
    } else if in_impact > DEEP_IMPACT {
        format!(
            "a grain that falls on the smallest one overlaps it by {in_impact:.1e} of its diameter"
        )
    } else {
        return None;
    };
    let remedy = match part.setup.law {
        Law::Linear(_) => format!(
            "leave `stiffness` and `duration` of [contact] out to have them chosen, or use contact.stiffness = {:.2e} \
             (N/m) or more",
            1.01 * burden.stiffness() * scene.units.si_stiffness()
        ),
        Law::Hertz(law) => format!(
            "use contact.youngs_modulus = {:.2e} (Pa) or more",
            1.01 * burden.asks_of(&part.setup.law)
                * law.material.youngs_modulus
                * scene.units.si_pressure()
        ),
    };
    Some(warning(reason, remedy))
}
