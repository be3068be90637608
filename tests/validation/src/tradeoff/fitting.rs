//! The error models of the product, fitted to the runs. Their numbers stand in `src/advice/coefficients.csv`, made by
//! `cargo validate coefficients`.

use psmrt::advice::tradeoff::model::{
    Evidence, GrainModel, LEAST_ERROR, METHODS, SolidMethod, WallModel, grain_error, slip_error,
};
use psmrt::advice::tradeoff::model_eps::{EpsModel, logarithm};
use psmrt::advice::tradeoff::model_low::{LowModel, shift, spread};
use psmrt::advice::tradeoff::model_tight::{self, TIGHT, TightModel};
use psmrt::advice::tradeoff::models::Models;
use psmrt::advice::tradeoff::runs::GrainPoint;
use psmrt::table::TableError;
use psmrt_reference::collision::Preset;

use super::evidence::{WallPoint, grain_points, wall_points};
use super::evidence_low::low_points;
use super::evidence_tight::tight_points;
use super::fit::{Fit, least_squares, rms};
use super::row::Row;

/// Models with what was left of their fits.
#[derive(Clone, Debug)]
pub struct Fits {
    /// With grains, one a collision, and one with the superposition operator.
    pub grains: Vec<(GrainModel, Fit)>,
    /// With grains and the weight `B = ε`.
    pub eps: Option<(EpsModel, Fit)>,
    /// With grains, d'Humières' rates and relaxation times below those of `grains`.
    pub low: Option<(LowModel, Fit)>,
    /// With grains and operators that let no fluid through.
    pub tight: Vec<(TightModel, Fit)>,
    /// Between plates; none for the magic rates, which are exact there.
    pub walls: Vec<(WallModel, Fit)>,
}

impl Fits {
    /// Of all models, to a sweep and to the studies that go with it.
    pub fn of(sweep: &[Row]) -> Result<Self, TableError> {
        let (points, walls) = (grain_points(sweep)?, wall_points(sweep));
        let grains: Vec<_> = METHODS
            .into_iter()
            .filter_map(|(collision, solid)| grain_model(collision, solid, &points))
            .collect();
        let is_above = |(model, _): &&(GrainModel, Fit)| {
            model.collision == Preset::DHumieres && model.solid == SolidMethod::Usual
        };
        let low = low_points(sweep)?;
        let low = grains.iter().find(is_above).and_then(|(above, _)| low_model(above, &low));
        let walls =
            Preset::ALL.into_iter().filter_map(|collision| wall_model(collision, &walls)).collect();
        let tight = tight_points()?;
        let tight = TIGHT
            .into_iter()
            .filter_map(|(collision, solid)| tight_model(collision, solid, &tight))
            .collect();
        Ok(Fits { grains, eps: eps_model(&points), low, tight, walls })
    }

    /// The models alone.
    pub fn models(&self) -> Models {
        Models {
            grains: self.grains.iter().map(|(model, _)| model.clone()).collect(),
            eps: self.eps.as_ref().map(|(model, _)| model.clone()),
            low: self.low.as_ref().map(|(model, _)| model.clone()),
            tight: self.tight.iter().map(|(model, _)| model.clone()).collect(),
            walls: self.walls.iter().map(|(model, _)| model.clone()).collect(),
        }
    }
}

/// Where the search starts: the leak of an isolated sphere, and a remainder of third order.
const GRAINS: [f64; 4] = [1.1, 1.0, 0.8, 3.0];

/// Fits the points of a collision whose error is large enough to be of one sign. `None` if there are
/// too few, or of fewer than three geometries.
pub fn grain_model(
    collision: Preset,
    solid: SolidMethod,
    points: &[GrainPoint],
) -> Option<(GrainModel, Fit)> {
    let own = |point: &&GrainPoint| {
        point.collision == collision && point.solid == solid && point.error > LEAST_ERROR
    };
    let own: Vec<&GrainPoint> = points.iter().filter(own).collect();
    let residual = |p: &[f64], point: &GrainPoint| {
        (grain_error(p, point.cells, point.tau, point.drag) / point.error).ln()
    };
    let through = |points: &[&GrainPoint]| {
        least_squares(&GRAINS, |p| points.iter().map(|point| residual(p, point)).collect())
    };
    let (fit, evidence) = fitted(&own, through, residual)?;
    let parameters = fit.parameters[..].try_into().ok()?;
    Some((GrainModel { collision, solid, parameters, evidence }, fit))
}

/// Where the search starts: the leak as with the other weight, a shift of half a cell at τ = 1.
const EPS: [f64; 5] = [1.4, 0.8, -0.7, 0.3, 0.5];

