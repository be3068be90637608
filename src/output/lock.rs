//! The lock of a run's folder: at most one process writes into it, and notices when it is gone.
//!
//! The lock is the operating system's on the file `run.lock`, so that a process that is killed frees it.
//! What stands in the file is for whoever finds it held.
//!
//! The file also identifies the folder: if it has been moved or removed, that is noticed, and it is never made again.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

use crate::scene::names::LOCK;

/// More of the file is not read: a line of our own is shorter.
const LONGEST: u64 = 200;

/// A held lock; free again when it is dropped or the process ends.
#[derive(Debug)]
pub struct Lock {
    path: PathBuf,
    file: File,
    /// Whether the file system has locks at all.
    holds: bool,
}

/// Why there is no lock.
#[derive(Debug)]
pub enum Refused {
    /// Another process has it: who, as it says itself.
    Held(String),
    /// The file cannot be made or locked.
    Error(io::Error),
}

impl Lock {
    /// Takes the lock of `folder`.
    pub fn take(folder: &Path) -> Result<Self, Refused> {
        let path = folder.join(LOCK);
        let mut options = OpenOptions::new();
        options.read(true).write(true).create(true).truncate(false);
        let mut file = options.open(&path).map_err(Refused::Error)?;
        let holds = match file.try_lock() {
            Ok(()) => true,
            Err(TryLockError::WouldBlock) => return Err(Refused::Held(holder(&mut file))),
            // Some network file systems have none.
            Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => false,
            Err(TryLockError::Error(error)) => return Err(Refused::Error(error)),
        };
        let mut lock = Lock { path, file, holds };
        lock.sign().map_err(Refused::Error)?;
        Ok(lock)
    }

    /// Whether the file system has locks: without, nothing keeps a second process away.
    pub fn holds(&self) -> bool {
        self.holds
    }

    /// Whether the file still has its name, and so the folder its own.
    pub fn is_there(&self) -> bool {
        let Ok(found) = fs::metadata(&self.path) else { return false };
        self.file.metadata().is_ok_and(|own| is_same(&own, &found))
    }

    /// Writes who holds it.
    fn sign(&mut self) -> io::Result<()> {
        self.file.set_len(0)?;
        self.file.rewind()?;
        let host = crate::machine::host().unwrap_or_else(|| "unknown".to_owned());
        writeln!(self.file, "process {} on host {host}", std::process::id())
    }
}

impl Drop for Lock {
    /// Closing the file would not do where another thread has just started a process: that one has a copy of all
    /// open files until it becomes the program asked for, and the copy would keep the lock.
    fn drop(&mut self) {
        let _ = self.file.unlock();
    }
}

/// What the holder has written, if it can be read.
fn holder(file: &mut File) -> String {
    let mut text = String::new();
    match file.take(LONGEST).read_to_string(&mut text) {
        Ok(_) if !text.trim().is_empty() => text.trim().escape_debug().to_string(),
        _ => "another process".to_owned(),
    }
}

#[cfg(unix)]
fn is_same(one: &fs::Metadata, other: &fs::Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    (one.dev(), one.ino()) == (other.dev(), other.ino())
}

/// Elsewhere a folder with an open file can neither be moved nor removed.
#[cfg(not(unix))]
fn is_same(_: &fs::Metadata, _: &fs::Metadata) -> bool {
    true
}
