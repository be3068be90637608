//! All ways to compute a scene that lie within the evidence, and which of them is best.

use psmrt_reference::lattice::viscosity;

use super::facts::{Facts, Limit};
use crate::stability::Model;
use crate::tradeoff::knobs::CollisionKnob;
use crate::tradeoff::model::Models;

/// Relaxation times that are tried.
const TAUS: [f64; 10] = [0.6, 0.65, 0.7, 0.8, 0.9, 1.0, 1.25, 1.5, 1.75, 2.0];

/// Above so many cells per step errors of compressibility set in: the square of the Mach number is 3 %.
pub const FASTEST: f64 = 0.1;

/// Cells times velocity over viscosity may be so many, as `psmrt check` warns.
const GRID_REYNOLDS: f64 = 10.0;

/// Between plates the evidence reaches from 6 to 32 cells; finer grids follow the closed form.
const PLATE_CELLS: [f64; 2] = [6.0, 256.0];

/// What single precision adds between plates (golden/tradeoff/sweep.csv, magic rates, the largest).
const PLATE_ROUNDING: f64 = 1e-4;

/// What an engine costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Speed {
    /// `reference` or `wgpu`.
    pub engine: String,
    /// Seconds per cell update, MRT.
    pub mrt: f64,
    /// The same with one relaxation time.
    pub srt: f64,
}

/// One way to compute the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    /// Cells along the axes.
    pub cells: [usize; 3],
    /// Edge of a cell, m.
    pub si_dx: f64,
    /// Cells across the smallest grain, or from wall to wall.
    pub resolution: f64,
    /// Relaxation time.
    pub tau: f64,
    /// Collision.
    pub collision: CollisionKnob,
    /// Engine, with the precision that goes with it.
    pub engine: String,
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

/// All ways for a scene on these engines.
pub fn ways(facts: &Facts, models: &Models, speeds: &[Speed]) -> Vec<Way> {
    let refinements = refinements(facts);
    let mut ways = Vec::new();
    for tau in TAUS {
        for collision in CollisionKnob::ALL {
            let fastest = fastest(facts, tau, collision);
            for &refinement in &refinements {
                for speed in speeds {
                    let knobs = (tau, collision, fastest);
                    ways.extend(way(facts, models, refinement, knobs, speed));
                }
            }
        }
    }
    ways
}

/// How fast the flow that the maps of stability speak of may be, cells per step: what they found to survive
/// and not to be wrong, and no more than errors of compressibility allow. Nothing where nothing was measured.
fn fastest(facts: &Facts, tau: f64, collision: CollisionKnob) -> f64 {
    let Some((measured, _)) = facts.mapped else { return FASTEST };
    let model = match collision {
        CollisionKnob::Srt => Model::Srt,
        CollisionKnob::Dhumieres => Model::DHumieres,
        CollisionKnob::Magic => Model::Magic,
    };
    measured.limit_of(model, tau).map_or(0.0, |limit| limit.most().min(FASTEST))
}

/// The scene as it is, predicted; `None` if it lies outside the evidence.
pub fn as_it_is(
    facts: &Facts,
    models: &Models,
    collision: CollisionKnob,
    speed: &Speed,
) -> Option<Way> {
    let knobs = (facts.tau, collision, fastest(facts, facts.tau, collision));
    way(facts, models, (facts.cells, facts.si_dx), knobs, speed)
}

/// Cells along the axes and edge of a cell, for every grid that fills the box.
fn refinements(facts: &Facts) -> Vec<([usize; 3], f64)> {
    let full: Vec<usize> = (0..3).filter(|&a| !facts.flat[a]).map(|a| facts.cells[a]).collect();
    let common = full.iter().copied().fold(0, gcd).max(1);
    let most = match facts.limit {
        Limit::Grains { cells, .. } => 40.0 / cells,
        Limit::Plates { cells } => PLATE_CELLS[1] / cells,
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

fn way(
    facts: &Facts,
    models: &Models,
    (cells, si_dx): ([usize; 3], f64),
    (tau, collision, fastest): (f64, CollisionKnob, f64),
    speed: &Speed,
) -> Option<Way> {
    let nu = viscosity(tau);
    let si_dt = nu * si_dx * si_dx / facts.si_viscosity;
    let velocity = facts.si_velocity.map(|si_velocity| si_velocity * si_dt / si_dx);
    let mapped = facts.mapped.map_or(0.0, |(_, si_velocity)| si_velocity * si_dt / si_dx);
    if mapped > fastest || velocity.is_some_and(|u| u > FASTEST || u / nu > GRID_REYNOLDS) {
        return None;
    }
    let finer = facts.si_dx / si_dx;
    let (resolution, error, band) = match facts.limit {
        Limit::Grains { cells, drag, .. } => {
            let within = |[low, high]: [f64; 2], value: f64| (low..=high).contains(&value);
            let d = cells * finer;
            let found = models.with_grains((collision, facts.solid), d, tau, drag)?;
            if !within(found.ranges[0], d) || !within(found.ranges[1], tau) {
                return None;
            }
            let [low, high] = found.band;
            // An error that may have either sign may be nothing.
            let least = if low * high < 0.0 { 0.0 } else { low.abs().min(high.abs()) };
            (d, found.error.abs(), [least, low.abs().max(high.abs())])
        }
        Limit::Plates { cells } => {
            let h = cells * finer;
            if !(PLATE_CELLS[0]..=PLATE_CELLS[1]).contains(&h) {
                return None;
            }
            let (error, band) = match (collision, models.of_walls(collision)) {
                // The walls are right: only rounding is left.
                (CollisionKnob::Magic, _) => (1e-7, 1.0),
                (_, model) => {
                    let model = model?;
                    (model.error(h, tau, velocity.unwrap_or(0.0)), model.band())
                }
            };
            let rounding = if speed.engine == "wgpu" { PLATE_ROUNDING } else { 0.0 };
            (h, error, [error / band, error * band + rounding])
        }
    };
    let steps = (facts.si_time / si_dt).ceil();
    let cost = if collision == CollisionKnob::Srt { speed.srt } else { speed.mrt };
    let count = cells.iter().map(|&n| n as f64).product::<f64>();
    Some(Way {
        cells,
        si_dx,
        resolution,
        tau,
        collision,
        engine: speed.engine.clone(),
        velocity,
        steps,
        error,
        band,
        seconds: count * steps * cost,
    })
}

/// The cheapest way whose error stays below `most` with its whole band; of equally cheap ones the most
/// accurate.
pub fn cheapest(ways: &[Way], most: f64) -> Option<&Way> {
    let good = ways.iter().filter(|way| way.band[1] <= most);
    good.min_by(|a, b| a.seconds.total_cmp(&b.seconds).then(a.error.total_cmp(&b.error)))
}

/// The most accurate way that takes at most `seconds`.
pub fn most_accurate(ways: &[Way], seconds: f64) -> Option<&Way> {
    let fast = ways.iter().filter(|way| way.seconds <= seconds);
    fast.min_by(|a, b| a.band[1].total_cmp(&b.band[1]).then(a.seconds.total_cmp(&b.seconds)))
}
