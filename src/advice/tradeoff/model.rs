//! Error models: what the physics says with free numbers, fitted to the evidence, with bands.
//!
//! **Grains.** Each full cell lets a flux through in proportion to the pressure gradient
//! (`tests/oracle/leakage.rs`): a body of permeability ν/2. The velocity under a given force is therefore too
//! large by a share that falls as `d²`, grows with `τ - 1/2` and with the drag `K` over Stokes' drag. What
//! remains comes from cells that are covered in part, and falls faster:
//!
//! ```text
//!   error = K^m [a (τ - 1/2)/d² + b/d^p]
//! ```
//!
//! The superposition operator has its own numbers in the same form. The weight `B = ε` errs in two ways of
//! opposite sign (`model_eps.rs`).
//!
//! **Plates.** Half-way bounce-back slips by an amount that is known in closed form; the rest is of second
//! order in the lattice velocity (d'Humières' rates treat the third-order moments as if the flow stood
//! still):
//!
//! ```text
//!   error = s |16 L - 3|/(3 H²)/sqrt(8/15) + c u²,   L = (τ - 1/2)[(1/s_q - 1/2) + 3 (1/s_m - 1/2)]/4
//! ```
//!
//! Bands hold 95 % of what is to be expected: 1.96 times the scatter of the logarithms, where the scatter is
//! that of geometries that the model has not seen (each is left out in turn).

use std::sync::OnceLock;

use psmrt_reference::collision::{Collision, Preset};
use psmrt_reference::rates::Rates;

use super::evidence::{
    GrainPoint, LEAST_TAU, SolidMethod, WallPoint, committed_sweep, grain_points, wall_points,
};
use super::evidence_low::low_points;
use super::fit::{Fit, least_squares, rms};
use super::model_eps::EpsModel;
use super::model_low::LowModel;
use crate::exact::magic_parameter;
use crate::table::TableError;

/// Below this the models say nothing: errors are then as large as what the place of a grain on the grid
/// does (0.3 %), and may have either sign.
pub const LEAST_ERROR: f64 = 0.01;

/// Quantile of the normal distribution that leaves 2.5 % at either end.
pub(super) const QUANTILE: f64 = 1.96;

/// The error of flows with grains, for one collision of the fluid and of solid cells.
#[derive(Clone, Debug, PartialEq)]
pub struct GrainModel {
    /// The collision.
    pub collision: Preset,
    /// How solid cells collide.
    pub solid: SolidMethod,
    /// `ln a`, `ln b`, `m`, `p`, and what they leave.
    pub fit: Fit,
    /// Scatter of the logarithm of the error in geometries left out of the fit.
    pub scatter: f64,
    /// Number of runs, and of geometries.
    pub counts: [usize; 2],
    /// Smallest and largest cells per diameter, relaxation time and drag among them.
    pub ranges: [[f64; 2]; 3],
}

/// `error = K^m [a (τ - 1/2)/d² + b/d^p]`
fn grain_error(parameters: &[f64], d: f64, tau: f64, drag: f64) -> f64 {
    let [a, b, m, p] = [parameters[0].exp(), parameters[1].exp(), parameters[2], parameters[3]];
    drag.powf(m) * (a * (tau - 0.5) / (d * d) + b / d.powf(p))
}

/// Where the search starts: the leak of an isolated sphere, and a remainder of third order.
const START: [f64; 4] = [1.1, 1.0, 0.8, 3.0];

impl GrainModel {
    /// Fits the points of a collision whose error is large enough to be of one sign. `None` if there are
    /// too few, or of fewer than three geometries.
    pub fn fit(collision: Preset, solid: SolidMethod, points: &[GrainPoint]) -> Option<Self> {
        let own = |point: &&GrainPoint| {
            point.collision == collision && point.solid == solid && point.error > LEAST_ERROR
        };
        let own: Vec<&GrainPoint> = points.iter().filter(own).collect();
        let fit = Self::through(&own)?;
        let (scatter, geometries) = unseen(&own, Self::through, residual)?;
        let counts = [own.len(), geometries];
        Some(GrainModel { collision, solid, fit, scatter, counts, ranges: ranges(&own) })
    }

