//! `psmrt run`: a scene from its file to results in a folder.

use std::path::PathBuf;

use super::beginning::with_fluid_of_run;
use super::execute::{execute, held};
use super::go_on::keep_origin;
use super::say::tell;
use super::{CommandError, engine, kind_of, write};
use crate::output::folder::{RunFolder, scene_name};
use crate::scene::Scene;

/// What `psmrt run` is asked for.
#[derive(Clone, Debug)]
pub struct RunRequest {
    /// The scene file.
    pub scene: PathBuf,
    /// Changes `key=value`.
    pub set: Vec<String>,
    /// Where the results go.
    pub out: Option<PathBuf>,
    /// Whether to print where the time went.
    pub profile: bool,
    /// Whether to print one JSON object instead of text.
    pub json: bool,
}

/// Runs a scene.
pub fn run(request: &RunRequest) -> Result<(), CommandError> {
    let scene = Scene::load(&request.scene, &request.set)?;
    let (scene, origin) = with_fluid_of_run(scene, &request.scene)?;
    let mut engine = engine(&scene, &request.scene, request.profile)?;
    if request.profile && engine.profile().is_none() {
        tell(&format!("--profile: the engine {} does not keep its times", engine.name()));
    }
    let scene = scene.as_run(kind_of(&engine))?;
    let folder = held(RunFolder::make(request.out.as_deref(), &scene_name(&request.scene))?);
    if let Some(origin) = &origin {
        keep_origin(&folder, origin)?;
    }
    write(folder.path(), |_| folder.keep(&scene))?;
    execute(&scene, &mut engine, &folder, None, request.json)
}
