//! The commands, one a file, and what they share: how they fail.

mod beginning;
pub mod check;
mod comparison;
mod conclusion;
mod conclusions;
pub mod conformance;
pub mod execute;
mod go_on;
pub mod info;
pub mod pack;
pub mod permeability;
mod permeability_runs;
pub mod plan;
mod plan_text;
mod profile;
pub mod progress;
pub mod resume;
pub mod run;
pub mod say;
pub mod scene_reference;
mod summary;
pub mod sweep;
mod sweep_plan;
mod viscosity;

use std::path::Path;

use thiserror::Error;

use crate::advice::estimate::memory;
use crate::checkpoint::CheckpointError;
use crate::conformance::files::FilesError;
use crate::engine::{Coupled, DeviceError, EngineName, StartError, open};
use crate::kernel::{KernelError, adapters};
use crate::output::folder::FolderError;
use crate::run::RunError;
use crate::scene::{EngineKind, Precision, Scene, SceneError};
use crate::table::TableError;
use say::tell;

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
    /// The device cannot be had, or not for this scene.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// A run cannot be resumed.
    #[error("{0}")]
    Resume(String),
    /// The options of a command make no sense together, or ask for what cannot be made.
    #[error("{0}")]
    Usage(String),
    /// A checkpoint cannot be used, and perhaps an older one can.
    #[error("{error}{older}")]
    Checkpoint {
        /// What is wrong with it.
        error: CheckpointError,
        /// The offer of the older one; empty if there is none.
        older: String,
    },
    /// A table that a command rests on cannot be used.
    #[error(transparent)]
    Csv(#[from] TableError),
    /// A command that another program has now.
    #[error(
        "`psmrt {0}` is now `cargo validate {0}`, run in a checkout of the project; it takes the same options"
    )]
    Moved(&'static str),
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
    Conformance(#[from] FilesError),
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
    /// The run has reached its limit before its flow was steady; its summary has said so.
    #[error("the run is not steady")]
    NotSteady,
    /// A table of a run is not the one that its checkpoint knows, and perhaps an older checkpoint fits.
    #[error("{error}{older}")]
    Table {
        /// What is wrong with it.
        error: RunError,
        /// The offer of the older one; empty if there is none.
        older: String,
    },
    /// Runs of a sweep that have not come to their end.
    #[error(
        "{failed} of {of} runs failed; the table says why, and each run's folder has what it had computed"
    )]
    SweepFailed {
        /// How many.
        failed: usize,
        /// Of how many.
        of: usize,
    },
    /// The user has interrupted a run of a sweep; its state is saved.
    #[error(
        "interrupted; the state is saved: give the same command with --out {folder}, which goes on"
    )]
    SweepInterrupted {
        /// The folder of the sweep.
        folder: String,
    },
    /// The user has interrupted the run; its state is saved.
    #[error("interrupted; the state is saved: psmrt resume {folder}")]
    Interrupted {
        /// The folder of the run.
        folder: String,
    },
}

impl From<KernelError> for CommandError {
    fn from(error: KernelError) -> Self {
        CommandError::Device(error.into())
    }
}

impl CommandError {
    /// The error for scripts: `{"error": ...}`, a scene's with its file, line, key and value.
    pub fn to_json(&self) -> serde_json::Value {
        match self {
            CommandError::Scene(error) => serde_json::json!({ "error": error }),
            error => serde_json::json!({ "error": { "problem": error.to_string() } }),
        }
    }

    /// The exit code: 2 for what the user can put right in the scene or the command line, 3 for a run that
    /// is not steady at its limit, 130 for an interruption, else 1.
    pub fn exit_code(&self) -> u8 {
        match self {
            CommandError::Scene(_)
            | CommandError::Device(_)
            | CommandError::Folder(_)
            | CommandError::Resume(_)
            | CommandError::Usage(_)
            | CommandError::Moved(_)
            | CommandError::Conformance(_)
            | CommandError::NoAnswers { .. }
            | CommandError::Table { .. }
            | CommandError::Checkpoint { .. } => 2,
            CommandError::Run(_)
            | CommandError::Write { .. }
            | CommandError::CandidateFailed
            | CommandError::SweepFailed { .. }
            | CommandError::Csv(_) => 1,
            CommandError::NotSteady => 3,
            CommandError::Interrupted { .. } | CommandError::SweepInterrupted { .. } => 130,
        }
    }
}

