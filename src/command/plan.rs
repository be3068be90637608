//! `psmrt plan`: the cheapest settings to compute a scene to a given error.

use psmrt_reference::collision::Preset;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::{Value, json};

use super::plan_text::{print, to_json, words};
use super::say::say;
use super::{CommandError, engine, engine_changes, engine_of};
use crate::advice::estimate::calibrate;
use crate::advice::plan::facts::{Facts, Limit};
use crate::advice::plan::options::{
    PlanOption, Speed, as_it_is, cheapest, most_accurate, options, why_none,
};
use crate::advice::plan::predict::{Outside, percent};
use crate::advice::plan::write::text;
use crate::advice::tradeoff::cost::mrt_over_srt;
use crate::advice::tradeoff::model::{LEAST_ERROR, SolidMethod};
use crate::advice::tradeoff::models::Models;
use crate::advice::tradeoff::support;
use crate::engine::EngineName;
use crate::kernel::adapters;
use crate::output::atomic;
use crate::quote;
use crate::scene::Scene;
use crate::table::TableError;

/// What `psmrt plan` is asked for.
#[derive(Clone, Debug)]
pub struct PlanRequest {
    /// The scene file.
    pub scene: PathBuf,
    /// Changes `key=value`.
    pub set: Vec<String>,
    /// The error that is wanted.
    pub error: Wanted,
    /// File for the planned scene.
    pub write: Option<PathBuf>,
    /// Whether to print one JSON object instead of text.
    pub json: bool,
}

/// A relative error, written `5%` or `0.05`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted(pub f64);

/// A part of a whole, as a number or in percent; `example` says how it is written.
pub(super) fn part(text: &str, example: &str) -> Result<f64, String> {
    let (number, percent) = match text.trim().strip_suffix('%') {
        Some(number) => (number.trim_end(), true),
        None => (text.trim(), false),
    };
    let value: Result<f64, _> = number.parse();
    let value = value
        .map_err(|_| format!("{} is no number: write it as {example}", quote::quoted(text)))?;
    // Divided, so that 40% is the same number as 0.4.
    Ok(if percent { value / 100.0 } else { value })
}

impl std::str::FromStr for Wanted {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let value = part(text, "5% or 0.05")?;
        let percent = text.trim().ends_with('%');
        match value {
            value if value > 0.0 && value < 1.0 => Ok(Wanted(value)),
            value if (1.0..100.0).contains(&value) && !percent => {
                let text = quote::shown(text.trim());
                Err(format!(
                    "{text} would be {} %: if you mean {text} %, write {text}%",
                    100.0 * value
                ))
            }
            _ => Err(format!(
                "{}: it must lie between 0 and 100 % (exclusive): write 5% or 0.05",
                quote::shown(text)
            )),
        }
    }
}

/// How long the speed of an engine is measured.
const CALIBRATION: Duration = Duration::from_millis(400);

/// Makes a plan. Errors if the evidence knows nothing of such a scene, or no option reaches the error.
pub fn plan(request: &PlanRequest) -> Result<(), CommandError> {
    let scene = Scene::load(&request.scene, &request.set)?;
    // What was left open is what a run would use.
    let engine = engine_of(&scene).kind();
    let scene = Scene { engine, ..scene.at_its_strongest().into_owned() };
    let name = request.scene.display();
    if scene.is_dry {
        return Err(CommandError::Usage(format!(
            "{name} has no fluid, and a plan is for the grid of one: free grains alone are computed, and their sub-steps are chosen \
             from the contacts; `psmrt check` says how many and how long that takes"
        )));
    }
    let facts = Facts::of(&scene)?
        .map_err(|why| CommandError::Usage(format!("{name} cannot be planned: {why}")))?;
    let wanted = request.error.0;
    let models = Models::committed()?;
    // Whether there is anything to plan with is known before an engine has made a step.
    let unmeasured: Vec<Speed> = offered(&scene, request)
        .into_iter()
        .map(|engine| Speed { engine, mrt: 1.0, srt: 1.0 })
        .collect();
    if options(&facts, models, &unmeasured).is_empty() {
        let now = now(&scene, &facts, models, &unmeasured);
        return Err(unreachable_error(&[], wanted, (&facts, models), &now));
    }
    let speeds = speeds(&scene, request)?;
    let now = now(&scene, &facts, models, &speeds);
    if matches!(facts.limit, Limit::Grains { .. }) && wanted < LEAST_ERROR {
        return Err(CommandError::Usage(format!(
            "an error of {} is below what the evidence reaches with grains ({}): there the place of a grain \
             on the grid counts as much as the grid; plan for {} and check it by a finer run{}",
            percent(wanted),
            percent(LEAST_ERROR),
            percent(LEAST_ERROR),
            now_words(&now)
        )));
    }
    let all = options(&facts, models, &speeds);
    let Some(best) = cheapest(&all, wanted) else {
        return Err(unreachable_error(&all, wanted, (&facts, models), &now));
    };
    let better = facts.better_operator().map(|other| {
        let can = speeds.iter().filter(|speed| is_open_to(request, speed.engine, other));
        let can: Vec<Speed> = can.cloned().collect();
        (other, options(&facts.with(other), models, &can))
    });
    let alternatives = alternatives(&all, better.as_ref(), best, wanted);
    let evidence = evidence(&facts, models, best)?;
    if request.json {
        let alternatives: Vec<Value> = alternatives
            .iter()
            .map(|(what, option)| json!({ "what": what, "way": option.map(to_json) }))
            .collect();
        let all = json!({
            "wanted": wanted, "now": now.as_ref().ok().map(to_json), "plan": to_json(best),
            "alternatives": alternatives, "evidence": evidence,
        });
        say(&all.to_string());
    } else {
        print(&scene, &facts, wanted, now.as_ref(), best, &alternatives, &evidence);
    }
    match &request.write {
        Some(file) => write_scene(&scene, request, best, file),
        None => Ok(()),
    }
}

