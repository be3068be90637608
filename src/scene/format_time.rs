//! Values that may change in time, as a scene spells them.

use schemars::JsonSchema;
use serde::Deserialize;

use super::triple::Triple;

/// A number, or how it changes in time.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum NumberInTime {
    /// It does not change.
    Constant(f64),
    /// It changes.
    Changing(Box<NumberSignal>),
}

/// A vector, or how it changes in time.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum VectorInTime {
    /// It does not change.
    Constant(Triple),
    /// It changes.
    Changing(Box<VectorSignal>),
}

/// A number that changes in time, instead of the number: a table (`{ table = [[0.0, 0.0], [0.1, 12.0]] }`), a table
/// from a file (`{ file = "head.csv" }`), a ramp (`{ from = 0.0, to = 12.0, end = 0.1 }`) or a sine (`{ amplitude = 2.0,
/// period = 0.05 }`). Times are those since the start of the run. In a time step from t to t + dt a face has the value of
/// t + dt/2, with which flows are of second order in time.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NumberSignal {
    /// Rows `[time, value]`, s and the unit of the key, with a straight line from one to the next. Times must not fall;
    /// where two rows have the same time, the value jumps. Before the first row the value is that of the first, after
    /// the last that of the last.
    pub table: Option<Vec<[f64; 2]>>,
    /// A CSV file of such rows, relative to the scene; its first line is `time (s),pressure (Pa)`. Blank lines and lines
    /// that begin with `#` are left out.
    pub file: Option<String>,
    /// Of a ramp: the value until `start`.
    pub from: Option<f64>,
    /// Of a ramp: the value from `end` on; in between on a straight line.
    pub to: Option<f64>,
    /// Of a ramp: when it begins, s; 0 where absent.
    pub start: Option<f64>,
    /// Of a ramp: when it ends, s.
    pub end: Option<f64>,
    /// Of a sine, `mean + amplitude sin(2 pi t/period + phase)`: its mean; 0 where absent.
    pub mean: Option<f64>,
    /// Of a sine: its amplitude.
    pub amplitude: Option<f64>,
    /// Of a sine: its period, s, at least four time steps.
    pub period: Option<f64>,
    /// Of a sine: its phase, radians; 0 where absent. 1.5707963267948966 makes it a cosine.
    pub phase: Option<f64>,
}

/// A vector that changes in time, instead of the vector: a table (`{ table = [[0.0, 0.0, 0.0, 0.0], [0.1, 1e-3, 0.0, 0.0]] }`),
/// a table from a file (`{ file = "motion.csv" }`), a ramp (`{ from = [0.0, 0.0, 0.0], to = [1e-3, 0.0, 0.0], end = 0.1 }`) or a
/// sine (`{ amplitude = [1e-3, 0.0, 0.0], period = 0.05 }`). Times are those since the start of the run. In a time step
/// from t to t + dt a face has the value of t + dt/2; a body force that of t, which acts on the velocities of t; a
/// prescribed grain the velocity and spin of t in the collision, and moves by the mean of its velocities at t and t + dt;
/// the weight of free grains is the mean of t and t + dt. With these, flows are of second order in time.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VectorSignal {
    /// Rows `[time, x, y, z]`, s and the unit of the key, with a straight line from one to the next. Times must not
    /// fall; where two rows have the same time, the value jumps. Before the first row the value is that of the first,
    /// after the last that of the last.
    pub table: Option<Vec<[f64; 4]>>,
    /// A CSV file of such rows, relative to the scene; its first line is `time (s),x (m/s),y (m/s),z (m/s)`, with `(m/s2)`
    /// for accelerations and `(rad/s)` for `spin`. Blank lines and lines that begin with `#` are left out.
    pub file: Option<String>,
    /// Of a ramp: the value until `start`.
    pub from: Option<Triple>,
    /// Of a ramp: the value from `end` on; in between on a straight line.
    pub to: Option<Triple>,
    /// Of a ramp: when it begins, s; 0 where absent.
    pub start: Option<f64>,
    /// Of a ramp: when it ends, s.
    pub end: Option<f64>,
    /// Of a sine, `mean + amplitude sin(2 pi t/period + phase)`: its mean; 0 where absent.
    pub mean: Option<Triple>,
    /// Of a sine: its amplitude.
    pub amplitude: Option<Triple>,
    /// Of a sine: its period, s, at least four time steps.
    pub period: Option<f64>,
    /// Of a sine: its phase, radians; 0 where absent. 1.5707963267948966 makes it a cosine.
    pub phase: Option<f64>,
}
