//! The configurations that were kept back from the fits: what the models predict, and what was measured.

use psmrt_reference::collision::Collision;
use psmrt_reference::rates::Rates;

use super::evidence::{grain_point, wall_point};
use super::knobs::CollisionKnob;
use super::model::{LEAST_ERROR, Models};
use super::record::Row;
use crate::cases::{CaseError, Table};

const RESULTS: &str = include_str!("../../golden/tradeoff/held_back_results.csv");

/// A prediction and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// What was run.
    pub row: Row,
    /// The predicted error.
    pub predicted: f64,
    /// The factor by which it may be off either way.
    pub band: f64,
    /// The measured error.
    pub measured: f64,
}

impl Trial {
    /// The ends of the band. Where less than the least error of the models is predicted, all below that
    /// error's band is within it.
    pub fn ends(&self) -> [f64; 2] {
        if self.predicted < LEAST_ERROR && self.row.knobs.cells_per_diameter().is_some() {
            let most = LEAST_ERROR * self.band;
            return [-most, most];
        }
        [self.predicted / self.band, self.predicted * self.band]
    }

    /// Whether the measured error lies within the band.
    pub fn hits(&self) -> bool {
        let [low, high] = self.ends();
        (low..=high).contains(&self.measured)
    }
}

/// The committed results of what was kept back.
pub fn committed_results() -> Result<Vec<Row>, CaseError> {
    Row::of_table(&Table::parse("golden/tradeoff/held_back_results.csv", RESULTS)?)
}

/// Each of these runs beside its prediction; runs without an error or without a model are left out.
pub fn trials(models: &Models, results: &[Row]) -> Vec<Trial> {
    results.iter().filter_map(|row| trial(models, row)).collect()
}

fn trial(models: &Models, row: &Row) -> Option<Trial> {
    let collision = row.knobs.collision;
    let (predicted, band, measured) = if let Some(point) = wall_point(row) {
        let model = models.of_walls(collision)?;
        let predicted = model.error(point.cells, point.tau, point.velocity);
        (predicted, model.band(), point.error)
    } else {
        let (point, model) = (grain_point(row)?, models.of_grains(collision)?);
        (model.error(point.cells, point.tau, point.drag), model.band(), point.error)
    };
    Some(Trial { row: row.clone(), predicted, band, measured })
}

/// The knob that a collision is, if it is one of them.
pub fn collision_of(collision: &Collision) -> Option<CollisionKnob> {
    let tau = collision.tau();
    match collision {
        Collision::Srt { .. } => Some(CollisionKnob::Srt),
        Collision::Mrt { rates } => {
            let is =
                |preset: Result<Rates, _>| preset.is_ok_and(|preset: Rates| close(&preset, rates));
            if is(Rates::dhumieres(tau)) {
                Some(CollisionKnob::Dhumieres)
            } else if is(Rates::magic(tau, 3.0 / 16.0)) {
                Some(CollisionKnob::Magic)
            } else if is(Rates::srt(tau)) {
                Some(CollisionKnob::Srt)
            } else {
                None
            }
        }
    }
}

/// Whether all rates agree but for rounding.
fn close(a: &Rates, b: &Rates) -> bool {
    let (a, b) = (a.diagonal(), b.diagonal());
    a.iter().zip(b.iter()).all(|(a, b)| (a - b).abs() < 1e-9)
}
