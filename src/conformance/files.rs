//! The kit as files: written, and compared with a kit that is there.
//!
//! A folder of NPY files and no archive: a reader takes thirty lines in any language, and equal bytes need no care for
//! times of files and compression.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use thiserror::Error;

use super::KIT_VERSION;
use super::array::Array;
use super::checksums::{self, KIT_LIMIT};
use super::given::inputs;
use super::judged::ratio;
use super::kit::{Kit, KitError};
use super::manifest::{ArrayEntry, FORMAT, Manifest, candidate_schema, kit_schema};
use crate::{input, quote};

/// A folder that cannot be used. Its texts name the file and the remedy.
#[derive(Debug, Error)]
pub enum FilesError {
    /// The kit cannot be made.
    #[error(transparent)]
    Kit(#[from] KitError),
    /// A folder that is not empty.
    #[error("{path} is not empty: name another folder with --out; nothing is overwritten")]
    NotEmpty {
        /// The folder.
        path: String,
    },
    /// A file that cannot be read or written.
    #[error("{path}: {error}")]
    Io {
        /// The file.
        path: String,
        /// Why.
        error: std::io::Error,
    },
    /// A file that says something wrong.
    #[error("{path}: {problem}; {remedy}")]
    Bad {
        /// The file.
        path: String,
        /// What is wrong.
        problem: String,
        /// What to do.
        remedy: String,
    },
}

impl FilesError {
    pub(super) fn io(path: &Path, error: std::io::Error) -> Self {
        FilesError::Io { path: quote::path(path), error }
    }

    pub(super) fn bad(path: &Path, problem: &dyn std::fmt::Display, remedy: &str) -> Self {
        let (path, problem) = (quote::path(path), quote::lines(&problem.to_string()));
        FilesError::Bad { path, problem, remedy: remedy.to_owned() }
    }
}

/// What to do about a kit that is not as it should be.
const EXPORT_ANEW: &str = "export the kit anew with `psmrt conformance export`";

/// All files of the kit: path in its folder, and contents. The same kit gives the same bytes.
pub fn files(kit: &Kit) -> BTreeMap<String, Vec<u8>> {
    let manifest = Manifest::new(kit);
    let mut files = BTreeMap::new();
    let arrays = arrays(kit, &manifest);
    for (path, array) in &arrays {
        files.insert(path.clone(), npy_bytes(array));
    }
    let entries =
        manifest.problems.iter().flat_map(|problem| problem.given.iter().chain(&problem.asked));
    for entry in entries {
        if let (Some(csv), Some(array)) = (&entry.csv, arrays.get(&entry.file)) {
            let lines: String = array.values.iter().map(|value| format!("{value:e}\n")).collect();
            files.insert(csv.clone(), format!("{}\n{lines}", entry.name).into_bytes());
        }
    }
    files.insert("manifest.json".into(), json_bytes(&serde_json::json!(manifest)));
    files.insert("manifest.schema.json".into(), json_bytes(&kit_schema()));
    files.insert("candidate.schema.json".into(), json_bytes(&candidate_schema()));
    files.insert("README.md".into(), include_bytes!("kit_readme.md").to_vec());
    files.insert("checksums.csv".into(), checksums::table(kit, &files).into_bytes());
    files
}

pub(super) fn json_bytes(value: &serde_json::Value) -> Vec<u8> {
    format!("{value:#}\n").into_bytes()
}

pub(super) fn npy_bytes(array: &Array) -> Vec<u8> {
    let mut bytes = Vec::new();
    // Writing to memory does not fail.
    let written = crate::output::npy::array(&mut bytes, &array.shape, array.values.iter().copied());
    debug_assert!(written.is_ok());
    bytes
}

/// The arrays of the kit by path: given, expected and gauges.
fn arrays(kit: &Kit, manifest: &Manifest) -> BTreeMap<String, Array> {
    let mut arrays = BTreeMap::new();
    for (solved, entry) in kit.problems.iter().zip(&manifest.problems) {
        for (input, entry) in inputs(&solved.problem.task).into_iter().zip(&entry.given) {
            arrays.insert(entry.file.clone(), input.array);
        }
        for (expected, entry) in solved.expected.iter().zip(&entry.asked) {
            arrays.insert(entry.file.clone(), expected.values.clone());
            if let Some(gauge) = &entry.gauge {
                arrays.insert(gauge.clone(), expected.gauges.clone());
            }
        }
    }
    arrays
}

/// Writes files into `folder`, which must be empty or absent.
pub(super) fn write_all(
    folder: &Path,
    files: &BTreeMap<String, Vec<u8>>,
) -> Result<(), FilesError> {
    fs::create_dir_all(folder).map_err(|error| FilesError::io(folder, error))?;
    let mut entries = fs::read_dir(folder).map_err(|error| FilesError::io(folder, error))?;
    if entries.next().is_some() {
        return Err(FilesError::NotEmpty { path: folder.display().to_string() });
    }
    for (name, contents) in files {
        let path = folder.join(name);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(|error| FilesError::io(parent, error))?;
        }
        fs::write(&path, contents).map_err(|error| FilesError::io(&path, error))?;
    }
    Ok(())
}