    fn through(points: &[&GrainPoint]) -> Option<Fit> {
        least_squares(&START, |p| points.iter().map(|point| residual(p, point)).collect())
    }

    /// Relative error of the velocity under a given force.
    pub fn error(&self, d: f64, tau: f64, drag: f64) -> f64 {
        grain_error(&self.fit.parameters, d, tau, drag)
    }

    /// The factor by which the measured error may be larger or smaller.
    pub fn band(&self) -> f64 {
        (QUANTILE * self.scatter).exp()
    }
}

/// Scatter of what fits leave of geometries that were left out of them, each in turn, and the number of
/// geometries. `None` if there are fewer than three.
pub(super) fn unseen(
    own: &[&GrainPoint],
    through: impl Fn(&[&GrainPoint]) -> Option<Fit>,
    residual: impl Fn(&[f64], &GrainPoint) -> f64,
) -> Option<(f64, usize)> {
    let mut geometries: Vec<&str> = own.iter().map(|point| &*point.geometry).collect();
    geometries.sort_unstable();
    geometries.dedup();
    if geometries.len() < 3 {
        return None;
    }
    let mut left = Vec::new();
    for left_out in &geometries {
        let (out, others): (Vec<_>, Vec<_>) =
            own.iter().partition(|point| point.geometry == *left_out);
        let fit = through(&others)?;
        left.extend(out.iter().map(|point| residual(&fit.parameters, point)));
    }
    Some((rms(&left), geometries.len()))
}

/// Smallest and largest cells per diameter, relaxation time and drag.
pub(super) fn ranges(own: &[&GrainPoint]) -> [[f64; 2]; 3] {
    let range = |value: fn(&GrainPoint) -> f64| {
        own.iter().fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], point| {
            [low.min(value(point)), high.max(value(point))]
        })
    };
    [range(|p| p.cells), range(|p| p.tau), range(|p| p.drag)]
}

fn residual(parameters: &[f64], point: &GrainPoint) -> f64 {
    (grain_error(parameters, point.cells, point.tau, point.drag) / point.error).ln()
}

/// The error between plates, for one collision.
#[derive(Clone, Debug, PartialEq)]
pub struct WallModel {
    /// The collision.
    pub collision: Preset,
    /// `s` and `c`, and what they leave.
    pub fit: Fit,
    /// Number of runs.
    pub count: usize,
}

/// Relative L2 error that the known slip of the wall makes, `h` cells from plate to plate.
pub fn slip_error(collision: Preset, tau: f64, h: f64) -> f64 {
    // Slip over the largest velocity: (G/(24 ν))/(G H²/(8 ν)) (16 L - 3).
    let slip = (16.0 * parameter(collision, tau) - 3.0).abs() / (3.0 * h * h);
    // Mean square of the parabola 1 - ξ² at the middles of h cells: 8/15 + 7/(15 h⁴).
    slip / (8.0 / 15.0 + 7.0 / (15.0 * h.powi(4))).sqrt()
}

/// `L` of a collision.
pub fn parameter(collision: Preset, tau: f64) -> f64 {
    match collision {
        Preset::Srt => magic_parameter(&Collision::Srt { tau }),
        Preset::DHumieres => Rates::dhumieres(tau)
            .map_or(f64::NAN, |rates| magic_parameter(&Collision::Mrt { rates })),
        Preset::Trt => 3.0 / 16.0,
    }
}

impl WallModel {
    /// Fits the points of a collision whose error is more than rounding. `None` if there are too few.
    pub fn fit(collision: Preset, points: &[WallPoint]) -> Option<Self> {
        let own = |point: &&WallPoint| point.collision == collision && point.error > 1e-4;
        let own: Vec<&WallPoint> = points.iter().filter(own).collect();
        let model = |p: &[f64], point: &WallPoint| {
            let slip = slip_error(collision, point.tau, point.cells);
            p[0] * slip + p[1] * point.velocity * point.velocity
        };
        let residuals = |p: &[f64]| {
            own.iter().map(|point| (model(p, point) / point.error).ln()).collect::<Vec<_>>()
        };
        let fit = least_squares(&[1.0, 0.0], residuals)?;
        Some(WallModel { collision, fit, count: own.len() })
    }

