//! What can be told about a scene before it runs: derived numbers, which models are on, what it
//! will cost, and what looks risky.

mod grains;
pub(crate) mod spheres;
pub(crate) mod stability;

use std::time::{Duration, Instant};

use psmrt_reference::collision::Collision;
use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::{FACE_NAMES, Face};
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::solids::Shape;
use serde::Serialize;

use crate::engine::Engine;
use crate::scene::check::domain::BYTES_PER_CELL;
use crate::scene::{EngineKind, Scene, What};

/// A derived number.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Number {
    /// What it is.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// Its unit; empty for a bare number.
    pub unit: &'static str,
    /// What it is taken from, or what is good.
    pub note: String,
}

/// Something that may go wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Warning {
    /// What and why.
    pub reason: String,
    /// What to do about it.
    pub remedy: String,
}

fn number(name: &'static str, value: f64, unit: &'static str, note: impl Into<String>) -> Number {
    Number { name, value, unit, note: note.into() }
}

/// The largest velocity that the scene names, m/s, and where it comes from.
pub(crate) fn si_velocity(scene: &Scene) -> Option<(f64, &'static str)> {
    if let Some(si_velocity) = scene.si_reference_velocity {
        return Some((si_velocity, "time.reference_velocity"));
    }
    if let Some(exact) = &scene.exact {
        return Some((exact.si_top_velocity().abs(), "the exact solution"));
    }
    let faces = scene.setup.domain.faces();
    let faces = (0..3).flat_map(|axis| faces.axis(axis)).map(|face| match face {
        Face::Wall { velocity } | Face::VelocityInlet { velocity } => velocity.norm(),
        _ => 0.0,
    });
    let solids = scene.setup.solid_phase.iter().flat_map(|phase| &phase.solids);
    let solids = solids.map(|solid| match solid.shape {
        Shape::Sphere { radius } => solid.velocity.norm() + radius * solid.spin.norm(),
        Shape::Cells { .. } => solid.velocity.norm(),
    });
    let speeds = faces.chain(solids).chain([scene.initial_velocity.norm()]);
    let most = speeds.fold(0.0, f64::max);
    let settling = grains::stokes_velocity(scene);
    if settling > most {
        return Some((settling * scene.units.si_velocity(), "Stokes' law for the fastest grain"));
    }
    (most > 0.0).then(|| (most * scene.units.si_velocity(), "the fastest face, grain or start"))
}

/// Diameters in cells, smallest and largest, if there are grains.
fn diameters(scene: &Scene) -> Option<(f64, f64)> {
    let solids = &scene.setup.solid_phase.as_ref()?.solids;
    let all = solids.iter().filter_map(|solid| match solid.shape {
        Shape::Sphere { radius } => Some(2.0 * radius),
        Shape::Cells { .. } => None,
    });
    let (low, high) = all.fold((f64::INFINITY, 0.0_f64), |(l, h), d| (l.min(d), h.max(d)));
    (high > 0.0).then_some((low, high))
}

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
        None => (cells.into_iter().max().unwrap_or(1) as f64 * dx, "the longest side of the box"),
    }
}

