//! The figures of seepage.

use psmrt_reference::collision::Preset;
use psmrt_report::{Axis, Figure, Marker, Series, Style};

use super::full_size;
use super::inlet;
use super::over_law;
use super::study::{grids, largest_stable, steady, taus};
use crate::cases::found::found;
use crate::cases::{BED_LAWS, CaseError};
use psmrt::table::Table;

/// Solid fraction at which the laws are drawn.
const FRACTION: f64 = 0.6;

/// All of them: `rows` of the quick form, and those of the study.
pub fn all(
    rows: &Table,
    study: &Table,
    [stability, inlet, full_size]: [&Table; 3],
    ordered: f64,
) -> Result<Vec<Figure>, CaseError> {
    Ok(vec![
        friction_figure(rows, study, full_size)?,
        grid_figure(study, ordered)?,
        law_grid_figure(study)?,
        tau_figure(study)?,
        stability_figure(stability, inlet)?,
    ])
}

/// psi against Re, and below it over the law of Beetstra et al.
fn friction_figure(rows: &Table, study: &Table, full_size: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "Seepage through random beds",
        Axis::log("Re = U d/(nu (1 - porosity))").range(0.08, 250.0),
        Axis::log("psi"),
    );
    let law = |psi_re: fn(f64, f64) -> f64| {
        let at = (0..=60).map(|i| 0.1 * 2000.0_f64.powf(f64::from(i) / 60.0));
        at.map(move |re| (re, psi_re(FRACTION, re))).collect::<Vec<_>>()
    };
    for (i, one) in BED_LAWS.iter().enumerate() {
        let points = law(one.psi_re).into_iter().map(|(re, psi_re)| (re, psi_re / re)).collect();
        let series =
            if i < 2 { Series::dashed(one.name, points) } else { Series::line(one.name, points) };
        figure = figure.with(series.with_colour(i));
    }
    let beds = beds(rows, study)?;
    figure = beds.iter().map(|(psi, _)| psi.clone()).fold(figure, Figure::with);
    figure = full_size::series(full_size, "psi")?.into_iter().fold(figure, Figure::with);
    figure = figure.with_panel(
        Axis::linear("psi over Beetstra et al.").range(0.6, 1.4).ticks(&[0.6, 0.8, 1.0, 1.2, 1.4]),
    );
    let beetstra = law(BED_LAWS[3].psi_re);
    for (i, one) in BED_LAWS.iter().enumerate() {
        let ratio = |((re, value), (_, of)): (&(f64, f64), &(f64, f64))| (*re, value / of);
        let points = law(one.psi_re).iter().zip(&beetstra).map(ratio).collect();
        let series =
            if i < 2 { Series::dashed(one.name, points) } else { Series::line(one.name, points) };
        figure = figure.with(series.with_colour(i));
    }
    for (psi, ratio) in beds {
        figure = figure.with(Series { points: ratio, ..psi });
    }
    figure = full_size::series(full_size, "over_Beetstra")?.into_iter().fold(figure, Figure::with);
    for edge in [0.9, 1.1] {
        let ends = vec![(0.1, edge), (200.0, edge)];
        figure = figure.with(Series::new("scatter of real beds", Style::Reference, ends));
    }
    Ok(figure.note(
        "tau = 0.51 (the paper's bed at Re 30: 0.505); laws at a porosity of 0.4, points over the law at their own; real beds scatter by 10 to 15 %",
    ))
}

/// psi of a kind of bed against Re, and it over the law of Beetstra et al.
type BedSeries = (Series, Vec<(f64, f64)>);

