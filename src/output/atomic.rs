//! Files that are there whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use tempfile::{Builder, TempPath};

/// Temporary files are called `psmrt-XXXXXX.part`: no name that anybody else takes.
const PREFIX: &str = "psmrt-";
const SUFFIX: &str = ".part";

/// Writes a file under a temporary name, waits until it is on the disk, and gives it its name,
/// replacing what had it. If anything fails, what was there before stays.
pub fn write(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    filled(path, fill)?.persist(path).map_err(|refused| refused.error)?;
    sync_folder(path)
}

/// The same, but errors with [`io::ErrorKind::AlreadyExists`] if something has the name by then: that
/// stays.
pub fn write_new(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    filled(path, fill)?.persist_noclobber(path).map_err(|refused| refused.error)?;
    sync_folder(path)
}

/// Removes what a process that was killed while it wrote has left half-written in `folder`. Nobody else
/// may be writing there.
pub fn remove_leftovers(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name.starts_with(PREFIX) && name.ends_with(SUFFIX) && entry.file_type()?.is_file() {
            fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}

/// A temporary file beside `path`, on the disk; it vanishes unless it is given a name.
fn filled(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<TempPath> {
    let mut builder = Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    // Without this only its owner could read the file; what the user's mask forbids is taken away still.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let (file, temporary) = builder.tempfile_in(folder_of(path))?.into_parts();
    let mut writer = BufWriter::with_capacity(1 << 20, file);
    fill(&mut writer)?;
    writer.flush()?;
    writer.get_ref().sync_all()?;
    Ok(temporary)
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Waits until the new name is on the disk too.
fn sync_folder(path: &Path) -> io::Result<()> {
    if cfg!(unix) { File::open(folder_of(path))?.sync_all() } else { Ok(()) }
}
