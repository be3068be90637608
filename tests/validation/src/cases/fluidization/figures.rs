//! The figures: the curve of fluidization, the onset and the expansion beside laws.

use psmrt_report::{Axis, Figure, Marker, Series, Style};

use super::{ERGUN, Run, TANG};
use crate::cases::found::drawn;
use crate::cases::{CaseError, Golden};
use psmrt::table::Table;

const RING: Style = Style::Points(Some(Marker::Ring));

pub(super) fn all(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let study = Run::of(golden, &golden.table("study.csv")?)?;
    let rows = drawn(rows);
    let mut quick = Vec::new();
    for engine in rows.values("engine")? {
        quick.extend(Run::of(golden, &rows.with(&[("engine", &engine)])?)?);
    }
    Ok(vec![curve(&study), onset(&study, &quick), expansion(&study, &quick)])
}

/// How much of the bed the water carries, and how high the bed is, against the velocity.
fn curve(study: &[Run]) -> Figure {
    let mut figure = Figure::new(
        "The water carries the bed from the minimum fluidization velocity on",
        Axis::log("superficial velocity over U_mf"),
        Axis::linear("drop of pressure times area, over weight less buoyancy").range(0.0, 1.2),
    );
    let exact: Vec<(f64, f64)> =
        (0..=60).map(|i| 10f64.powf(-0.6 + 2.0 * f64::from(i) / 60.0)).map(|u| (u, u.min(1.0))).collect();
    figure = figure.with(Series::dashed("exact: weight less buoyancy, reached at U_mf", exact));
    let points = |run: &Run, value: &dyn Fn(&super::Level) -> f64| -> Vec<(f64, f64)> {
        let Some([at, _]) = run.onset() else { return Vec::new() };
        let flows = run.levels.iter().filter(|level| level.re > 0.0);
        flows.map(|level| (level.re / at, value(level))).collect()
    };
    let runs = || study.iter().enumerate().filter(|(_, run)| run.onset().is_some());
    for (colour, run) in runs() {
        figure = figure
            .with(Series::points(run.name.clone(), points(run, &|level| level.lift)).with_colour(colour));
    }
    figure = figure.with_panel(Axis::linear("height over that at rest"));
    for (colour, run) in runs() {
        let rest = run.levels.first().map_or(f64::NAN, |level| level.height);
        let series = Series::points(run.name.clone(), points(run, &|level| level.height / rest));
        figure = figure.with(series.with_colour(colour));
    }
    figure.note("110 grains of 8 or 12 cells on a sieve, periodic sides; U_mf: where the straight line of the resting bed reaches its weight")
}

/// Re at the onset against Archimedes' number.
fn onset(study: &[Run], quick: &[Run]) -> Figure {
    let wen_yu = |archimedes: f64| (33.7f64.powi(2) + 0.0408 * archimedes).sqrt() - 33.7;
    let curve = |factor: f64| -> Vec<(f64, f64)> {
        (0..=40).map(|i| 10f64.powf(1.8 + 2.8 * f64::from(i) / 40.0)).map(|ar| (ar, factor * wen_yu(ar))).collect()
    };
    let mut figure = Figure::new(
        "Minimum fluidization velocity",
        Axis::log("Archimedes number"),
        Axis::log("Re = U_mf d/nu"),
    )
    .with(Series::line("Wen & Yu 1966", curve(1.0)))
    .with(Series::dashed("Wen & Yu, a standard deviation", curve(1.34)).with_colour(0))
    .with(Series::dashed("Wen & Yu, a standard deviation", curve(0.66)).with_colour(0));
    for (law, marker) in [(TANG, Marker::Ring), (ERGUN, Marker::Diamond)] {
        let points = study.iter().filter_map(|run| {
            let [_, porosity] = run.onset()?;
            Some((run.grains.archimedes, run.grains.carried(&law, porosity)))
        });
        let label = format!("{}, at the porosity of each bed", law.name);
        figure = figure.with(Series::new(label, Style::Points(Some(marker)), points.collect()));
    }
    let points = |runs: &[Run]| -> Vec<(f64, f64)> {
        runs.iter().filter_map(|run| Some((run.grains.archimedes, run.onset()?[0]))).collect()
    };
    figure
        .with(Series::points("psmrt, 8 and 12 cells", points(study)))
        .with(Series::new("psmrt, quick, 6 cells", RING, points(quick)))
        .note("sand of 0.2, 0.5 and 1 mm in water")
}

/// The velocity over that of one grain alone, against the porosity.
fn expansion(study: &[Run], quick: &[Run]) -> Figure {
    let mut figure = Figure::new(
        "The expanded bed",
        Axis::linear("porosity").range(0.4, 0.85),
        Axis::log("superficial velocity over that of one grain alone"),
    );
    let expanded = || study.iter().filter(|run| run.lifted().count() > 1);
    let porosities = || (0..=40).map(|i| 0.42 + 0.4 * f64::from(i) / 40.0);
    for (colour, run) in expanded().enumerate() {
        for (law, name) in ["Richardson & Zaki", "Garside & Al-Dibouni"].into_iter().enumerate() {
            let line = porosities().map(|eps| (eps, run.grains.settling(eps)[law])).collect();
            let label = format!("{name}, Re_t = {:.1}", run.grains.re_terminal);
            let series = if law == 0 { Series::line(label, line) } else { Series::dashed(label, line) };
            figure = figure.with(series.with_colour(colour));
        }
        let points = |run: &Run| -> Vec<(f64, f64)> {
            run.lifted().map(|level| (level.inside, level.re / run.grains.re_terminal)).collect()
        };
        figure = figure.with(Series::points(format!("psmrt, {}", run.name), points(run)).with_colour(colour));
    }
    let points = quick.iter().flat_map(|run| {
        run.lifted().map(|level| (level.inside, level.re / run.grains.re_terminal))
    });
    figure
        .with(Series::new("psmrt, quick, 6 cells", RING, points.collect()))
        .note("porosity inside the bed, without a diameter at the sieve and at the top")
}
