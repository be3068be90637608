//! What `run` and `resume` share: the loop with its progress, and what is said and kept at the end.

use std::io::Write;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::{Instant, SystemTime, UNIX_EPOCH};

use psmrt_report::Figure;
use serde_json::{Value, json};

use super::conclusions::conclusions;
use super::progress::ProgressLine;
use super::say::{say, tell};
use super::{CommandError, comparison, info, profile, summary, write};
use crate::advice::estimate::{Warning, disk, operator, warnings};
use crate::checkpoint::{self, Progress};
use crate::engine::Coupled;
use crate::exact::Comparison;
use crate::output::folder::RunFolder;
use crate::output::{atomic, bed_plots, csv, grain_list, grain_plots, plot};
use crate::run::{End, run as run_scene};
use crate::scene::names;
use crate::scene::{Scene, What};

/// The states of runs that there is nothing to go on with.
const FINISHED: [&str; 3] = ["steady", "not steady", "limit"];

/// Exit code after a second interruption, which does not wait for the state to be saved.
const INTERRUPTED: i32 = 130;

/// A run that has come to its end.
pub(super) struct CarriedOut {
    /// How.
    pub end: End,
    /// Beside an exact solution.
    found: Option<Comparison>,
    /// What `run.json` says.
    pub facts: Value,
    first_step: u64,
    seconds: f64,
}

/// Runs a scene from where `engine` is, with its results in `folder`; says nothing if `quiet` but on the way.
pub(super) fn carried_out(
    scene: &Scene,
    engine: &mut Coupled,
    folder: &RunFolder,
    resumed: Option<&Progress>,
    quiet: bool,
) -> Result<CarriedOut, CommandError> {
    let (start, first_step) = (Instant::now(), engine.steps());
    if !quiet {
        warn(scene, folder.path());
    }
    let facts = |engine: &Coupled, state: &str, end: Option<End>| {
        write_facts(scene, engine, folder, (first_step, start), (state, end))
    };
    facts(engine, "running", None)?;
    let mut progress = ProgressLine::new(scene, quiet, interruption());
    let end = run_scene(scene, engine, folder, resumed, &mut progress);
    drop(progress);
    let end = match end {
        Ok(End::Interrupted) => {
            facts(engine, "interrupted", None)?;
            let folder = folder.path().display().to_string();
            return Err(CommandError::Interrupted { folder });
        }
        Ok(end) => end,
        Err(error) => {
            // A run that failed on a full disk should say that, not that its facts cannot be written.
            let _ = facts(engine, "failed", None);
            return Err(error.into());
        }
    };
    let path = folder.path();
    let found = match &scene.exact {
        Some(exact) => Some(comparison::compare(scene, exact, engine, path)?),
        None => None,
    };
    draw_records(scene, path)?;
    if let Some(list) = grain_list::of_run(scene, engine) {
        write(&path.join(names::GRAINS_AT_END), |path| {
            atomic::write(path, |out| out.write_all(list.as_bytes()))
        })?;
    }
    // These come last: a run that says that it has finished has all its files.
    let word = match end {
        End::Steady { .. } => "steady",
        End::NotSteady { .. } => "not steady",
        End::Limit | End::Interrupted => "limit",
    };
    let facts = facts(engine, word, Some(end))?;
    Ok(CarriedOut { end, found, facts, first_step, seconds: start.elapsed().as_secs_f64() })
}

/// Runs a scene as [`carried_out`] does, and says what came of it.
pub(super) fn execute(
    scene: &Scene,
    engine: &mut Coupled,
    folder: &RunFolder,
    resumed: Option<&Progress>,
    json: bool,
) -> Result<(), CommandError> {
    let CarriedOut { end, found, facts, first_step, seconds } =
        carried_out(scene, engine, folder, resumed, json)?;
    let path = folder.path();
    let verdict = match end {
        End::NotSteady { .. } => Err(CommandError::NotSteady),
        End::Steady { .. } | End::Limit | End::Interrupted => Ok(()),
    };
    if json {
        let comparison = found.as_ref().map(comparison::to_json);
        let profile = engine.profile().map(|profile| profile::to_json(&profile));
        let all = json!({
            "folder": path.display().to_string(), "run": facts, "comparison": comparison, "profile": profile,
        });
        say(&all.to_string());
        return verdict;
    }
    let steps = engine.steps();
    let updates = (steps - first_step) as f64 * scene.updates_per_step() as f64;
    say(&format!(
        "{} after {steps} steps ({:.4e} s); {seconds:.2} s of computing, {:.2} million {} a second",
        match end {
            End::Steady { .. } => "steady",
            End::NotSteady { .. } => "at its limit and NOT steady",
            End::Limit | End::Interrupted => "at its limit",
        },
        steps as f64 * scene.units.si_dt,
        updates / seconds / 1e6,
        scene.update_name()
    ));
    if let Some(operator) = operator(scene) {
        say(&operator);
    }
    if let Some(profile) = engine.profile() {
        say(&profile::to_text(&profile));
    }
    if let (Some(found), Some(exact)) = (&found, &scene.exact) {
        say(&comparison::to_text(exact, found));
    }
    let last = summary::to_text(scene, engine);
    if !last.is_empty() {
        say(&format!("at the end:\n{last}"));
    }
    for found in conclusions(scene, engine, end) {
        say(&found.text);
    }
    if let Some(trouble) = summary::not_steady(scene, engine, end) {
        say(&trouble);
    }
    if let Some(kept) = checkpoint::list(path).ok().and_then(|all| all.last().cloned()) {
        let size = std::fs::metadata(&kept).map_or(0.0, |facts| facts.len() as f64);
        say(&format!(
            "its last state is kept, {} (not with checkpoint.at_end = false); going on: psmrt resume {} --set ...",
            disk::words(size),
            path.display()
        ));
    }
    say(&format!("results in {}", path.display()));
    verdict
}

