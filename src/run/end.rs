//! How a run ends: at its end, or because it could not go on.

use std::io;

use thiserror::Error;

use crate::checkpoint::CheckpointError;
use crate::engine::EngineStop;
use crate::stopped_grain::GrainStop;

/// A run that could not go on.
#[derive(Debug, Error)]
pub enum RunError {
    /// The guard has stopped it, a free grain cannot be moved, or the device has failed.
    #[error(transparent)]
    Stopped(#[from] EngineStop),
    /// A contact has not held a free grain, or a grain is nowhere.
    #[error(transparent)]
    Grain(#[from] Box<GrainStop>),
    /// The way of a prescribed sphere has ended.
    #[error("stopped: {said}\n  help: {remedy}")]
    Met {
        /// What it has run into.
        said: String,
        /// What to do.
        remedy: String,
    },
    /// Its results cannot be written.
    #[error(
        "results cannot be written: {0}; what was written before is whole: make room on the disk, or allow \
         writing there, and go on with `psmrt resume`"
    )]
    Write(#[from] io::Error),
    /// Its state cannot be saved.
    #[error(
        "the checkpoint cannot be written: {0}; what was written before is whole: make room on the disk, or \
         allow writing there, and go on with `psmrt resume`"
    )]
    Checkpoint(#[from] CheckpointError),
    /// A table that a resumed run should go on with is not the one that it has written.
    #[error("{0}; put it back as it was, or start a new run: nothing has been changed")]
    Table(io::Error),
    /// Its folder, or something in it, has been moved or removed while it ran.
    #[error(
        "the folder {path}, or a part of it, has been moved or removed while the run wrote into it: {rescue}"
    )]
    Gone {
        /// Where it was.
        path: String,
        /// What has been saved elsewhere, and how to go on.
        rescue: String,
    },
}

impl RunError {
    /// Whether a file or folder that was there has gone.
    pub(super) fn misses_a_file(&self) -> bool {
        let (RunError::Write(error) | RunError::Checkpoint(CheckpointError::File { error, .. })) =
            self
        else {
            return false;
        };
        error.kind() == io::ErrorKind::NotFound
    }
}

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// It has made all the steps that the scene allows, and nothing more was asked of it.
    Limit,
    /// It has become steady.
    Steady {
        /// What is still to go, see [`History::left`](super::steady::History::left).
        left: Option<f64>,
    },
    /// It has made all the steps that the scene allows and has not become steady.
    NotSteady {
        /// The same.
        left: Option<f64>,
    },
    /// The user has interrupted it; its state is saved.
    Interrupted,
}
