//! Which models a scene turns on, each with the reason.

use psmrt_reference::collision::Collision;
use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::{FACE_NAMES, Face};
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::solids::Solid;

use super::grains;
use crate::in_time::Drives;
use crate::scene::format_grains::OperatorName;
use crate::scene::{OutputInterval, Scene, What};

/// The models that are on, each with the reason.
pub fn models(scene: &Scene) -> Vec<String> {
    let setup = &scene.setup;
    let mut models = if scene.is_dry { Vec::new() } else { of_fluid(scene) };
    models.extend(grains::models(scene));
    if setup.body_force.is_some() {
        models.push("body force: Guo (body_force)".to_owned());
    }
    for axis in 0..3 {
        for side in 0..2 {
            let name = FACE_NAMES[axis][side];
            match setup.domain.faces().axis(axis)[side] {
                Face::Periodic => {}
                Face::NonReflectingPressure { memory, .. } => models.push(format!(
                    "face {name}: {}, memory {:.4e} s",
                    face_words(&setup.domain.faces().axis(axis)[side]),
                    memory * scene.units.si_dt
                )),
                Face::Wall { .. } if scene.is_dry => {
                    models.push(format!("face {name}: wall, in contact with grains"));
                }
                face => models.push(format!("face {name}: {}", face_words(&face))),
            }
        }
    }
    for (key, period, end) in scene.drives.iter().flat_map(Drives::all) {
        models.push(match period {
            Some(period) => {
                format!("{key}: a sine of period {:.4e} s", period * scene.units.si_dt)
            }
            None => format!("{key}: a table, until {:.4e} s", end * scene.units.si_dt),
        });
    }
    for record in &scene.records {
        let what = match record.what {
            What::Box => "means over the domain",
            What::Profile { .. } => "a profile",
            What::Loads => "hydrodynamic force and torque on grains",
            What::Slice { .. } => "pictures of a slice",
            What::Fields { .. } => "fields",
            What::Grains => "grains",
            What::GrainMeans => "means over the free grains",
            What::Layers { .. } => "layers of the bed",
            What::Walls => "forces on the faces",
            What::ContactMeans => "means over the contacts of the free grains",
            What::Contacts => "the network of contacts",
            What::Permeability { .. } => "permeability of the bed",
        };
        let interval = match record.interval {
            OutputInterval::Every(steps) => {
                format!(" ({:.4e} s)", steps as f64 * scene.units.si_dt)
            }
            OutputInterval::AtEnd => String::new(),
        };
        models.push(format!("record {}: {what}, {}{interval}", record.name, record.interval));
    }
    models
}

/// Those of the fluid and of the solids in it.
fn of_fluid(scene: &Scene) -> Vec<String> {
    let setup = &scene.setup;
    let mut models = vec![match setup.collision {
        Collision::Srt { .. } => "collision: SRT, that is BGK (collision.model)".to_owned(),
        Collision::Mrt { rates } => format!(
            "collision: MRT, s_e {:.4}, s_eps {:.4}, s_q {:.4}, s_nu {:.4}, s_pi {:.4}, s_m {:.4}",
            rates.e, rates.eps, rates.q, rates.nu, rates.pi, rates.m
        ),
    }];
    if let Some(phase) = &setup.solid_phase {
        models.push(format!(
            "partial saturation: {}, {}, coverage {} (there are grains)",
            match phase.weighting {
                Weighting::NobleTorczynski => "Noble-Torczynski weighting",
                Weighting::SolidFraction => "weighting by solid fraction",
                Weighting::Graded => "its own weighting",
            },
            match phase.operator {
                SolidOperator::NonEquilibriumBounceBack => "non-equilibrium bounce-back",
                SolidOperator::Superposition => "superposition",
                SolidOperator::FullBounceBack => "full bounce-back",
                SolidOperator::GradedViscosity => "graded viscosity",
            },
            match phase.coverage {
                CoverageRule::Exact => "exact".to_owned(),
                CoverageRule::Sampled { n } => format!("sampled {n} x {n} x {n}"),
                CoverageRule::Linear => "linear".to_owned(),
            }
        ));
        models.extend(operator(scene));
        let changing = scene.drives.as_ref().is_some_and(|drives| !drives.prescribed.is_empty());
        if changing || phase.solids.iter().any(Solid::moves) {
            models.push("moving grains: coverage is computed in every step".to_owned());
        }
    }
    models
}

/// The operator of the solid, and whether it was chosen, in a line; none without grains.
pub fn operator(scene: &Scene) -> Option<String> {
    let phase = scene.setup.solid_phase.as_ref().filter(|_| !scene.is_dry)?;
    let word = OperatorName::of(phase.operator).word();
    let changing = scene.drives.as_ref().is_some_and(|drives| !drives.prescribed.is_empty());
    let is_moved = changing || scene.free.is_some() || phase.solids.iter().any(Solid::has_velocity);
    let why = match (scene.operator_is_chosen, phase.weighting, is_moved) {
        (false, ..) => "named in the scene",
        (true, Weighting::Graded, _) => {
            "chosen, since none is named and all grains are fixed; the paper's is bounce_back"
        }
        (true, _, true) => "chosen, since none is named and grains move",
        (true, _, false) => "chosen, since none is named but a weighting is given",
    };
    Some(format!("solid.operator: {word} ({why})"))
}

fn face_words(face: &Face) -> &'static str {
    match face {
        Face::Periodic => "periodic",
        Face::Wall { velocity } if velocity.norm() > 0.0 => "moving wall, half-way bounce-back",
        Face::Wall { .. } => "wall, half-way bounce-back",
        Face::FreeSlip => "free slip, mirror plane",
        Face::VelocityInlet { .. } => "velocity inlet, half-way bounce-back",
        Face::FreeOutflow => "free outflow, zero gradient",
        Face::Pressure { .. } => "pressure, anti-bounce-back",
        Face::DevelopedPressure { .. } => "pressure, developed flow, non-equilibrium extrapolation",
        Face::NonReflectingPressure { .. } => {
            "pressure, non-reflecting, non-equilibrium extrapolation at the density of the outgoing wave"
        }
    }
}
