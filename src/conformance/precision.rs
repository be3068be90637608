//! The precision in which a candidate works, by which it is judged.

use serde::{Deserialize, Serialize};

/// The precision of a candidate.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema,
)]
pub enum Precision {
    /// Double precision throughout.
    #[default]
    #[serde(rename = "f64")]
    F64,
    /// Single precision.
    #[serde(rename = "f32")]
    F32,
    /// Populations are kept in half precision, whatever the arithmetic.
    #[serde(rename = "f16-storage")]
    F16Storage,
}

impl Precision {
    /// Machine epsilon: the distance from 1 to the next number.
    pub fn epsilon(self) -> f64 {
        match self {
            Precision::F64 => f64::EPSILON,        // 2^-52
            Precision::F32 => f32::EPSILON.into(), // 2^-23
            Precision::F16Storage => 1.0 / 1024.0, // 2^-10
        }
    }

    /// Its name, as in a candidate's manifest.
    pub fn name(self) -> &'static str {
        match self {
            Precision::F64 => "f64",
            Precision::F32 => "f32",
            Precision::F16Storage => "f16-storage",
        }
    }
}
