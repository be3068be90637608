//! `psmrt resume`: goes on with a run that was interrupted, killed, or stopped by a full disk.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::execute::{execute, held};
pub use super::go_on::ResumeRequest;
use super::go_on::{check_origin, go_on};
use super::say::{say, tell};
use super::{CommandError, engine, write};
use crate::checkpoint::{self, CheckpointError, Header, Progress};
use crate::engine::Coupled;
use crate::output::folder::RunFolder;
use crate::run::{check_tables, set_aside};
use crate::scene::Scene;
use crate::scene::names::{FACTS, SCENE};

/// Resumes a run. One that has finished is left as it is.
pub fn resume(request: &ResumeRequest) -> Result<(), CommandError> {
    let path = &request.folder;
    let file = path.join(SCENE);
    if !file.is_file() {
        let problem = format!(
            "{} is no folder of a run: it has no scene.toml (a run that was killed before it had written \
             its scene has computed nothing: remove the folder and use `psmrt run` again)",
            path.display()
        );
        return Err(CommandError::Resume(problem));
    }
    if !request.set.is_empty() {
        return go_on(request);
    }
    if let Some(out) = &request.out {
        return Err(CommandError::Usage(format!(
            "--out {}: a run that goes on unchanged goes on in its own folder; leave it out, or change something by --set",
            out.display()
        )));
    }
    if let Some(facts) = finished(path)? {
        say_finished(path, &facts, request.json);
        return Ok(());
    }
    let folder = held(RunFolder::open(path)?);
    // Its process may have ended it while this one waited for nothing.
    if let Some(facts) = finished(path)? {
        say_finished(path, &facts, request.json);
        return Ok(());
    }
    let scene = Scene::load(&file, &[])?;
    let mut engine = engine(&scene, &file, false)?;
    let named = request.checkpoint.as_ref();
    let progress = where_it_goes_on(named, &folder, &scene, &mut engine)?;
    execute(&scene, &mut engine, &folder, progress.as_ref(), request.json)
}

/// Puts the engine where a run goes on, at its newest checkpoint or the one that is named; at its beginning, and then there
/// is no progress, if it has none.
pub(super) fn where_it_goes_on(
    named: Option<&PathBuf>,
    folder: &RunFolder,
    scene: &Scene,
    engine: &mut Coupled,
) -> Result<Option<Progress>, CommandError> {
    let progress = go_back(named, folder, scene, engine)?;
    if progress.is_none() {
        let path = folder.path();
        check_origin(path)?;
        tell("there is no checkpoint yet: the run starts again from its beginning");
        for moved in write(path, |_| set_aside(scene, folder))? {
            tell(&format!("what it had written is set aside as {}", moved.display()));
        }
    }
    Ok(progress)
}

/// What a run says about itself, if it has come to its end.
pub(super) fn finished(folder: &Path) -> Result<Option<Value>, CommandError> {
    let file = folder.join(FACTS);
    let unusable = |error: String| {
        CommandError::Resume(format!(
            "{} cannot be read ({error}), so that it is not known whether the run has finished: make it \
             readable, or remove it if it has not",
            file.display()
        ))
    };
    let text = match std::fs::read_to_string(&file) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        text => text.map_err(|error| unusable(error.to_string()))?,
    };
    let facts: Value = serde_json::from_str(&text).map_err(|error| unusable(error.to_string()))?;
    Ok((facts["finished"] == true).then_some(facts))
}

fn say_finished(folder: &Path, facts: &Value, json: bool) {
    let folder = folder.display().to_string();
    if json {
        say(&json!({ "folder": folder, "run": facts, "resumed": false }).to_string());
        return;
    }
    say(&format!(
        "this run has finished ({}) after {} steps: there is nothing to go on with\n\
         (longer, or with other values: psmrt resume {folder} --set stop.steps=... --out DIR)\nresults in {folder}",
        facts["state"].as_str().unwrap_or("at its end"),
        facts["steps"]
    ));
}

/// Puts the engine into the state of the checkpoint; `None` if there is none.
fn go_back(
    named: Option<&PathBuf>,
    folder: &RunFolder,
    scene: &Scene,
    engine: &mut Coupled,
) -> Result<Option<Progress>, CommandError> {
    let known = checkpoint::list(folder.path()).map_err(unusable)?;
    let Some(path) = named.or(known.last()) else { return Ok(None) };
    let loaded = usable(path, folder, scene, engine)
        .and_then(|_| checkpoint::load(path, folder, scene, engine).map_err(unusable));
    match loaded {
        Ok(progress) => {
            tell(&format!("going on from step {} ({})", engine.steps(), path.display()));
            Ok(Some(progress))
        }
        Err(error) => {
            let fits =
                |other: &&PathBuf| *other < path && usable(other, folder, scene, engine).is_ok();
            let older = known.iter().rev().find(fits);
            let older = older.map_or_else(String::new, |older| offer(folder.path(), older));
            Err(match error {
                CommandError::Checkpoint { error, .. } => CommandError::Checkpoint { error, older },
                CommandError::Table { error, .. } => CommandError::Table { error, older },
                other => other,
            })
        }
    }
}

/// Errors unless a run can go on from a checkpoint: it is whole, it is this run's, and so are the tables.
fn usable(
    path: &Path,
    folder: &RunFolder,
    scene: &Scene,
    engine: &Coupled,
) -> Result<Header, CommandError> {
    let header = checkpoint::check(path, folder, scene, engine).map_err(unusable)?;
    check_tables(scene, folder.path(), &header.progress)
        .map_err(|error| CommandError::Table { error, older: String::new() })?;
    Ok(header)
}

fn unusable(error: CheckpointError) -> CommandError {
    CommandError::Checkpoint { error, older: String::new() }
}

fn offer(folder: &Path, older: &Path) -> String {
    format!(
        "\nan older one is there: psmrt resume {} --checkpoint {}",
        folder.display(),
        older.display()
    )
}
