//! What a scene file holds, key by key, as the user writes it: TOML, SI units.
//!
//! The comments on the keys are the reference: they go into the JSON schema, into
//! `src/scene/REFERENCE.md`, and into the messages about missing keys. Nothing is checked here but
//! names and types; see [`super::check`].

use schemars::JsonSchema;
use serde::Deserialize;

use super::format_free::{ContactSection, CouplingSection, GravitySection, LubricationSection};
use super::format_grains::{GrainsSection, SolidSection};
use super::format_initial::InitialSection;
use super::format_run::{
    CheckpointSection, CompareSection, EngineSection, RecordSection, StopSection,
};
use super::format_time::{NumberInTime, VectorInTime};
use super::triple::Triple;

/// A scene: one flow, with what to record and when to stop. All values in SI units.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// One line that says what the scene shows.
    pub title: Option<String>,
    /// The domain.
    pub domain: DomainSection,
    /// The fluid. A scene without it computes its free grains alone: weight, contacts, walls; `time.dt` is needed then, and keys of
    /// the fluid are refused. `domain.dx` is only the unit of its lengths: no cells are there, and a grain may be smaller. Faces may
    /// be periodic, walls or mirror planes; records of kind `grains`, `grain_means`, `contacts`, `contact_means` and `walls` are
    /// taken (with no force of a fluid). The list that the run leaves, `grains_at_end.csv`, starts a scene with fluid.
    pub fluid: Option<FluidSection>,
    /// The time step.
    pub time: TimeSection,
    /// The fluid's collision; MRT with d'Humieres' rates where the section is absent.
    pub collision: Option<CollisionSection>,
    /// What happens at the six faces; those that are absent are periodic.
    #[serde(default)]
    pub faces: FacesSection,
    /// A force on the fluid everywhere; none where the section is absent.
    pub body_force: Option<BodyForceSection>,
    /// How the fluid starts; at rest where the section is absent.
    pub initial: Option<InitialSection>,
    /// The grains; none where there is no such section.
    #[serde(default)]
    pub grains: Vec<GrainsSection>,
    /// How grains act on the fluid; the defaults where the section is absent.
    pub solid: Option<SolidSection>,
    /// Gravity on free grains; none where the section is absent.
    pub gravity: Option<GravitySection>,
    /// How free grains touch; the defaults where the section is absent.
    pub contact: Option<ContactSection>,
    /// Lubrication between free grains; none where the section is absent.
    pub lubrication: Option<LubricationSection>,
    /// How fluid and free grains act on each other; the defaults where the section is absent.
    pub coupling: Option<CouplingSection>,
    /// What to record, and how often.
    #[serde(default)]
    pub records: Vec<RecordSection>,
    /// When the run ends: at the first of the given limits.
    pub stop: StopSection,
    /// When to save the state of the run, to go on from after an interruption.
    pub checkpoint: Option<CheckpointSection>,
    /// What computes the scene: the oracle, the CPU engine or a GPU.
    pub engine: Option<EngineSection>,
    /// An exact solution to compare with at the end.
    pub compare: Option<CompareSection>,
}

/// The domain, of cubic cells of edge `dx`. Give exactly one of `size` and `cells`; or neither where `[[grains]]` has an image,
/// which the domain is then as large as.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DomainSection {
    /// Edge of a cell, m.
    pub dx: f64,
    /// Lengths of the domain along x, y, z, m: each a whole number of `dx`.
    pub size: Option<Triple>,
    /// Cells along x, y, z.
    pub cells: Option<[i64; 3]>,
}

/// The fluid.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FluidSection {
    /// Density, kg/m3.
    pub density: f64,
    /// Kinematic viscosity, m2/s.
    pub kinematic_viscosity: f64,
}

/// The time step. Give exactly one of `dt`, `tau` and `lattice_velocity`.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeSection {
    /// Time step, s. Without `fluid` the only one of these; contacts take as many sub-steps in it as they need. No velocity that the
    /// scene gives may then be more than a fifth of `domain.dx` in it.
    pub dt: Option<f64>,
    /// Relaxation time in time steps, above 0.5: `dt = (tau - 0.5)/3 dx2/kinematic_viscosity`. Errors at grains grow
    /// with `tau - 0.5`, and the cost falls with it: Pareto-optimal runs with errors below 10 % have tau 0.55 to 0.8
    /// (golden/tradeoff/front.csv). `psmrt check` predicts the error of a scene, with the default collision for tau from 0.503.
    pub tau: Option<f64>,
    /// Velocity in cells per time step that `reference_velocity` becomes; 0.01 to 0.1 is usual.
    pub lattice_velocity: Option<f64>,
    /// With `lattice_velocity`: the largest velocity that the flow should reach, m/s.
    pub reference_velocity: Option<f64>,
}