/// The derived numbers.
pub fn numbers(scene: &Scene) -> Vec<Number> {
    let (units, tau) = (&scene.units, scene.setup.collision.tau());
    let cells = scene.setup.domain.cells();
    let count = scene.setup.domain.cell_count();
    let mut numbers = vec![
        number("cells", count as f64, "", format!("{} x {} x {}", cells[0], cells[1], cells[2])),
        number("dx", units.si_dx, "m", "edge of a cell"),
        number("dt", units.si_dt, "s", "time step"),
        number("tau", tau, "", "relaxation time; 0.6 to 1 is usual"),
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
        numbers.push(number("grains", phase.solids.len() as f64, "", "spheres"));
        let note = if high > low { format!("the largest has {high:.2}") } else { String::new() };
        numbers.push(number("cells per diameter", low, "", note));
        let volume: f64 = phase
            .solids
            .iter()
            .map(|solid| match solid.shape {
                Shape::Sphere { radius } => 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3),
                Shape::Cells { .. } => 0.0,
            })
            .sum();
        numbers.push(number("solid fraction", volume / count as f64, "", "grains over box"));
    }
    numbers.extend(grains::numbers(scene));
    // Two copies of 19 populations of 4 bytes on a device.
    let (engine, bytes) = match scene.engine {
        EngineKind::Wgpu => ("wgpu", 2 * 19 * 4),
        EngineKind::Reference | EngineKind::Auto => ("reference", BYTES_PER_CELL),
    };
    let memory = (count as u64 * bytes) as f64 / f64::from(1 << 20);
    numbers.push(number("memory", memory, "MiB", format!("populations, engine {engine}")));
    let (steps, si_time) = (scene.stop.steps as f64, scene.stop.steps as f64 * units.si_dt);
    numbers.push(number("steps", steps, "", format!("at most; {si_time:.4e} s")));
    numbers
}

/// Measures how long the scene takes, by running its first steps for `budget`: cell updates per
/// second, and the seconds that all steps would take.
pub fn calibrate(scene: &Scene, engine: &mut dyn Engine, budget: Duration) -> Option<[f64; 2]> {
    // Shaders compile at their first use, and a device still works when `step` has returned: only what
    // it is asked for then waits for it.
    let is_on_device = engine.adapter().is_some();
    if is_on_device && scene.stop.steps > 2 {
        engine.step(2).ok()?;
        engine.box_means();
    }
    let (start, first) = (Instant::now(), engine.steps());
    let mut batch = 1;
    while start.elapsed() < budget && engine.steps() < scene.stop.steps {
        engine.step(batch).ok()?;
        if is_on_device {
            engine.box_means();
        }
        batch = (2 * batch).min(scene.stop.steps - engine.steps()).max(1);
    }
    let per_second = (engine.steps() - first) as f64 / start.elapsed().as_secs_f64().max(1e-9);
    let cells = scene.setup.domain.cell_count() as f64;
    Some([per_second * cells, scene.stop.steps as f64 / per_second])
}

/// The models that are on, each with the reason.
pub fn models(scene: &Scene) -> Vec<String> {
    let setup = &scene.setup;
    let mut models = vec![match setup.collision {
        Collision::Srt { .. } => "collision: SRT (collision.model)".to_owned(),
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
            },
            match phase.operator {
                SolidOperator::NonEquilibriumBounceBack => "non-equilibrium bounce-back",
                SolidOperator::Superposition => "superposition",
            },
            match phase.coverage {
                CoverageRule::Exact => "exact".to_owned(),
                CoverageRule::Sampled { n } => format!("sampled {n} x {n} x {n}"),
            }
        ));
        if phase.solids.iter().any(psmrt_reference::solids::Solid::moves) {
            models.push("moving grains: coverage is found again in every step".to_owned());
        }
    }
    models.extend(grains::models(scene));
    if setup.body_force.is_some() {
        models.push("body force: Guo (body_force)".to_owned());
    }
    for axis in 0..3 {
        for side in 0..2 {
            let name = FACE_NAMES[axis][side];
            match setup.domain.faces().axis(axis)[side] {
                Face::Periodic => {}
                face => models.push(format!("face {name}: {}", face_words(&face))),
            }
        }
    }
    for record in &scene.records {
        let what = match record.what {
            What::Box => "means over the box",
            What::Profile { .. } => "a profile",
            What::Loads => "loads on grains",
            What::Slice { .. } => "pictures of a slice",
            What::Fields { .. } => "fields",
            What::Grains => "grains",
            What::GrainMeans => "means over the free grains",
        };
        models.push(format!("record {}: {what}, {}", record.name, record.rhythm));
    }
    models
}

