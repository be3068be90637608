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

use super::model::{Evidence, Prediction, QUANTILE, SolidMethod, method};
use crate::advice::coefficients::numbers;
use crate::table::TableError;
use psmrt_reference::collision::Preset;

/// The model.
#[derive(Clone, Debug, PartialEq)]
pub struct EpsModel {
    /// `ln a`, `m`, `ln b`, `n`, `q`
    pub parameters: [f64; 5],
    /// What they were fitted to; the scatter is that of the velocity.
    pub evidence: Evidence,
}

/// `ln(1 + error)`
pub fn logarithm(p: &[f64], d: f64, tau: f64, drag: f64) -> f64 {
    let leak = drag.powf(p[1]) * p[0].exp() * (tau - 0.5) / (d * d);
    let shift = drag.powf(p[3]) * p[2].exp() * (tau - 0.5).powf(-p[4]) / d;
    (1.0 + leak).ln() - shift
}

impl EpsModel {
    /// That of `coefficients.csv`.
    pub(super) fn committed() -> Result<Self, TableError> {
        let of = method(Preset::DHumieres, SolidMethod::SolidFraction);
        Ok(EpsModel { parameters: numbers("grains", &of)?, evidence: Evidence::committed(&of)? })
    }

    /// The factor by which the velocity may be larger or smaller.
    pub fn band(&self) -> f64 {
        (QUANTILE * self.evidence.scatter).exp()
    }

    /// Relative error of the velocity under a given force.
    pub fn prediction(&self, d: f64, tau: f64, drag: f64) -> Prediction {
        let velocity = logarithm(&self.parameters, d, tau, drag).exp();
        Prediction {
            error: velocity - 1.0,
            band: [velocity / self.band() - 1.0, velocity * self.band() - 1.0],
            ranges: [self.evidence.ranges[0], self.evidence.ranges[1]],
        }
    }
}
