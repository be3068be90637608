//! `psmrt run`: a scene from its file to results in a folder.

use std::io::Write;
use std::path::PathBuf;

use super::execute::execute;
use super::{CommandError, engine, write};
use crate::output::{atomic, folder};
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
    let mut engine = engine(&scene, &request.scene, request.profile)?;
    if request.profile && engine.profile().is_none() {
        eprintln!("--profile: the engine {} does not keep its times", engine.name());
    }
    let folder = folder::make(request.out.as_deref(), &folder::scene_name(&request.scene))?;
    // The copies of the files that the scene names come first: a folder with a scene in it is whole.
    for attachment in &scene.attachments {
        write(&folder.join(attachment.file_name()), |path| {
            atomic::write(path, |out| out.write_all(&attachment.bytes))
        })?;
    }
    let scene = scene.with_copied_attachments()?;
    write(&folder.join("scene.toml"), |path| {
        atomic::write(path, |out| out.write_all(scene.text.as_bytes()))
    })?;
    execute(&scene, engine.as_mut(), &folder, None, request.json)
}