/// The engine that a scene asks for, at its start. With `profiled` it keeps where its time goes, if it
/// can.
fn engine(scene: &Scene, file: &Path, profiled: bool) -> Result<Coupled, CommandError> {
    let name = file.display().to_string();
    let refused = |problem: String| -> CommandError {
        SceneError::whole_file(&name, problem, "change the scene").into()
    };
    let engine = engine_of(scene);
    if !engine.needs_device() {
        if let (false, Some(name)) = (scene.engine == EngineKind::Auto, &scene.adapter) {
            tell(&format!(
                "engine.adapter = \"{name}\" of the scene is not used: engine {} computes on the processor",
                engine.word()
            ));
        }
        if let Some((problem, remedy)) = memory::shortage(scene) {
            return Err(SceneError::whole_file(&name, problem, remedy).into());
        }
    }
    open(engine, scene, None, profiled).map_err(|error| match error {
        StartError::Device(error) => error.into(),
        error => refused(error.to_string()),
    })
}

/// The engine as scenes name it.
fn kind_of(engine: &Coupled) -> EngineKind {
    EngineName::from_word(engine.name()).map_or(EngineKind::default(), EngineName::kind)
}

/// The engine that is to compute a scene. `auto` takes a software adapter for none: that shares the
/// processor with the CPU engine, which is several times as fast, which a user should ask for by name.
fn engine_of(scene: &Scene) -> EngineName {
    if let Some(named) = EngineName::of(scene) {
        return named;
    }
    let cpu = EngineName::cpu(scene.precision);
    if scene.is_dry {
        // Grains are computed on the processor whatever the engine.
        return cpu;
    }
    if scene.precision == Some(Precision::Double) {
        tell("engine auto: double precision is asked for, so the CPU engine (cpu) computes");
        return cpu;
    }
    let found = adapters();
    let is_there = scene.adapter.is_some() || found.iter().any(|a| !a.is_software());
    if !is_there {
        let why = if found.is_empty() { "no adapter" } else { "only a software adapter" };
        tell(&format!("engine auto: {why}, so the CPU engine ({}) computes", cpu.word()));
    }
    if is_there && !found.is_empty() { EngineName::Wgpu } else { cpu }
}

/// The changes of a scene that `--engine` and `--adapter` stand for: they become part of the scene that
/// the run's folder keeps, so that `resume` goes on with the same. Errors where the engine has no use for
/// an adapter.
pub fn engine_changes(
    engine: Option<&str>,
    adapter: Option<&str>,
) -> Result<Vec<String>, CommandError> {
    let named = engine.and_then(EngineName::from_word);
    if let (Some(engine), Some(name)) = (named.filter(|engine| !engine.needs_device()), adapter) {
        return Err(CommandError::Usage(format!(
            "--adapter {name}: --engine {} computes on the processor and takes no adapter; \
             leave one of them out, or take --engine wgpu",
            engine.word()
        )));
    }
    let engine = engine.or(adapter.map(|_| "wgpu"));
    let kind = named.map(|engine| engine.kind().word()).or(engine);
    let kind = kind.map(|kind| format!("engine.kind=\"{kind}\""));
    let single = named == Some(EngineName::CpuSingle);
    let precision = single.then(|| "engine.precision=\"single\"".to_owned());
    let adapter = adapter.map(|name| format!("engine.adapter={}", toml_edit::Value::from(name)));
    Ok(kind.into_iter().chain(precision).chain(adapter).collect())
}

/// Does the writing of one file. Errors with the name of the file when that fails.
pub fn write<T, E: std::fmt::Display>(
    path: &Path,
    writing: impl FnOnce(&Path) -> Result<T, E>,
) -> Result<T, CommandError> {
    writing(path).map_err(|error| CommandError::Write {
        path: path.display().to_string(),
        error: error.to_string(),
    })
}
