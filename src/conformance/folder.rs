//! A candidate's answers as files.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::KIT_VERSION;
use super::array::Array;
use super::files::{self, FilesError, json_bytes, npy_bytes, write_all};
use super::judged::Submission;
use super::kit::Kit;
use super::manifest::CandidateManifest;
use super::order::DirectionOrder;
use crate::{input, quote};

/// Reads the answers in `folder`. Errors if the manifest cannot be used; an array that cannot be used is
/// a wrong answer with its reason.
pub fn read(kit: &Kit, folder: &Path) -> Result<Submission, FilesError> {
    let path = folder.join("manifest.json");
    let manifest = manifest(&path)?;
    let order = match &manifest.directions {
        None => DirectionOrder::default(),
        Some(directions) => DirectionOrder::new(directions).map_err(|error| {
            FilesError::bad(
                &path,
                &error,
                "list all nineteen as [x, y, z] in your order, or leave it out",
            )
        })?,
    };
    let mut answers = vec![Vec::new(); kit.problems.len()];
    let mut unasked = Vec::new();
    for entry in entries(folder)? {
        let name = file_name(&entry);
        if name == "manifest.json" || name.starts_with('.') {
            continue;
        }
        match kit.problems.iter().position(|solved| solved.problem.id == name) {
            Some(problem) if entry.is_dir() => {
                for file in entries(&entry)? {
                    match file_name(&file).strip_suffix(".npy") {
                        Some(answer) => answers[problem].push((answer.to_owned(), array(&file))),
                        None => unasked.push(format!("{name}/{}", file_name(&file))),
                    }
                }
            }
            _ => unasked.push(name),
        }
    }
    let name = quote::shown(&manifest.name);
    Ok(Submission { name, precision: manifest.precision, order, answers, unasked })
}

/// Writes the answers of an engine into `folder`, which must be empty or absent, as [`read`] and `psmrt
/// conformance check` take them. Answers that cannot be read are left out.
pub fn write(kit: &Kit, submission: &Submission, folder: &Path) -> Result<(), FilesError> {
    let manifest = CandidateManifest {
        name: submission.name.clone(),
        precision: submission.precision,
        directions: Some(submission.order.directions().to_vec()),
        kit_version: KIT_VERSION,
    };
    let mut files = BTreeMap::new();
    files.insert("manifest.json".to_owned(), json_bytes(&serde_json::json!(manifest)));
    for (solved, answers) in kit.problems.iter().zip(&submission.answers) {
        for (name, array) in answers {
            if let Ok(array) = array {
                files.insert(format!("{}/{name}.npy", solved.problem.id), npy_bytes(array));
            }
        }
    }
    write_all(folder, &files)
}

fn manifest(path: &Path) -> Result<CandidateManifest, FilesError> {
    let remedy = &format!(
        "write e.g. {{\"name\": \"my code\", \"precision\": \"f32\", \"kit_version\": {KIT_VERSION}}}: see \
         candidate.schema.json in the kit"
    );
    let bytes = input::read(path, files::LARGEST_MANIFEST)
        .map_err(|error| FilesError::bad(path, &error, remedy))?;
    let manifest: CandidateManifest =
        serde_json::from_slice(&bytes).map_err(|error| FilesError::bad(path, &error, remedy))?;
    if manifest.kit_version != KIT_VERSION {
        let problem = format!("kit_version = {}, the kit's is {KIT_VERSION}", manifest.kit_version);
        return Err(FilesError::bad(path, &problem, "answer the kit of this version"));
    }
    Ok(manifest)
}

/// What is in a folder, sorted.
fn entries(folder: &Path) -> Result<Vec<PathBuf>, FilesError> {
    let read = || -> io::Result<Vec<PathBuf>> {
        fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect()
    };
    let mut entries = read().map_err(|error| FilesError::io(folder, error))?;
    entries.sort();
    Ok(entries)
}

fn file_name(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

fn array(path: &Path) -> Result<Array, String> {
    let bytes = input::read(path, files::LARGEST_ARRAY).map_err(|error| error.to_string())?;
    Array::of_npy(&bytes).map_err(|error| error.to_string())
}
