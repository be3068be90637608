//! `psmrt resume`: goes on with a run that was interrupted, killed, or stopped by a full disk.

use std::path::{Path, PathBuf};

use super::execute::execute;
use super::{CommandError, engine, write};
use crate::checkpoint::{self, Progress};
use crate::engine::Engine;
use crate::run::forget_records;
use crate::scene::Scene;

/// What `psmrt resume` is asked for.
#[derive(Clone, Debug)]
pub struct ResumeRequest {
    /// The folder of the run.
    pub folder: PathBuf,
    /// The checkpoint to go on from; the newest where `None`.
    pub checkpoint: Option<PathBuf>,
    /// Whether to print one JSON object instead of text.
    pub json: bool,
}

/// Resumes a run.
pub fn resume(request: &ResumeRequest) -> Result<(), CommandError> {
    let folder = &request.folder;
    let file = folder.join("scene.toml");
    if !file.is_file() {
        let problem = format!(
            "{} is no folder of a run: it has no scene.toml (a run that was killed before it had written \
             its scene has computed nothing: remove the folder and use `psmrt run` again)",
            folder.display()
        );
        return Err(CommandError::Resume(problem));
    }
    let scene = Scene::load(&file, &[])?;
    let mut engine = engine(&scene, &file, false)?;
    let progress = go_back(request, &scene, engine.as_mut())?;
    if progress.is_none() {
        eprintln!("there is no checkpoint yet: the run starts again from its beginning");
        write(folder, |folder| forget_records(&scene, folder))?;
    }
    execute(&scene, engine.as_mut(), folder, progress.as_ref(), request.json)
}

/// Puts the engine into the state of the checkpoint; `None` if there is none.
fn go_back(
    request: &ResumeRequest,
    scene: &Scene,
    engine: &mut dyn Engine,
) -> Result<Option<Progress>, CommandError> {
    let known = checkpoint::list(&request.folder);
    let Some(path) = request.checkpoint.as_ref().or(known.last()) else { return Ok(None) };
    match checkpoint::load(path, scene, engine) {
        Ok(progress) => {
            eprintln!("going on from step {} ({})", engine.steps(), path.display());
            Ok(Some(progress))
        }
        Err(error) => {
            let older = known.iter().rev().find(|other| *other < path);
            let older = older.map_or_else(String::new, |older| offer(&request.folder, older));
            Err(CommandError::Checkpoint { error, older })
        }
    }
}

fn offer(folder: &Path, older: &Path) -> String {
    format!(
        "\nan older one is there: psmrt resume {} --checkpoint {}",
        folder.display(),
        older.display()
    )
}
