//! The figures: restitution against the Stokes number, two courses beside the measured ones, and what the restitution depends on.

use psmrt_report::{Axis, Figure, Marker, Series, Style};

use super::fall::{Between, Liquid, WetRebound};
use super::study::{BASE, MAIN, TRADE, of, restitution};
use super::{measured, measured_restitution};
use crate::cases::found::{drawn, found};
use crate::cases::{CaseError, Golden};
use psmrt::table::Table;

/// The spheres with measured courses.
const COURSES: [&str; 2] = ["27", "152"];

pub(super) fn all(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let (literature, bounces) = (golden.table("literature.csv")?, golden.table("bounces.csv")?);
    let (study, courses) = (golden.table("study.csv")?, golden.table("courses.csv")?);
    Ok(vec![
        restitutions(&study, &literature, &bounces)?,
        low(&courses, &literature, &bounces, &drawn(rows))?,
        high(&courses, &literature, &bounces)?,
        trade(&study, &literature, &bounces)?,
    ])
}

fn restitutions(study: &Table, literature: &Table, bounces: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "Rebound of a sphere from a wall in a liquid",
        Axis::log("Stokes number St = rho_p U d/(9 mu)").range(10.0, 1000.0),
        Axis::linear("restitution over the dry one").range(0.0, 1.0),
    );
    let curve = |law: fn(f64) -> f64| -> Vec<(f64, f64)> {
        (0..=100)
            .map(|i| 10.0_f64.powf(1.0 + 0.02 * f64::from(i)))
            .map(|st| (st, law(st)))
            .collect()
    };
    figure = figure
        .with(Series::line("exp(-35/St), Legendre et al. 2005", curve(|st| (-35.0 / st).exp())))
        .with(Series::dashed("1 - 10/St", curve(|st| 1.0 - 10.0 / st)));
    let mut points = Vec::new();
    for stokes in COURSES {
        let liquid = Liquid::of(literature, stokes)?;
        let course = measured(bounces, &liquid, stokes)?;
        points.push((liquid.stokes(liquid.velocity), measured_restitution(&course, &liquid)));
    }
    let errors = vec![0.1; points.len()];
    figure = figure.with(
        Series::new(
            "measured courses, Gondret et al. 2002",
            Style::Points(Some(Marker::Square)),
            points,
        )
        .with_errors(errors),
    );
    let mut points = Vec::new();
    for fall in MAIN {
        let own = of(study, &fall)?;
        points.push((own.number("stokes")?, own.number("restitution")?));
    }
    figure = figure.with(Series::points("psmrt, 16 cells per diameter", points));
    let without = |stokes| WetRebound { stokes, between: Between::Nothing, ..BASE };
    let mut points = Vec::new();
    for stokes in COURSES {
        let own = of(study, &without(stokes))?;
        points.push((own.number("stokes")?, own.number("restitution")?));
    }
    figure = figure.with(Series::new(
        "psmrt, no lubrication, 12 cells",
        Style::Points(Some(Marker::Ring)),
        points,
    ));
    Ok(figure.note("bars: 0.1, by which measured restitutions scatter round a common curve"))
}

/// Time and gap of a committed course.
fn course(courses: &Table, fall: &WetRebound) -> Result<Vec<(f64, f64)>, CaseError> {
    Ok(of(courses, fall)?.points("time_d_over_u", "gap")?)
}

fn low(
    courses: &Table,
    literature: &Table,
    bounces: &Table,
    rows: &Table,
) -> Result<Figure, CaseError> {
    let measured = measured(bounces, &Liquid::of(literature, "27")?, "27")?;
    let mut figure = Figure::new(
        "St 27: gap before and after the impact",
        Axis::linear("time since contact (d/U)").range(-1.0, 4.5),
        Axis::linear("gap (diameters)").range(0.0, 0.8),
    )
    .with(Series::new(
        "measured, Gondret et al. 2002",
        Style::Points(Some(Marker::Square)),
        measured,
    ));
    for (label, fall) in [
        ("16 cells", MAIN[0]),
        ("12 cells", BASE),
        ("no lubrication", WetRebound { between: Between::Nothing, ..BASE }),
        ("roughness 0.01 a", WetRebound { smallest: 1e-2, ..BASE }),
    ] {
        figure = figure.with(Series::line(label, course(courses, &fall)?));
    }
    for engine in rows.values("engine")? {
        let own = rows.with(&[("engine", &engine)])?.points("time_d_over_u", "gap")?;
        // Some of them: marks side by side.
        let thinned = own.into_iter().step_by(12).collect();
        figure = figure.with(found("12 cells, quick form", &engine, thinned, None));
    }
    Ok(figure)
}

fn high(courses: &Table, literature: &Table, bounces: &Table) -> Result<Figure, CaseError> {
    let measured = measured(bounces, &Liquid::of(literature, "152")?, "152")?;
    Ok(Figure::new(
        "St 152: gap before and after the impact",
        Axis::linear("time since contact (d/U)").range(-3.0, 18.0),
        Axis::linear("gap (diameters)").range(0.0, 3.0),
    )
    .with(Series::new(
        "measured, Gondret et al. 2002",
        Style::Points(Some(Marker::Square)),
        measured,
    ))
    .with(Series::line("16 cells", course(courses, &MAIN[2])?)))
}

fn trade(study: &Table, literature: &Table, bounces: &Table) -> Result<Figure, CaseError> {
    let liquid = Liquid::of(literature, "27")?;
    let expected = measured_restitution(&measured(bounces, &liquid, "27")?, &liquid);
    let names = TRADE.map(|(name, _)| name);
    let mut points = Vec::new();
    for (place, (_, fall)) in (1_u32..).zip(TRADE) {
        points.push((f64::from(place), restitution(study, &fall)?));
    }
    let ends = |value: f64| vec![(0.5, value), (names.len() as f64 + 0.5, value)];
    let figure = Figure::new(
        "St 27: what the restitution depends on",
        Axis::of_names(&names),
        Axis::linear("restitution over the dry one").range(0.0, 1.0),
    );
    Ok(figure
        .with(Series::line("measured", ends(expected)))
        .with(Series::new("scatter of measurements", Style::Reference, ends(expected + 0.1)))
        .with(Series::new("", Style::Reference, ends(expected - 0.1)))
        .with(Series::points("psmrt", points))
        .note("as it is: 12 cells per diameter, 0.1 cells a step, contact of 0.1 steps, cut-off of a cell, roughness 0.001 a; slower: 0.05 cells a step; 0.003 a and 0.01 a: roughness; none: no lubrication; 10 steps: contact; dry: no lubrication in it"))
}
