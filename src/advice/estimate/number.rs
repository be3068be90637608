//! A number that is derived from a scene.

use serde::Serialize;

/// A derived number.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Number {
    /// What it is.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// Its unit; empty for a bare number.
    pub unit: &'static str,
    /// What it is taken from, or what is good.
    pub note: String,
}

/// One of them.
pub(crate) fn number(
    name: &'static str,
    value: f64,
    unit: &'static str,
    note: impl Into<String>,
) -> Number {
    Number { name, value, unit, note: note.into() }
}
