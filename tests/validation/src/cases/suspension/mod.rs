//! Random suspensions that settle, against Richardson and Zaki.

use psmrt_report::{Axis, Figure, Marker, Series, Style};

use super::found::found;
use super::{Bench, Case, CaseError, Claim, Golden};
use psmrt::table::Table;

/// Hindered settling.
pub const CASE: Case = Case {
    name: "suspension",
    title: "Hindered settling of random suspensions",
    about: &[
        "Forty spheres at random places in a periodic box settle more slowly than one alone. So few in a \
         box add a correction of its own, which an independent program knows placement by placement: it \
         sums the far field of the same spheres over all images (far_field.py), and of an infinite \
         suspension the same far field has a closed form. Shown is the velocity found, times the ratio of \
         the two, beside Richardson and Zaki's (1 - phi)^n with n = 4.65 (Richardson & Zaki 1954) and 5.1 \
         (Garside & Al-Dibouni 1977).",
        "Six cells per diameter; the denser, the more the leaking of the spheres counts, so from 0.2 on the \
         relaxation time is 0.55. study.csv holds the full form on the oracle, scene.toml one of its placements at a \
         fraction of 0.2, at the quicker relaxation time 0.7, which each engine repeats.",
    ],
    scenes: &["scene.toml"],
    literature: &["far_field.csv"],
    rows: "expected.csv",
    studies: &["study.csv"],
    units: "velocity and far fields over Stokes' velocity of one sphere alone",
    full: "cargo run --release -p psmrt-validation --example suspension_study made study.csv; hours, and it can be cut off",
    measure,
    judge,
    draw,
};

const EXPONENTS: [f64; 2] = [4.65, 5.1];

/// Solid fraction and the relaxation time that is judged.
const JUDGED: [(&str, &str); 5] =
    [("0.02", "0.7"), ("0.05", "0.7"), ("0.1", "0.7"), ("0.2", "0.55"), ("0.3", "0.55")];

/// Velocity of one grain of the scene alone by Stokes' law, m/s.
const SI_ALONE: f64 = 4.1667e-4;

/// Seed and solid fraction of the scene, as the far field's table spells them.
const SCENE: [(&str, &str); 3] =
    [("wanted_solid_fraction", "0.2"), ("grains", "40"), ("seed", "1")];

fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    let (run, _) = bench.run("suspension/scene.toml", &[])?;
    let last = |record: &str, column: &str| -> Result<f64, CaseError> {
        let values = run.record(record)?.numbers(column)?;
        Ok(values.last().copied().unwrap_or(f64::NAN))
    };
    // Relative to the volume of grains and fluid together.
    let volume = last("box", "superficial_velocity_z (m/s)")?;
    let velocity = (volume - last("means", "velocity_z (m/s)")?) / SI_ALONE;
    let far = bench.literature(CASE.name, "far_field.csv")?.with(&SCENE)?;
    let infinite = velocity / far.number("periodic_box")? * far.number("infinite")?;
    let mut table = Table::new(&["engine", "solid_fraction", "velocity", "velocity_infinite"]);
    let fraction = format!("{:.6}", far.number("solid_fraction")?);
    let word = bench.engine_name().word().to_owned();
    table.add(vec![word, fraction, format!("{velocity:.5}"), format!("{infinite:.5}")]);
    Ok(table)
}

/// Solid fraction, and the velocity of an infinite suspension from each placement.
fn estimates(rows: &Table, wanted: &str, tau: &str) -> Result<(f64, Vec<f64>), CaseError> {
    let own = rows.with(&[("wanted_solid_fraction", wanted), ("tau", tau), ("grains", "40")])?;
    let fractions = own.numbers("solid_fraction")?;
    let [found, periodic, infinite] = [
        own.numbers("velocity")?,
        own.numbers("far_field_box")?,
        own.numbers("far_field_infinite")?,
    ];
    let each = found.iter().zip(&periodic).zip(&infinite);
    let values = each.map(|((found, periodic), infinite)| found / periodic * infinite).collect();
    Ok((fractions.first().copied().unwrap_or(f64::NAN), values))
}

/// The mean of several placements, and its standard error.
fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
    (mean, (squares / (n - 1.0) / n).sqrt())
}

/// What the figure calls its points.
const EACH: &str = "oracle, each placement";
const MEAN: &str = "mean of the placements";
const RING: Style = Style::Points(Some(Marker::Ring));

/// What dense suspensions may fall below the laws by, and why.
const DENSE: (f64, &str) = (
    0.9,
    "spheres just put down at random settle more slowly than the suspensions of the experiments, whose structure is \
     that of settling; and the ratio of far fields is rough where spheres nearly touch",
);

