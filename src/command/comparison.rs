//! The comparison with an exact solution: as text, table and picture.

use std::io::Write;
use std::path::Path;

use psmrt_report::{Figure, render_svg};
use serde_json::{Value as Json, json};

use super::{CommandError, write};
use crate::engine::Coupled;
use crate::exact::{Comparison, PlanePoiseuille};
use crate::output::csv;
use crate::output::records::profile_rows;
use crate::output::{atomic, plot};
use crate::scene::Scene;
use crate::scene::check::record_kinds::middle;
use crate::scene::columns::Column;
use crate::scene::names::COMPARISON;

const COLUMNS: [Column; 3] = [
    Column::new("position", "m"),
    Column::new("velocity", "m/s"),
    Column::new("exact_velocity", "m/s"),
];

/// Compares the profile through the middle of the domain, writes it as a table and draws it.
pub(super) fn compare(
    scene: &Scene,
    exact: &PlanePoiseuille,
    engine: &Coupled,
    folder: &Path,
) -> Result<Comparison, CommandError> {
    let middle = middle(&scene.setup.domain);
    let rows = profile_rows(scene, engine, exact.across, middle);
    let along: Vec<f64> = rows.iter().map(|row| row[2 + exact.along]).collect();
    let comparison = Comparison::new(exact, &along);
    // Both are made from the end of the run: a resumed run makes them again.
    let [table, picture] = COMPARISON.map(|name| folder.join(name));
    write(&table, |path| {
        atomic::write(path, |out| csv::write(out, &COLUMNS, &comparison.si_rows))
    })?;
    let figure = plot::profile(&scene.title, exact, &comparison);
    write(&picture, |path| write_figure(&figure, path))?;
    Ok(comparison)
}

pub(super) fn to_text(exact: &PlanePoiseuille, comparison: &Comparison) -> String {
    format!(
        "against the exact profile (largest velocity {:.4e} m/s, {} cells across):\n  \
         relative L2 error {:.3e}; the wall's known slip alone makes {:.3e}\n  \
         largest error     {:.3e} of the largest velocity",
        exact.si_top_velocity(),
        comparison.si_rows.len(),
        comparison.relative_l2,
        comparison.explained_l2,
        comparison.relative_max
    )
}

pub(super) fn to_json(comparison: &Comparison) -> Json {
    json!({
        "relative_l2": comparison.relative_l2,
        "relative_max": comparison.relative_max,
        "explained_l2": comparison.explained_l2,
    })
}

/// Draws a figure into a file that is whole or not there.
pub(super) fn write_figure(figure: &Figure, path: &Path) -> std::io::Result<()> {
    let svg = render_svg(figure).map_err(std::io::Error::other)?;
    atomic::write(path, |out| out.write_all(svg.as_bytes()))
}
