//! What a problem gives besides arrays, as JSON: for candidates that read files.

use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, FACE_NAMES, Face};
use psmrt_reference::lattice::{Vec3, viscosity};
use psmrt_reference::moments::NAMES;
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::SolidPhase;
use psmrt_reference::solids::Shape;
use serde_json::{Map, Value, json};

use super::task::{Contacts, Scene, Task, Wanted};

/// The parameters of `task`: what is no array.
pub fn parameters(task: &Task) -> Value {
    match task {
        Task::Constants(task) => json!({
            "preset": "dhumieres", "tau": task.rates.tau(), "rates": named_rates(&task.rates),
            "moment_names": NAMES,
        }),
        Task::Moments(_) => json!({ "moment_names": NAMES }),
        Task::Collisions(task) => {
            let first = task.cells.first();
            let mut parameters = Map::new();
            let mrt = first.is_some_and(|cell| matches!(cell.collision, Collision::Mrt { .. }));
            parameters.insert("collision".into(), if mrt { "mrt" } else { "srt" }.into());
            parameters
                .insert("body_force".into(), first.is_some_and(|c| c.body_force.is_some()).into());
            if first.is_some_and(|cell| cell.solid.is_some()) {
                parameters.insert("operator".into(), operator_name(task.operator).into());
                parameters.insert("weighting".into(), weighting_name(task.weighting).into());
            }
            Value::Object(parameters)
        }
        Task::Weights(_) | Task::SharedWeights(_) => {
            json!({ "weighting": weighting_name(Weighting::NobleTorczynski) })
        }
        Task::SolidFractions(_) => json!({}),
        Task::Streaming(task) => {
            json!({ "cells": task.domain.cells(), "faces": faces(&task.domain) })
        }
        Task::Scene(scene) => scene_parameters(scene),
        Task::Contacts(Contacts { plane, pairs }) => json!({
            "plane": plane,
            "friction": pairs.iter().any(|pair| pair.law.friction.is_some()),
            "rolling": pairs.iter().any(|pair| pair.law.rolling.is_some()),
        }),
        Task::Formulas(task) => {
            let ([d, v, nu], [count, diameter, porosity, x, y]) = (task.settling, task.bed);
            json!({
                "settling": { "diameter_m": d, "velocity_m_per_s": v, "viscosity_m2_per_s": nu },
                "bed": { "spheres": count, "diameter": diameter, "porosity": porosity, "sides": [x, y] },
            })
        }
    }
}

fn named_rates(rates: &Rates) -> Value {
    let Rates { e, eps, q, nu, pi, m } = rates;
    json!({ "e": e, "eps": eps, "q": q, "nu": nu, "pi": pi, "m": m })
}

fn scene_parameters(scene: &Scene) -> Value {
    let setup = &scene.setup;
    let mut parameters = json!({
        "cells": setup.domain.cells(),
        "faces": faces(&setup.domain),
        "body_force": setup.body_force.map(components),
        "steps": scene.steps,
        "solids": [],
    });
    let tau = setup.collision.tau();
    if scene.viscosity_given {
        parameters["viscosity"] = viscosity(tau).into();
    } else {
        parameters["tau"] = tau.into();
    }
    match &setup.collision {
        Collision::Srt { .. } => parameters["collision"] = "srt".into(),
        Collision::Mrt { rates } => {
            parameters["collision"] = "mrt".into();
            parameters["rates"] = named_rates(rates);
            if let (true, Some(rates)) =
                (scene.viscosity_given, parameters["rates"].as_object_mut())
            {
                rates.remove("nu");
            }
        }
    }
    if let Some(phase) = &setup.solid_phase {
        parameters["operator"] = operator_name(phase.operator).into();
        parameters["weighting"] = weighting_name(phase.weighting).into();
        parameters["solids"] = solids(phase);
    }
    if let Some(Wanted::ShearViscosity { amplitude }) = scene.wanted.first() {
        parameters["amplitude"] = (*amplitude).into();
    }
    parameters
}

fn solids(phase: &SolidPhase) -> Value {
    let solid = |solid: &psmrt_reference::solids::Solid| {
        let radius = match &solid.shape {
            Shape::Sphere { radius } => Some(*radius),
            Shape::Cells { .. } => None,
        };
        json!({
            "radius": radius,
            "centre": components(solid.centre),
            "velocity": components(solid.velocity),
            "spin": components(solid.angular_velocity),
        })
    };
    phase.solids.iter().map(solid).collect()
}

fn operator_name(operator: SolidOperator) -> &'static str {
    match operator {
        SolidOperator::NonEquilibriumBounceBack => "non_equilibrium_bounce_back",
        SolidOperator::Superposition => "superposition",
        SolidOperator::FullBounceBack => "full_bounce_back",
        SolidOperator::GradedViscosity => "graded_viscosity",
    }
}

fn weighting_name(weighting: Weighting) -> &'static str {
    match weighting {
        Weighting::SolidFraction => "solid_fraction",
        Weighting::NobleTorczynski => "noble_torczynski",
        Weighting::Graded => "graded",
    }
}

fn faces(domain: &Domain) -> Value {
    let mut faces = Map::new();
    for axis in 0..3 {
        for side in 0..2 {
            let face = match domain.faces().axis(axis)[side] {
                Face::Periodic => json!({ "kind": "periodic" }),
                Face::Wall { velocity } => {
                    json!({ "kind": "wall", "velocity": components(velocity) })
                }
                Face::FreeSlip => json!({ "kind": "free_slip" }),
                Face::VelocityInlet { velocity } => {
                    json!({ "kind": "velocity_inlet", "velocity": components(velocity) })
                }
                Face::FreeOutflow => json!({ "kind": "free_outflow" }),
                Face::Pressure { density } => json!({ "kind": "pressure", "density": density }),
                Face::DevelopedPressure { density } => {
                    json!({ "kind": "developed_pressure", "density": density })
                }
                Face::NonReflectingPressure { density, memory } => {
                    json!({ "kind": "non_reflecting_pressure", "density": density, "memory": memory })
                }
            };
            faces.insert(FACE_NAMES[axis][side].to_owned(), face);
        }
    }
    Value::Object(faces)
}

fn components(vector: Vec3) -> [f64; 3] {
    vector.into()
}

/// The kind of a problem, as the manifest spells it.
pub fn kind(task: &Task) -> &'static str {
    match task {
        Task::Constants(_) => "constants",
        Task::Moments(_) => "moments",
        Task::Collisions(_) => "collisions",
        Task::SolidFractions(_) => "solid_fractions",
        Task::Weights(_) => "weights",
        Task::SharedWeights(_) => "shared_weights",
        Task::Streaming(_) => "streaming",
        Task::Scene(_) => "scene",
        Task::Contacts(_) => "contacts",
        Task::Formulas(_) => "formulas",
    }
}
