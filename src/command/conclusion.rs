//! Something that a run has shown, and whether it is steady.

use serde_json::Value as Json;

use crate::run::End;

/// Something that a run has shown.
pub(super) struct Conclusion {
    /// For people, a line.
    pub text: String,
    /// For programs.
    pub json: Json,
}

/// Whether the criterion of the scene was met, if it has one.
pub(super) fn is_steady(end: End) -> Option<bool> {
    match end {
        End::Steady { .. } => Some(true),
        End::NotSteady { .. } => Some(false),
        End::Limit | End::Interrupted => None,
    }
}

pub(super) fn steady_words(end: End) -> &'static str {
    match is_steady(end) {
        Some(true) => "steady",
        Some(false) => "NOT steady",
        None => "not judged whether steady: the scene has no [stop.steady]",
    }
}
