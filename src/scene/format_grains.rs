//! The keys of grains and of the solid's collision.

use psmrt_reference::partial_saturation::SolidOperator;
use schemars::JsonSchema;
use serde::Deserialize;

use super::format_bodies::BodySection;
use super::format_lists::ColumnsSection;
use super::format_time::VectorInTime;
use super::format_voxels::ImageSection;
use super::triple::Triple;

/// A grain, or several made by one rule. Each grain is a sphere; an image and a body are solids of any shape.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainsSection {
    /// `sphere` (one grain), `csv` (a list in a file), `array` (a regular array that fills the domain),
    /// `random` (a random suspension), `bed` (grains that have settled onto the face `z_low`, or above it), `voxels` (solids of any
    /// shape, as an image shows them; they are fixed) or `body` (one body that is no sphere: from an STL file, a box, a cylinder).
    pub kind: GrainsKind,
    /// With `sphere`: its centre, m; with `body`: where its own origin lies, about which it turns, m.
    pub centre: Option<Triple>,
    /// With all kinds but `csv`, `voxels` and `body`: diameter, m.
    pub diameter: Option<f64>,
    /// With `csv`: the file, relative to the scene. Its first line is
    /// `x (m),y (m),z (m),diameter (m)`, and `,density (kg/m3)` where the grains have their own, the
    /// columns in any order, `radius (m)` instead of the diameter if you like; each further line is a
    /// grain. Free grains may have `velocity_x (m/s)` to `velocity_z (m/s)` and `spin_x (rad/s)` to `spin_z (rad/s)`, as at the
    /// start. A run with free grains leaves such a list of them, `grains_at_end.csv`. A dump of LAMMPS or LIGGGHTS in SI units (its last
    /// frame, with places from the low corner of its box; columns `x y z`, `radius` or `diameter`, and perhaps `density`, `vx vy vz`, `omegax omegay omegaz`; others are left out) and
    /// the text of YADE's `export.text` are read as well, and so are VTK's files of points (`.vtp`, `.vtu`), those of records of kind
    /// `grains` and those that ParaView saves as text or without compression: `Points` in m and the arrays `diameter (m)` or
    /// `radius (m)`, and perhaps `density (kg/m3)`, `velocity (m/s)`, `spin (rad/s)`. All grains of a file move as the section says.
    /// Blank lines and lines that begin with `#` are left out.
    pub file: Option<String>,
    /// With `csv`: which columns are what, for a table of another program.
    pub columns: Option<ColumnsSection>,
    /// With `voxels`: the image.
    pub image: Option<ImageSection>,
    /// With `body`: its shape and its size.
    pub body: Option<BodySection>,
    /// With `array`: `sc` (simple cubic), `bcc` (body-centred) or `fcc` (face-centred).
    pub lattice: Option<LatticeName>,
    /// With `array`: unit cells along x, y, z; 1 each where absent. They must come out as cubes.
    pub counts: Option<[i64; 3]>,
    /// With `random` and `bed`, instead of `diameter`: smallest and largest diameter, m; uniformly distributed by
    /// number between them.
    pub diameter_range: Option<[f64; 2]>,
    /// With `random` and `bed`, instead of `diameter`: a sieve curve, rows `[diameter, finer]`: diameter of the sieve, m, and the share
    /// of the mass that is finer, from 0 to 1. Between two sieves the mass is evenly distributed over the logarithm of the
    /// diameter; two rows with the same diameter give that part of the mass this diameter, so that
    /// `[[1e-4, 0], [1e-4, 0.3], [3e-4, 0.3], [3e-4, 1]]` is a mixture of two. With `solid_fraction` the sizes are scaled a little, so
    /// that the grains have just that.
    pub grading: Option<Vec<[f64; 2]>>,
    /// With `random` and `bed`, instead of `diameter`: a log-normal distribution of the mass: the median diameter, m, and the factor of
    /// one standard deviation (1.5, say); cut off at three of them.
    pub log_normal: Option<[f64; 2]>,
    /// With `array`, instead of `diameter`, and with `random`, instead of `count`: volume of the
    /// grains over that of the domain, in (0, 1). A suspension above 0.25 needs a domain that is periodic
    /// along all axes.
    pub solid_fraction: Option<f64>,
    /// With `random` and `bed`: number of grains.
    pub count: Option<i64>,
    /// With `random` and `bed`: seed of positions and sizes, a whole number; 1 where absent. The same
    /// seed gives the same grains.
    pub seed: Option<i64>,
    /// With `random`: least distance between surfaces, m; 0 where absent.
    pub gap: Option<f64>,
    /// With `bed`: friction while it settles, 0 (the densest packing) to 10; 0.5 where absent.
    pub packing_friction: Option<f64>,
    /// With `bed`: height of the floor that it settles onto above the face `z_low`, m, as of a sieve that lets fluid pass; 0 where absent.
    /// Leave a diameter above a velocity inlet: what enters under a grain that touches the inlet has no way out. Not
    /// with free grains, which would fall from there.
    pub floor: Option<f64>,
    /// `fixed` (the default), `prescribed` (moves with the given `velocity` and angular velocity `spin`) or `free`
    /// (moves under hydrodynamic force, contacts and gravity). A prescribed sphere re-enters at periodic faces and may
    /// leave through `pressure` and `free_outflow` faces; if it overlaps any other face, or a sphere that is not free,
    /// by more than 1 % of its diameter, the run stops. A prescribed body stops the run when 1 % of its volume is out of the domain
    /// or in another solid.
    #[serde(default)]
    pub motion: MotionKind,
    /// With `free`: density of the grains, kg/m3; not together with a `csv` file that has a column for it.
    pub density: Option<f64>,
    /// With `prescribed`: velocity, m/s: a vector, or how it changes in time; with `free`: velocity at the start. The fluid inside a grain starts with the
    /// grain, the fluid outside with `initial.velocity`. The fluid that a free grain must displace takes momentum from
    /// it within a few steps, as sound: a single grain of r times the fluid's density keeps r/(r + 1/2) of its velocity
    /// relative to the fluid (added mass; tests/oracle/free_start.rs).
    pub velocity: Option<VectorInTime>,
    /// With `prescribed`: angular velocity, rad/s: a vector, or how it changes in time; with `free`: angular velocity at
    /// the start.
    pub spin: Option<VectorInTime>,
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
    /// An image.
    Voxels,
    /// A body that is no sphere.
    Body,
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
pub enum MotionKind {
    /// It does not move.
    #[default]
    Fixed,
    /// It moves with a given velocity.
    Prescribed,
    /// It moves under hydrodynamic force, contacts and gravity.
    Free,
}

