//! A warning about a scene.

use serde::Serialize;

/// Something that may go wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Warning {
    /// What and why.
    pub reason: String,
    /// What to do about it.
    pub remedy: String,
}

/// A warning.
pub(super) fn warning(reason: impl Into<String>, remedy: impl Into<String>) -> Warning {
    Warning { reason: reason.into(), remedy: remedy.into() }
}
