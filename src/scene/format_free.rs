//! The keys that only scenes with free grains have: contact, lubrication, gravity, coupling.

use schemars::JsonSchema;
use serde::Deserialize;

use super::format_time::VectorInTime;

/// Contacts of free grains with each other, with fixed and prescribed grains, and with the faces of the domain: a
/// spring and a dashpot (Voigt) with Coulomb friction. Linear contacts have one stiffness: give the normal spring by
/// `stiffness` or by `duration`, the dashpot by `damping` or by `restitution`. With `youngs_modulus` contacts are those of
/// elastic spheres (Hertz and Mindlin), which get stiffer as they are pressed together; `restitution`, `friction`,
/// `rolling_resistance` and `substeps` then mean the same. A free grain that overlaps another grain or a face by more than half its
/// radius, or that a contact ejects, stops the run.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactSection {
    /// Stiffness of the normal spring, N/m. Where neither it nor `duration` is given, contacts last 10 time steps, or
    /// fewer if the weight of the grains requires stiffer ones, so that overlaps are at most: in a bed of all free
    /// grains at rest 0.3 % of a diameter at its bottom (about 1 % in the strongest force chains), the heaviest grain
    /// at rest on the smallest 1 %, and when it falls on it 5 %.
    pub stiffness: Option<f64>,
    /// With `stiffness`: damping of the normal dashpot, N s/m.
    pub damping: Option<f64>,
    /// Instead of `stiffness`: duration of the contact of two of the lightest free grains in a central impact, s; up to
    /// a million time steps. Contacts as short as 0.03 time steps are resolved correctly (golden/stability/contact.csv).
    pub duration: Option<f64>,
    /// Instead of `damping`: coefficient of restitution of such an impact in vacuum, 0.01 to 1; 0.5 where neither is
    /// given.
    pub restitution: Option<f64>,
    /// Instead of `stiffness` or `duration`: Young's modulus of the grains and of the faces of the domain, Pa. The normal
    /// force is Hertz's, `(4/3) E* √(R* δ) δ` with the overlap `δ`, `E* = E/(2 (1 - ν²))` and `1/R* = 1/R₁ + 1/R₂` (on a face
    /// the radius); the tangential spring is Mindlin's, `8 G* √(R* δ)` per length. Sub-steps resolve contacts that overlap by a
    /// tenth of a radius, about 4 % of Rayleigh's time with friction; they go as the root of the modulus, so that a modulus
    /// far below the material's is usual: choose it so that `psmrt check` shows overlaps of less than 1 %.
    pub youngs_modulus: Option<f64>,
    /// With `youngs_modulus`: Poisson's ratio, 0 to 0.5; 0.3 where absent.
    pub poisson_ratio: Option<f64>,
    /// Coulomb's coefficient of friction, 0 (smooth grains) to 10; 0.5 where absent.
    pub friction: Option<f64>,
    /// Ratio of tangential to normal stiffness, and of the dampings, 0.001 to 10; 2/7 where absent, with which a
    /// sphere's tangential and normal oscillations have the same period.
    pub tangential_ratio: Option<f64>,
    /// Coefficient of rolling resistance, 0 to 10: the tangent of the slope on which a grain just begins to roll; grains
    /// roll freely where absent.
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
    /// Gap below which it no longer grows, m: the roughness of the grains; a thousandth of the smallest
    /// radius where absent.
    pub smallest_gap: Option<f64>,
    /// Whether it acts on grains that overlap, as at the smallest gap; `true` where absent. It calms contacts at rest, and
    /// takes most of a rebound in contacts that are stretched to several time steps: `false` leaves those to the
    /// contact's own restitution (golden/wet_rebound).
    pub while_touching: Option<bool>,
}

/// Gravity on free grains.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GravitySection {
    /// Acceleration, m/s2: a vector, or how it changes in time.
    pub acceleration: VectorInTime,
    /// `reduced` (the default: the weight of a grain less its buoyancy acts on it, and the pressure is that above the
    /// hydrostatic one) or `body_force` (gravity acts on fluid and grains; the buoyancy
    /// is too small on coarse grids: 58, 80 and 92 % of the displaced weight at 4, 8 and 16 cells per
    /// diameter and tau = 1, tests/oracle/coupling.rs).
    #[serde(default)]
    pub form: GravityForm,
    /// `true` for a domain that is periodic along gravity, where no wall supports the fluid and the grains: a uniform
    /// pressure gradient on fluid and grains balances the net weight (weight less buoyancy) of all grains, as in a tall
    /// vessel. Total momentum is then conserved and grains settle through the fluid; without it, fluid and grains
    /// accelerate downwards together. `false` where absent. Requires the form `reduced`, free grains only, and faces
    /// that are periodic or `free_slip`. Settling velocities of arrays are quoted relative to the mean flux: subtract
    /// the superficial velocity of a `box` record.
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

/// How fluid and free grains act on each other. With either `internal_fluid` the coupling is stable and conserves
/// momentum for grains of 1 to 10 times the fluid's density, at tau 0.501 to 2. For lighter grains it is stable down to
/// 0.7 times the fluid's density with `lagged` (tau to 1; 0.8 times at 2), and with `kept` down to 0.5 times at tau
/// 0.51, 0.6 at 0.55, 0.7 at 0.6 and 0.8, 0.8 at 1 (golden/stability/movers.csv); below that, their velocity
/// oscillates with growing amplitude until the run stops. `lagged` is the default because a released sphere then
/// accelerates as the exact solution does, within 2.5 % of its terminal velocity; with `kept` it is too slow by more
/// than 1.5 times that (tests/oracle/released_sphere.rs). With `lagged` and averaged forces the angular velocity of a neutrally
/// buoyant grain oscillates. All of this is for `solid.operator` `bounce_back` and `superposition`, under which grains collide
/// with the velocity that they have come with. With `full_bounce_back` it is solved for before the collision, which is
/// stable for lighter grains too, down to a tenth of the fluid's density (tests/oracle/implicit_coupling.rs).
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CouplingSection {
    /// Inertia of the fluid inside a grain: `lagged` (added back with a lag of one step, the default) or `kept` (retained
    /// by the grain).
    #[serde(default)]
    pub internal_fluid: InternalFluidName,
    /// Whether the mean hydrodynamic force and torque of the last two steps acts on a grain, instead of those of the
    /// last; `false` where absent. Not with the solid operator `full_bounce_back`.
    #[serde(default)]
    pub average_loads: bool,
}

/// What becomes of the inertia of the fluid inside a grain.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum InternalFluidName {
    /// Added back with a lag of one step.
    #[default]
    Lagged,
    /// Retained by the grain.
    Kept,
}
