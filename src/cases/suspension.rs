//! Random suspensions that settle, against Richardson and Zaki.

use psmrt_report::{Axis, Figure, Series};

use super::{Bench, Case, CaseError, Claim, Golden, Table};

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
         relaxation time is 0.55. These are results of the full form on the oracle (study.csv); `cargo \
         test` repeats three placements.",
    ],
    scenes: &[],
    literature: &["far_field.csv"],
    rows: "study.csv",
    units: "velocity and far fields over Stokes' velocity of one sphere alone",
    full: "cargo run --release --example suspension_study made these rows; hours, and it can be cut off",
    measure,
    judge,
    draw,
};

const EXPONENTS: [f64; 2] = [4.65, 5.1];

/// Solid fraction and the relaxation time that is judged.
const JUDGED: [(&str, &str); 5] =
    [("0.02", "0.7"), ("0.05", "0.7"), ("0.1", "0.7"), ("0.2", "0.55"), ("0.3", "0.55")];

/// The quick form is the test `tests/suspension.rs`; here its committed full form is judged.
fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    bench.literature(CASE.name, CASE.rows)
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

fn judge(_: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    JUDGED
        .into_iter()
        .map(|(wanted, tau)| {
            let (phi, values) = estimates(rows, wanted, tau)?;
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let [upper, lower] = EXPONENTS.map(|n| (1.0 - phi).powf(n));
            let (below, why) = if phi < 0.15 {
                (0.95, "between the two exponents, and 5 % beyond for the scatter of two or three placements")
            } else {
                (
                    0.9,
                    "spheres just put down at random settle more slowly than the suspensions of the experiments, \
                     whose structure is that of settling; and the ratio of far fields is rough where spheres \
                     nearly touch",
                )
            };
            Ok(Claim {
                what: format!("solid fraction {wanted}: velocity over that of one grain alone"),
                measured: mean,
                allowed: below * lower..=1.05 * upper,
                why,
            })
        })
        .collect()
}

fn draw(_: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let mut figure = Figure::new(
        "Hindered settling",
        Axis::linear("solid fraction").range(0.0, 0.35),
        Axis::linear("velocity over that of one grain alone").range(0.0, 1.0),
    );
    for n in EXPONENTS {
        let curve = (0..=35).map(|i| f64::from(i) / 100.0).map(|phi| (phi, (1.0 - phi).powf(n)));
        figure = figure.with(Series::line(format!("(1 - phi)^{n}"), curve.collect()));
    }
    let mut points = Vec::new();
    for (wanted, tau) in JUDGED {
        let (phi, values) = estimates(rows, wanted, tau)?;
        points.extend(values.into_iter().map(|value| (phi, value)));
    }
    let middle = |phi: f64| EXPONENTS.map(|n| (1.0 - phi).powf(n)).iter().sum::<f64>() / 2.0;
    figure = figure
        .with(Series::points("oracle, each placement", points.clone()))
        .with_panel(Axis::linear("over the middle of the two, - 1").range(-0.3, 0.3));
    for n in EXPONENTS {
        let curve = (0..=35).map(|i| f64::from(i) / 100.0);
        let curve = curve.map(|phi| (phi, (1.0 - phi).powf(n) / middle(phi) - 1.0));
        figure = figure.with(Series::line(format!("(1 - phi)^{n}"), curve.collect()));
    }
    let residual = points.into_iter().map(|(phi, value)| (phi, value / middle(phi) - 1.0));
    Ok(vec![figure.with(Series::points("oracle, each placement", residual.collect()))])
}
