//! What is made of the rows of a sweep: fits, fronts, and predictions beside measurements, as tables.

use super::figures::{on_front, placed, problems};
use super::knobs::COLUMNS;
use super::model::Models;
use super::record::Row;
use super::trial::Trial;
use crate::cases::Table;

/// The models with their parameters, standard errors and bands.
pub fn fits(models: &Models) -> Table {
    let columns = [
        "model",
        "collision",
        "runs",
        "geometries",
        "parameter",
        "value",
        "standard_error",
        "scatter",
        "band_95",
    ];
    let mut table = Table::new(&columns);
    let mut add =
        |words: [&str; 2], counts: [usize; 2], fit: [(&str, f64, f64); 4], scatter, band| {
            for (name, value, error) in fit.into_iter().filter(|(name, ..)| !name.is_empty()) {
                table.add(vec![
                    words[0].to_owned(),
                    words[1].to_owned(),
                    counts[0].to_string(),
                    counts[1].to_string(),
                    name.to_owned(),
                    format!("{value:.4}"),
                    format!("{error:.4}"),
                    format!("{scatter:.4}"),
                    format!("{band:.3}"),
                ]);
            }
        };
    for model in &models.grains {
        let (p, e) = (&model.fit.parameters, &model.fit.errors);
        // The error of a logarithm is a relative one.
        let rows = [
            ("a", p[0].exp(), p[0].exp() * e[0]),
            ("b", p[1].exp(), p[1].exp() * e[1]),
            ("m", p[2], e[2]),
            ("p", p[3], e[3]),
        ];
        add(["grains", model.collision.word()], model.counts, rows, model.scatter, model.band());
    }
    for model in &models.walls {
        let (p, e) = (&model.fit.parameters, &model.fit.errors);
        let none = ("", 0.0, 0.0);
        let rows = [("s", p[0], e[0]), ("c", p[1], e[1]), none, none];
        let counts = [model.count, 1];
        add(["plates", model.collision.word()], counts, rows, model.fit.scale, model.band());
    }
    table
}

/// The fronts of all flows, of models that converge.
pub fn fronts(rows: &[Row], costs: &Table) -> Table {
    let columns: Vec<&str> =
        COLUMNS.iter().copied().chain(["error", "cell_updates", "seconds_by_cost"]).collect();
    let mut table = Table::new(&columns);
    for problem in problems(rows) {
        for best in on_front(&placed(&problem, rows, costs), false) {
            let mut row = best.row.knobs.row();
            row.push(best.row.error.map_or_else(String::new, |error| format!("{error:.4e}")));
            row.push(best.row.cell_updates().to_string());
            row.push(format!("{:.3e}", best.seconds));
            table.add(row);
        }
    }
    table
}

/// What was kept back, predicted and measured.
pub fn check(trials: &[Trial]) -> Table {
    let columns: Vec<&str> =
        COLUMNS.iter().copied().chain(["predicted", "low", "high", "measured", "within"]).collect();
    let mut table = Table::new(&columns);
    for trial in trials {
        let mut row = trial.row.knobs.row();
        let [low, high] = trial.ends();
        for value in [trial.predicted, low, high, trial.measured] {
            row.push(format!("{value:.4e}"));
        }
        row.push(if trial.hits() { "yes" } else { "no" }.to_owned());
        table.add(row);
    }
    table
}