/// The two laws at a solid fraction.
fn laws(phi: f64) -> [f64; 2] {
    EXPONENTS.map(|n| (1.0 - phi).powf(n))
}

fn judge(golden: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    for engine in rows.values("engine")? {
        let own = rows.with(&[("engine", &engine)])?;
        let [upper, lower] = laws(own.number("solid_fraction")?);
        claims.push(Claim {
            what: format!(
                "{engine}: solid fraction 0.2, one placement: velocity over that of one grain alone"
            ),
            measured: own.number("velocity_infinite")?,
            allowed: DENSE.0 * lower..=1.05 * upper,
            why: "as for the study's dense suspensions (below); at this tau, 0.7, the spheres leak so much more than at its 0.55 \
                  that the same placement settles 9 % faster, which is why it comes closer to the laws",
        });
    }
    claims.extend(full_claims(&golden.table("study.csv")?)?);
    Ok(claims)
}

/// What is claimed of the study.
fn full_claims(study: &Table) -> Result<Vec<Claim>, CaseError> {
    JUDGED
        .into_iter()
        .map(|(wanted, tau)| {
            let (phi, values) = estimates(study, wanted, tau)?;
            let (mean, _) = mean_and_error(&values);
            let [upper, lower] = laws(phi);
            let (below, why) = if phi < 0.15 {
                (0.95, "between the two exponents, and 5 % beyond for the scatter of two or three placements")
            } else {
                DENSE
            };
            Ok(Claim {
                what: format!("study: solid fraction {wanted}: velocity over that of one grain alone"),
                measured: mean,
                allowed: below * lower..=1.05 * upper,
                why,
            })
        })
        .collect()
}

fn draw(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let study = golden.table("study.csv")?;
    let mut figure = Figure::new(
        "Hindered settling",
        Axis::linear("solid fraction").range(0.0, 0.35),
        Axis::linear("velocity over that of one grain alone").range(0.0, 1.0),
    );
    for n in EXPONENTS {
        let curve = (0..=35).map(|i| f64::from(i) / 100.0).map(|phi| (phi, (1.0 - phi).powf(n)));
        figure = figure.with(Series::line(format!("(1 - phi)^{n}"), curve.collect()));
    }
    let (mut points, mut means, mut errors) = (Vec::new(), Vec::new(), Vec::new());
    for (wanted, tau) in JUDGED {
        let (phi, values) = estimates(&study, wanted, tau)?;
        let (mean, error) = mean_and_error(&values);
        means.push((phi, mean));
        errors.push(error);
        points.extend(values.into_iter().map(|value| (phi, value)));
    }
    let middle = |phi: f64| laws(phi).iter().sum::<f64>() / 2.0;
    figure = figure
        .with(Series::points(EACH, points.clone()))
        .with(Series::new(MEAN, RING, means.clone()).with_errors(errors.clone()));
    let quick = |scale: &dyn Fn(f64) -> f64| -> Result<Vec<Series>, CaseError> {
        let each = rows.values("engine")?.into_iter().map(|engine| {
            let own =
                rows.with(&[("engine", &engine)])?.points("solid_fraction", "velocity_infinite")?;
            let points = own.into_iter().map(|(phi, value)| (phi, value / scale(phi))).collect();
            Ok(found("scene.toml", &engine, points, None))
        });
        each.collect()
    };
    figure = quick(&|_| 1.0)?
        .into_iter()
        .fold(figure, Figure::with)
        .with_panel(Axis::linear("over the middle of the two, - 1").range(-0.3, 0.3));
    for n in EXPONENTS {
        let curve = (0..=35).map(|i| f64::from(i) / 100.0);
        let curve = curve.map(|phi| (phi, (1.0 - phi).powf(n) / middle(phi) - 1.0));
        figure = figure.with(Series::line(format!("(1 - phi)^{n}"), curve.collect()));
    }
    let residual = |points: Vec<(f64, f64)>| {
        points.into_iter().map(|(phi, value)| (phi, value / middle(phi) - 1.0)).collect()
    };
    let bars = means.iter().zip(errors).map(|(mean, error)| error / middle(mean.0)).collect();
    figure = figure
        .with(Series::points(EACH, residual(points)))
        .with(Series::new(MEAN, RING, residual(means)).with_errors(bars));
    for series in quick(&middle)? {
        let points = series.points.iter().map(|&(phi, ratio)| (phi, ratio - 1.0)).collect();
        figure = figure.with(Series { points, ..series });
    }
    Ok(vec![figure.note(
        "bars: standard error over the two or three placements; the exponents are stated without uncertainty. From 0.2 on tau = 0.55; scene.toml: 0.7",
    )])
}
