//! The keys that say what a run leaves behind, when it ends, and what computes it.

use schemars::JsonSchema;
use serde::Deserialize;

use super::format::Triple;

/// Something to record. At most one of `every` and `every_steps`; without either it is recorded
/// once, at the end.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RecordSection {
    /// Name of the record and of its file: letters, digits, `-` and `_`.
    pub name: String,
    /// `box` (means over the box), `profile` (a line of cells), `loads` (place, motion, force and
    /// torque of each grain), `grain_means` (means over the free grains), `slice` (a picture of a
    /// plane), `fields` (all cells) or `grains` (all grains, for ParaView).
    pub kind: RecordKind,
    /// Time between rows, s.
    pub every: Option<f64>,
    /// Steps between rows.
    pub every_steps: Option<i64>,
    /// With `profile`: the axis along which the line runs; with `slice`: the axis that the plane is
    /// normal to.
    pub axis: Option<AxisName>,
    /// With `profile` and `slice`: a point on the line or plane, m; the middle of the box where
    /// absent.
    pub point: Option<Triple>,
    /// With `slice`: what the colours show; `speed` where absent.
    pub quantity: Option<Quantity>,
    /// With `fields`: `vti` (ParaView, single precision), `npy` (NumPy, double precision) or both;
    /// `vti` where absent.
    pub formats: Option<Vec<FieldFormat>>,
}

/// What a record holds.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum RecordKind {
    /// Means over the box.
    Box,
    /// Pressure and velocity along a line of cells.
    Profile,
    /// Place and motion of each grain, and force and torque of the fluid on it in the last step.
    Loads,
    /// A picture (SVG) of a plane of cells; grains are grey, with their outlines.
    Slice,
    /// Pressure, velocity and solid fraction of all cells.
    Fields,
    /// Place, motion and load of all grains.
    Grains,
    /// Place, motion, energy and contacts of the free grains on the mean.
    GrainMeans,
}

/// What a picture shows.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Length of the velocity.
    #[default]
    Speed,
    /// Pressure.
    Pressure,
    /// Velocity along x.
    VelocityX,
    /// Velocity along y.
    VelocityY,
    /// Velocity along z.
    VelocityZ,
}

/// A file format for fields.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum FieldFormat {
    /// VTK image data.
    Vti,
    /// NumPy arrays.
    Npy,
}

/// An axis.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum AxisName {
    /// Axis 0.
    X,
    /// Axis 1.
    Y,
    /// Axis 2.
    Z,
}

/// When the run ends. Give at least one of `time` and `steps`.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StopSection {
    /// Time after which the run ends, s.
    pub time: Option<f64>,
    /// Number of steps after which the run ends.
    pub steps: Option<i64>,
    /// Ends the run sooner, once a record has become steady.
    pub steady: Option<SteadySection>,
}

/// Steady: three rows of a record in a row, each of which changes a column by less than
/// `tolerance` of its value.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SteadySection {
    /// Name of a record of kind `box`, `grain_means` or `loads`.
    pub record: String,
    /// One of its columns, for example `superficial_velocity_x`; of `loads` a force, summed over all
    /// grains.
    pub column: String,
    /// Largest relative change from row to row, in (0, 1).
    pub tolerance: f64,
}

/// When to save the state. At most one of `every_steps` and `every_minutes`; 10 minutes where the
/// section is absent.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CheckpointSection {
    /// Steps between two checkpoints.
    pub every_steps: Option<i64>,
    /// Minutes of computing between two checkpoints.
    pub every_minutes: Option<f64>,
}

/// What computes the scene; `reference` where the section is absent. Single precision changes none of the errors
/// of golden/tradeoff by more than 1e-4 (effects.csv), the double precision of `reference` is what it is judged by.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EngineSection {
    /// `reference`: double precision on the CPU; `wgpu`: single precision on a GPU; `auto`: `wgpu` where
    /// there is a GPU, else `reference`.
    pub kind: EngineKind,
    /// With `wgpu` and `auto`: a part of the adapter's name as `psmrt info` lists it; the fastest kind
    /// where absent.
    pub adapter: Option<String>,
}

/// An engine.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum EngineKind {
    /// The oracle.
    #[default]
    Reference,
    /// The kernel.
    Wgpu,
    /// The kernel where there is a GPU in hardware, else the oracle.
    Auto,
}

impl EngineKind {
    /// As scenes spell it.
    pub fn word(self) -> &'static str {
        match self {
            EngineKind::Reference => "reference",
            EngineKind::Wgpu => "wgpu",
            EngineKind::Auto => "auto",
        }
    }
}

/// An exact solution to compare with.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CompareSection {
    /// `plane_poiseuille`: flow between two walls, driven by a body force.
    pub exact: ExactName,
}

/// The exact solutions.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum ExactName {
    /// Flow between two parallel walls at rest, driven by a body force along them.
    PlanePoiseuille,
}
