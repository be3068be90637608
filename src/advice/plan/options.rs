//! All ways to compute a scene that lie within the evidence, and which of them is best.

use psmrt_reference::collision::Preset;
use psmrt_reference::lattice::viscosity;

use super::facts::{Facts, Limit};
use super::predict::{Outside, Parameters, WALL_CELLS, is_heavy_enough, predict};
use crate::advice::tradeoff::model::SolidMethod;
use crate::advice::tradeoff::models::Models;
use crate::engine::EngineName;

/// Relaxation times that are tried.
const TAUS: [f64; 13] = [0.51, 0.52, 0.55, 0.6, 0.65, 0.7, 0.8, 0.9, 1.0, 1.25, 1.5, 1.75, 2.0];

/// Above so many cells per step errors of compressibility set in: the square of the Mach number is 3 %.
pub const FASTEST: f64 = 0.1;

/// Cells times velocity over viscosity may be so many, as `psmrt check` warns.
const GRID_REYNOLDS: f64 = 10.0;

/// What an engine costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Speed {
    /// `reference` or `wgpu`.
    pub engine: EngineName,
    /// Seconds per cell update, MRT.
    pub mrt: f64,
    /// The same with one relaxation time.
    pub srt: f64,
}

/// One option: settings with which the scene can be computed.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanOption {
    /// Cells along the axes.
    pub cells: [usize; 3],
    /// Edge of a cell, m.
    pub si_dx: f64,
    /// Cells across the smallest grain, or from wall to wall.
    pub resolution: f64,
    /// Relaxation time.
    pub tau: f64,
    /// Collision.
    pub collision: Preset,
    /// How solid cells collide, where there are grains.
    pub solid: SolidMethod,
    /// Engine, with the precision that goes with it.
    pub engine: EngineName,
    /// Largest velocity in cells per step, if it is known.
    pub velocity: Option<f64>,
    /// Steps, at most.
    pub steps: f64,
    /// Predicted relative error.
    pub error: f64,
    /// The band that holds 95 %.
    pub band: [f64; 2],
    /// Predicted seconds, at most.
    pub seconds: f64,
}

/// All options for a scene on these engines.
pub fn options(facts: &Facts, models: &Models, speeds: &[Speed]) -> Vec<PlanOption> {
    let refinements = refinements(facts);
    let mut options = Vec::new();
    for tau in TAUS.into_iter().filter(|&tau| is_heavy_enough(facts, tau)) {
        for collision in Preset::ALL {
            let fastest = fastest(facts, tau, collision);
            for &refinement in &refinements {
                if !is_slow_enough(facts, refinement.1, tau, fastest) {
                    continue;
                }
                for speed in speeds {
                    options.extend(option(facts, models, refinement, (tau, collision), speed));
                }
            }
        }
    }
    options
}

/// Whether no map of stability and no error of compressibility forbids a flow as fast as that of a scene.
fn is_slow_enough(facts: &Facts, si_dx: f64, tau: f64, fastest: f64) -> bool {
    let nu = viscosity(tau);
    // One cell per step, m/s.
    let si_unit = facts.si_viscosity / (nu * si_dx);
    let mapped = facts.mapped.map_or(0.0, |(_, si_velocity)| si_velocity / si_unit);
    let velocity = facts.si_velocity.map(|si_velocity| si_velocity / si_unit);
    // What the body force adds in a step: a dt²/dx.
    let gain = facts.si_acceleration * si_dx / (si_unit * si_unit);
    gain <= FASTEST
        && mapped <= fastest
        && velocity.is_none_or(|u| u <= FASTEST && u / nu <= GRID_REYNOLDS)
}

/// Why there is no option to compute a scene at all.
pub fn why_none(facts: &Facts, models: &Models) -> String {
    if let Some((ratio, _)) = facts.lightest
        && !TAUS.into_iter().any(|tau| is_heavy_enough(facts, tau))
    {
        return format!(
            "a free grain has {ratio:.2} times the density of the fluid, and no grain that light stayed alive \
             and right at any relaxation time (golden/stability/movers.csv; `psmrt check` says what was): make \
             it heavier, or hold it fixed"
        );
    }
    let grids = refinements(facts);
    let resolutions: Vec<f64> =
        grids.iter().map(|(_, si_dx)| facts.limit.cells() * facts.si_dx / si_dx).collect();
    let heavy = Facts { lightest: None, ..facts.clone() };
    let is_known = |&resolution: &f64| {
        Preset::ALL.into_iter().any(|collision| {
            let parameters =
                Parameters { resolution, tau: 0.8, collision, single: false, velocity: Some(0.0) };
            predict(&heavy, models, &parameters).is_ok()
        })
    };
    if !resolutions.iter().any(is_known) {
        let [nx, ny, nz] = facts.cells;
        return format!(
            "no grid that fits the domain of {nx} x {ny} x {nz} cells has as many cells per diameter, or between \
             walls, as the evidence (4 to 23, and 6 and more): choose a box whose sides share a larger divisor"
        );
    }
    format!(
        "at every grid and relaxation time of the evidence the flow is faster than {FASTEST} cells per time step, \
         faster than golden/stability allows, or has structures smaller than a cell: choose a slower flow, or \
         a smaller box"
    )
}