fn beds(rows: &Table, study: &Table) -> Result<Vec<BedSeries>, CaseError> {
    let mut all = Vec::new();
    for engine in rows.values("engine")? {
        let wanted = [
            ("engine", engine.as_str()),
            ("packing", "random 2"),
            ("collision", Preset::DHumieres.word()),
        ];
        let series = found("9 spheres, 8 cells", &engine, Vec::new(), Some(BED_LAWS.len()));
        all.push((series, rows.with(&wanted)?));
    }
    let mrt = steady(study, Preset::DHumieres.word())?.with(&[("tau", "0.51")])?;
    let next = BED_LAWS.len() + 1;
    for (i, (kinds, label)) in [
        (&[("random 3", "8.0000")] as &[_], "31 spheres, 8 cells"),
        (&[("random 3", "12.0000")], "31 spheres, 12 cells"),
        (&[("random 3", "16.0000"), ("random 3", "24.0000")], "31 spheres, 16 and 24 cells"),
        (&[("random 4", "8.0000"), ("random 5", "8.0000")], "73 and 143 spheres, 8 cells"),
    ]
    .into_iter()
    .enumerate()
    {
        let mut own = Table::default();
        for (packing, cells) in kinds {
            own.append(mrt.with(&[("packing", *packing), ("cells_per_diameter", *cells)])?);
        }
        all.push((Series::points(label, Vec::new()).with_colour(next + i), own));
    }
    let srt =
        steady(study, Preset::Srt.word())?.with(&[("tau", "0.51"), ("packing", "random 3")])?;
    let series = Series::points("31 spheres, 8 cells, SRT", Vec::new()).with_colour(next + 4);
    all.push((series, srt));
    let mut beds = Vec::new();
    for (series, table) in all {
        let points = table.points("Re", "psi")?;
        let ratio: Vec<_> = points.iter().map(|p| p.0).zip(over_law(&table)?).collect();
        if !points.is_empty() {
            beds.push((Series { points, ..series }, ratio));
        }
    }
    Ok(beds)
}

/// The ordered bed and nine spheres on several grids.
fn grid_figure(study: &Table, ordered: f64) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "Resistance of beds against resolution, Re about 1",
        Axis::linear("(cell size/diameter)²").range(0.0, 0.0165),
        Axis::linear("ordered bed: psi over the exact one").range(0.5, 1.3),
    );
    let taus = ["0.505", "0.51", "0.52", "0.55"];
    let mut all = Vec::new();
    for (packing, unit) in [("fcc", ordered), ("random 2", 1.0)] {
        let mut series = Vec::new();
        for (colour, tau) in taus.into_iter().enumerate() {
            let points = grids(study, packing, tau)?.into_iter();
            let points: Vec<_> = points.map(|(d, psi_re)| (d.powi(-2), psi_re / unit)).collect();
            let one = Series::line_points(format!("tau {tau}"), points).with_colour(colour);
            series.push(one);
        }
        // Not all relaxation times have fine grids of both beds.
        series.retain(|one| !one.points.is_empty());
        all.push(series);
    }
    let random = all.pop().unwrap_or_default();
    figure = all.into_iter().flatten().fold(figure, Figure::with);
    figure = figure.with_panel(Axis::linear("nine spheres: psi Re").range(100.0, 240.0));
    figure = random.into_iter().fold(figure, Figure::with);
    Ok(figure
        .note("8 cells per diameter are at 0.0156, 16 at 0.0039; a straight line is second order"))
}

/// One bed of 31 spheres on several grids, over the law at each Reynolds number.
fn law_grid_figure(study: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "31 spheres, tau = 0.51: psi over the law against resolution",
        Axis::linear("(cell size/diameter)²").range(0.0, 0.0165),
        Axis::linear("psi over Beetstra et al.").range(0.75, 1.15),
    );
    let bed = steady(study, Preset::DHumieres.word())?
        .with(&[("packing", "random 3"), ("tau", "0.51")])?;
    for reynolds in ["1", "10", "30", "100"] {
        let own = bed.with(&[("seed", "1"), ("Re_wanted", reynolds)])?;
        let cells = own.numbers("cells_per_diameter")?.into_iter().map(|d| d.powi(-2));
        let mut points: Vec<_> = cells.zip(over_law(&own)?).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        figure = figure.with(Series::line_points(format!("Re about {reynolds}"), points));
    }
    Ok(figure
        .note("8 cells per diameter are at 0.0156, 12 at 0.0069, 16 at 0.0039; other beds of 31 scatter by 6 %"))
}

/// What the relaxation time does.
fn tau_figure(study: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "Resistance of a bed of 31 spheres at 8 cells per diameter, Re about 1",
        Axis::log("tau - 1/2").range(0.0025, 0.6),
        Axis::log("psi Re"),
    );
    for (collision, weighting, label) in [
        (Preset::DHumieres.word(), "noble_torczynski", "MRT, B(epsilon, tau)"),
        (Preset::Srt.word(), "noble_torczynski", "SRT, B(epsilon, tau)"),
        (Preset::DHumieres.word(), "solid_fraction", "MRT, B = epsilon"),
    ] {
        let points = taus(study, collision, weighting)?;
        let points = points.into_iter().map(|(tau, psi_re)| (tau - 0.5, psi_re)).collect();
        figure = figure.with(Series::line_points(label, points));
    }
    let across = |y: f64| vec![(0.0025, y), (0.6, y)];
    Ok(figure
        .with(Series::dashed("Carman-Kozeny: 180", across(180.0)))
        .with(Series::dashed("Blake-Kozeny: 150", across(150.0)))
        .note("the permeability d² porosity³/((1 - porosity)² psi Re) falls as psi Re rises"))
}

