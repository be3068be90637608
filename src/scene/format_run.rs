//! The keys that say what a run leaves behind, when it ends, and what computes it.

use schemars::JsonSchema;
use serde::Deserialize;

use super::triple::Triple;

/// Something to record. At most one of `every` and `every_steps`; without either it is recorded
/// once, at the end.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RecordSection {
    /// Name of the record and of its file: letters, digits, `-` and `_`.
    pub name: String,
    /// `box` (means over the domain, with the superficial velocity), `profile` (values along a line), `loads` (position,
    /// motion, and hydrodynamic force and torque of each grain), `grain_means` (means over the free grains), `permeability`
    /// (of a bed at rest that fluid flows through, with what laws say of it), `layers` (porosity, pressure, flow and stresses
    /// of grains by layers), `walls` (forces on the faces), `contact_means` (fabric and stress), `contacts` (the network of
    /// contacts, for ParaView), `slice` (a picture of a plane), `fields` (all cells) or `grains` (all grains, for ParaView). The
    /// superficial velocity is
    /// the mass flux over the fluid's density, averaged over all cells, those in grains included; the mass flux is the
    /// mean of the momentum before and after a collision. The first row holds the values at the start.
    pub kind: RecordKind,
    /// Time between rows, s: rounded to whole time steps, at least one.
    pub every: Option<f64>,
    /// Steps between rows.
    pub every_steps: Option<i64>,
    /// With `profile`: the axis along which the line runs; with `slice`: the axis that the plane is
    /// normal to; with `layers`: the axis along which they follow one another; with `permeability`: the axis of the flow,
    /// which may be absent where it goes along one axis only.
    pub axis: Option<AxisName>,
    /// With `profile` and `slice`: a point on the line or plane, m; the middle of the domain where absent. Between
    /// the centres of cells (for instance in the middle of an even number of them) values are interpolated linearly from
    /// the two or four nearest lines or planes of cells, those in grains included, also across periodic faces;
    /// within half a cell of other faces they are extrapolated linearly from the two nearest ones.
    pub point: Option<Triple>,
    /// With `layers`: how many, of whole cells and as thick as each other as can be; at least 2, or 1 along a periodic axis.
    pub layers: Option<i64>,
    /// With `slice`: what the colours show; `speed` where absent.
    pub quantity: Option<Quantity>,
    /// With `slice`: the values at the lower and the upper end of the colours, in m/s or Pa, the same for all
    /// pictures of the record; values beyond have the colour of the end. Where absent each picture has its own.
    pub range: Option<[f64; 2]>,
    /// With `loads` and `every` or `every_steps`: whether force and torque are means over the steps since the row before
    /// (in the first row: those of the last step) instead of those of the last step (false where absent). The loads of
    /// every step are then asked for, which a GPU answers slowly.
    pub average: Option<bool>,
    /// With `fields`: `vti` (ParaView, single precision), `npy` (NumPy, double precision) or both;
    /// `vti` where absent. The axes of an `npy` array are z, y, x and, of vectors, component: `velocity[k, j, i, 0]`
    /// is the velocity along x at x = (i + 1/2) dx, y = (j + 1/2) dx, z = (k + 1/2) dx, m/s; `pressure` is in Pa.
    pub formats: Option<Vec<FieldFormat>>,
}

/// What a record holds.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum RecordKind {
    /// Means over the domain.
    Box,
    /// Pressure and velocity along a line of cells.
    Profile,
    /// Position and motion of each grain, and the hydrodynamic force and torque on it in the last step.
    Loads,
    /// A picture (SVG) of a plane of cells; grains are grey, with their outlines.
    Slice,
    /// Pressure, velocity and solid fraction of all cells.
    Fields,
    /// Position, motion, hydrodynamic force and torque of all grains.
    Grains,
    /// Means over the free grains: position, motion, energy and contacts.
    GrainMeans,
    /// Porosity, pressure, flow, and grains with their stresses, in layers across an axis.
    Layers,
    /// Forces of fluid and grains on each face that is not periodic.
    Walls,
    /// Contacts of the free grains: how many, their fabric and the stress that they bear.
    ContactMeans,
    /// The network of contacts of the free grains, each with its force.
    Contacts,
    /// Permeability of a bed that fluid flows through, driven along a periodic axis by a body force or between two open
    /// faces; its porosity, Re and psi, and what laws give at these.
    Permeability,
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

/// Steady: a column of a record is within `tolerance` of its final value. The final value is estimated from the last
/// half of the time since the start, however often samples are taken: an exponential approach is extrapolated, and an
/// oscillation is taken to go on with the amplitude of the last quarter. The estimate must stay within the tolerance
/// for an eighth of the time. A run that reaches `time` or `steps` first reports that it is not steady, and by how
/// much; its exit code is 3.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SteadySection {
    /// Name of a record of kind `box`, `grain_means`, `contact_means`, `loads` or `permeability`.
    pub record: String,
    /// One of its columns, for example `superficial_velocity_x`; of `loads` a component of force, summed over all
    /// grains.
    pub column: String,
    /// Largest distance from the final value, as a share of the value, in (0, 1).
    pub tolerance: f64,
}

/// When to save the state. At most one of `every_steps` and `every_minutes`; 10 minutes where neither is given.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CheckpointSection {
    /// Steps between two checkpoints.
    pub every_steps: Option<i64>,
    /// Minutes of computing between two checkpoints.
    pub every_minutes: Option<f64>,
    /// Whether a run that has come to its end keeps its last state, from which `psmrt resume --set` goes on; `true` where
    /// absent. It takes 19 numbers a cell, of 8 bytes in double precision.
    pub at_end: Option<bool>,
}

/// What computes the scene; `cpu` in double precision where the section is absent. Single precision changes none of the
/// errors of golden/tradeoff by more than 1e-4 (effects.csv); every engine is judged by `reference`, the oracle.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EngineSection {
    /// `cpu`: the fast engine on the CPU; `reference`: the oracle, double precision on the CPU, written to be read;
    /// `wgpu`: single precision on a GPU; `auto`: `wgpu` where there is a GPU, else `cpu`.
    pub kind: EngineKind,
    /// With `cpu`: `double`, the default, or `single`, which takes half the memory and half the time. With `auto`
    /// `double` leaves a GPU aside.
    pub precision: Option<Precision>,
    /// With `wgpu` and `auto`: a part of the adapter's name as `psmrt info` lists it; the fastest kind
    /// where absent.
    pub adapter: Option<String>,
}

/// An engine.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum EngineKind {
    /// The oracle.
    Reference,
    /// The CPU engine: computes what the oracle does, to round-off in double precision, some ten times as fast.
    #[default]
    Cpu,
    /// The kernel.
    Wgpu,
    /// The kernel where there is a GPU in hardware, else the CPU engine.
    Auto,
}

/// How many digits an engine keeps.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum Precision {
    /// About 7; populations are kept less their lattice weights, so that nearly all of these tell of the flow.
    Single,
    /// About 16.
    Double,
}

impl EngineKind {
    /// As scenes spell it.
    pub fn word(self) -> &'static str {
        match self {
            EngineKind::Reference => "reference",
            EngineKind::Cpu => "cpu",
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
