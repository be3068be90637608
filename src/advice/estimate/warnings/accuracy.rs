//! Warnings of grids and relaxation times with which a flow comes out wrong, by the same prediction as
//! `psmrt plan` makes.

use crate::advice::estimate::warning::{Warning, warning};
use crate::advice::plan::facts::{Facts, Limit};
use crate::advice::plan::options::{PlanOption, Speed, as_it_is, most_accurate, options, why_none};
use crate::advice::plan::predict::{Outside, Parameters, Predicted, percent, predict};
use crate::advice::tradeoff::models::Models;
use crate::engine::EngineName;
use crate::scene::{EngineKind, Scene};
use psmrt_reference::collision::Preset;

/// A predicted error above this is warned of. Laws of the drag of beds differ by as much from each other, so
/// that a larger one spoils what one can compare with; and of the Pareto-optimal runs
/// (golden/tradeoff/front.csv) those below it are affordable.
pub(crate) const TOO_LARGE: f64 = 0.1;

/// A scene and what is predicted of it.
pub(crate) struct Outlook {
    /// What the scene is.
    pub facts: Facts,
    models: &'static Models,
    parameters: Parameters,
    kernel: bool,
    /// What is predicted, or why nothing is.
    pub found: Result<Predicted, Outside>,
}

/// What is predicted of a scene; `None` if nothing in it limits the accuracy in a way that is known.
pub(crate) fn outlook(scene: &Scene) -> Option<Outlook> {
    let facts = Facts::of(scene).ok()?.ok()?;
    let models = Models::committed().ok()?;
    let collision = Preset::of(&scene.setup.collision)?;
    let kernel = scene.engine == EngineKind::Wgpu;
    let single = EngineName::of(scene).is_some_and(|engine| engine.bytes_of_number() == 4);
    let parameters = Parameters {
        resolution: facts.limit.cells(),
        tau: facts.tau,
        collision,
        single,
        velocity: facts.si_velocity.map(|velocity| velocity / scene.units.si_velocity()),
    };
    let found = predict(&facts, models, &parameters);
    Some(Outlook { facts, models, parameters, kernel, found })
}

/// What the error is one of.
pub(crate) fn subject(scene: &Scene, limit: &Limit) -> &'static str {
    match (limit, settles(scene), scene.setup.body_force) {
        (Limit::Plates { .. } | Limit::Shear { .. }, ..) => "the profile (relative L2)",
        (Limit::Duct { .. }, ..) => "the mean velocity",
        (Limit::Grains { .. }, true, _) => "the settling velocity",
        (Limit::Grains { .. }, false, Some(_)) => "the flow that the force drives",
        (Limit::Grains { .. }, false, None) => {
            "the flow that a given force would drive past the grains"
        }
    }
}

/// Whether free grains settle or rise by gravity.
fn settles(scene: &Scene) -> bool {
    scene.free.as_ref().is_some_and(|part| part.settings.gravity.is_some())
}

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let Some(outlook) = outlook(scene) else { return Vec::new() };
    let reason = match &outlook.found {
        Ok(found) if found.error.abs() > TOO_LARGE => {
            format!("{}: {}", predicted(scene, found), because(&outlook.facts))
        }
        Ok(_) => return Vec::new(),
        Err(Outside { why, nearest: Some(near), may_be_worse }) => {
            if !may_be_worse && near.error.abs() <= TOO_LARGE {
                return Vec::new();
            }
            format!(
                "the error cannot be predicted: {why}; at the nearest point of the evidence {}",
                predicted(scene, near)
            )
        }
        // Between walls and where no run has the method nothing is known to be wrong.
        Err(Outside { nearest: None, .. }) => return Vec::new(),
    };
    let mut remedy = remedy(&outlook);
    remedy += &other_operator(scene, &outlook);
    vec![warning(reason, remedy)]
}

/// What the operator that is more accurate for such grains would do with nothing else changed, where that is predicted to
/// help.
fn other_operator(scene: &Scene, outlook: &Outlook) -> String {
    let Outlook { facts, models, parameters, found, .. } = outlook;
    let Some(other) = facts.better_operator() else { return String::new() };
    // Where free grains are coupled implicitly is for the engine to say.
    if scene.free.is_some() && scene.engine == EngineKind::Wgpu {
        return String::new();
    }
    let now = match found {
        Ok(now) => now.size().0,
        Err(outside) => outside.nearest.as_ref().map_or(f64::INFINITY, |near| near.size().0),
    };
    match predict(&facts.with(other), models, parameters).map(|found| found.size()) {
        Ok((error, [low, high])) if error < now => format!(
            "; `solid.operator = \"{}\"` makes it {} ({} to {}) with nothing else changed",
            other.operator().word(),
            percent(error),
            percent(low),
            percent(high)
        ),
        _ => String::new(),
    }
}

