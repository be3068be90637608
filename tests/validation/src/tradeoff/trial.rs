//! The configurations that were held back from the fits: what the models predict, and what was measured.

use super::evidence::{grain_point, solid_method, wall_point};
use super::parameters::Parameters;
use super::row::Row;
use psmrt::advice::tradeoff::model::{LEAST_ERROR, SolidMethod};
use psmrt::advice::tradeoff::models::Models;
use psmrt::table::{Table, TableError};

const RESULTS: &str = include_str!("../../../../golden/tradeoff/held_back_results.csv");

/// The list itself.
const LIST: &str = include_str!("../../../../golden/tradeoff/held_back.csv");

/// How many of the list were chosen first: bands were widened, once, after these had been run.
const FIRST: usize = 27;

/// A prediction and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// What was run.
    pub row: Row,
    /// Whether bands were widened after it had been run: it cannot show that they hold.
    pub widened: bool,
    /// The predicted error.
    pub predicted: f64,
    /// What 95 % lie between. Where less than the least error of the models is predicted, all below that
    /// error's band is within it.
    pub ends: [f64; 2],
    /// The measured error.
    pub measured: f64,
}

impl Trial {
    /// Whether the measured error lies within the band.
    pub fn hits(&self) -> bool {
        (self.ends[0]..=self.ends[1]).contains(&self.measured)
    }
}

/// Whether a trial had an operator that lets no fluid through.
pub fn is_of_tight(trial: &Trial) -> bool {
    let method = solid_method(&trial.row.parameters);
    matches!(method, Some(SolidMethod::Graded | SolidMethod::FullBounceBack))
}

/// How many of some trials hit, and how many there are: of those that bands were widened after, and of the
/// others.
pub fn score(trials: &[Trial]) -> [[usize; 2]; 2] {
    [true, false].map(|widened| {
        let own = || trials.iter().filter(|trial| trial.widened == widened);
        [own().filter(|trial| trial.hits()).count(), own().count()]
    })
}

/// The committed results of what was held back.
pub fn committed_results() -> Result<Vec<Row>, TableError> {
    Row::of_table(&Table::parse("golden/tradeoff/held_back_results.csv", RESULTS)?)
}

/// Each of these runs beside its prediction; runs without an error or without a model are left out.
pub fn trials(models: &Models, results: &[Row]) -> Result<Vec<Trial>, TableError> {
    let list = Table::parse("golden/tradeoff/held_back.csv", LIST)?;
    let list: Vec<Parameters> =
        list.rows.iter().map(|row| Parameters::from_row(row)).collect::<Result<_, _>>()?;
    let widened =
        |row: &Row| list.iter().take(FIRST).any(|parameters| *parameters == row.parameters);
    Ok(results
        .iter()
        .filter_map(|row| {
            let (predicted, ends, measured) = predicted(models, row)?;
            Some(Trial { row: row.clone(), widened: widened(row), predicted, ends, measured })
        })
        .collect())
}

/// What is predicted, the band, and what was measured.
fn predicted(models: &Models, row: &Row) -> Option<(f64, [f64; 2], f64)> {
    let collision = row.parameters.collision;
    if let Some(point) = wall_point(row) {
        let model = models.of_walls(collision)?;
        let error = model.error(point.cells, point.tau, point.velocity);
        return Some((error, [error / model.band(), error * model.band()], point.error));
    }
    let point = grain_point(row)?;
    let method = (collision, point.solid);
    let found = models.with_grains(method, point.cells, point.tau, point.drag)?;
    let ends = match models.of_grains(collision, point.solid) {
        Some(model) if found.error < LEAST_ERROR => {
            [-LEAST_ERROR * model.band(), LEAST_ERROR * model.band()]
        }
        _ => found.band,
    };
    Some((found.error, ends, point.error))
}
