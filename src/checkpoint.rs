//! Checkpoints: the state of a run in one file, from which it goes on bit for bit.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | `PSMRTCK6`: the digit is the version of this format |
//! | 8 | length of the header |
//! | | header, JSON: [`Header`] |
//! | | the engine's state |
//! | 8 | XXH3 of all before |
//!
//! A file is written under another name, synced and renamed; the last two are kept. The header binds it to
//! its run and to all that the run has read: nothing else is gone on with from it.

mod header;

use std::fs::{self, File};
use std::io::{self, BufReader, Read, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;
use xxhash_rust::xxh3::Xxh3Default;

use crate::engine::Coupled;
use crate::output::atomic;
use crate::output::folder::RunFolder;
use crate::output::hashed::Hashed;
use crate::scene::{Scene, names};

pub use header::{Header, InputFile, Progress, SteadyWatch};

const MAGIC: &[u8; 8] = b"PSMRTCK6";

/// How the magic of all versions begins.
const ANY_VERSION: &[u8] = b"PSMRTCK";

/// Checkpoints that are kept.
const KEPT: usize = 2;

/// A header longer than this is no header.
const MAX_HEADER: u64 = 1 << 26;

/// A checkpoint that cannot be used.
#[derive(Debug, Error)]
pub enum CheckpointError {
    /// It cannot be read or written.
    #[error("{path}: {error}")]
    File {
        /// The file.
        path: String,
        /// Why.
        error: io::Error,
    },
    /// It is cut off, damaged, or something else.
    #[error("{path} {problem}")]
    Unusable {
        /// The file.
        path: String,
        /// What is wrong with it.
        problem: String,
    },
}

/// The folder of a run's checkpoints.
pub fn folder(run: &Path) -> PathBuf {
    run.join(names::CHECKPOINTS)
}

/// Saves the state of a run and removes all but the last two checkpoints.
pub fn save(
    run: &RunFolder,
    scene: &Scene,
    engine: &Coupled,
    progress: Progress,
) -> Result<PathBuf, CheckpointError> {
    let header = Header::new(run, scene, engine, progress);
    let path = folder(run.path()).join(format!("step_{:012}.checkpoint", header.steps));
    let written = atomic::write(&path, |file| {
        let mut out = Hashed::new(file);
        let header = serde_json::to_vec(&header).map_err(io::Error::other)?;
        out.write_all(MAGIC)?;
        out.write_all(&(header.len() as u64).to_le_bytes())?;
        out.write_all(&header)?;
        engine.save(&mut out)?;
        let digest = out.digest();
        out.inner.write_all(&digest.to_le_bytes())
    });
    written.map_err(|error| file_error(&path, error))?;
    keep(run, KEPT)?;
    Ok(path)
}

/// Removes all checkpoints but the last.
pub fn keep_newest(run: &RunFolder) -> Result<(), CheckpointError> {
    keep(run, 1)
}

fn keep(run: &RunFolder, most: usize) -> Result<(), CheckpointError> {
    for old in list(run.path())?.iter().rev().skip(most) {
        fs::remove_file(old).map_err(|error| file_error(old, error))?;
    }
    Ok(())
}

/// The checkpoints of a run, the oldest first; none if it has no folder for them. Errors if that cannot be
/// read.
pub fn list(run: &Path) -> Result<Vec<PathBuf>, CheckpointError> {
    let folder = folder(run);
    let failed = |error| file_error(&folder, error);
    let entries = match fs::read_dir(&folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries.map_err(failed)?,
    };
    let mut paths = Vec::new();
    for entry in entries {
        let path = entry.map_err(failed)?.path();
        if path.extension().is_some_and(|suffix| suffix == "checkpoint") {
            paths.push(path);
        }
    }
    paths.sort();
    Ok(paths)
}

/// Checks a checkpoint from end to end, and that it belongs to this run, scene and engine.
pub fn check(
    path: &Path,
    run: &RunFolder,
    scene: &Scene,
    engine: &Coupled,
) -> Result<Header, CheckpointError> {
    check_sum(path)?;
    let (header, _) = open(path).map_err(|error| file_error(path, error))?;
    match header.obstacle(run, scene, engine) {
        None => Ok(header),
        Some(problem) => {
            Err(CheckpointError::Unusable { path: path.display().to_string(), problem })
        }
    }
}

/// Checks a checkpoint as [`check`] does, then puts the engine into its state.
pub fn load(
    path: &Path,
    run: &RunFolder,
    scene: &Scene,
    engine: &mut Coupled,
) -> Result<Progress, CheckpointError> {
    let header = check(path, run, scene, engine)?;
    let (_, mut file) = open(path).map_err(|error| file_error(path, error))?;
    engine.load(&mut file).map_err(|error| file_error(path, error))?;
    Ok(header.progress)
}

/// Checks a checkpoint as [`check`] does, of the scene `was`, then puts an engine that was opened with changed values of
/// that scene into its state.
pub fn load_with_changes(
    path: &Path,
    run: &RunFolder,
    was: &Scene,
    engine: &mut Coupled,
) -> Result<(), CheckpointError> {
    check(path, run, was, engine)?;
    let (_, mut file) = open(path).map_err(|error| file_error(path, error))?;
    engine.load_with_changes(&mut file).map_err(|error| file_error(path, error))
}

/// The header, and the file where the engine's state begins.
fn open(path: &Path) -> io::Result<(Header, BufReader<File>)> {
    let mut file = BufReader::with_capacity(1 << 20, crate::input::open(path)?);
    let mut start = [0; 16];
    file.read_exact(&mut start)?;
    let length = u64::from_le_bytes(std::array::from_fn(|i| start[8 + i]));
    let mut header = Vec::new();
    (&mut file).take(length.min(MAX_HEADER)).read_to_end(&mut header)?;
    Ok((serde_json::from_slice(&header).map_err(io::Error::other)?, file))
}

/// Errors unless the file is a checkpoint and its last 8 bytes are the sum of all before.
fn check_sum(path: &Path) -> Result<(), CheckpointError> {
    let unusable = |problem: &str| {
        let problem = problem.to_owned();
        Err(CheckpointError::Unusable { path: path.display().to_string(), problem })
    };
    let file = |error| file_error(path, error);
    let length = fs::metadata(path).map_err(file)?.len();
    if length < 24 {
        return unusable("is cut off: it is too short for a checkpoint");
    }
    let mut from = BufReader::with_capacity(1 << 20, File::open(path).map_err(file)?);
    let mut hash = Xxh3Default::new();
    let mut magic = [0; 8];
    from.read_exact(&mut magic).map_err(file)?;
    if magic != *MAGIC {
        return unusable(if magic.starts_with(ANY_VERSION) {
            "was written by another version of psmrt, in another format: resume with that version, or \
             start a new run"
        } else {
            "is no checkpoint of psmrt"
        });
    }
    hash.update(&magic);
    let mut left = length - 16;
    let mut buffer = vec![0; 1 << 16];
    while left > 0 {
        let wanted = usize::try_from(left).unwrap_or(usize::MAX).min(buffer.len());
        from.read_exact(&mut buffer[..wanted]).map_err(file)?;
        hash.update(&buffer[..wanted]);
        left -= wanted as u64;
    }
    let mut sum = [0; 8];
    from.read_exact(&mut sum).map_err(file)?;
    if hash.digest() == u64::from_le_bytes(sum) {
        return Ok(());
    }
    unusable("is cut off or damaged: its checksum does not fit")
}

fn file_error(path: &Path, error: io::Error) -> CheckpointError {
    CheckpointError::File { path: path.display().to_string(), error }
}