    /// Relative L2 error of the profile, `h` cells from plate to plate, `velocity` cells per step.
    pub fn error(&self, h: f64, tau: f64, velocity: f64) -> f64 {
        let [s, c] = [self.fit.parameters[0], self.fit.parameters[1]];
        s * slip_error(self.collision, tau, h) + c * velocity * velocity
    }

    /// The factor by which the measured error may be larger or smaller: a closed form leaves next to no
    /// scatter, but the flows are steady to a share of 1e-8 a row only, and the error may be 1e-4.
    pub fn band(&self) -> f64 {
        (QUANTILE * self.fit.scale).exp().max(NARROWEST)
    }
}

/// The narrowest band between plates.
const NARROWEST: f64 = 1.02;

/// A predicted error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// The error, signed.
    pub error: f64,
    /// What 95 % lie between.
    pub band: [f64; 2],
    /// Cells per diameter and relaxation times that the evidence has.
    pub ranges: [[f64; 2]; 2],
}

/// All models that the evidence supports.
#[derive(Clone, Debug, PartialEq)]
pub struct Models {
    /// With grains, one a collision, and one with the superposition operator.
    pub grains: Vec<GrainModel>,
    /// With grains and the weight `B = ε`.
    pub eps: Option<EpsModel>,
    /// With grains, d'Humières' rates and relaxation times below those of `grains`.
    pub low: Option<LowModel>,
    /// Between plates; none for the magic rates, which are exact there.
    pub walls: Vec<WallModel>,
}

impl Models {
    /// Fitted to these points.
    pub fn fit(grains: &[GrainPoint], walls: &[WallPoint]) -> Self {
        let all = Preset::ALL;
        let methods = all
            .map(|parameter| (parameter, SolidMethod::Usual))
            .into_iter()
            .chain([(Preset::DHumieres, SolidMethod::Superposition)]);
        Models {
            grains: methods
                .filter_map(|(parameter, solid)| GrainModel::fit(parameter, solid, grains))
                .collect(),
            eps: EpsModel::fit(grains),
            low: None,
            walls: all.iter().filter_map(|&parameter| WallModel::fit(parameter, walls)).collect(),
        }
    }

    /// Fitted to all that is committed, once.
    pub fn committed() -> Result<&'static Self, TableError> {
        static MODELS: OnceLock<Models> = OnceLock::new();
        if let Some(models) = MODELS.get() {
            return Ok(models);
        }
        let sweep = committed_sweep()?;
        let mut models = Models::fit(&grain_points(&sweep)?, &wall_points(&sweep));
        let low = low_points(&sweep)?;
        let above = models.of_grains(Preset::DHumieres, SolidMethod::Usual);
        models.low = above.and_then(|above| LowModel::fit(above, &low));
        Ok(MODELS.get_or_init(|| models))
    }

    /// The model with grains of a collision of the fluid and of solid cells.
    pub fn of_grains(&self, collision: Preset, solid: SolidMethod) -> Option<&GrainModel> {
        self.grains.iter().find(|model| model.collision == collision && model.solid == solid)
    }

    /// The error with grains; `None` where nothing was fitted.
    pub fn with_grains(
        &self,
        (collision, solid): (Preset, SolidMethod),
        d: f64,
        tau: f64,
        drag: f64,
    ) -> Option<Prediction> {
        if solid == SolidMethod::SolidFraction {
            let model = self.eps.as_ref().filter(|_| collision == Preset::DHumieres)?;
            return Some(model.prediction(d, tau, drag));
        }
        let model = self.of_grains(collision, solid)?;
        let low = self
            .low
            .as_ref()
            .filter(|_| collision == Preset::DHumieres && solid == SolidMethod::Usual);
        if let Some(low) = low.filter(|_| tau < LEAST_TAU) {
            return Some(low.prediction(model, d, tau, drag));
        }
        let error = model.error(d, tau, drag);
        let band = [error / model.band(), error * model.band()];
        let lowest = low.map_or(model.ranges[1][0], |low| low.ranges[1][0]);
        Some(Prediction { error, band, ranges: [model.ranges[0], [lowest, model.ranges[1][1]]] })
    }

    /// The model between plates of a collision.
    pub fn of_walls(&self, collision: Preset) -> Option<&WallModel> {
        self.walls.iter().find(|model| model.collision == collision)
    }
}
