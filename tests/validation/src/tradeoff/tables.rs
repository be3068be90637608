//! What is made of the rows of a sweep: fits, fronts, and predictions beside measurements, as tables.

use super::figures::{on_front, placed, problems};
use super::fitting::Fits;
use crate::tradeoff::parameters::COLUMNS;
use crate::tradeoff::row::Row;
use crate::tradeoff::trial::Trial;
use psmrt::advice::tradeoff::model::SolidMethod;
use psmrt::table::Table;
use psmrt_reference::collision::Preset;

/// The models with their parameters, standard errors and bands.
pub fn fits(fits: &Fits) -> Table {
    let columns = [
        "model",
        "collision",
        "solid",
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
        |words: [&str; 3], counts: [usize; 2], fit: &[(&str, f64, f64)], scatter, band| {
            for (name, value, error) in fit {
                let mut row: Vec<String> = words.map(str::to_owned).into();
                row.extend(counts.map(|count| count.to_string()));
                row.push((*name).to_owned());
                row.extend([format!("{value:.4}"), format!("{error:.4}")]);
                row.extend([format!("{scatter:.4}"), format!("{band:.3}")]);
                table.add(row);
            }
        };
    // The error of a logarithm is a relative one.
    let whole = |ln: f64, error: f64| (ln.exp(), ln.exp() * error);
    for (model, fit) in &fits.grains {
        let (p, e) = (&model.parameters, &fit.errors);
        let ((a, da), (b, db)) = (whole(p[0], e[0]), whole(p[1], e[1]));
        let rows = [("a", a, da), ("b", b, db), ("m", p[2], e[2]), ("p", p[3], e[3])];
        let words = ["grains", model.collision.word(), model.solid.word()];
        add(words, model.evidence.counts, &rows, model.evidence.scatter, model.band());
    }
    if let Some((model, fit)) = &fits.eps {
        let (p, e) = (&model.parameters, &fit.errors);
        let ((a, da), (b, db)) = (whole(p[0], e[0]), whole(p[2], e[2]));
        let rows =
            [("a", a, da), ("m", p[1], e[1]), ("b", b, db), ("n", p[3], e[3]), ("q", p[4], e[4])];
        let words = ["grains", Preset::DHumieres.word(), SolidMethod::SolidFraction.word()];
        add(words, model.evidence.counts, &rows, model.evidence.scatter, model.band());
    }
    for (model, fit) in &fits.tight {
        let (p, e) = (&model.parameters, &fit.errors);
        let ((b, db), (c, dc)) = (whole(p[0], e[0]), whole(p[2], e[2]));
        let last = match model.collision {
            Preset::Srt => {
                let (a, da) = whole(p[4], e[4]);
                ("a", a, da)
            }
            Preset::DHumieres | Preset::Trt => ("r", p[4], e[4]),
        };
        let rows = [("b", b, db), ("m", p[1], e[1]), ("c", c, dc), ("n", p[3], e[3]), last];
        let words = ["grains", model.collision.word(), model.solid.word()];
        // The band is a share of what scatters, not a factor.
        add(words, model.evidence.counts, &rows, model.evidence.scatter, model.share());
    }
    for (model, fit) in &fits.walls {
        let (p, e) = (&model.parameters, &fit.errors);
        let rows = [("s", p[0], e[0]), ("c", p[1], e[1])];
        let words = ["plates", model.collision.word(), "none"];
        add(words, [model.count, 1], &rows, model.scatter, model.band());
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
            let mut row = best.row.parameters.row();
            row.push(best.row.error.map_or_else(String::new, |error| format!("{error:.4e}")));
            row.push(best.row.cell_updates().to_string());
            row.push(format!("{:.3e}", best.seconds));
            table.add(row);
        }
    }
    table
}

/// What was held back, predicted and measured.
pub fn check(trials: &[Trial]) -> Table {
    let columns: Vec<&str> = COLUMNS
        .iter()
        .copied()
        .chain(["predicted", "low", "high", "measured", "within", "bands_widened_after"])
        .collect();
    let mut table = Table::new(&columns);
    for trial in trials {
        let mut row = trial.row.parameters.row();
        let [low, high] = trial.ends;
        for value in [trial.predicted, low, high, trial.measured] {
            row.push(format!("{value:.4e}"));
        }
        row.extend(
            [trial.hits(), trial.widened].map(|is| if is { "yes" } else { "no" }.to_owned()),
        );
        table.add(row);
    }
    table
}
