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

use super::model::{Evidence, GrainModel, LEAST_TAU, Prediction, QUANTILE};
use crate::advice::coefficients::numbers;
use crate::table::TableError;

/// The model.
#[derive(Clone, Debug, PartialEq)]
pub struct LowModel {
    /// `ln b`, `n`, `r`
    pub parameters: [f64; 3],
    /// What they were fitted to; the scatter is that of the velocity, over [`spread`].
    pub evidence: Evidence,
}

/// What its rows of coefficients are called.
pub const LOW: &str = "MRT_dHumieres NT below tau 0.6";

/// What the velocity may be off where nothing is predicted: the place of a grain on the grid, twice that of
/// `LEAST_ERROR`.
const FLOOR: f64 = 0.02;

/// `s`
pub fn shift(p: &[f64], d: f64, tau: f64, drag: f64) -> f64 {
    let root = |tau: f64| 1.0 / (tau - 0.5).sqrt();
    drag.powf(p[1]) * p[0].exp() / d.powf(p[2]) * (root(tau) - root(LEAST_TAU))
}

/// What the logarithm of the velocity scatters with: the error that is partly cancelled.
pub fn spread(above: &GrainModel, d: f64, tau: f64, drag: f64) -> f64 {
    above.error(d, tau, drag).ln_1p() + FLOOR
}

impl LowModel {
    /// That of `coefficients.csv`.
    pub(super) fn committed() -> Result<Self, TableError> {
        Ok(LowModel { parameters: numbers("grains", LOW)?, evidence: Evidence::committed(LOW)? })
    }

    /// Half of the band over `spread`.
    pub fn share(&self) -> f64 {
        QUANTILE * self.evidence.scatter
    }

    /// Relative error of the velocity under a given force.
    pub fn prediction(&self, above: &GrainModel, d: f64, tau: f64, drag: f64) -> Prediction {
        let logarithm = above.error(d, tau, drag).ln_1p() - shift(&self.parameters, d, tau, drag);
        let band = self.share() * spread(above, d, tau, drag);
        Prediction {
            error: logarithm.exp_m1(),
            band: [(logarithm - band).exp_m1(), (logarithm + band).exp_m1()],
            ranges: [
                self.evidence.ranges[0],
                [self.evidence.ranges[1][0], above.evidence.ranges[1][1]],
            ],
        }
    }
}