/// How fast flows are stable.
fn stability_figure(stability: &Table, inlet: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "Largest stable Re in a bed of nine spheres at 8 cells per diameter",
        Axis::log("tau - 1/2").range(0.0008, 0.2),
        Axis::log("Re = U d/(nu (1 - porosity))").range(1.0, 500.0),
    );
    for (collision, weighting, label) in [
        (Preset::Srt.word(), "noble_torczynski", "SRT, B(epsilon, tau)"),
        (Preset::DHumieres.word(), "noble_torczynski", "MRT, B(epsilon, tau)"),
        (Preset::Trt.word(), "noble_torczynski", "Lambda = 3/16, B(epsilon, tau)"),
        (Preset::Srt.word(), "solid_fraction", "SRT, B = epsilon"),
        (Preset::DHumieres.word(), "solid_fraction", "MRT, B = epsilon"),
    ] {
        let points = limits(stability, "reference", collision, weighting, "8.0000")?;
        figure = figure.with(Series::line_points(label, points));
    }
    let across = |y: f64| vec![(0.0008, y), (0.2, y)];
    let doubling = |bed| {
        let taus = (0..=40).map(|i| 0.0008 * 250.0_f64.powf(f64::from(i) / 40.0));
        let curve = taus.map(|above| (above, inlet::doubling(above, bed)));
        curve.filter(|p| p.1 < 500.0).collect::<Vec<_>>()
    };
    // Rings for SRT, crosses for MRT.
    let kinds = [
        (Preset::Srt.word(), "SRT", Marker::Ring),
        (Preset::DHumieres.word(), "MRT", Marker::Cross),
    ];
    for (cells, colours, label) in
        [("8.0000", [0, 1], "single precision"), ("16.0000", [5, 5], "16 cells, single precision")]
    {
        for ((collision, name, marker), colour) in kinds.into_iter().zip(colours) {
            let points = limits(stability, "wgpu", collision, "noble_torczynski", cells)?;
            if !points.is_empty() {
                let series =
                    Series::new(format!("{name}, {label}"), Style::Points(Some(marker)), points);
                figure = figure.with(series.with_colour(colour));
            }
        }
    }
    for (collision, name, marker) in kinds {
        let points = inlet::limits(inlet, "wgpu", collision)?;
        let series = Series::new(format!("{name}, by inlet"), Style::Points(Some(marker)), points);
        figure = figure.with(series.with_colour(6));
    }
    Ok(figure
        .with(Series::dashed("twice the density: paper", doubling(inlet::PAPER)).with_colour(6))
        .with(Series::line("twice the density: inlet.toml", doubling(inlet::SMALL)).with_colour(6))
        .with(Series::dashed("the paper, MRT: 30", across(30.0)).with_colour(1))
        .with(Series::dashed("the paper, SRT: 2", across(2.0)).with_colour(0))
        .note("points: the next run, with twice the force, was stopped, or Re was past 200 already")
        .note("by inlet: last stable Re of inlet.toml; twice the density: where the pressure under a bed makes it"))
}

/// The largest stable Re against tau - 1/2.
fn limits(
    stability: &Table,
    engine: &str,
    collision: &str,
    weighting: &str,
    cells: &str,
) -> Result<Vec<(f64, f64)>, CaseError> {
    let own = stability.with(&[
        ("engine", engine),
        ("collision", collision),
        ("weighting", weighting),
        ("cells_per_diameter", cells),
    ])?;
    let mut points = Vec::new();
    for tau in own.values("tau")? {
        let stable = largest_stable(&own, &[("tau", &tau)])?;
        // The force was doubled until a run was stopped, or Re was past 200.
        let all = own.with(&[("tau", &tau)])?;
        let is_whole =
            stable > 200.0 || all.with(&[("outcome", "stable")])?.rows.len() < all.rows.len();
        if stable > 0.0 && is_whole {
            points.push((tau.parse().map_or(f64::NAN, |tau: f64| tau - 0.5), stable));
        }
    }
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(points)
}
