//! The folder of a run. Nothing that is there already is ever overwritten.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// A folder that cannot be used.
#[derive(Debug, Error)]
pub enum FolderError {
    /// The folder that was asked for holds something.
    #[error("{path} is not empty: name another folder with --out, or `psmrt resume {path}`")]
    NotEmpty {
        /// The folder.
        path: String,
    },
    /// It cannot be made.
    #[error("the folder {path} cannot be made: {error}")]
    Make {
        /// The folder.
        path: String,
        /// Why.
        error: io::Error,
    },
}

/// Name of a scene: its file's, or its folder's where the file is called `scene.toml`.
pub fn scene_name(scene: &Path) -> String {
    let stem = scene.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let parent = fs::canonicalize(scene)
        .ok()
        .and_then(|path| Some(path.parent()?.file_name()?.to_string_lossy().into_owned()));
    match (stem, parent) {
        (Some(stem), Some(parent)) if stem == "scene" => parent,
        (Some(stem), _) => stem,
        (None, _) => "scene".to_owned(),
    }
}

/// The folder of a new run: `out`, which must be empty or absent, or else the first of
/// `out/<name>`, `out/<name>-2`, ... that is free.
pub fn make(out: Option<&Path>, name: &str) -> Result<PathBuf, FolderError> {
    let make_error =
        |path: &Path, error| FolderError::Make { path: path.display().to_string(), error };
    if let Some(path) = out {
        fs::create_dir_all(path).map_err(|error| make_error(path, error))?;
        let mut entries = fs::read_dir(path).map_err(|error| make_error(path, error))?;
        return match entries.next() {
            None => Ok(path.to_owned()),
            Some(_) => Err(FolderError::NotEmpty { path: path.display().to_string() }),
        };
    }
    let parent = Path::new("out");
    fs::create_dir_all(parent).map_err(|error| make_error(parent, error))?;
    for number in 1_u64.. {
        let suffix = if number == 1 { String::new() } else { format!("-{number}") };
        let path = parent.join(format!("{name}{suffix}"));
        match fs::create_dir(&path) {
            Ok(()) => return Ok(path),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(make_error(&path, error)),
        }
    }
    Err(make_error(parent, io::Error::other("every number is taken")))
}
