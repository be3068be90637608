//! The figures: how the column rises, and what each contact carries.

use psmrt_report::{Axis, Figure, Series};

use super::{SPHERES, exact, levels};
use crate::cases::found::{drawn, found};
use crate::cases::{CaseError, Golden};
use psmrt::table::Table;

pub(super) fn all(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let rows = drawn(rows);
    Ok(vec![settlement(golden, &rows)?, forces(golden, &rows)?])
}

fn settlement(golden: &Golden, rows: &Table) -> Result<Figure, CaseError> {
    let top = SPHERES - 1;
    let closed = exact(golden)?;
    let rest = closed[0][1][top];
    let mut figure = Figure::new(
        "The column rises as the flow takes the load off its springs",
        Axis::linear("i/i_c").range(0.0, 1.0),
        Axis::linear("settlement of the top over that at rest").range(0.0, 1.05),
    )
    .with(Series::dashed("closed form: 1 - i/i_c", vec![(0.0, 1.0), (1.0, 0.0)]));
    for engine in rows.values("engine")? {
        let levels = levels(&rows.with(&[("engine", &engine)])?)?;
        let points = levels.iter().map(|level| (level.ratio, level.settlement[top] / rest));
        figure = figure.with(found("", &engine, points.collect(), None));
    }
    Ok(figure.note("ten spheres of 6 cells, head held at 0, 0.3, 0.6 and 0.85 of the critical one"))
}

fn forces(golden: &Golden, rows: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "What each contact carries, from the sieve up",
        Axis::linear("contact (0: the sieve)").range(0.0, SPHERES as f64),
        Axis::linear("force over the weight less buoyancy of a sphere").range(0.0, 10.5),
    );
    let closed = exact(golden)?;
    let at = |values: &[f64]| {
        values.iter().enumerate().map(|(j, &value)| (j as f64, value)).collect::<Vec<_>>()
    };
    let engines = rows.values("engine")?;
    for (colour, [forces, _]) in closed.iter().enumerate() {
        let mut line = at(forces);
        line.push((SPHERES as f64, 0.0));
        figure = figure.with(Series::dashed("closed form", line).with_colour(colour));
    }
    for engine in &engines {
        for (colour, level) in levels(&rows.with(&[("engine", engine)])?)?.iter().enumerate() {
            let kind = format!("i/i_c = {:.2}", level.ratio);
            figure = figure.with(found(&kind, engine, at(&level.force), Some(colour)));
        }
    }
    Ok(figure.note("by the overlaps of the spheres; the last sphere's drag is a tenth larger than the others', the first's a little smaller"))
}