/// The fluid's collision. On the same grid and at the same tau the defaults have the smallest error in every array,
/// bed, duct and shaft of golden/tradeoff. The error of `srt` (BGK) is 1.1 times as large at tau 0.6 and 1.7 times at
/// 1.5, that of `magic` (TRT) 2.5 times at 0.6 and 1.2 times at 1.5 (medians). `srt` takes less time per step, `magic`
/// is exact at plane walls along the grid; `psmrt plan` compares them for a scene.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CollisionSection {
    /// `mrt` (multiple relaxation times, the default) or `srt` (a single one: BGK).
    #[serde(default)]
    pub model: CollisionModel,
    /// With `mrt`, the preset of the free rates: `dhumieres` (the default), `magic` (two relaxation times: TRT) or
    /// `srt`.
    pub rates: Option<RatesName>,
    /// With `rates = "magic"`: the parameter Lambda, above 0; 3/16 = 0.1875 puts plane walls exactly half-way between nodes.
    pub magic: Option<f64>,
    /// With `mrt`: rate of the energy, in (0, 2), instead of the preset's.
    pub s_e: Option<f64>,
    /// With `mrt`: rate of the energy squared, in (0, 2), instead of the preset's.
    pub s_eps: Option<f64>,
    /// With `mrt`: rate of the energy flux, in (0, 2), instead of the preset's.
    pub s_q: Option<f64>,
    /// With `mrt`: rate of the fourth-order stresses, in (0, 2), instead of the preset's.
    pub s_pi: Option<f64>,
    /// With `mrt`: rate of the third-order moments, in (0, 2), instead of the preset's.
    pub s_m: Option<f64>,
}

/// Which collision.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum CollisionModel {
    /// Multiple relaxation times.
    #[default]
    Mrt,
    /// A single relaxation time (BGK).
    Srt,
}

/// Where the free rates of MRT come from.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum RatesName {
    /// d'Humieres et al. 2002: 1.19, 1.4, 1.2, 1.4, 1.98.
    #[default]
    Dhumieres,
    /// Two relaxation times (TRT) with a given magic parameter Lambda.
    Magic,
    /// All rates 1/tau.
    Srt,
}

/// The six faces. Every face that is not periodic stops free grains: at walls they are in contact, with friction; at
/// mirror planes (`free_slip`) they are in contact with their own mirror image; inlets, outflows and pressure faces
/// act on them as a sieve, which lets only the fluid through.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FacesSection {
    /// The face at x = 0.
    pub x_low: Option<FaceSection>,
    /// The face at the far end of x.
    pub x_high: Option<FaceSection>,
    /// The face at y = 0.
    pub y_low: Option<FaceSection>,
    /// The face at the far end of y.
    pub y_high: Option<FaceSection>,
    /// The face at z = 0.
    pub z_low: Option<FaceSection>,
    /// The face at the far end of z.
    pub z_high: Option<FaceSection>,
}

/// One face.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FaceSection {
    /// `periodic`, `wall`, `free_slip`, `velocity_inlet`, `free_outflow` or `pressure`.
    pub kind: FaceKind,
    /// Velocity of a `wall` (in its plane; at rest where absent) or of a `velocity_inlet`, m/s: a vector, or how it
    /// changes in time.
    pub velocity: Option<VectorInTime>,
    /// Pressure above that of the fluid at its reference density, at a `pressure` face, Pa: a number, or how it changes
    /// in time.
    pub pressure: Option<NumberInTime>,
    /// At a `pressure` face: whether the flow is developed there, that is, does not change along the normal. Then the
    /// face transmits the shear stress of the cells inside, and Poiseuille flow passes unchanged. Without it (the
    /// default) the face transmits no shear stress, as at the mouth of a jet: each end makes a channel effectively
    /// shorter by a twentieth of its width.
    pub developed: Option<bool>,
    /// At a `pressure` face: whether sound leaves through it (false where absent). The pressure there then follows
    /// the wave that arrives; over times longer than `memory` it is the given one. The shear stress is
    /// transmitted as with `developed = true`. Of the energy of a wave of period P the share
    /// 1/(1 + (4 pi memory/P)^2) is reflected (by a pressure face nearly all, by a free outflow about 6 %), of one that
    /// arrives at 30 degrees to the normal at least 0.5 %, at 45 degrees 3 %, at 60 degrees 11 %. Eddies that leave
    /// within the memory are impeded by the face: one of radius R and speed u' in a stream U meets a pressure of about
    /// 0.4 rho U u' with the default (0.3 at a developed face) and a tenth of it stays for a while; with a memory of
    /// R/(4 U) it meets 0.1. Between two such faces a pressure difference accelerates the fluid as if the domain were
    /// longer by 2 c_s memory: nine times as long with the default. The speed of sound c_s is the lattice's,
    /// dx/(sqrt(3) dt).
    pub non_reflecting: Option<bool>,
    /// At a non-reflecting face: time after which its pressure is held again, s, from 1 to 10^6 time steps. Where
    /// absent 4 times that in which sound crosses the domain along the normal (4 sqrt(3) steps a cell): of the memories
    /// with which the flow between a velocity inlet and the face settles fast, to a thousandth in 20 crossings, the one
    /// that sends least sound back.
    pub memory: Option<f64>,
}

/// What happens at a face.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum FaceKind {
    /// What leaves here enters at the opposite face.
    Periodic,
    /// No slip.
    Wall,
    /// A mirror plane.
    FreeSlip,
    /// Fluid enters with a given velocity.
    VelocityInlet,
    /// Zero gradient along the normal.
    FreeOutflow,
    /// A given pressure.
    Pressure,
}

/// A force on the fluid.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodyForceSection {
    /// Force per mass on the fluid, m/s2: a vector, or how it changes in time.
    pub acceleration: VectorInTime,
}
