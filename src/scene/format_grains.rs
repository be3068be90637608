//! The keys of grains and of the solid's collision.

use schemars::JsonSchema;
use serde::Deserialize;

use super::format::Triple;

/// A grain, or several made by one rule. Each grain is a sphere.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainsSection {
    /// `sphere` (one grain), `csv` (a list in a file), `array` (a regular array that fills the box),
    /// `random` (a random suspension) or `bed` (grains that have settled onto the face `z_low`).
    pub kind: GrainsKind,
    /// With `sphere`: its centre, m.
    pub centre: Option<Triple>,
    /// With all kinds but `csv`: diameter, m.
    pub diameter: Option<f64>,
    /// With `csv`: the file, relative to the scene. Its first line is
    /// `x (m),y (m),z (m),diameter (m)`, and `,density (kg/m3)` where the grains have their own, the
    /// columns in any order, `radius (m)` instead of the diameter if you like; each further line is a
    /// grain. Blank lines and lines that begin with `#` are left out.
    pub file: Option<String>,
    /// With `array`: `sc` (simple cubic), `bcc` (body-centred) or `fcc` (face-centred).
    pub lattice: Option<LatticeName>,
    /// With `array`: unit cells along x, y, z; 1 each where absent. They must come out as cubes.
    pub counts: Option<[i64; 3]>,
    /// With `random` and `bed`, instead of `diameter`: smallest and largest diameter, m; by number
    /// all between are as frequent.
    pub diameter_range: Option<[f64; 2]>,
    /// With `array`, instead of `diameter`, and with `random`, instead of `count`: volume of the
    /// grains over that of the box, in (0, 1). A suspension above 0.25 needs a box that is periodic
    /// along all axes.
    pub solid_fraction: Option<f64>,
    /// With `random` and `bed`: number of grains.
    pub count: Option<i64>,
    /// With `random` and `bed`: seed of places and sizes, a whole number; 1 where absent. The same
    /// seed gives the same grains.
    pub seed: Option<i64>,
    /// With `random`: least distance between surfaces, m; 0 where absent.
    pub gap: Option<f64>,
    /// With `bed`: friction while it settles; 0.5 where absent, 0 packs dense.
    pub packing_friction: Option<f64>,
    /// `fixed` (the default), `prescribed` (moves as `velocity` and `spin` say) or `free` (moves as
    /// fluid, neighbours and gravity push it). A prescribed sphere comes in again at periodic faces and may
    /// leave through `pressure` and `free_outflow`; in any other face, or in a sphere that is not free, it
    /// stops the run once it is more than 1 % of a diameter deep.
    #[serde(default)]
    pub motion: Motion,
    /// With `free`: density of the grains, kg/m3; not where a `csv` file has a column for it.
    pub density: Option<f64>,
    /// With `prescribed`: velocity, m/s; with `free` that at the start. The fluid that a grain covers
    /// starts with the grain, that outside with `initial.velocity`; what has to give way takes its share
    /// within a few steps, by sound: alone, a free grain of r times the fluid's density keeps
    /// r/(r + 1/2) of its velocity against the fluid's (tests/oracle/free_start.rs).
    pub velocity: Option<Triple>,
    /// With `prescribed`: angular velocity, rad/s; with `free` that at the start.
    pub spin: Option<Triple>,
}

/// Where grains come from.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum GrainsKind {
    /// One grain.
    Sphere,
    /// A list in a CSV file.
    Csv,
    /// A regular array.
    Array,
    /// A random suspension.
    Random,
    /// A settled bed.
    Bed,
}

/// A regular array.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum LatticeName {
    /// Simple cubic.
    Sc,
    /// Body-centred cubic.
    Bcc,
    /// Face-centred cubic.
    Fcc,
}

/// How a grain moves.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum Motion {
    /// It is held.
    #[default]
    Fixed,
    /// It moves as told.
    Prescribed,
    /// It moves as fluid, neighbours and gravity push it.
    Free,
}

/// How grains act on the fluid. The defaults are what converges (golden/tradeoff): with `solid_fraction` the
/// flow through an array is up to 55 % too slow at tau 0.6 and up to 7 times too fast at 1.5, and right in
/// between by cancellation only; `superposition` errs 1.4 to 2.9 times as much as the default, flow by flow; sampled solid
/// fractions change the error by a fifth with 2 points along each axis, and by 2 % with 5 (medians).
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SolidSection {
    /// Weight of the solid in a cell: `noble_torczynski` (the default) or `solid_fraction`.
    #[serde(default)]
    pub weighting: WeightingName,
    /// Collision in the solid: `bounce_back` of the non-equilibrium part (the default) or
    /// `superposition`.
    #[serde(default)]
    pub operator: OperatorName,
    /// How the solid fraction of a cell is found: `exact` (the default) or `sampled`.
    #[serde(default)]
    pub coverage: CoverageName,
    /// With `sampled`: points along each axis of a cell, 1 to 100.
    pub samples: Option<i64>,
}

/// Weight of the solid in a cell.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum WeightingName {
    /// Depends on the relaxation time too.
    #[default]
    NobleTorczynski,
    /// The solid fraction itself.
    SolidFraction,
}

/// Collision in the solid.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum OperatorName {
    /// Bounce-back of the non-equilibrium part.
    #[default]
    BounceBack,
    /// Superposition.
    Superposition,
}

/// How the solid fraction of a cell is found.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum CoverageName {
    /// In closed form.
    #[default]
    Exact,
    /// By sample points.
    Sampled,
}