fn face_words(face: &Face) -> &'static str {
    match face {
        Face::Periodic => "periodic",
        Face::Wall { velocity } if velocity.norm() > 0.0 => "moving wall, half-way bounce-back",
        Face::Wall { .. } => "wall, half-way bounce-back",
        Face::FreeSlip => "mirror",
        Face::VelocityInlet { .. } => "velocity inlet, half-way bounce-back",
        Face::FreeOutflow => "free outflow, zero gradient",
        Face::Pressure { .. } => "pressure, anti-bounce-back",
    }
}

/// Speeds above this Mach number make more than a few percent of error.
const HIGH_MACH: f64 = 0.17;

/// What looks risky.
pub fn warnings(scene: &Scene) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let mut warn = |reason: String, remedy: &str| {
        warnings.push(Warning { reason, remedy: remedy.to_owned() });
    };
    let tau = scene.setup.collision.tau();
    if tau < 0.52 {
        let reason = format!("tau = {tau:.4} is close to 0.5: small structures hardly decay");
        warn(reason, "use a finer grid, a longer time step, or MRT with d'Humieres' rates");
    }
    if tau > 2.0 {
        let reason = format!("tau = {tau:.3} is large: walls and grains are placed less exactly");
        warn(reason, "use a shorter time step (a smaller `time.tau`)");
    }
    if let Some((si_speed, source)) = si_velocity(scene) {
        let speed = si_speed / scene.units.si_velocity();
        if speed * 3.0_f64.sqrt() > HIGH_MACH {
            let reason = format!("the velocity from {source} is {speed:.3} cells per time step");
            warn(reason, "use a shorter time step; below 0.05 errors of compressibility vanish");
        }
        let grid_reynolds = speed / psmrt_reference::lattice::viscosity(tau);
        if grid_reynolds > 10.0 {
            let reason = format!("the grid Reynolds number is {grid_reynolds:.0}, above 10");
            warn(reason, "use a finer grid: the flow has structures smaller than a cell");
        }
    }
    // Figures: golden/sphere_arrays/study.csv, SC at 0.065, MRT with d'Humieres' rates, weight NT.
    if let Some((low, _)) = diameters(scene).filter(|(low, _)| *low < 8.0) {
        let reason = format!(
            "a grain is {low:.1} cells across: its drag is too small by tens of percent, the more the \
             larger tau is (in a dilute array at 4 cells by 17 % at tau 0.6, 25 % at 0.8, 32 % at 1, 44 % \
             at 1.5; at 8 cells by 3, 6, 9 and 14 %)"
        );
        warn(reason, "use 8 cells or more (a smaller `domain.dx`), and tau of 0.6 to 0.8");
    } else if diameters(scene).is_some_and(|(low, _)| low < 16.0 && tau >= 1.5) {
        let reason = format!(
            "tau = {tau:.2} with grains of fewer than 16 cells: their drag is too small (in a dilute array \
             at 8 cells by 14 % at tau 1.5 and 20 % at 2, but 6 % at 0.8)"
        );
        warn(reason, "use a shorter time step (a smaller `time.tau`)");
    }
    let faces = scene.setup.domain.faces();
    let has = |wanted: fn(&Face) -> bool| (0..3).any(|axis| faces.axis(axis).iter().any(wanted));
    if has(|face| matches!(face, Face::VelocityInlet { .. }))
        && !has(|face| matches!(face, Face::Pressure { .. }))
    {
        let reason = "a velocity inlet with a free outflow leaves the mean density free".to_owned();
        warn(reason, "use a `pressure` outlet, or watch the column density of a record `box`");
    }
    for Warning { reason, remedy } in grains::warnings(scene) {
        warn(reason, &remedy);
    }
    for Warning { reason, remedy } in stability::warnings(scene) {
        warn(reason, &remedy);
    }
    if scene.records.is_empty() && scene.exact.is_none() {
        warn("nothing is recorded".to_owned(), "add [[records]]");
    }
    warnings
}
