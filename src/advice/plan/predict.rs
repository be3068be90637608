//! The error of a scene at some grid, relaxation time and collision, by the fitted models: what `psmrt plan`
//! plans by and `psmrt check` warns by.

use super::facts::{Facts, Limit};
use crate::advice::stability::limits;
use crate::advice::tradeoff::models::Models;
use psmrt_reference::collision::Preset;

/// Between walls the evidence reaches from 6 to 32 cells; finer grids follow the closed form.
pub(super) const WALL_CELLS: [f64; 2] = [6.0, 256.0];

/// What single precision adds between plates (golden/tradeoff/sweep.csv, magic rates, the largest).
const WALL_ROUNDING: f64 = 1e-4;

/// What is left of a profile that is exact but for rounding, in double precision, and for when it counts as steady.
const ROUND_OFF: f64 = 1e-7;

/// The error of a Couette flow with d'Humières' rates over the square of the wall's velocity: 0.001 to 0.015 at tau of
/// 0.55 to 1.5 (reference/ERRATA.md, `tests/oracle/couette.rs`). With one rate and with magic rates it is exact.
const SHEAR: f64 = 0.015;

/// How a scene is computed, as far as its error depends on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Cells across the smallest grain, or from wall to wall.
    pub resolution: f64,
    /// Relaxation time.
    pub tau: f64,
    /// Collision of the fluid.
    pub collision: Preset,
    /// Whether in single precision.
    pub single: bool,
    /// Largest velocity in cells per step, if it is known.
    pub velocity: Option<f64>,
}

/// A predicted error, positive where the flow is too fast or a grain settles too fast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Predicted {
    /// The relative error.
    pub error: f64,
    /// What 95 % lie between.
    pub band: [f64; 2],
}

impl Predicted {
    /// The same without the sign.
    pub fn size(&self) -> (f64, [f64; 2]) {
        let [low, high] = self.band;
        // An error that may have either sign may be nothing.
        let least = if low * high < 0.0 { 0.0 } else { low.abs().min(high.abs()) };
        (self.error.abs(), [least, low.abs().max(high.abs())])
    }
}

/// Why nothing is predicted.
#[derive(Clone, Debug, PartialEq)]
pub struct Outside {
    /// Which parameter lies outside the evidence, and what the evidence has.
    pub why: String,
    /// What the models say at the nearest point of the evidence, if it is a grid or a relaxation time that
    /// lies outside.
    pub nearest: Option<Predicted>,
    /// Whether the error may be larger than there: not on finer grids.
    pub may_be_worse: bool,
}

impl Outside {
    fn method(why: impl Into<String>) -> Self {
        Outside { why: why.into(), nearest: None, may_be_worse: true }
    }
}

/// What is predicted; if that lies outside the evidence, why.
pub fn predict(
    facts: &Facts,
    models: &Models,
    parameters: &Parameters,
) -> Result<Predicted, Outside> {
    let Parameters { resolution, tau, collision, single, velocity } = *parameters;
    if let Some((ratio, _)) = facts.lightest.filter(|_| !is_heavy_enough(facts, tau)) {
        return Err(Outside::method(format!(
            "a free grain of {ratio:.2} times the density of the fluid does not stay alive and right at tau = {} \
             (golden/stability/movers.csv)",
            figure(tau)
        )));
    }
    let rounding = if single { WALL_ROUNDING } else { 0.0 };
    match &facts.limit {
        Limit::Grains { drag, .. } => {
            let method = (collision, facts.solid);
            let Some(found) = models.with_grains(method, resolution, tau, *drag) else {
                return Err(Outside::method(format!(
                    "no run of the evidence has {} with this weight and operator of solid cells",
                    collision.title()
                )));
            };
            let [cells, taus] = found.ranges;
            let ranges = [
                (format!("{} cells across the smallest grain", figure(resolution)), cells),
                (format!("tau = {}", figure(tau)), taus),
            ];
            let out = [resolution, tau].into_iter().zip(ranges);
            let out: Vec<(f64, String, [f64; 2])> = out
                .filter(|(value, (_, range))| !is_within(*value, *range))
                .map(|(value, (words, range))| (value, words, range))
                .collect();
            if out.is_empty() {
                return Ok(Predicted { error: found.error, band: found.band });
            }
            let near = models.with_grains(
                method,
                resolution.clamp(cells[0], cells[1]),
                tau.clamp(taus[0], taus[1]),
                *drag,
            );
            let words = out.iter().map(|(_, words, [low, high])| {
                format!("{words} is outside the evidence ({} to {})", figure(*low), figure(*high))
            });
            Err(Outside {
                why: words.collect::<Vec<_>>().join(", and "),
                nearest: near.map(|near| Predicted { error: near.error, band: near.band }),
                may_be_worse: out
                    .iter()
                    .any(|(value, _, range)| *range != cells || *value < range[0]),
            })
        }
        Limit::Plates { .. } => {
            among_walls("from wall to wall", resolution)?;
            let (error, factor) = match (collision, models.of_walls(collision)) {
                // The walls are right.
                (Preset::Trt, _) => (ROUND_OFF, 1.0),
                (_, Some(model)) => {
                    (model.error(resolution, tau, velocity.unwrap_or(0.0)), model.band())
                }
                (_, None) => return Err(Outside::method("there is no model of its collision")),
            };
            Ok(Predicted { error, band: [error / factor, error * factor + rounding] })
        }
        Limit::Shear { .. } => {
            among_walls("from wall to wall", resolution)?;
            let square = match collision {
                Preset::DHumieres => SHEAR * velocity.unwrap_or(0.0).powi(2),
                Preset::Srt | Preset::Trt => 0.0,
            };
            let most = ROUND_OFF + 2.0 * square + rounding;
            Ok(Predicted { error: ROUND_OFF + square, band: [ROUND_OFF, most] })
        }
        Limit::Duct { duct, .. } => {
            among_walls("across the duct", resolution)?;
            let collision =
                collision.collision(tau).map_err(|error| Outside::method(error.to_string()))?;
            let (error, [low, high]) = duct.error(&collision, resolution);
            Ok(Predicted { error, band: [low - rounding, high + rounding] })
        }
    }
}

/// Whether free grains as light as those of a scene stayed alive and right at a relaxation time.
pub(super) fn is_heavy_enough(facts: &Facts, tau: f64) -> bool {
    facts.lightest.is_none_or(|(ratio, inside)| {
        limits::lightest(inside, tau).is_some_and(|limit| ratio >= limit)
    })
}

/// Whether a value lies in a range: diameters and relaxation times have been computed from other numbers.
fn is_within(value: f64, [low, high]: [f64; 2]) -> bool {
    (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(&value)
}

/// An error if the evidence has no such grid between walls.
fn among_walls(what: &str, resolution: f64) -> Result<(), Outside> {
    if is_within(resolution, WALL_CELLS) {
        return Ok(());
    }
    let [low, high] = WALL_CELLS;
    Err(Outside {
        why: format!("{resolution} cells {what} is outside the evidence ({low} to {high})"),
        nearest: None,
        may_be_worse: resolution < low,
    })
}

/// Four digits, without zeros at the end.
fn figure(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Two digits that count.
pub fn percent(value: f64) -> String {
    match 100.0 * value {
        percent if percent < 0.0 => format!("-{}", self::percent(-value)),
        percent if percent < 0.001 => "< 0.001 %".to_owned(),
        percent if percent < 0.0995 => format!("{percent:.3} %"),
        percent if percent < 0.995 => format!("{percent:.2} %"),
        percent if percent < 9.95 => format!("{percent:.1} %"),
        percent => format!("{percent:.0} %"),
    }
}
