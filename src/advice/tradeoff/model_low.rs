//! The error of flows with grains at relaxation times near 1/2, under MRT with d'Humières' rates.
//!
//! What `model.rs` says, and a second error of the other sign: grains are too large by a part of a cell that
//! grows towards τ = 1/2, so that their drag slows the flow. It is nothing at τ = 0.6, where the other model
//! takes over:
//!
//! ```text
//!   1 + error = (1 + e(τ)) exp(-s),   s = K^n b/d^r [(τ - 1/2)^(-1/2) - 0.1^(-1/2)]
//! ```
//!
//! with `e` the model of larger relaxation times, its numbers unchanged. The two cancel near τ = 0.51 in dense
//! beds of 8 to 12 cells, so that the band is one of the velocity, `1 + error`; it widens with `e`.

use super::evidence::{GrainPoint, LEAST_TAU};
use super::fit::{Fit, least_squares};
use super::model::{GrainModel, Prediction, QUANTILE, ranges, unseen};

/// The model and what it leaves.
#[derive(Clone, Debug, PartialEq)]
pub struct LowModel {
    /// `ln b`, `n`, `r`, and what they leave.
    pub fit: Fit,
    /// Scatter of the logarithm of the velocity in geometries left out of the fit, over `spread`.
    pub scatter: f64,
    /// Number of runs, and of geometries.
    pub counts: [usize; 2],
    /// Smallest and largest cells per diameter, relaxation time and drag among them.
    pub ranges: [[f64; 2]; 3],
}

/// Where the search starts: a thirtieth at 8 cells and a drag of 100.
const START: [f64; 3] = [-1.5, 0.5, 2.0];

/// What the velocity may be off where nothing is predicted: the place of a grain on the grid, twice that of
/// `LEAST_ERROR`.
const FLOOR: f64 = 0.02;

fn shift(p: &[f64], d: f64, tau: f64, drag: f64) -> f64 {
    let root = |tau: f64| 1.0 / (tau - 0.5).sqrt();
    drag.powf(p[1]) * p[0].exp() / d.powf(p[2]) * (root(tau) - root(LEAST_TAU))
}

/// What the logarithm of the velocity scatters with: the error that is partly cancelled.
fn spread(above: &GrainModel, d: f64, tau: f64, drag: f64) -> f64 {
    above.error(d, tau, drag).ln_1p() + FLOOR
}

fn residual(above: &GrainModel, p: &[f64], point: &GrainPoint) -> f64 {
    let (d, tau, drag) = (point.cells, point.tau, point.drag);
    let logarithm = above.error(d, tau, drag).ln_1p() - shift(p, d, tau, drag);
    (logarithm - point.error.ln_1p()) / spread(above, d, tau, drag)
}

impl LowModel {
    /// Fits the points to what `above` leaves of them. `None` if there are too few, or of fewer than three
    /// geometries.
    pub fn fit(above: &GrainModel, points: &[GrainPoint]) -> Option<Self> {
        let own: Vec<&GrainPoint> = points.iter().collect();
        let through = |points: &[&GrainPoint]| {
            least_squares(&START, |p| points.iter().map(|one| residual(above, p, one)).collect())
        };
        let (scatter, geometries) = unseen(&own, through, |p, point| residual(above, p, point))?;
        let counts = [own.len(), geometries];
        Some(LowModel { fit: through(&own)?, scatter, counts, ranges: ranges(&own) })
    }

    /// Half of the band over `spread`.
    pub fn share(&self) -> f64 {
        QUANTILE * self.scatter
    }

    /// Relative error of the velocity under a given force.
    pub fn prediction(&self, above: &GrainModel, d: f64, tau: f64, drag: f64) -> Prediction {
        let logarithm =
            above.error(d, tau, drag).ln_1p() - shift(&self.fit.parameters, d, tau, drag);
        let band = self.share() * spread(above, d, tau, drag);
        Prediction {
            error: logarithm.exp_m1(),
            band: [(logarithm - band).exp_m1(), (logarithm + band).exp_m1()],
            ranges: [self.ranges[0], [self.ranges[1][0], above.ranges[1][1]]],
        }
    }
}
