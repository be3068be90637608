//! The commands, one a file, and what they share: how they fail.

pub mod check;
mod comparison;
mod execute;
pub mod info;
pub mod oracle;
mod progress;
pub mod resume;
pub mod run;

use std::path::Path;

use thiserror::Error;

use crate::checkpoint::CheckpointError;
use crate::engine::ReferenceEngine;
use crate::oracle::files::FilesError;
use crate::output::folder::FolderError;
use crate::run::RunError;
use crate::scene::{Scene, SceneError};

/// A command that failed.
#[derive(Debug, Error)]
pub enum CommandError {
    /// The scene is wrong.
    #[error(transparent)]
    Scene(#[from] Box<SceneError>),
    /// The folder for the results cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// The run could not go on.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A run cannot be resumed.
    #[error("{0}")]
    Resume(String),
    /// A checkpoint cannot be used, and perhaps an older one can.
    #[error("{error}{older}")]
    Checkpoint {
        /// What is wrong with it.
        error: CheckpointError,
        /// The offer of the older one; empty if there is none.
        older: String,
    },
    /// A file cannot be written.
    #[error("{path} cannot be written: {error}")]
    Write {
        /// The file.
        path: String,
        /// Why.
        error: String,
    },
    /// The folder of a kit or of a candidate cannot be used.
    #[error(transparent)]
    Oracle(#[from] FilesError),
    /// A candidate's folder without a single answer.
    #[error(
        "{folder} has no answers: put them at {folder}/PROBLEM/ANSWER.npy, as the kit's README says"
    )]
    NoAnswers {
        /// The folder.
        folder: String,
    },
    /// A candidate with wrong answers; the verdict has said which.
    #[error("the candidate failed")]
    CandidateFailed,
    /// The user has interrupted the run; its state is saved.
    #[error("interrupted; the state is saved: psmrt resume {folder}")]
    Interrupted {
        /// The folder of the run.
        folder: String,
    },
}

impl CommandError {
    /// The error for scripts: `{"error": ...}`, a scene's with its file, line, key and value.
    pub fn to_json(&self) -> serde_json::Value {
        match self {
            CommandError::Scene(error) => serde_json::json!({ "error": error }),
            error => serde_json::json!({ "error": { "problem": error.to_string() } }),
        }
    }

    /// The exit code: 2 for what the user can put right in the scene or the command line, 130 for
    /// an interruption, else 1.
    pub fn exit_code(&self) -> u8 {
        match self {
            CommandError::Scene(_)
            | CommandError::Folder(_)
            | CommandError::Resume(_)
            | CommandError::Oracle(_)
            | CommandError::NoAnswers { .. }
            | CommandError::Checkpoint { .. } => 2,
            CommandError::Run(_) | CommandError::Write { .. } | CommandError::CandidateFailed => 1,
            CommandError::Interrupted { .. } => 130,
        }
    }
}

/// The engine for a scene, at its start.
fn engine(scene: &Scene, file: &Path) -> Result<ReferenceEngine, CommandError> {
    ReferenceEngine::new(scene).map_err(|error| {
        let file = file.display().to_string();
        SceneError::whole_file(&file, error.to_string(), "change the scene").into()
    })
}

/// Does the writing of one file and says which file it was when that fails.
fn write<E: std::fmt::Display>(
    path: &Path,
    writing: impl FnOnce(&Path) -> Result<(), E>,
) -> Result<(), CommandError> {
    writing(path).map_err(|error| CommandError::Write {
        path: path.display().to_string(),
        error: error.to_string(),
    })
}
