//! The folder of a run. Nothing that is there already is ever overwritten, and one process at a time
//! writes into it.

use std::fs;
use std::hash::{BuildHasher, Hasher, RandomState};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use thiserror::Error;

use super::atomic;
use super::lock::{Lock, Refused};
use crate::scene::Scene;
use crate::scene::names::{self, ID, LOCK, SCENE};

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
    /// Another process writes into it.
    #[error(
        "{holder} is writing into {path}: wait until it has ended or end it (Ctrl-C saves its state), or \
         name another folder"
    )]
    Held {
        /// The folder.
        path: String,
        /// Who.
        holder: String,
    },
    /// A file that every run has cannot be made or read.
    #[error("{path}: {error}; a run needs a folder that it may write into")]
    File {
        /// The file.
        path: String,
        /// Why.
        error: io::Error,
    },
}

/// The folder of a run, held by this process.
#[derive(Debug)]
pub struct RunFolder {
    path: PathBuf,
    id: String,
    lock: Lock,
}

impl RunFolder {
    /// The folder of a new run: `out`, which must be empty or absent, or else the first of
    /// `out/<name>`, `out/<name>-2`, ... that is free.
    pub fn make(out: Option<&Path>, name: &str) -> Result<Self, FolderError> {
        let Some(path) = out else {
            let parent = Path::new("out");
            fs::create_dir_all(parent).map_err(|error| make_error(parent, error))?;
            return Self::open(&first_free(parent, name)?);
        };
        fs::create_dir_all(path).map_err(|error| make_error(path, error))?;
        // What a run that was killed at once has left is nothing; a folder of other things is not to get
        // a lock.
        if !is_unused(path)? {
            return Err(match path.join(LOCK).exists().then(|| Lock::take(path)) {
                Some(Err(Refused::Held(holder))) => held(path, holder),
                _ => FolderError::NotEmpty { path: path.display().to_string() },
            });
        }
        let lock = take(path)?;
        // Whoever had it until now may have begun and ended a run.
        if !is_unused(path)? {
            return Err(FolderError::NotEmpty { path: path.display().to_string() });
        }
        Self::with_lock(path, lock)
    }

    /// The folder of a run that has begun, or an empty one.
    pub fn open(path: &Path) -> Result<Self, FolderError> {
        Self::with_lock(path, take(path)?)
    }

    /// A fresh folder beside one that is gone, called after it.
    pub fn rescue_of(gone: &Self) -> Result<Self, FolderError> {
        let name = gone.path.file_name().unwrap_or_default().to_string_lossy();
        let parent = gone.path.parent().filter(|parent| !parent.as_os_str().is_empty());
        let parent = parent.filter(|parent| parent.is_dir()).unwrap_or(Path::new("."));
        Self::open(&first_free(parent, &format!("{name}-rescued"))?)
    }

    fn with_lock(path: &Path, lock: Lock) -> Result<Self, FolderError> {
        let file = path.join(ID);
        let failed = |error| FolderError::File { path: file.display().to_string(), error };
        let id = match fs::read_to_string(&file) {
            Ok(text) => text.trim().to_owned(),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let id = new_id();
                atomic::write(&file, |out| writeln!(out, "{id}")).map_err(failed)?;
                id
            }
            Err(error) => return Err(failed(error)),
        };
        Ok(RunFolder { path: path.to_owned(), id, lock })
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What tells the run from others of the same scene.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Whether the system keeps other processes away.
    pub fn is_locked(&self) -> bool {
        self.lock.holds()
    }

    /// Whether it still is where it was.
    pub fn is_there(&self) -> bool {
        self.lock.is_there()
    }

    /// Makes the folders in it that a run of `scene` needs, and removes what a process that was killed has
    /// left half-written. Once a run has begun no folder is made again: one that has gone is missed.
    pub fn prepare(&self, scene: &Scene) -> io::Result<()> {
        atomic::remove_leftovers(&self.path)?;
        let made = names::all(
            &scene.records,
            &scene.attachments,
            (scene.exact.is_some(), scene.free.is_some()),
        );
        for folder in made.iter().filter(|made| made.is_folder) {
            let path = self.path.join(&folder.name);
            match fs::create_dir(&path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                    atomic::remove_leftovers(&path)?;
                }
                made => made?,
            }
        }
        Ok(())
    }

    /// Keeps copies of a scene and of the files that it names.
    pub fn keep(&self, scene: &Scene) -> io::Result<()> {
        // The lists come first: a folder with a scene in it is whole.
        for list in &scene.attachments {
            atomic::write(&self.path.join(&list.file_name), |out| out.write_all(&list.bytes))?;
        }
        atomic::write(&self.path.join(SCENE), |out| out.write_all(scene.text.as_bytes()))
    }
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

/// Makes the first of `<name>`, `<name>-2`, ... that is free.
fn first_free(parent: &Path, name: &str) -> Result<PathBuf, FolderError> {
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

/// Whether a folder holds nothing but what a run makes before anything else.
fn is_unused(path: &Path) -> Result<bool, FolderError> {
    for entry in fs::read_dir(path).map_err(|error| make_error(path, error))? {
        let name = entry.map_err(|error| make_error(path, error))?.file_name();
        if name != LOCK && name != ID {
            return Ok(false);
        }
    }
    Ok(true)
}

fn take(path: &Path) -> Result<Lock, FolderError> {
    Lock::take(path).map_err(|refused| match refused {
        Refused::Held(holder) => held(path, holder),
        Refused::Error(error) => {
            FolderError::File { path: path.join(LOCK).display().to_string(), error }
        }
    })
}

fn held(path: &Path, holder: String) -> FolderError {
    FolderError::Held { path: path.display().to_string(), holder }
}

fn make_error(path: &Path, error: io::Error) -> FolderError {
    FolderError::Make { path: path.display().to_string(), error }
}

/// A name that no other run has: the time, and keys that the standard library draws for each process.
fn new_id() -> String {
    let now = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.as_nanos());
    let mut drawn = RandomState::new().build_hasher();
    drawn.write_u32(std::process::id());
    format!("{now:x}-{:016x}", drawn.finish())
}