/// A prediction in words: the flow, or what a given flow does to the grains.
fn predicted(scene: &Scene, found: &Predicted) -> String {
    let is_fast = found.error > 0.0;
    let sizes = |value: fn(f64) -> f64| {
        let [low, high] = found.band.map(value);
        let (low, high) = if is_fast { (low, high) } else { (-high, -low) };
        format!("{} ({} to {})", percent(value(found.error).abs()), percent(low), percent(high))
    };
    let too = if is_fast { "fast" } else { "slow" };
    match (settles(scene), scene.setup.body_force) {
        (true, _) => format!("grains are predicted to settle {} too {too}", sizes(|e| e)),
        (false, Some(_)) => format!("the flow is predicted to be {} too {too}", sizes(|e| e)),
        (false, None) => {
            // Drag goes with force over velocity.
            let too = if is_fast { "small" } else { "large" };
            format!("the drag is predicted to be {} too {too}", sizes(|e| e / (1.0 + e)))
        }
    }
}

/// What makes the error as large as it is.
fn because(facts: &Facts) -> String {
    let Facts { tau, .. } = facts;
    match &facts.limit {
        Limit::Grains { cells, drag, because } => format!(
            "{cells:.1} cells across the smallest grain, tau = {tau:.4}, and a drag of {drag:.2} times Stokes', \
             that of {because}"
        ),
        Limit::Plates { cells } | Limit::Shear { cells } => {
            format!("{cells} cells from wall to wall, tau = {tau:.4}")
        }
        Limit::Duct { cells, .. } => format!("{cells} cells across the duct, tau = {tau:.4}"),
    }
}

/// Near tau = 1/2 two errors cancel, so that a small one may be an accident: a remedy may not err by more than
/// this either, nor have a coarser grid.
const AT_MOST: f64 = 2.0 * TOO_LARGE;

/// The cheapest option that causes no warning, with the scene's collision; else the most accurate.
fn remedy(outlook: &Outlook) -> String {
    let Outlook { facts, models, parameters, kernel, .. } = outlook;
    let collision = &parameters.collision;
    let engine = if *kernel { EngineName::Wgpu } else { EngineName::Cpu };
    let speed = Speed { engine, mrt: 1.0, srt: 1.0 };
    let all = options(facts, models, std::slice::from_ref(&speed));
    let is_own = |option: &PlanOption| {
        option.collision == *collision && option.si_dx <= facts.si_dx * (1.0 + 1e-9)
    };
    let own: Vec<PlanOption> = all.into_iter().filter(is_own).collect();
    let good = own.iter().filter(|option| option.error <= TOO_LARGE && option.band[1] <= AT_MOST);
    let good = good.min_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let Some(best) = good.or(most_accurate(&own, f64::INFINITY)) else {
        return why_none(facts, models);
    };
    let now = as_it_is(facts, models, *collision, &speed);
    if now.as_ref().is_ok_and(|now| best.error >= now.error) {
        return "no grid that fits the domain and no relaxation time of the evidence has a smaller error: choose a \
                domain whose sides share a larger divisor"
            .to_owned();
    }
    let [nx, ny, nz] = best.cells;
    let mut changes = Vec::new();
    if best.cells != facts.cells {
        changes.push(format!("`domain.dx` = {:e} ({nx} x {ny} x {nz} cells)", best.si_dx));
    }
    if (best.tau - facts.tau).abs() > 1e-9 {
        changes.push(format!("`time.tau` = {}", best.tau));
    }
    let work = now.map_or_else(
        |_| String::new(),
        |now| format!(" for {:.1} times the work", best.seconds / now.seconds),
    );
    format!(
        "{} makes it {} ({} to {}){work}; `psmrt plan` finds the cheapest settings for an error",
        changes.join(" with "),
        percent(best.error),
        percent(best.band[0]),
        percent(best.band[1])
    )
}
