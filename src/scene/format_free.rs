//! The keys that only scenes with free grains have: contact, lubrication, gravity, coupling.

use schemars::JsonSchema;
use serde::Deserialize;

use super::format::Triple;

/// How free grains touch each other, grains that are held, and the faces of the box. Give the normal
/// spring by `stiffness` or by `duration`, the dashpot by `damping` or by `restitution`. A free grain that
/// lies deeper than half its radius in another or in a face, or is thrown by a contact, stops the run.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactSection {
    /// Stiffness of the normal spring, N/m. Where neither it nor `duration` is given, contacts last 10 time
    /// steps, or less if weight asks for it: a bed of all free grains at rest overlaps by 0.3 % of a diameter
    /// at its bottom (the strongest chains of force by about 1 %), the heaviest grain at rest on the smallest
    /// by 1 %, and when it falls on it by 5 %, at most.
    pub stiffness: Option<f64>,
    /// With `stiffness`: damping of the normal dashpot, N s/m.
    pub damping: Option<f64>,
    /// Instead of `stiffness`: how long two of the lightest free grains touch in a central impact, s; up to a
    /// million time steps. Contacts down to 0.03 time steps are right (golden/stability/contact.csv).
    pub duration: Option<f64>,
    /// Instead of `damping`: speed of parting over speed of meeting of such an impact in vacuum, 0.01
    /// to 1; 0.5 where neither is given.
    pub restitution: Option<f64>,
    /// Coulomb's coefficient of friction, 0 for smooth grains; 0.5 where absent.
    pub friction: Option<f64>,
    /// Tangential over normal stiffness, and damping alike, 0.001 to 10; 2/7 where absent: then a sphere
    /// swings tangentially in the time in which it swings normally.
    pub tangential_ratio: Option<f64>,
    /// Coefficient of rolling resistance: the tangent of the slope down which a grain just rolls;
    /// grains roll freely where absent.
    pub rolling_resistance: Option<f64>,
    /// Sub-steps of the grains in a time step; as many as the contacts need (25 in the shortest) where
    /// absent. Fewer than 10 in the shortest contact are refused.
    pub substeps: Option<i64>,
}

/// The part of the lubrication between close surfaces that the grid does not resolve; none where the
/// section is absent.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LubricationSection {
    /// Gap from which the correction acts, m; the edge of a cell where absent.
    pub cutoff_gap: Option<f64>,
    /// Gap below which it grows no more, m: the roughness of the grains; a thousandth of the smallest
    /// radius where absent.
    pub smallest_gap: Option<f64>,
}

/// Gravity on free grains.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GravitySection {
    /// Acceleration, m/s2.
    pub acceleration: Triple,
    /// `reduced` (the default: grains carry their weight less their buoyancy, the pressure is that
    /// above the hydrostatic one) or `body_force` (fluid and grains carry their weight; the buoyancy
    /// is too small on coarse grids: 58, 80 and 92 % of the displaced weight at 4, 8 and 16 cells per
    /// diameter and tau = 1, tests/oracle/coupling.rs).
    #[serde(default)]
    pub form: GravityForm,
    /// `true` where the domain is periodic along gravity and nothing else holds up what is in it: a uniform
    /// pressure gradient, which acts on fluid and grains alike, carries the net weight (weight less buoyancy) of
    /// all grains, as in a tall vessel. The total momentum then stays as it starts and grains settle through the
    /// fluid; without it, fluid and grains fall together faster and faster. `false` where absent. Needs the
    /// form `reduced`, free grains only, and faces that are periodic or `free_slip`. Settling velocities of
    /// arrays are quoted against the mean flux: subtract the superficial velocity of a `box` record.
    #[serde(default)]
    pub balance: bool,
}

/// How gravity acts.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum GravityForm {
    /// By reduced pressure.
    #[default]
    Reduced,
    /// As a body force on the fluid too.
    BodyForce,
}

/// How fluid and free grains act on each other. With either `internal_fluid` a grain of 1 to 10 times the fluid's
/// density survives and keeps momentum, tau 0.501 to 2; lighter ones do so down to 0.7 times with `lagged` (tau to 1;
/// 0.8 times at 2), and with `kept` down to 0.5 times at tau 0.51, 0.6 at 0.55, 0.7 at 0.6 and 0.8, 0.8 at 1
/// (golden/stability/movers.csv), below which they are thrown about until the run breaks; `lagged` is the default
/// because a released sphere then starts as the exact solution says, within 2.5 % of its terminal velocity, while
/// `kept` is too slow by more than 1.5 times that (tests/oracle/coupling.rs). Averaged loads with `lagged` let the spin
/// of a neutrally buoyant grain swing.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CouplingSection {
    /// Inertia of the fluid inside a grain: `lagged` (given back a step later, the default) or `kept`.
    #[serde(default)]
    pub internal_fluid: InternalFluidName,
    /// Whether the mean of the last two loads drives a grain, instead of the last; `false` where
    /// absent.
    #[serde(default)]
    pub average_loads: bool,
}

/// What becomes of the inertia of the fluid inside a grain.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum InternalFluidName {
    /// Given back one step later.
    #[default]
    Lagged,
    /// Stays with the grain.
    Kept,
}
