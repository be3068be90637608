//! The keys of the start of the fluid.

use schemars::JsonSchema;
use serde::Deserialize;

use super::format_run::AxisName;
use super::triple::Triple;

/// How the fluid starts. Give `velocity`, or `flow` with its keys, or `velocity_field`, or `from`. In all of them each
/// cell starts in equilibrium, so that the stresses of the flow appear within the first few relaxation times. If a grain
/// is free or prescribed, the fluid inside a grain starts with the grain's motion.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InitialSection {
    /// Velocity of the fluid everywhere, m/s; with `flow = "shear_wave"`: where it is largest.
    pub velocity: Option<Triple>,
    /// A flow by its formula. `shear`: between two walls, whose velocities the fluid has at them, and in between on a straight
    /// line. `shear_wave`: velocity sin(2 pi s/L), where s runs from 0 to L along `across`; it decays as exp(-nu k2 t), k = 2 pi/L.
    /// `taylor_green`: vortices in the plane normal to `across`, with r and s along its axes and k = 2 pi/L of each:
    /// speed (sin(k_r r) cos(k_s s), -(k_r/k_s) cos(k_r r) sin(k_s s)), with the pressure that belongs to it; between
    /// periodic faces it decays as exp(-nu (k_r2 + k_s2) t).
    pub flow: Option<FlowName>,
    /// With `flow`: the axis along which a shear changes; of vortices the axis on which they turn.
    pub across: Option<AxisName>,
    /// With `flow = "taylor_green"`: the largest velocity along the first axis of the plane, m/s.
    pub speed: Option<f64>,
    /// A NumPy file (`.npy`), relative to the scene, of the velocity of each cell, m/s: of shape `[nz, ny, nx, 3]`, as a
    /// record of kind `fields` writes it.
    pub velocity_field: Option<String>,
    /// The folder of a run, relative to the scene: each cell starts with the velocity and pressure of the last state that
    /// this run has kept. Its grid must be the same; engine, time step, faces and solids may differ. Grains are not taken
    /// from there: name its `grains_at_end.csv` in a section `[[grains]]` of kind `csv`. (A run that goes on bit for bit,
    /// with springs of contacts and stresses of the fluid: `psmrt resume DIR --set ... --out ...`.)
    pub from: Option<String>,
}

/// A flow by its formula.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum FlowName {
    /// Between two walls.
    Shear,
    /// A sine.
    ShearWave,
    /// Vortices.
    TaylorGreen,
}
