//! The error of flows with grains whose operator lets no fluid through: graded viscosity, and full bounce-back (SC3).
//!
//! Two errors of opposite sign add up. Cut cells smooth the surface of a grain over the width of a cell, which lets more
//! fluid past, to second order in the cell; and grains are too large by a part of a cell, to first order:
//!
//! ```text
//!   ln(1 + error) = K^m [b (τ - 1/2)^r + a (τ - 1/2)²]/d² - K^n c/d
//! ```
//!
//! Graded viscosity hardly depends on `τ` (`r` is small), full bounce-back does. `a` is for SRT alone: in the fluid beside a
//! grain the place of its surface goes with the product of `1/s - 1/2` of even and odd moments, which with SRT is
//! `(τ - 1/2)²`, and with the other rates grows no faster than `τ - 1/2`.
//!
//! Where the two cancel the error itself says nothing, so the band is one of the velocity, `1 + error`, and widens with the
//! first of them. Errors below [`LEAST_ERROR`] are not told from each other: the place of a grain on the grid does as much.

use super::model::{Evidence, LEAST_ERROR, Prediction, QUANTILE, SolidMethod, method};
use crate::advice::coefficients::numbers;
use crate::table::TableError;
use psmrt_reference::collision::Preset;

/// The combinations that have such a model.
pub const TIGHT: [(Preset, SolidMethod); 4] = [
    (Preset::Srt, SolidMethod::Graded),
    (Preset::DHumieres, SolidMethod::Graded),
    (Preset::Trt, SolidMethod::Graded),
    (Preset::DHumieres, SolidMethod::FullBounceBack),
];

/// The model.
#[derive(Clone, Debug, PartialEq)]
pub struct TightModel {
    /// Collision of the fluid.
    pub collision: Preset,
    /// How solid cells collide.
    pub solid: SolidMethod,
    /// `ln b`, `m`, `ln c`, `n`, and `r`; with SRT `ln a` instead of `r`, which is nothing there.
    pub parameters: [f64; 5],
    /// What they were fitted to; the scatter is that of the logarithm of the velocity, over [`spread`].
    pub evidence: Evidence,
}

/// `K^m [b (τ - 1/2)^r + a (τ - 1/2)²]/d²`
fn smoothed(collision: Preset, p: &[f64], d: f64, tau: f64, drag: f64) -> f64 {
    let excess = tau - 0.5;
    let size = match collision {
        Preset::Srt => p[0].exp() + p[4].exp() * excess * excess,
        Preset::DHumieres | Preset::Trt => p[0].exp() * excess.powf(p[4]),
    };
    drag.powf(p[1]) * size / (d * d)
}

/// `ln(1 + error)`
pub fn logarithm(collision: Preset, p: &[f64], d: f64, tau: f64, drag: f64) -> f64 {
    // K^n c/d
    let too_large = drag.powf(p[3]) * p[2].exp() / d;
    smoothed(collision, p, d, tau, drag) - too_large
}

/// What that scatters with: the larger error, which is cancelled in part, and what the place of a grain on the grid does.
pub fn spread(collision: Preset, p: &[f64], d: f64, tau: f64, drag: f64) -> f64 {
    smoothed(collision, p, d, tau, drag) + LEAST_ERROR
}

impl TightModel {
    /// That of `coefficients.csv`.
    pub(super) fn committed(collision: Preset, solid: SolidMethod) -> Result<Self, TableError> {
        let of = method(collision, solid);
        let (parameters, evidence) = (numbers("grains", &of)?, Evidence::committed(&of)?);
        Ok(TightModel { collision, solid, parameters, evidence })
    }

    /// Half of the band over `spread`.
    pub fn share(&self) -> f64 {
        QUANTILE * self.evidence.scatter
    }

    /// Relative error of the velocity under a given force. One that is below the least that is told is that, and its band
    /// holds all that are.
    pub fn prediction(&self, d: f64, tau: f64, drag: f64) -> Prediction {
        let p = &self.parameters;
        let logarithm = logarithm(self.collision, p, d, tau, drag);
        let half = self.share() * spread(self.collision, p, d, tau, drag);
        let error = logarithm.exp_m1();
        let [low, high] = [logarithm - half, logarithm + half].map(f64::exp_m1);
        let (error, band) = if error.abs() < LEAST_ERROR {
            (LEAST_ERROR.copysign(error), [low.min(-LEAST_ERROR), high.max(LEAST_ERROR)])
        } else {
            (error, [low, high])
        };
        let [cells, taus, _] = self.evidence.ranges;
        Prediction { error, band, ranges: [cells, taus] }
    }
}