/// The scene as it is, on its own engine.
fn now(
    scene: &Scene,
    facts: &Facts,
    models: &Models,
    speeds: &[Speed],
) -> Result<PlanOption, Outside> {
    let none = |why: &str| Outside { why: why.to_owned(), nearest: None, may_be_worse: true };
    let collision = Preset::of(&scene.setup.collision)
        .ok_or_else(|| none("no run of the evidence has its relaxation rates"))?;
    let engine = EngineName::of(scene).unwrap_or(EngineName::cpu(scene.precision));
    let speed = speeds.iter().find(|speed| speed.engine == engine);
    as_it_is(facts, models, collision, speed.ok_or_else(|| none("its engine is not there"))?)
}

/// The scene as it is, at the end of a message.
fn now_words(now: &Result<PlanOption, Outside>) -> String {
    match now {
        Ok(now) => format!(
            "\nas it is: {} ({} to {}), {}",
            percent(now.error),
            percent(now.band[0]),
            percent(now.band[1]),
            words(now)
        ),
        Err(outside) => format!("\nas it is: {}", outside.why),
    }
}

/// The engines that may be proposed: the CPU engine, the kernel on a GPU in hardware, and whatever the scene asks for.
fn offered(scene: &Scene, request: &PlanRequest) -> Vec<EngineName> {
    let mut offered = vec![EngineName::cpu(scene.precision)];
    if adapters().iter().any(|adapter| !adapter.is_software()) {
        offered.push(EngineName::Wgpu);
    }
    offered.extend(EngineName::of(scene).filter(|own| !offered.contains(own)));
    // Not every engine moves free grains with every operator.
    offered.retain(|engine| {
        engine_changes(Some(engine.word()), None).is_ok_and(|changes| {
            Scene::load(&request.scene, &[request.set.clone(), changes].concat()).is_ok()
        })
    });
    offered
}

/// Their speed on this scene and machine.
fn speeds(scene: &Scene, request: &PlanRequest) -> Result<Vec<Speed>, CommandError> {
    let mut speeds = Vec::new();
    for name in offered(scene, request) {
        let mut set = request.set.clone();
        set.extend(engine_changes(Some(name.word()), None)?);
        let scene = Scene::load(&request.scene, &set)?;
        let mut engine = engine(&scene, &request.scene, false)?;
        let Some(pace) = calibrate(&scene, &mut engine, CALIBRATION) else {
            let problem =
                "its first steps fail: `psmrt run` says why; a plan needs a scene that runs";
            return Err(CommandError::Usage(format!("{}: {problem}", request.scene.display())));
        };
        let per_second = pace.updates_per_second;
        let is_srt = Preset::of(&scene.setup.collision) == Some(Preset::Srt);
        let ratio = mrt_over_srt(name)?;
        let (srt, mrt) = if is_srt {
            (1.0 / per_second, ratio / per_second)
        } else {
            (1.0 / per_second / ratio, 1.0 / per_second)
        };
        speeds.push(Speed { engine: name, mrt, srt });
    }
    Ok(speeds)
}

fn unreachable_error(
    all: &[PlanOption],
    wanted: f64,
    (facts, models): (&Facts, &Models),
    now: &Result<PlanOption, Outside>,
) -> CommandError {
    let now = now_words(now);
    let Some(best) = most_accurate(all, f64::INFINITY) else {
        return CommandError::Usage(format!("{}{now}", why_none(facts, models)));
    };
    CommandError::Usage(format!(
        "an error of {} is out of reach within the evidence: the best is {} ({} to {}), {}; ask for more \
         than {}{now}",
        percent(wanted),
        percent(best.error),
        percent(best.band[0]),
        percent(best.band[1]),
        words(best),
        percent(best.band[1])
    ))
}

