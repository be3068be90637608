//! A sphere that settles in a tank, against measured curves.

pub(super) mod figures;
pub(super) mod study;

use psmrt_report::Figure;

use super::{Bench, Case, CaseError, Claim, Golden};
use psmrt::table::Table;

/// Ten Cate's settling sphere.
pub const CASE: Case = Case {
    name: "ten_cate",
    title: "A sphere settles in a tank (ten Cate et al. 2002)",
    about: &[
        "A sphere of 15 mm is let go in a tank of silicone oil, 100 x 100 x 160 mm; four oils give Reynolds \
         numbers of 1.5, 4.1, 11.6 and 31.9. Measured curves of velocity and gap, digitised to about 2 % of \
         the largest velocity and 0.05 diameters: these are the error bars. The experiment's own uncertainty is \
         not in the data that we hold.",
        "The quick form lets the sphere of Re 31.9 fall the whole way on 6 cells per diameter, on each engine. The falls \
         of the study, at 8, 12 and 16 cells, are committed: study.csv says which engine made each, falls.csv holds \
         their courses.",
        "What does not agree: at Re 1.5 the sphere falls more slowly than measured, by 0.5, 2.9 and 3.7 % on the three grids \
         and 4.8 % extrapolated, away from the measurement with each refinement; ten Cate's own lattice Boltzmann \
         computation is 5.6 % below. And all measured spheres lag by 0.15 to 0.4 diameters, from the first points on, \
         which stand at gaps of 8.1 to 8.2 where 8 was set, so that they seem to brake 0.03 to 0.2 s late.",
    ],
    scenes: &["scene.toml"],
    literature: &["literature.csv", "curves.csv"],
    rows: "expected.csv",
    studies: &["study.csv", "falls.csv"],
    units: "time_s in seconds; gap_over_d in diameters; velocity_m_s in m/s, upwards",
    full: "cargo validate report --full --case ten_cate takes the 8 cells of scene.toml; cargo run --release -p psmrt-validation --example ten_cate_study made study.csv and falls.csv (hours; it can be cut off)",
    measure,
    judge,
    draw,
};

/// The experiments and their Reynolds numbers.
pub(super) const EXPERIMENTS: [(&str, &str); 4] =
    [("E1", "1.5"), ("E2", "4.1"), ("E3", "11.6"), ("E4", "31.9")];

/// The experiment of the scene.
pub(super) const OWN: &str = "E4";

/// Diameter, m, and half the width and the height of the tank in diameters.
pub(super) const SI_DIAMETER: f64 = 0.015;
pub(super) const HALF_WIDTH: f64 = 50.0 / 15.0;
pub(super) const HEIGHT: f64 = 160.0 / 15.0;

/// Gap over the diameter at which a fall has ended.
const TOUCHES: f64 = 0.004;

fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    let cells = if bench.is_full() { 8.0 } else { 6.0 };
    let [half, height] = [HALF_WIDTH, HEIGHT].map(|length| (length * cells).round());
    let changes = [
        format!("domain.dx={:e}", SI_DIAMETER / cells),
        format!("domain.cells=[{half}, {half}, {height}]"),
    ];
    let (run, _) = bench.run("ten_cate/scene.toml", &changes)?;
    let loads = run.record("sphere")?;
    let (heights, velocities) = (loads.numbers("z (m)")?, loads.numbers("velocity_z (m/s)")?);
    let mut table =
        Table::new(&["engine", "cells_per_diameter", "time_s", "gap_over_d", "velocity_m_s"]);
    for ((time, height), velocity) in loads.numbers("time (s)")?.iter().zip(heights).zip(velocities)
    {
        let gap = height / SI_DIAMETER - 0.5;
        if gap <= TOUCHES {
            break;
        }
        table.add(vec![
            bench.engine_name().word().to_owned(),
            cells.to_string(),
            format!("{time:.5}"),
            format!("{gap:.5}"),
            format!("{:.6}", -velocity),
        ]);
    }
    Ok(table)
}

/// The measured points of an experiment, velocities downwards.
pub(super) fn measured(
    curves: &Table,
    case: &str,
    quantity: &str,
) -> Result<Vec<(f64, f64)>, CaseError> {
    let own = curves.with(&[("case", case), ("quantity", quantity)])?.points("t_s", "value")?;
    Ok(own.into_iter().map(|(time, value)| (time, value.abs())).collect())
}

/// Time and `computed - measured` at the measured points that the computed course reaches.
pub(super) fn differences(computed: &[(f64, f64)], measured: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let off = |&(time, value): &(f64, f64)| Some((time, interpolate(computed, time)? - value));
    measured.iter().filter_map(off).collect()
}

/// A curve at `x`, which lies between two of its points.
fn interpolate(curve: &[(f64, f64)], x: f64) -> Option<f64> {
    let pair = curve.windows(2).find(|pair| pair[0].0 <= x && x <= pair[1].0)?;
    let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
    Some(y0 + (y1 - y0) * (x - x0) / (x1 - x0))
}

fn judge(golden: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let (published, curves) = (golden.table("literature.csv")?, golden.table("curves.csv")?);
    let largest = published.with(&[("case", OWN)])?.number("umax_exp_m_s")?;
    let measured = measured(&curves, OWN, "velocity_m_s")?;
    let mut claims = Vec::new();
    for engine in rows.values("engine")? {
        let own = rows.with(&[("engine", &engine)])?;
        let course = own.points("time_s", "velocity_m_s")?;
        let fastest = course.iter().map(|point| point.1).fold(0.0, f64::max);
        claims.push(Claim {
            what: format!("{engine}: {OWN} (Re 31.9): error of the largest velocity"),
            measured: fastest / largest - 1.0,
            allowed: -0.03..=0.03,
            why: "measured; the velocity of the published curve and its largest value differ by 0.5 %, digitised to 2 %. A \
                  sphere of 6 cells in a stream of Re 30 has the drag of one of 8 within 0.1 %, both 2 % too much \
                  (golden/sphere_drag/study.csv), which is 1 % of the velocity",
        });
        // Below a gap of one diameter it brakes.
        let above = own.numbers("gap_over_d")?.iter().filter(|gap| **gap >= 1.0).count();
        let off = differences(&course[..above], &measured);
        let squares = off.iter().map(|point| point.1.powi(2)).sum::<f64>();
        claims.push(Claim {
            what: format!("{engine}: {OWN}: velocity above a gap of one diameter, rms of the difference over the largest"),
            measured: (squares / off.len() as f64).sqrt() / largest,
            allowed: 0.0..=0.05,
            why: study::VELOCITY,
        });
    }
    claims.extend(study::claims(&golden.table("study.csv")?, &published)?);
    Ok(claims)
}

fn draw(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    figures::all(golden, rows)
}
