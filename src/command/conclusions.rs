//! What the records of a run mean, as far as that can be concluded from one run: the permeability of a bed, the drag
//! coefficient of a sphere in a stream, the settling velocity of a grain, the viscosity of a sheared mixture. Each says whether it is steady.

use std::f64::consts::PI;

use psmrt_reference::coupling::Gravity;
use psmrt_reference::domain::Face;
use psmrt_reference::lattice::{Vec3, viscosity};
use serde_json::{Value as Json, json};

use super::conclusion::{Conclusion, is_steady, steady_words};
use super::viscosity::viscosity_of_mixture;
use crate::advice::estimate::outlook;
use crate::engine::Coupled;
use crate::output::records::seepage_now;
use crate::run::End;
use crate::scene::check::permeability::through_bed;
use crate::scene::{Scene, What};
use crate::seepage::bed::{DENSE, layer};
use crate::seepage::laws::SI_DARCY;
use crate::seepage::permeability::{BESIDE, Seepage};
use crate::seepage::spheres::{has_image, spheres_of};

/// All that can be concluded.
pub(super) fn conclusions(scene: &Scene, engine: &Coupled, end: End) -> Vec<Conclusion> {
    if scene.is_dry {
        // All of these are of the fluid.
        return Vec::new();
    }
    let found = [
        permeability(scene, engine, end),
        drag_coefficient(scene, engine, end),
        settling_velocity(scene, engine),
        viscosity_of_mixture(scene, engine, end),
    ];
    found.into_iter().flatten().collect()
}

/// Free grains that are faster than this share of the water in the pores are no bed at rest.
const AT_REST: f64 = 0.01;

/// Inertia changes the permeability of a bed by about a percent at this Re (Beetstra's law).
const SLOW: f64 = 1.0;

fn permeability(scene: &Scene, engine: &Coupled, end: End) -> Option<Conclusion> {
    let flow = scene.records.iter().find_map(|record| match record.what {
        What::Permeability { axis, si_gravity } => Some((axis, si_gravity)),
        _ => None,
    });
    let has_box = scene.records.iter().any(|record| record.what == What::Box);
    // Grains that are no bed have a drag, not a permeability.
    let of_scene = || {
        let flow = through_bed(&scene.setup, scene.free.as_ref(), &scene.units).ok()?;
        (has_box && layer(engine.setup(), flow.0).fraction >= DENSE).then_some(flow)
    };
    let (axis, si_gravity) = flow.or_else(of_scene)?;
    let found = seepage_now(scene, engine, (axis, si_gravity));
    let k = found.si_permeability();
    if !k.is_finite() {
        return None;
    }
    let fastest = engine.solids().iter().map(|solid| solid.velocity.norm()).fold(0.0, f64::max);
    let pores = found.si_velocity.abs() / found.porosity / scene.units.si_velocity();
    let is_at_rest = fastest <= AT_REST * pores;
    let name = ["x", "y", "z"][axis];
    let mut text = format!(
        "permeability along {name}: {}; porosity {:.3}, Re {:.2e}; {}",
        in_words(&found),
        found.porosity,
        found.reynolds(),
        steady_words(end)
    );
    let predicted = predicted(scene);
    if let Some([error, low, high]) = predicted {
        text += &format!(
            "; the grid is predicted to make k {:+.1} % ({:+.1} to {:+.1} %) too large",
            100.0 * error,
            100.0 * low,
            100.0 * high
        );
    }
    text += &format!("; laws: {}", laws_in_words(&found));
    if found.reynolds() > SLOW {
        text += "; inertia counts at this Re, so that k holds at this Re only";
    }
    if !is_at_rest {
        text += "; grains MOVE: this is no property of a bed at rest";
    }
    let mut json = to_json(&found);
    json["what"] = json!("permeability");
    json["axis"] = json!(name);
    json["steady"] = json!(is_steady(end));
    json["grains_at_rest"] = json!(is_at_rest);
    json["predicted_error"] = json!(predicted);
    Some(Conclusion { text, json })
}

/// The error of k that `plan` predicts for a scene as it is, and what 95 % lie between; positive where k is too large.
pub(super) fn predicted(scene: &Scene) -> Option<[f64; 3]> {
    let found = outlook(scene)?.found.ok()?;
    Some([found.error, found.band[0], found.band[1]])
}

/// k and K.
pub(super) fn in_words(found: &Seepage) -> String {
    let k = found.si_permeability();
    let darcy = k / SI_DARCY;
    format!(
        "k = {k:.3e} m2 ({} darcy), K = {:.3e} m/s (g = {:.2} m/s2)",
        if (0.1..1e5).contains(&darcy.abs()) {
            format!("{darcy:.2}")
        } else {
            format!("{darcy:.3e}")
        },
        found.si_conductivity(),
        found.si_gravity
    )
}

/// What the laws give, m2.
pub(super) fn laws_in_words(found: &Seepage) -> String {
    let [kozeny, beetstra, tang] = BESIDE.map(|law| found.si_by(&law));
    format!("Kozeny-Carman {kozeny:.2e}, Beetstra {beetstra:.2e}, Tang {tang:.2e} m2")
}

