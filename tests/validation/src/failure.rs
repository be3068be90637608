//! How a command of `cargo validate` fails.

use crate::stability::LabError;
use psmrt::command::CommandError;
use psmrt::table::TableError;
use thiserror::Error;

use crate::cases::CaseError;

/// A command that failed.
#[derive(Debug, Error)]
pub enum Failure {
    /// As a command of psmrt does.
    #[error(transparent)]
    Command(#[from] CommandError),
    /// A case cannot be measured.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// A table that a command rests on cannot be used.
    #[error(transparent)]
    Csv(#[from] TableError),
    /// A map of stability cannot be made.
    #[error(transparent)]
    Stability(#[from] LabError),
    /// A claim of the report fails.
    #[error("some claims fail: see the report")]
    ClaimsFail,
    /// The oracle's results are not the reviewed ones.
    #[error("the results differ from the reviewed ones: find out why, then `golden write`")]
    GoldenDiffers,
}

impl Failure {
    /// The options of a command make no sense together, or ask for what cannot be made.
    pub fn usage(problem: String) -> Self {
        CommandError::Usage(problem).into()
    }

    /// The error for scripts: `{"error": ...}`.
    pub fn to_json(&self) -> serde_json::Value {
        match self {
            Failure::Command(error) => error.to_json(),
            error => serde_json::json!({ "error": { "problem": error.to_string() } }),
        }
    }

    /// The exit code: 2 for what the user can put right in the command line, else 1.
    pub fn exit_code(&self) -> u8 {
        match self {
            Failure::Command(error) => error.exit_code(),
            _ => 1,
        }
    }
}
