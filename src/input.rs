//! Files that the user names: only what is a file, and only up to a size. A device or a pipe would be
//! read without end, or never answer.

use std::fs::{File, FileType, Metadata};
use std::io::{self, Read};
use std::path::Path;

use thiserror::Error;

/// Bytes in a MiB.
pub const MIB: u64 = 1 << 20;

/// Why a file is not read.
#[derive(Debug, Error)]
pub enum InputError {
    /// The system refuses it.
    #[error("it cannot be read: {0}")]
    Io(#[from] io::Error),
    /// A folder, a pipe, a device, ...
    #[error("it is {0}, not a file")]
    NoFile(&'static str),
    /// Larger than anything of its kind.
    #[error("it is larger than {} MiB, the limit", most / MIB)]
    TooLarge {
        /// Bytes that are allowed.
        most: u64,
    },
}

impl From<InputError> for io::Error {
    fn from(error: InputError) -> Self {
        match error {
            InputError::Io(error) => error,
            other => io::Error::other(other.to_string()),
        }
    }
}

/// Opens a file for reading, after links have been followed. Errors unless it is a regular one.
pub fn open(path: &Path) -> Result<File, InputError> {
    // Opening a pipe waits for its other end: look first.
    regular(&std::fs::metadata(path)?)?;
    let file = File::open(path)?;
    regular(&file.metadata()?)?;
    Ok(file)
}

/// The contents of a regular file of at most `most` bytes.
pub fn read(path: &Path, most: u64) -> Result<Vec<u8>, InputError> {
    let file = open(path)?;
    let too_large = InputError::TooLarge { most };
    if file.metadata()?.len() > most {
        return Err(too_large);
    }
    let mut bytes = Vec::new();
    // What grows meanwhile, or states no length, ends at the limit too.
    file.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most { Err(too_large) } else { Ok(bytes) }
}

/// Whether a name ends so, in small letters or capitals.
pub fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or("");
    endings.iter().any(|known| known.eq_ignore_ascii_case(ending))
}

fn regular(metadata: &Metadata) -> Result<(), InputError> {
    if metadata.is_file() { Ok(()) } else { Err(InputError::NoFile(kind(metadata.file_type()))) }
}

#[cfg(unix)]
fn kind(kind: FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    match kind {
        kind if kind.is_dir() => "a folder",
        kind if kind.is_fifo() => "a pipe",
        kind if kind.is_socket() => "a socket",
        _ => "a device",
    }
}

#[cfg(not(unix))]
fn kind(kind: FileType) -> &'static str {
    if kind.is_dir() { "a folder" } else { "a device" }
}
