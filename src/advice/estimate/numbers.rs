//! The derived numbers of a scene.

use psmrt_reference::domain::Face;

use super::number::{Number, number};
use super::velocity::si_velocity;
use super::warnings::accuracy::{outlook, subject};
use super::{grains, memory, seepage};
use crate::advice::plan::predict::Outside;
use crate::engine::EngineName;
use crate::packing::passing_diameter;
use crate::scene::Scene;
use crate::seepage::bed::bed;
use crate::seepage::spheres::{diameters, has_image, is_of_cells, solid_fraction, spheres};
use crate::seepage::surface::sauter;

/// The length for the Reynolds number, m, and what it is.
fn si_length(scene: &Scene) -> (f64, &'static str) {
    let (cells, dx) = (scene.setup.domain.cells(), scene.units.si_dx);
    if let Some((_, diameter)) = diameters(scene) {
        return (diameter * dx, "the largest grain");
    }
    let walls = (0..3).filter(|&axis| {
        let faces = scene.setup.domain.faces().axis(axis);
        faces.iter().any(|face| matches!(face, Face::Wall { .. }))
    });
    match walls.map(|axis| cells[axis]).min() {
        Some(gap) => (gap as f64 * dx, "the distance between the walls"),
        None => {
            (cells.into_iter().max().unwrap_or(1) as f64 * dx, "the longest side of the domain")
        }
    }
}

/// The error that `psmrt plan` predicts of the scene as it is.
fn predicted_error(scene: &Scene) -> Option<Number> {
    let outlook = outlook(scene)?;
    let subject = subject(scene, &outlook.facts.limit);
    let (found, note) = match outlook.found {
        Ok(found) => (found, format!("of {subject}")),
        Err(Outside { why, nearest, .. }) => {
            (nearest?, format!("of {subject}, at the nearest point of the evidence: {why}"))
        }
    };
    let [low, high] = found.band.map(|value| 100.0 * value);
    let note = format!("{low:.2} to {high:.2} %, {note}");
    Some(number("predicted error", 100.0 * found.error, "%", note))
}

/// The sizes by mass, of spheres that are not all alike.
fn grading(scene: &Scene) -> Option<Number> {
    let si_diameters: Vec<f64> =
        spheres(scene).iter().map(|(_, radius, _)| 2.0 * radius * scene.units.si_dx).collect();
    let [d10, d50, d60] = [0.1, 0.5, 0.6].map(|share| passing_diameter(&si_diameters, share));
    let (low, high) = diameters(scene)?;
    // Beyond what rounding makes of diameters that are alike.
    if high / low < 1.0 + 1e-6 {
        return None;
    }
    let note = format!("by mass; d10 {d10:.4e} m, d60/d10 = {:.2}", d60 / d10);
    Some(number("d50", d50, "m", note))
}

/// The derived numbers, with values that change in time at their largest.
pub fn numbers(scene: &Scene) -> Vec<Number> {
    let scene = &*scene.at_its_strongest();
    let mut numbers = if scene.is_dry { of_dry_scene(scene) } else { of_fluid(scene) };
    numbers.extend(grains::numbers(scene));
    numbers.extend(of_effort(scene));
    numbers
}

/// Those of a scene without fluid.
fn of_dry_scene(scene: &Scene) -> Vec<Number> {
    let units = &scene.units;
    let [x, y, z] = scene.setup.domain.cells().map(|n| n as f64 * units.si_dx);
    let note = "along x; there is no fluid, and no cells";
    let mut numbers = vec![
        number("domain", x, "m", format!("{note}; {y:.4e} m along y, {z:.4e} m along z")),
        number("dt", units.si_dt, "s", "time step"),
    ];
    numbers.extend(grading(scene));
    numbers.push(number("solid fraction", solid_fraction(scene), "", "grains over domain"));
    numbers
}

/// Those of the fluid and of the solids in it.
fn of_fluid(scene: &Scene) -> Vec<Number> {
    let (units, tau) = (&scene.units, scene.setup.collision.tau());
    let cells = scene.setup.domain.cells();
    let count = scene.setup.domain.cell_count();
    let mut numbers = vec![
        number("cells", count as f64, "", format!("{} x {} x {}", cells[0], cells[1], cells[2])),
        number("dx", units.si_dx, "m", "edge of a cell"),
        number("dt", units.si_dt, "s", "time step"),
        number("tau", tau, "", "relaxation time; errors of grains grow with it"),
        number("velocity scale", units.si_velocity(), "m/s", "one cell per time step"),
    ];
    if let Some((si_speed, source)) = si_velocity(scene) {
        let mach = si_speed / units.si_velocity() * 3.0_f64.sqrt();
        let (si_length, what) = si_length(scene);
        let nu = psmrt_reference::lattice::viscosity(tau) * units.si_viscosity();
        numbers.push(number("velocity", si_speed, "m/s", format!("from {source}")));
        numbers.push(number("Mach number", mach, "", "its square is the error of compressibility"));
        numbers.push(number(
            "Reynolds number",
            si_speed * si_length / nu,
            "",
            format!("on {what}"),
        ));
    }
    if let (Some((low, high)), Some(phase)) = (diameters(scene), &scene.setup.solid_phase) {
        let spheres = phase.solids.iter().filter(|solid| !is_of_cells(solid)).count();
        numbers.push(number("grains", spheres as f64, "", "spheres"));
        let note = if high > low { format!("the largest has {high:.2}") } else { String::new() };
        numbers.push(number("cells per diameter", low, "", note));
    }
    numbers.extend(grading(scene));
    let has_image = has_image(&scene.setup);
    if scene.setup.solid_phase.is_some() {
        let note = if has_image { "solids over domain" } else { "grains over domain" };
        numbers.push(number("solid fraction", solid_fraction(scene), "", note));
    }
    if has_image {
        let note = "of spheres with the volume and the surface of images and bodies, 6 V/S";
        numbers.push(number("cells per diameter", sauter(&scene.setup), "", note));
    }
    if let Some(bed) = bed(scene) {
        let [x, y, z] = bed.reaches;
        let note = format!(
            "of the bed at cells {:.0} to {:.0}, {:.0} to {:.0}, {:.0} to {:.0}",
            x[0], x[1], y[0], y[1], z[0], z[1]
        );
        numbers.push(number("solid fraction there", bed.fraction, "", note));
    }
    numbers.extend(seepage::numbers(scene));
    numbers.extend(predicted_error(scene));
    numbers
}

/// What the scene will cost.
fn of_effort(scene: &Scene) -> Vec<Number> {
    let mut numbers = Vec::new();
    let engine = EngineName::of(scene).unwrap_or(EngineName::cpu(scene.precision)).word();
    let parts: Vec<_> = memory::parts(scene).iter().map(|part| part.what).collect();
    let mib = memory::needed(scene) as f64 / f64::from(1 << 20);
    numbers.push(number("memory", mib, "MiB", format!("{}; engine {engine}", parts.join(", "))));
    let written = super::disk::bytes(scene);
    let note = "of records, their pictures and checkpoints, at most";
    numbers.push(number("disk", written / f64::from(1 << 20), "MiB", note));
    let (steps, si_time) = (scene.stop.steps as f64, scene.stop.steps as f64 * scene.units.si_dt);
    numbers.push(number("steps", steps, "", format!("at most; {si_time:.4e} s")));
    numbers
}