/// The same for programs.
pub(super) fn to_json(found: &Seepage) -> Json {
    let [kozeny, beetstra, tang] = BESIDE.map(|law| found.si_by(&law));
    let k = found.si_permeability();
    json!({
        "k_m2": k, "k_darcy": k / SI_DARCY, "K_m_per_s": found.si_conductivity(),
        "k_over_d2": k / found.si_diameter / found.si_diameter, "gravity_m_per_s2": found.si_gravity,
        "superficial_velocity_m_per_s": found.si_velocity,
        "hydraulic_gradient": found.hydraulic_gradient(),
        "porosity": found.porosity, "bed_m": found.si_reach, "diameter_m": found.si_diameter,
        "reynolds": found.reynolds(), "psi": found.psi(),
        "laws_m2": { "kozeny_carman": kozeny, "beetstra": beetstra, "tang": tang },
    })
}

/// C_D of a sphere alone that a stream of known velocity passes, or that moves through water at rest.
fn drag_coefficient(scene: &Scene, engine: &Coupled, end: End) -> Option<Conclusion> {
    let setup = engine.setup();
    let spheres = spheres_of(setup);
    let &[(solid, radius, share)] = &spheres[..] else { return None };
    if has_image(setup) {
        return None;
    }
    if scene.free.is_some() || setup.body_force.is_some_and(|force| force.norm() > 0.0) {
        return None;
    }
    let faces = setup.domain.faces();
    let inlets = (0..3).flat_map(|axis| faces.axis(axis)).filter_map(|face| match face {
        Face::VelocityInlet { velocity } => Some(velocity),
        _ => None,
    });
    let inlets: Vec<Vec3> = inlets.collect();
    let stream = match inlets[..] {
        [] => Vec3::zeros(),
        [one] => one,
        // Several inlets make no stream.
        _ => return None,
    };
    let past = stream - solid.velocity;
    let speed = past.norm();
    if speed == 0.0 {
        return None;
    }
    let force = engine.loads().first()?.force.dot(&past) / speed / share;
    // C_D = F/(ρ U²/2 π d²/4)
    let coefficient = force / (0.5 * speed * speed * PI * radius * radius);
    let re = 2.0 * radius * speed / viscosity(setup.collision.tau());
    // C_D = 24/Re (1 + 0.15 Re^0.687)   (Schiller & Naumann 1933, up to Re = 800)
    let alone = 24.0 / re * (1.0 + 0.15 * re.powf(0.687));
    let width = (0..3)
        .filter(|&axis| past[axis].abs() < 0.5 * speed)
        .map(|axis| setup.domain.cells()[axis] as f64 / 2.0 / radius)
        .fold(f64::INFINITY, f64::min);
    let text = format!(
        "drag coefficient of the sphere: {coefficient:.4} at Re {re:.3}, in a domain {width:.1} diameters wide; {}; \
         alone in unbounded fluid {alone:.4} (Schiller & Naumann)",
        steady_words(end)
    );
    let json = json!({
        "what": "drag_coefficient", "drag_coefficient": coefficient, "reynolds": re,
        "width_diameters": width, "schiller_naumann": alone, "steady": is_steady(end),
    });
    Some(Conclusion { text, json })
}

/// What is left of the weight in water of a grain that has its final velocity to a percent or so.
const FINAL: f64 = 0.01;

/// The velocity at which a grain alone settles or rises, and how far that is from final.
fn settling_velocity(scene: &Scene, engine: &Coupled) -> Option<Conclusion> {
    let part = scene.free.as_ref()?;
    let ([grain], Some(Gravity::Reduced { acceleration })) =
        (&part.grains[..], part.settings.gravity)
    else {
        return None;
    };
    let (solids, system) = (engine.solids(), engine.free_grains()?);
    let (&[number], g) = (&part.solids[..], acceleration.norm()) else { return None };
    let solid = solids.get(number)?;
    let is_alone = solids.len() == 1 && crate::output::grain_means::row(scene, engine)[8] == 0.0;
    if g == 0.0 || !is_alone || system.grains().len() != 1 {
        return None;
    }
    let along = acceleration / g;
    let volume = solid.volume();
    let weight = (grain.mass - volume * part.settings.fluid_density) * g;
    if weight == 0.0 {
        return None;
    }
    // Of a grain on a mirror plane the load is that on the half that is computed.
    let share = spheres_of(engine.setup()).get(number)?.2;
    let drag = engine.loads().get(number)?.force.dot(&along) / share;
    // Nothing is left of (m_s - m_f) g + F at the final velocity.
    let left = (weight + drag) / weight;
    let speed = solid.velocity.dot(&along);
    let si_speed = speed * scene.units.si_velocity();
    let re = speed.abs() * solid.diameter() / viscosity(engine.setup().collision.tau());
    let is_final = left.abs() <= FINAL;
    let verdict = if is_final { "final" } else { "NOT final" };
    let text = format!(
        "settling velocity: {si_speed:.4e} m/s along gravity, Re {re:.3}; {verdict}: the drag carries {:.1} % of the weight in \
         water",
        100.0 * (1.0 - left)
    );
    let json = json!({
        "what": "settling_velocity", "velocity_m_per_s": si_speed, "reynolds": re,
        "share_of_weight_left": left, "steady": is_final,
    });
    Some(Conclusion { text, json })
}
