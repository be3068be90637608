//! What `run` and `resume` share: the loop with its progress, and what is said and kept at the end.

use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Instant, SystemTime, UNIX_EPOCH};

use psmrt_report::{Figure, write_svg};
use serde_json::{Value, json};

use super::progress::Progress as ProgressBar;
use super::{CommandError, comparison, info, profile, summary, write};
use crate::checkpoint::Progress;
use crate::engine::Engine;
use crate::estimate::{Warning, disk, warnings};
use crate::output::{atomic, csv, grain_plots, plot};
use crate::run::{End, run as run_scene};
use crate::scene::{Scene, What};

/// Exit code after a second interruption, which does not wait for the state to be saved.
const INTERRUPTED: i32 = 130;

/// Runs a scene from where `engine` is, with its results in `folder`.
pub(super) fn execute(
    scene: &Scene,
    engine: &mut dyn Engine,
    folder: &Path,
    resumed: Option<&Progress>,
    json: bool,
) -> Result<(), CommandError> {
    let (start, first_step) = (Instant::now(), engine.steps());
    if !json {
        warn(scene, folder);
    }
    write_facts(scene, engine, folder, (first_step, start), ("running", None))?;
    let mut progress = ProgressBar::new(scene, json, interruption());
    let end = run_scene(scene, engine, folder, resumed, &mut progress);
    drop(progress);
    let word = match &end {
        Ok(End::Steady { .. }) => "steady",
        Ok(End::NotSteady { .. }) => "not steady",
        Ok(End::Limit) => "limit",
        Ok(End::Interrupted) => "interrupted",
        Err(_) => "failed",
    };
    // A run that failed on a full disk should say that, not that its facts cannot be written.
    let facts = write_facts(scene, engine, folder, (first_step, start), (word, end.as_ref().ok()));
    let (end, facts) = (end?, facts?);
    let verdict =
        if let End::NotSteady { .. } = end { Err(CommandError::NotSteady) } else { Ok(()) };
    if end == End::Interrupted {
        return Err(CommandError::Interrupted { folder: folder.display().to_string() });
    }
    let found = match &scene.exact {
        Some(exact) => Some(comparison::compare(scene, exact, engine, folder)?),
        None => None,
    };
    draw_records(scene, folder)?;
    if json {
        let comparison = found.as_ref().map(comparison::to_json);
        let profile = engine.profile().map(|profile| profile::to_json(&profile));
        let all = json!({
            "folder": folder, "run": facts, "comparison": comparison, "profile": profile,
        });
        say(&all.to_string());
        return verdict;
    }
    let steps = engine.steps();
    let seconds = start.elapsed().as_secs_f64();
    let updates = (steps - first_step) as f64 * scene.setup.domain.cell_count() as f64;
    say(&format!(
        "{} after {steps} steps ({:.4e} s); {seconds:.2} s of computing, {:.2} million cell updates \
         a second",
        match end {
            End::Steady { .. } => "steady",
            End::NotSteady { .. } => "at its limit and NOT steady",
            End::Limit | End::Interrupted => "at its limit",
        },
        steps as f64 * scene.units.si_dt,
        updates / seconds / 1e6
    ));
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
    if let Some(trouble) = summary::not_steady(scene, engine, end) {
        say(&trouble);
    }
    say(&format!("results in {}", folder.display()));
    verdict
}

/// Says beforehand what looks risky, a line each; `run.json` and `--json` have it too.
fn warn(scene: &Scene, folder: &Path) {
    for Warning { reason, remedy } in all_warnings(scene, folder) {
        // Whoever has closed this has decided not to be warned.
        let _ = writeln!(std::io::stderr(), "warning: {reason} (help: {remedy})");
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
        let table = folder.join(format!("{}.csv", record.name));
        let title = format!("{} ({})", scene.title, record.name);
        let rows = || csv::read(&table);
        let figure = || -> std::io::Result<Option<Figure>> {
            Ok(match record.what {
                What::Box => Some(plot::box_record(&title, &rows()?)),
                What::Profile { axis, .. } => Some(plot::line_record(&title, axis, &rows()?)),
                What::Loads => grain_plots::loads(&title, &table)?,
                What::GrainMeans => grain_plots::means(&title, &rows()?),
                What::Fields { .. } | What::Slice { .. } | What::Grains => None,
            })
        };
        write(&table.with_extension("svg"), |path| match figure() {
            Ok(None) => Ok(()),
            Ok(Some(figure)) => write_svg(&figure, path).map_err(|error| error.to_string()),
            Err(error) => Err(error.to_string()),
        })?;
    }
    Ok(())
}

/// Prints a line. A reader who has gone away is no reason to fail.
pub(super) fn say(line: &str) {
    let _ = writeln!(std::io::stdout(), "{line}");
}

/// Becomes true at Ctrl-C (or SIGTERM); the second one ends the process at once.
pub(super) fn interruption() -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    let set = ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED);
        }
    });
    if let Err(error) = set {
        eprintln!("warning: Ctrl-C will not save the state: {error}");
    }
    interrupted
}

/// Writes `run.json`: what is needed to repeat the run, and how it went.
fn write_facts(
    scene: &Scene,
    engine: &dyn Engine,
    folder: &Path,
    (first_step, start): (u64, Instant),
    (state, end): (&str, Option<&End>),
) -> Result<Value, CommandError> {
    let unix_time =
        SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |duration| duration.as_secs());
    let facts = json!({
        "state": state,
        "title": scene.title,
        "engine": engine.name(),
        "adapter": engine.adapter(),
        "first_step": first_step,
        "steps": engine.steps(),
        "wall_seconds": start.elapsed().as_secs_f64(),
        "written_unix_time": unix_time,
        "dt_s": scene.units.si_dt,
        "dx_m": scene.units.si_dx,
        "tau": scene.setup.collision.tau(),
        "warnings": all_warnings(scene, folder),
        "steady": end.map(|&end| summary::steady(scene, engine, end)),
        "results": end.map(|_| summary::results(scene, engine)),
        "files": {
            "csv": "SI units, in the first line of each table; box: means over all cells, solids included",
            "npy": "axes z, y, x and, of vectors, component (x, y, z); cell centres; SI units",
        },
        "program": info::program(),
        "machine": info::machine(),
    });
    let text = format!("{facts:#}\n");
    write(&folder.join("run.json"), |path| {
        atomic::write(path, |out| out.write_all(text.as_bytes()))
    })?;
    Ok(facts)
}