/// Fits the points with the weight `B = ε`. `None` if there are too few, or of fewer than three geometries.
pub fn eps_model(points: &[GrainPoint]) -> Option<(EpsModel, Fit)> {
    let own = |point: &&GrainPoint| {
        point.collision == Preset::DHumieres && point.solid == SolidMethod::SolidFraction
    };
    let own: Vec<&GrainPoint> = points.iter().filter(own).collect();
    let residual = |p: &[f64], point: &GrainPoint| {
        logarithm(p, point.cells, point.tau, point.drag) - (1.0 + point.error).ln()
    };
    let through = |points: &[&GrainPoint]| {
        least_squares(&EPS, |p| points.iter().map(|point| residual(p, point)).collect())
    };
    let (fit, evidence) = fitted(&own, through, residual)?;
    Some((EpsModel { parameters: fit.parameters[..].try_into().ok()?, evidence }, fit))
}

/// Where the search starts: a thirtieth at 8 cells and a drag of 100.
const LOW: [f64; 3] = [-1.5, 0.5, 2.0];

/// Fits the points near τ = 1/2 to what `above` leaves of them. `None` if there are too few, or of fewer than three
/// geometries.
pub fn low_model(above: &GrainModel, points: &[GrainPoint]) -> Option<(LowModel, Fit)> {
    let own: Vec<&GrainPoint> = points.iter().collect();
    let residual = |p: &[f64], point: &GrainPoint| {
        let (d, tau, drag) = (point.cells, point.tau, point.drag);
        let logarithm = above.error(d, tau, drag).ln_1p() - shift(p, d, tau, drag);
        (logarithm - point.error.ln_1p()) / spread(above, d, tau, drag)
    };
    let through = |points: &[&GrainPoint]| {
        least_squares(&LOW, |p| points.iter().map(|one| residual(p, one)).collect())
    };
    let (fit, evidence) = fitted(&own, through, residual)?;
    Some((LowModel { parameters: fit.parameters[..].try_into().ok()?, evidence }, fit))
}

/// Where the search starts: what cut cells smooth is a few cells squared, and grains are larger by a third of a cell.
const TIGHT_START: [f64; 5] = [1.0, 0.4, -1.0, 0.3, 0.0];

/// Fits the points of an operator that lets no fluid through. `None` if there are too few, or of fewer than three
/// geometries.
pub fn tight_model(
    collision: Preset,
    solid: SolidMethod,
    points: &[GrainPoint],
) -> Option<(TightModel, Fit)> {
    let own = |point: &&GrainPoint| point.collision == collision && point.solid == solid;
    let own: Vec<&GrainPoint> = points.iter().filter(own).collect();
    let residual = |p: &[f64], point: &GrainPoint| {
        let (d, tau, drag) = (point.cells, point.tau, point.drag);
        let off = model_tight::logarithm(collision, p, d, tau, drag) - point.error.ln_1p();
        off / model_tight::spread(collision, p, d, tau, drag)
    };
    let through = |points: &[&GrainPoint]| {
        least_squares(&TIGHT_START, |p| points.iter().map(|one| residual(p, one)).collect())
    };
    let (fit, evidence) = fitted(&own, through, residual)?;
    let parameters = fit.parameters[..].try_into().ok()?;
    Some((TightModel { collision, solid, parameters, evidence }, fit))
}

/// Fits the points of a collision whose error is more than rounding. `None` if there are too few.
pub fn wall_model(collision: Preset, points: &[WallPoint]) -> Option<(WallModel, Fit)> {
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
    let parameters = fit.parameters[..].try_into().ok()?;
    Some((WallModel { collision, parameters, scatter: fit.scale, count: own.len() }, fit))
}

/// The fit through all points, and what it rests on: the scatter is that of geometries that were left out, each in
/// turn. `None` if there are fewer than three.
fn fitted(
    own: &[&GrainPoint],
    through: impl Fn(&[&GrainPoint]) -> Option<Fit>,
    residual: impl Fn(&[f64], &GrainPoint) -> f64,
) -> Option<(Fit, Evidence)> {
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
    let range = |value: fn(&GrainPoint) -> f64| {
        own.iter().fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], point| {
            [low.min(value(point)), high.max(value(point))]
        })
    };
    let ranges = [range(|p| p.cells), range(|p| p.tau), range(|p| p.drag)];
    let counts = [own.len(), geometries.len()];
    Some((through(own)?, Evidence { scatter: rms(&left), counts, ranges }))
}
