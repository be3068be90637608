//! The error of flows with grains and the weight `B = ε`, under MRT with d'Humières' rates.
//!
//! Two errors of opposite sign add up. Grains leak, as with Noble and Torczynski's weight; and they are too
//! large, by a part of a cell that grows towards τ = 1/2, so that more drag slows the flow. The first falls as
//! `d²`, the second as `d`:
//!
//! ```text
//!   1 + error = (1 + K^m a (τ - 1/2)/d²) exp(-K^n b (τ - 1/2)^-q/d)
//! ```
//!
//! Where they cancel the error itself says nothing, so the band is one of the velocity, `1 + error`: a factor
//! either way. In dense beds the form is crude, and the band is too wide to plan by. That is a result: there is
//! no saying how far off `B = ε` is without a run with another weight.

use super::evidence::{GrainPoint, SolidMethod};
use super::fit::{Fit, least_squares};
use super::model::{Prediction, QUANTILE, ranges, unseen};
use psmrt_reference::collision::Preset;

/// The model and what it leaves.
#[derive(Clone, Debug, PartialEq)]
pub struct EpsModel {
    /// `ln a`, `m`, `ln b`, `n`, `q`, and what they leave.
    pub fit: Fit,
    /// Scatter of the logarithm of the velocity in geometries left out of the fit.
    pub scatter: f64,
    /// Number of runs, and of geometries.
    pub counts: [usize; 2],
    /// Smallest and largest cells per diameter, relaxation time and drag among them.
    pub ranges: [[f64; 2]; 3],
}

/// Where the search starts: the leak as with the other weight, a shift of half a cell at τ = 1.
const START: [f64; 5] = [1.4, 0.8, -0.7, 0.3, 0.5];

/// `ln(1 + error)`
fn logarithm(p: &[f64], d: f64, tau: f64, drag: f64) -> f64 {
    let leak = drag.powf(p[1]) * p[0].exp() * (tau - 0.5) / (d * d);
    let shift = drag.powf(p[3]) * p[2].exp() * (tau - 0.5).powf(-p[4]) / d;
    (1.0 + leak).ln() - shift
}

fn residual(p: &[f64], point: &GrainPoint) -> f64 {
    logarithm(p, point.cells, point.tau, point.drag) - (1.0 + point.error).ln()
}

fn through(points: &[&GrainPoint]) -> Option<Fit> {
    least_squares(&START, |p| points.iter().map(|point| residual(p, point)).collect())
}

impl EpsModel {
    /// Fits the points with this weight. `None` if there are too few, or of fewer than three geometries.
    pub fn fit(points: &[GrainPoint]) -> Option<Self> {
        let own = |point: &&GrainPoint| {
            point.collision == Preset::DHumieres && point.solid == SolidMethod::SolidFraction
        };
        let own: Vec<&GrainPoint> = points.iter().filter(own).collect();
        let (scatter, geometries) = unseen(&own, through, residual)?;
        let counts = [own.len(), geometries];
        Some(EpsModel { fit: through(&own)?, scatter, counts, ranges: ranges(&own) })
    }

    /// The factor by which the velocity may be larger or smaller.
    pub fn band(&self) -> f64 {
        (QUANTILE * self.scatter).exp()
    }

    /// Relative error of the velocity under a given force.
    pub fn prediction(&self, d: f64, tau: f64, drag: f64) -> Prediction {
        let velocity = logarithm(&self.fit.parameters, d, tau, drag).exp();
        Prediction {
            error: velocity - 1.0,
            band: [velocity / self.band() - 1.0, velocity * self.band() - 1.0],
            ranges: [self.ranges[0], self.ranges[1]],
        }
    }
}