/// Whether an engine has another operator of solid cells for a scene, and nothing else in the scene forbids it.
fn is_open_to(request: &PlanRequest, engine: EngineName, other: SolidMethod) -> bool {
    // Every engine has it for grains that are not free.
    if other == SolidMethod::Graded {
        return true;
    }
    let mut set = request.set.clone();
    set.push(format!("solid.operator=\"{}\"", other.operator().word()));
    engine_changes(Some(engine.word()), None)
        .is_ok_and(|changes| Scene::load(&request.scene, &[set, changes].concat()).is_ok())
}

/// What lies around a plan; `better`: the options with an operator of solid cells that is more accurate.
fn alternatives<'a>(
    all: &'a [PlanOption],
    better: Option<&'a (SolidMethod, Vec<PlanOption>)>,
    best: &PlanOption,
    wanted: f64,
) -> Vec<(String, Option<&'a PlanOption>)> {
    let mut found = vec![
        ("twice as fast".to_owned(), most_accurate(all, 0.5 * best.seconds)),
        ("half the error".to_owned(), cheapest(all, 0.5 * wanted)),
    ];
    if let Some((other, all)) = better {
        let word = other.operator().word();
        // A step is taken for as long with it.
        let same = most_accurate(all, best.seconds * (1.0 + 1e-9));
        found.push((format!("with {word}"), same));
    }
    for collision in Preset::ALL.into_iter().filter(|&other| other != best.collision) {
        let own: Vec<&PlanOption> =
            all.iter().filter(|option| option.collision == collision).collect();
        let best = own.into_iter().filter(|option| option.band[1] <= wanted);
        let best = best.min_by(|a, b| a.seconds.total_cmp(&b.seconds));
        found.push((format!("with {}", collision.title()), best));
    }
    found
}

/// What a plan rests on, a line each.
fn evidence(facts: &Facts, models: &Models, best: &PlanOption) -> Result<Vec<String>, TableError> {
    match &facts.limit {
        Limit::Grains { drag, because, .. } => {
            let mut lines = vec![format!(
                "drag over Stokes' drag about {drag:.3}: that of {because}; the error grows with it"
            )];
            lines.extend(support::of_grains(
                models,
                (best.collision, facts.solid),
                best.resolution,
                best.tau,
                *drag,
            )?);
            let reynolds =
                facts.si_velocity.map(|u| u * best.resolution * best.si_dx / facts.si_viscosity);
            lines.extend(support::of_reynolds(reynolds));
            Ok(lines)
        }
        Limit::Plates { .. } => Ok(support::of_walls(models, best.collision)),
        Limit::Shear { .. } => Ok(vec![
            "between plates of which one moves the profile is exact with SRT and with magic rates, and off by less \
             than 0.03 u^2 (u in cells per step) with d'Humieres' (reference/ERRATA.md)"
                .to_owned(),
        ]),
        Limit::Duct { ratio, .. } => Ok(vec![format!(
            "a duct {ratio:.2} times as wide as high: what half-way walls and the grid do to second order is known \
             in closed form (src/advice/plan/duct.rs); the ducts of golden/duct/expected.csv lie within the band"
        )]),
    }
}

/// Writes the planned scene; a file that is there stays.
fn write_scene(
    scene: &Scene,
    request: &PlanRequest,
    best: &PlanOption,
    file: &Path,
) -> Result<(), CommandError> {
    let failed = |error: String| CommandError::Write { path: file.display().to_string(), error };
    let folder = request.scene.parent().unwrap_or(Path::new(""));
    let comment = format!(
        "Planned by psmrt plan for an error of {}: predicted {} ({} to {}).",
        percent(request.error.0),
        percent(best.error),
        percent(best.band[0]),
        percent(best.band[1])
    );
    let text = text(scene, folder, best, &comment).map_err(|error| failed(error.to_string()))?;
    let name = file.display().to_string();
    // A plan that cannot be run is not written.
    Scene::from_bytes(
        &name,
        text.clone().into_bytes(),
        file.parent().unwrap_or(Path::new("")),
        &[],
    )?;
    atomic::write_new(file, |out| out.write_all(text.as_bytes())).map_err(|error| {
        match error.kind() {
            std::io::ErrorKind::AlreadyExists => CommandError::Usage(format!(
                "{name} is there already and stays: give --write another name, or remove it"
            )),
            _ => failed(error.to_string()),
        }
    })?;
    if !request.json {
        say(&format!("\nwritten to {name}"));
    }
    Ok(())
}