/// Writes the kit into `folder`, which must be empty or absent. Returns the number of files and bytes.
pub fn export(folder: &Path) -> Result<(usize, usize), FilesError> {
    let files = files(&Kit::make()?);
    write_all(folder, &files)?;
    Ok((files.len(), files.values().map(Vec::len).sum()))
}

/// Bytes that a manifest may have.
pub(super) const LARGEST_MANIFEST: u64 = 16 * input::MIB;

/// Bytes that an array may have; those of the kit have less than a MiB.
pub(super) const LARGEST_ARRAY: u64 = 256 * input::MIB;

fn read_bytes(path: &Path, most: u64) -> Result<Vec<u8>, FilesError> {
    input::read(path, most).map_err(|error| FilesError::io(path, error.into()))
}

/// Reads an array.
pub(super) fn read_array(path: &Path) -> Result<Array, FilesError> {
    let bytes = read_bytes(path, LARGEST_ARRAY)?;
    Array::of_npy(&bytes).map_err(|error| FilesError::bad(path, &error, EXPORT_ANEW))
}

/// Reads the manifest of a kit of this version.
pub fn read_manifest(folder: &Path) -> Result<Manifest, FilesError> {
    let path = folder.join("manifest.json");
    let bytes = read_bytes(&path, LARGEST_MANIFEST)?;
    let found: serde_json::Value = serde_json::from_slice(&bytes)
        .map_err(|error| FilesError::bad(&path, &error, EXPORT_ANEW))?;
    if found["format"] != FORMAT {
        let problem = "it is not the manifest of a kit";
        return Err(FilesError::bad(
            &path,
            &problem,
            "name the folder that `psmrt conformance export` made",
        ));
    }
    if found["kit_version"] != KIT_VERSION {
        let problem =
            format!("kit_version = {}, this psmrt judges {KIT_VERSION}", found["kit_version"]);
        return Err(FilesError::bad(
            &path,
            &problem,
            "export the kit anew, or take the psmrt that made it",
        ));
    }
    serde_json::from_value(found).map_err(|error| FilesError::bad(&path, &error, EXPORT_ANEW))
}

/// Errors unless the kit in `folder` is what this program makes, up to what machines may differ in.
pub fn verify(kit: &Kit, folder: &Path) -> Result<(), FilesError> {
    let own = Manifest::new(kit);
    read_manifest(folder)?;
    let path = folder.join("manifest.json");
    if read_bytes(&path, LARGEST_MANIFEST)? != json_bytes(&serde_json::json!(own)) {
        return Err(FilesError::bad(&path, &"it is not as this psmrt writes it", EXPORT_ANEW));
    }
    let arrays = arrays(kit, &own);
    let take = |path: &str| Ok(arrays.get(path).cloned().unwrap_or_default());
    compare(&own, take, folder).map(|_| ())
}

/// Compares two kits in folders. Returns the largest difference, in epsilon times gauge.
pub fn compare_folders(one: &Path, two: &Path) -> Result<f64, FilesError> {
    let manifest = read_manifest(one)?;
    read_manifest(two)?;
    let path = two.join("manifest.json");
    if read_bytes(&path, LARGEST_MANIFEST)?
        != read_bytes(&one.join("manifest.json"), LARGEST_MANIFEST)?
    {
        let problem = format!("it is not that of {}", one.display());
        return Err(FilesError::bad(&path, &problem, EXPORT_ANEW));
    }
    compare(&manifest, |path| read_array(&one.join(path)), two)
}

/// Compares all arrays with those in `folder`.
fn compare(
    manifest: &Manifest,
    own: impl Fn(&str) -> Result<Array, FilesError>,
    folder: &Path,
) -> Result<f64, FilesError> {
    let mut largest: f64 = 0.0;
    for problem in &manifest.problems {
        for entry in problem.given.iter().chain(&problem.asked) {
            largest = largest.max(compare_array(entry, &own, folder)?);
        }
    }
    Ok(largest)
}

fn compare_array(
    entry: &ArrayEntry,
    own: &impl Fn(&str) -> Result<Array, FilesError>,
    folder: &Path,
) -> Result<f64, FilesError> {
    let path = folder.join(&entry.file);
    let (right, found) = (own(&entry.file)?, read_array(&path)?);
    // What is given is a number of its own size, sums of some terms of the size of 1 at most.
    let gauges = match &entry.gauge {
        Some(file) => own(file)?,
        None => Array {
            values: right.values.iter().map(|v| v.abs().max(1.0)).collect(),
            ..right.clone()
        },
    };
    if found.shape != right.shape || gauges.shape != right.shape {
        let problem = format!("its shape is {:?}, not {:?}", found.shape, right.shape);
        return Err(FilesError::bad(&path, &problem, EXPORT_ANEW));
    }
    let mut largest: f64 = 0.0;
    for (i, &value) in found.values.iter().enumerate() {
        let error = ratio(value, right.values[i], gauges.values[i]) / f64::EPSILON;
        if error > KIT_LIMIT {
            let problem = format!(
                "value {i} is {value:e} where {:e} should be: {error:.3e} epsilon times gauge apart, \
                 {KIT_LIMIT} is allowed between machines",
                right.values[i]
            );
            return Err(FilesError::bad(&path, &problem, EXPORT_ANEW));
        }
        largest = largest.max(error);
    }
    Ok(largest)
}
