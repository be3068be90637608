//! `psmrt resume --set`: goes on from the last state of a run with changed values, in a folder of its own.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use toml_edit::{DocumentMut, Item};

use super::execute::{execute, held};
use super::say::tell;
use super::{CommandError, engine, write};
use crate::checkpoint;
use crate::output::atomic;
use crate::output::folder::{RunFolder, scene_name};
use crate::quote::shown;
use crate::scene::Scene;
use crate::scene::names::{ORIGIN, SCENE};

/// What `psmrt resume` is asked for.
#[derive(Clone, Debug)]
pub struct ResumeRequest {
    /// The folder of the run.
    pub folder: PathBuf,
    /// The checkpoint to go on from; the newest where `None`.
    pub checkpoint: Option<PathBuf>,
    /// Changes `key=value`: then it goes on in another folder.
    pub set: Vec<String>,
    /// That folder; one beside the others of `out/` where `None`.
    pub out: Option<PathBuf>,
    /// Whether to print one JSON object instead of text.
    pub json: bool,
}

/// What may be changed, as messages list it.
const MAY_CHANGE: &str = "title, stop, records, checkpoint, body_force.acceleration, gravity.acceleration, the velocity and \
                          pressure of faces, the velocity and spin of prescribed grains, contact and lubrication";

/// Goes on from the newest checkpoint of a run, or the one that is named.
pub(super) fn go_on(request: &ResumeRequest) -> Result<(), CommandError> {
    let path = &request.folder;
    let file = path.join(SCENE);
    let refused = |problem: String| Err(CommandError::Resume(problem));
    let folder = held(RunFolder::open(path)?);
    let was = Scene::load(&file, &[])?;
    for change in &request.set {
        let key = change.split_once('=').map_or(change.as_str(), |(key, _)| key).trim();
        if let Some(why) = obstacle(key, &was) {
            return refused(format!(
                "--set {}: {why}; what may change is: {MAY_CHANGE} (a new run of a changed scene: psmrt run {})",
                shown(change),
                file.display()
            ));
        }
    }
    let scene = Scene::load(&file, &request.set)?;
    if was.setup.body_force.is_none() && scene.setup.body_force.is_some() {
        return refused(
            "--set body_force.acceleration: the run has no body force, and what was computed without one cannot take one \
             later; start a new run with `acceleration = [0.0, 0.0, 0.0]` in [body_force], which can"
                .to_owned(),
        );
    }
    let known = checkpoint::list(path)
        .map_err(|error| CommandError::Checkpoint { error, older: String::new() })?;
    let Some(state) = request.checkpoint.as_ref().or(known.last()) else {
        return refused(format!(
            "{} has no saved state to go on from: it has been removed, or the scene has `checkpoint.at_end = false`",
            path.display()
        ));
    };
    let mut engine = engine(&scene, &file, false)?;
    checkpoint::load_with_changes(state, &folder, &was, &mut engine)
        .map_err(|error| CommandError::Checkpoint { error, older: String::new() })?;
    if scene.stop.steps <= engine.steps() {
        let si_time = engine.steps() as f64 * scene.units.si_dt;
        return refused(format!(
            "the run has come to step {} ({si_time:.6e} s) already, and is to stop at step {}: give a later end, counted \
             from its very start, for example --set stop.time={:.3e}",
            engine.steps(),
            scene.stop.steps,
            2.0 * si_time
        ));
    }
    let new = held(RunFolder::make(request.out.as_deref(), &scene_name(&file))?);
    let origin = json!({
        "folder": path.display().to_string(), "run": folder.id(), "step": engine.steps(),
        "changes": request.set,
    });
    keep_origin(&new, &origin)?;
    write(new.path(), |_| new.keep(&scene))?;
    tell(&format!("going on from step {} ({})", engine.steps(), state.display()));
    execute(&scene, &mut engine, &new, None, request.json)
}

/// Keeps from where a run goes on. First of all: a folder without a state of its own is then known to have no beginning of
/// its own either.
pub(super) fn keep_origin(folder: &RunFolder, origin: &Value) -> Result<(), CommandError> {
    write(&folder.path().join(ORIGIN), |path| {
        atomic::write(path, |out| out.write_all(format!("{origin:#}\n").as_bytes()))
    })
}

/// Why a key cannot be changed, if it cannot.
fn obstacle(key: &str, was: &Scene) -> Option<String> {
    let parts: Vec<&str> = key.split('.').map(str::trim).collect();
    let section = parts[0].split('[').next().unwrap_or_default();
    let last = parts.get(1).copied().unwrap_or_default();
    let fixed = |what: &str| Some(format!("{what} cannot change in a run that goes on"));
    match section {
        "title" | "stop" | "records" | "checkpoint" | "contact" | "lubrication" => None,
        "body_force" | "gravity" if last == "acceleration" => None,
        "faces" if matches!(parts.get(2).copied(), Some("velocity" | "pressure")) => None,
        "faces" => fixed("the kind of a face, and what belongs to it,"),
        "grains" if matches!(last, "velocity" | "spin") => {
            let document = was.text.parse::<DocumentMut>().ok()?;
            let key = format!("{}.motion", parts[0]);
            let mut root = document.into_item();
            let motion = crate::scene::find_mut(&mut root, &key).and_then(|item| motion(item));
            let is_prescribed = motion.as_deref() == Some("prescribed");
            (!is_prescribed)
                .then(|| "the motion of a grain that is not prescribed is its own".to_owned())
        }
        "grains" => fixed("grains, but for the motion of those that are prescribed,"),
        "domain" | "fluid" | "time" => fixed("grid, fluid and time step"),
        "collision" | "solid" | "coupling" => fixed("how it is computed"),
        "engine" => fixed("the engine, in whose form the state is saved,"),
        _ => fixed("this"),
    }
}

fn motion(item: &Item) -> Option<String> {
    item.as_str().map(str::to_owned)
}

/// Errors if a folder without a saved state is that of a run that goes on from another's.
pub(super) fn check_origin(folder: &Path) -> Result<(), CommandError> {
    if !folder.join(ORIGIN).exists() {
        return Ok(());
    }
    Err(CommandError::Resume(format!(
        "{} goes on from the state of another run (see its {ORIGIN}), and was ended before it had saved one of its own: \
         remove it, and give the command again that made it",
        folder.display()
    )))
}
