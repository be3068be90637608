//! What can be told about contacts: their numbers, and in which words they are named.

use psmrt_reference::grains::grain::{Grain, sphere_volume};
use psmrt_reference::grains::hertz::{HertzLaw, RESOLVED_OVERLAP};
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::laws::Law;

use super::number::{Number, number};
use crate::scene::{FreePart, Scene};

/// The grains that move.
fn free(part: &FreePart) -> impl Iterator<Item = &Grain> {
    part.grains.iter().filter(|grain| !grain.held)
}

/// The numbers of the contact law. `impact`: the largest speed at which a grain falls on something, cells per time step.
pub(super) fn numbers(scene: &Scene, part: &FreePart, impact: f64) -> Vec<Number> {
    match &part.setup.law {
        Law::Linear(law) => linear(scene, part, law),
        Law::Hertz(law) => hertz(scene, part, law, impact),
    }
}

fn linear(scene: &Scene, part: &FreePart, law: &ContactLaw) -> Vec<Number> {
    let units = &scene.units;
    let pair = 0.5 * free(part).map(|grain| grain.mass).fold(f64::INFINITY, f64::min);
    let duration = law.duration(pair);
    let restitution =
        format!("coefficient of restitution {:.3}, two of the lightest", law.restitution(pair));
    vec![
        number(
            "contact duration",
            duration * units.si_dt,
            "s",
            format!("{duration:.2} time steps, of two of the lightest"),
        ),
        number("stiffness", law.stiffness * units.si_stiffness(), "N/m", "normal spring"),
        number("damping", law.damping * units.si_damping(), "N s/m", restitution),
    ]
}

fn hertz(scene: &Scene, part: &FreePart, law: &HertzLaw, impact: f64) -> Vec<Number> {
    let units = &scene.units;
    let Some(lightest) = free(part).min_by(|one, two| one.mass.total_cmp(&two.mass)) else {
        return Vec::new();
    };
    let (radius, mass) = (0.5 * lightest.radius, 0.5 * lightest.mass);
    // The fastest impact, or the deepest that sub-steps resolve.
    let (duration, which) = match impact {
        speed if speed > 0.0 => {
            let si_speed = speed * units.si_velocity();
            (law.duration(radius, mass, speed), format!("that meet at {si_speed:.2e} m/s"))
        }
        _ => {
            let overlap = RESOLVED_OVERLAP * lightest.radius;
            let duration = law.at(overlap, radius, mass).duration(mass);
            (duration, format!("that overlap by {RESOLVED_OVERLAP} of the radius"))
        }
    };
    let material = law.material;
    // Of the grain for which it is shortest.
    let density = |grain: &Grain| grain.mass / sphere_volume(grain.radius);
    let time = |grain: &Grain| material.rayleigh_time(grain.radius, density(grain));
    let rayleigh = free(part).map(time).fold(f64::INFINITY, f64::min);
    let substep = 1.0 / f64::from(part.substeps().unwrap_or(1));
    let modulus = format!("of the grains; Poisson's ratio {}", material.poisson_ratio);
    let share = format!("of Rayleigh's time, {:.3e} s", rayleigh * units.si_dt);
    vec![
        number(
            "contact duration",
            duration * units.si_dt,
            "s",
            format!("{duration:.2} time steps, of two of the lightest {which}"),
        ),
        number("Young's modulus", material.youngs_modulus * units.si_pressure(), "Pa", modulus),
        number("restitution", law.restitution(), "", "at any speed"),
        number("sub-step", substep / rayleigh, "", share),
    ]
}

/// The contact law in words, with the keys that say so.
pub(super) fn model(scene: &Scene, part: &FreePart) -> String {
    let keys = "(contact; keys that are absent take defaults)";
    match &part.setup.law {
        Law::Linear(law) => {
            let friction = match law.friction {
                Some(friction) => format!(
                    "friction {}, tangential stiffness {:.4} of the normal one",
                    friction.coefficient,
                    friction.stiffness / law.stiffness
                ),
                None => "smooth".to_owned(),
            };
            let rolling = rolling(law.rolling.map(|rolling| rolling.coefficient));
            format!("contact: spring and dashpot, {friction}{rolling} {keys}")
        }
        Law::Hertz(law) => {
            let friction = match law.friction {
                Some(friction) => format!("friction {friction}"),
                None => "smooth".to_owned(),
            };
            let rolling = rolling(law.rolling.map(|rolling| rolling.coefficient));
            format!(
                "contact: elastic spheres (Hertz and Mindlin), Young's modulus {:.3e} Pa, Poisson's ratio {}, \
                 {friction}{rolling} {keys}",
                law.material.youngs_modulus * scene.units.si_pressure(),
                law.material.poisson_ratio
            )
        }
    }
}

fn rolling(coefficient: Option<f64>) -> String {
    coefficient.map_or_else(String::new, |value| format!(", rolling resistance {value}"))
}