/// How fast the flow that the maps of stability speak of may be, cells per step: what they found to survive
/// and not to be wrong, and no more than errors of compressibility allow. Nothing where nothing was measured.
fn fastest(facts: &Facts, tau: f64, collision: Preset) -> f64 {
    let Some((measured, _)) = facts.mapped else { return FASTEST };
    measured.limit_of(collision, tau).map_or(0.0, |limit| limit.most().min(FASTEST))
}

/// The scene as it is, predicted; if it lies outside the evidence, why.
pub fn as_it_is(
    facts: &Facts,
    models: &Models,
    collision: Preset,
    speed: &Speed,
) -> Result<PlanOption, Outside> {
    option(facts, models, (facts.cells, facts.si_dx), (facts.tau, collision), speed)
}

/// Cells along the axes and edge of a cell, for every grid that fills the domain.
fn refinements(facts: &Facts) -> Vec<([usize; 3], f64)> {
    let full: Vec<usize> = (0..3).filter(|&a| !facts.flat[a]).map(|a| facts.cells[a]).collect();
    let common = full.iter().copied().fold(0, gcd).max(1);
    let most = match facts.limit {
        Limit::Grains { cells, .. } => 40.0 / cells,
        Limit::Plates { cells } | Limit::Shear { cells } | Limit::Duct { cells, .. } => {
            WALL_CELLS[1] / cells
        }
    };
    (1..)
        .map(|parts: usize| (parts, parts as f64 / common as f64))
        .take_while(|(_, finer)| *finer <= most)
        .map(|(parts, finer)| {
            let cells = [0, 1, 2]
                .map(|axis| if facts.flat[axis] { 1 } else { facts.cells[axis] / common * parts });
            (cells, facts.si_dx / finer)
        })
        .collect()
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

fn option(
    facts: &Facts,
    models: &Models,
    (cells, si_dx): ([usize; 3], f64),
    (tau, collision): (f64, Preset),
    speed: &Speed,
) -> Result<PlanOption, Outside> {
    let si_dt = viscosity(tau) * si_dx * si_dx / facts.si_viscosity;
    let velocity = facts.si_velocity.map(|si_velocity| si_velocity * si_dt / si_dx);
    let resolution = facts.limit.cells() * facts.si_dx / si_dx;
    let single = !speed.engine.is_double();
    let predicted =
        predict(facts, models, &Parameters { resolution, tau, collision, single, velocity })?;
    let (error, band) = predicted.size();
    // As many as before where the step is the same, whatever rounding says.
    let steps = (facts.si_time / si_dt * (1.0 - 1e-12)).ceil();
    let cost = if collision == Preset::Srt { speed.srt } else { speed.mrt };
    let count = cells.iter().map(|&n| n as f64).product::<f64>();
    Ok(PlanOption {
        cells,
        si_dx,
        resolution,
        tau,
        collision,
        solid: facts.solid,
        engine: speed.engine,
        velocity,
        steps,
        error,
        band,
        seconds: count * steps * cost,
    })
}

/// The cheapest option whose error stays below `most` with its whole band; of equally cheap ones the most
/// accurate.
pub fn cheapest(options: &[PlanOption], most: f64) -> Option<&PlanOption> {
    let good = options.iter().filter(|option| option.band[1] <= most);
    good.min_by(|a, b| a.seconds.total_cmp(&b.seconds).then(a.error.total_cmp(&b.error)))
}

/// The most accurate option that takes at most `seconds`.
pub fn most_accurate(options: &[PlanOption], seconds: f64) -> Option<&PlanOption> {
    let fast = options.iter().filter(|option| option.seconds <= seconds);
    fast.min_by(|a, b| a.band[1].total_cmp(&b.band[1]).then(a.seconds.total_cmp(&b.seconds)))
}