/// How grains act on the fluid: the partially saturated method (PSM), one of the immersed moving boundary (IMB)
/// methods. `bounce_back` and graded viscosity converge with the grid (golden/tradeoff). With `solid_fraction` the flow through an array is
/// up to 55 % too slow at tau 0.6 and up to 7 times too fast at 1.5; in between it is right by cancellation only. With
/// `superposition` errors are 1.4 to 2.9 times those of the default, depending on the flow. Sampled solid fractions
/// change the error by a fifth with 2 points along each axis, and by 2 % with 5 (medians).
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SolidSection {
    /// Weight `B` of the solid in a cell: `noble_torczynski` (the default) or `solid_fraction`. Not with
    /// `graded_viscosity`, which has its own; where it is given and no `operator` is, that is `bounce_back`.
    pub weighting: Option<WeightingName>,
    /// Collision in the solid: `bounce_back` of the non-equilibrium part (SC1 of the literature, the paper's),
    /// `superposition` (SC2), `full_bounce_back` (SC3) or `graded_viscosity`, of psmrt's own making. Where absent it is
    /// chosen: `graded_viscosity` where all grains are fixed, since it is the more accurate there, most of all where grains
    /// are coarse or tau is large (golden/tradeoff/operators.csv; near tau 1/2 and on fine grids `bounce_back` is as good);
    /// `bounce_back` where a grain moves or a `weighting` is given, which belongs to it. `psmrt check` says which it is, and
    /// what error goes with it. With the last two of the four no fluid passes through the cells that a solid fills.
    /// `graded_viscosity` is not for free grains, and the force on one that moves as prescribed swings with it by some
    /// percent from step to step. Free grains with `full_bounce_back` are coupled implicitly:
    /// the velocity that they have in a collision is solved for before it. At 4 and 6 cells per diameter and tau = 0.7 they
    /// then settle with 1.04 and 0.99 of the exact velocity, with `bounce_back` with 1.25 and 1.09
    /// (tests/oracle/implicit_coupling.rs).
    pub operator: Option<OperatorName>,
    /// How the solid fraction of a cell is found: `exact` (the default), `sampled`, or `linear` in the distance between
    /// the centres of grain and cell, the fastest where grains move.
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
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum OperatorName {
    /// Bounce-back of the non-equilibrium part (SC1).
    BounceBack,
    /// Superposition (SC2).
    Superposition,
    /// Bounce-back of the whole populations (SC3).
    FullBounceBack,
    /// Cut cells as fluid that is `1/(1 - epsilon)` times as viscous.
    GradedViscosity,
}

impl OperatorName {
    /// The name of an operator.
    pub fn of(operator: SolidOperator) -> Self {
        match operator {
            SolidOperator::NonEquilibriumBounceBack => OperatorName::BounceBack,
            SolidOperator::Superposition => OperatorName::Superposition,
            SolidOperator::FullBounceBack => OperatorName::FullBounceBack,
            SolidOperator::GradedViscosity => OperatorName::GradedViscosity,
        }
    }

    /// As scenes spell it.
    pub fn word(self) -> &'static str {
        match self {
            OperatorName::BounceBack => "bounce_back",
            OperatorName::Superposition => "superposition",
            OperatorName::FullBounceBack => "full_bounce_back",
            OperatorName::GradedViscosity => "graded_viscosity",
        }
    }
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
    /// Linear in the distance between the centres of sphere and cell.
    Linear,
}
