//! The figures: the curve of fluidization, the onset and the expansion beside laws.

use psmrt_report::{Axis, Figure, Marker, Series, Style};

use super::{ERGUN, Run, TANG};
use crate::cases::found::drawn;
use crate::cases::{BedLaw, CaseError, Golden};
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
    let exact: Vec<(f64, f64)> = (0..=60)
        .map(|i| 10f64.powf(-0.6 + 2.0 * f64::from(i) / 60.0))
        .map(|u| (u, u.min(1.0)))
        .collect();
    figure = figure.with(Series::dashed("exact: weight less buoyancy, reached at U_mf", exact));
    // The expanded fine sand begins beyond its onset: that of the same bed in another run counts.
    let at = |run: &Run| {
        let same = |other: &&Run| other.grains.archimedes == run.grains.archimedes;
        run.onset().or_else(|| study.iter().find(same)?.onset())
    };
    let points = |run: &Run, value: &dyn Fn(&super::Level) -> f64| -> Vec<(f64, f64)> {
        let Some([onset, _]) = at(run) else { return Vec::new() };
        let flows = run.levels.iter().filter(|level| level.re > 0.0);
        flows.map(|level| (level.re / onset, value(level))).collect()
    };
    let runs = || study.iter().enumerate();
    for (colour, run) in runs() {
        let series = Series::points(run.name.clone(), points(run, &|level| level.lift));
        figure = figure.with(series.with_colour(colour));
    }
    figure = figure.with_panel(Axis::linear("height over that at rest"));
    for (colour, run) in runs() {
        let rest = run.levels.first().map_or(f64::NAN, |level| level.height);
        let series = Series::points(run.name.clone(), points(run, &|level| level.height / rest));
        figure = figure.with(series.with_colour(colour));
    }
    figure.note("110 grains of 8 or 12 cells on a sieve, periodic sides; U_mf: where what rests on the sieve would be gone. What is short of the line before is \
                 lost below the grains on the sieve")
}

/// Re at the onset against Archimedes' number.
fn onset(study: &[Run], quick: &[Run]) -> Figure {
    let found = |runs: &[Run], over: &dyn Fn(&Run) -> f64| -> Vec<(f64, f64)> {
        let each = runs.iter().filter_map(|run| Some((run, run.onset()?[0])));
        each.map(|(run, re)| (run.grains.archimedes, re / over(run))).collect()
    };
    let law = |law: BedLaw, over: &dyn Fn(&Run) -> f64| -> Vec<(f64, f64)> {
        let each = study.iter().filter_map(|run| Some((run, run.onset()?[1])));
        each.map(|(run, porosity)| {
            (run.grains.archimedes, run.grains.carried(&law, porosity) / over(run))
        })
        .collect()
    };
    let mut figure = Figure::new(
        "Minimum fluidization velocity",
        Axis::log("Archimedes number"),
        Axis::log("Re = U_mf d/nu"),
    );
    for is_ratio in [false, true] {
        let over = |run: &Run| if is_ratio { run.grains.wen_yu } else { 1.0 };
        let scale = |archimedes: f64| if is_ratio { 1.0 } else { wen_yu(archimedes) };
        if is_ratio {
            figure = figure.with_panel(Axis::linear("over Wen & Yu").range(0.5, 2.0));
        }
        let line = |factor: f64| numbers().map(|ar| (ar, factor * scale(ar))).collect::<Vec<_>>();
        figure = figure
            .with(Series::line("Wen & Yu 1966", line(1.0)).with_colour(0))
            .with(Series::dashed("Wen & Yu, a standard deviation", line(1.34)).with_colour(0))
            .with(Series::dashed("Wen & Yu, a standard deviation", line(0.66)).with_colour(0));
        for (colour, one, marker) in [(1, TANG, Marker::Diamond), (2, ERGUN, Marker::Cross)] {
            let label = format!("{}, at the porosity of each bed", one.name);
            let series = Series::new(label, Style::Points(Some(marker)), law(one, &over));
            figure = figure.with(series.with_colour(colour));
        }
        let filled = Style::Points(Some(Marker::Circle));
        figure = figure
            .with(Series::new("psmrt, 8 and 12 cells", filled, found(study, &over)).with_colour(3))
            .with(Series::new("psmrt, quick, 6 cells", RING, found(quick, &over)).with_colour(3));
    }
    figure.note("sand of 0.2, 0.5 and 1 mm in water")
}

/// `U_mf d/nu` by Wen & Yu.
fn wen_yu(archimedes: f64) -> f64 {
    (33.7f64.powi(2) + 0.0408 * archimedes).sqrt() - 33.7
}

/// Archimedes' numbers from 63 to 40,000.
fn numbers() -> impl Iterator<Item = f64> {
    (0..=40).map(|i| 10f64.powf(1.8 + 2.8 * f64::from(i) / 40.0))
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
            let series =
                if law == 0 { Series::line(label, line) } else { Series::dashed(label, line) };
            figure = figure.with(series.with_colour(colour));
        }
        let points = |run: &Run| -> Vec<(f64, f64)> {
            run.lifted().map(|level| (level.inside, level.re / run.grains.re_terminal)).collect()
        };
        figure = figure
            .with(Series::points(format!("psmrt, {}", run.name), points(run)).with_colour(colour));
    }
    let points = quick.iter().flat_map(|run| {
        run.lifted().map(|level| (level.inside, level.re / run.grains.re_terminal))
    });
    figure
        .with(Series::new("psmrt, quick, 6 cells", RING, points.collect()))
        .note("porosity inside the bed, without a diameter at the sieve and at the top")
}