/// Says beforehand what looks risky, a line each; `run.json` and `--json` have it too.
fn warn(scene: &Scene, folder: &Path) {
    for Warning { reason, remedy } in all_warnings(scene, folder) {
        tell(&format!("warning: {reason} (help: {remedy})"));
    }
}

/// What looks risky about the scene, and about where it writes.
fn all_warnings(scene: &Scene, folder: &Path) -> Vec<Warning> {
    let mut all = warnings(scene);
    all.extend(disk::warnings(scene, folder));
    all
}

/// Draws the records that a curve can show.
fn draw_records(scene: &Scene, folder: &Path) -> Result<(), CommandError> {
    for record in &scene.records {
        let table = folder.join(names::table(&record.name));
        let title = format!("{} ({})", scene.title, record.name);
        let rows = || csv::read(&table);
        let figure = || -> std::io::Result<Option<Figure>> {
            Ok(match record.what {
                What::Box => Some(plot::box_record(&title, &rows()?)),
                What::Profile { axis, .. } => Some(plot::line_record(&title, axis, &rows()?)),
                What::Loads => grain_plots::loads(&title, &table)?,
                What::GrainMeans => grain_plots::means(&title, &rows()?),
                What::ContactMeans => bed_plots::contacts(&title, &rows()?),
                What::Layers { axis, .. } => bed_plots::layers(&title, axis, &rows()?),
                What::Permeability { .. } => Some(plot::permeability_record(&title, &rows()?)),
                What::Walls
                | What::Fields { .. }
                | What::Slice { .. }
                | What::Grains
                | What::Contacts => None,
            })
        };
        write(&folder.join(names::picture(&record.name)), |path| match figure()? {
            None => Ok(()),
            Some(figure) => comparison::write_figure(&figure, path),
        })?;
    }
    Ok(())
}

/// Says where nothing keeps a second process out of the folder of a run.
pub(super) fn held(folder: RunFolder) -> RunFolder {
    if !folder.is_locked() {
        tell(&format!(
            "warning: the file system of {} has no locks: do not start a second run or resume there",
            folder.path().display()
        ));
    }
    folder
}

/// Becomes true at Ctrl-C (or SIGTERM); the second one ends the process at once.
pub fn interruption() -> Arc<AtomicBool> {
    // A command of several runs asks for each, and a handler is set but once.
    static INTERRUPTED_BY_USER: OnceLock<Arc<AtomicBool>> = OnceLock::new();
    Arc::clone(INTERRUPTED_BY_USER.get_or_init(watch_for_interruption))
}

fn watch_for_interruption() -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    let set = ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED);
        }
    });
    if let Err(error) = set {
        tell(&format!("warning: Ctrl-C will not save the state: {error}"));
    }
    interrupted
}

/// Writes `run.json`: what is needed to repeat the run, and how it went.
fn write_facts(
    scene: &Scene,
    engine: &Coupled,
    folder: &RunFolder,
    (first_step, start): (u64, Instant),
    (state, end): (&str, Option<End>),
) -> Result<Value, CommandError> {
    let unix_time =
        SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |duration| duration.as_secs());
    let facts = json!({
        "state": state,
        "finished": FINISHED.contains(&state),
        "id": folder.id(),
        "title": scene.title,
        "engine": engine.name(),
        "adapter": engine.adapter(),
        "first_step": first_step,
        "steps": engine.steps(),
        "wall_seconds": start.elapsed().as_secs_f64(),
        "written_unix_time": unix_time,
        "dt_s": scene.units.si_dt,
        "dx_m": scene.units.si_dx,
        "tau": (!scene.is_dry).then(|| scene.setup.collision.tau()),
        "solid_operator": operator(scene),
        "warnings": all_warnings(scene, folder.path()),
        "steady": end.map(|end| summary::steady(scene, engine, end)),
        "results": end.map(|_| summary::results(scene, engine)),
        "conclusions": end.map(|end| -> Vec<Value> {
            conclusions(scene, engine, end).into_iter().map(|found| found.json).collect()
        }),
        "files": {
            "csv": "SI units, in the first line of each table; box: means over all cells, solids included",
            "npy": "axes z, y, x and, of vectors, component (x, y, z); cell centres; SI units",
        },
        "program": info::program(),
        "machine": info::machine(),
    });
    let text = format!("{facts:#}\n");
    write(&folder.path().join(names::FACTS), |path| {
        atomic::write(path, |out| out.write_all(text.as_bytes()))
    })?;
    Ok(facts)
}
