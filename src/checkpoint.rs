//! Checkpoints: the state of a run in one file, from which it goes on bit for bit.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | `PSMRTCK1` |
//! | 8 | length of the header |
//! | | header, JSON: [`Header`] |
//! | | the engine's state |
//! | 8 | XXH3 of all before |
//!
//! A file is written under another name, synced and renamed; the last two are kept.

use std::fs::{self, File};
use std::io::{self, BufReader, Read, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use thiserror::Error;
use xxhash_rust::xxh3::{Xxh3Default, xxh3_64};

use crate::engine::Engine;
use crate::output::atomic;
use crate::run::steady::Saved;
use crate::scene::Scene;

const MAGIC: &[u8; 8] = b"PSMRTCK1";

/// Checkpoints that are kept.
const KEPT: usize = 2;

/// A header longer than this is no header.
const MAX_HEADER: u64 = 1 << 20;

/// What a checkpoint says about itself, and what the time loop needs to go on.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Header {
    /// Version of psmrt that wrote it.
    pub version: String,
    /// Engine that wrote it.
    pub engine: String,
    /// XXH3 of the scene's text.
    pub scene: u64,
    /// Steps made.
    pub steps: u64,
    /// The time loop's own state.
    pub progress: Progress,
}

/// The time loop's own state.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct Progress {
    /// Length in bytes of each record's table, 0 for a record that is none.
    pub table_lengths: Vec<u64>,
    /// What the steady-state criterion has seen, if there is one.
    pub steady: Option<Saved>,
}

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
    run.join("checkpoints")
}

/// Saves the state of a run and removes all but the last two checkpoints.
pub fn save(
    run: &Path,
    scene: &Scene,
    engine: &dyn Engine,
    progress: Progress,
) -> Result<PathBuf, CheckpointError> {
    let steps = engine.steps();
    let path = folder(run).join(format!("step_{steps:012}.checkpoint"));
    let header = Header {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        engine: engine.name().to_owned(),
        scene: xxh3_64(scene.text.as_bytes()),
        steps,
        progress,
    };
    let written = fs::create_dir_all(folder(run)).and_then(|()| {
        atomic::write(&path, |file| {
            let mut out = Hashed { inner: file, hash: Xxh3Default::new() };
            let header = serde_json::to_vec(&header).map_err(io::Error::other)?;
            out.write_all(MAGIC)?;
            out.write_all(&(header.len() as u64).to_le_bytes())?;
            out.write_all(&header)?;
            engine.save(&mut out)?;
            let digest = out.hash.digest();
            out.inner.write_all(&digest.to_le_bytes())
        })
    });
    written.map_err(|error| file_error(&path, error))?;
    for old in list(run).iter().rev().skip(KEPT) {
        fs::remove_file(old).map_err(|error| file_error(old, error))?;
    }
    Ok(path)
}

/// The checkpoints of a run, the oldest first.
pub fn list(run: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder(run)).into_iter().flatten().flatten();
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|suffix| suffix == "checkpoint"))
        .collect();
    paths.sort();
    paths
}

/// Checks a checkpoint from end to end, then puts the engine into its state.
pub fn load(
    path: &Path,
    scene: &Scene,
    engine: &mut dyn Engine,
) -> Result<Progress, CheckpointError> {
    let unusable = |problem: &str| CheckpointError::Unusable {
        path: path.display().to_string(),
        problem: problem.to_owned(),
    };
    check_sum(path)?;
    let open = || -> io::Result<(Header, BufReader<File>)> {
        let mut file = BufReader::with_capacity(1 << 20, File::open(path)?);
        let mut start = [0; 16];
        file.read_exact(&mut start)?;
        let length = u64::from_le_bytes(std::array::from_fn(|i| start[8 + i]));
        let mut header = Vec::new();
        (&mut file).take(length.min(MAX_HEADER)).read_to_end(&mut header)?;
        Ok((serde_json::from_slice(&header).map_err(io::Error::other)?, file))
    };
    let (header, mut file) = open().map_err(|error| file_error(path, error))?;
    if header.scene != xxh3_64(scene.text.as_bytes()) {
        return Err(unusable("belongs to another scene, or the scene has been changed since"));
    }
    if header.engine != engine.name() {
        return Err(unusable(&format!("was written by the engine `{}`", header.engine)));
    }
    engine.load(&mut file).map_err(|error| file_error(path, error))?;
    Ok(header.progress)
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
        return unusable("is no checkpoint of psmrt (or of another version)");
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

/// A writer that sums up what goes through it.
struct Hashed<W> {
    inner: W,
    hash: Xxh3Default,
}

impl<W: Write> Write for Hashed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.inner.write(bytes)?;
        self.hash.update(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}
