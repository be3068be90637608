//! Ten Cate's settling sphere with the implicit coupling of full bounce-back, beside the paper's operator.

use std::path::Path;

use psmrt::engine::EngineName;
use psmrt::table::Table;

use super::set::{Set, begin};
use super::{BOUNCE_BACK, FULL};
use crate::cases::ten_cate::{HALF_WIDTH, HEIGHT, SI_DIAMETER, differences, measured};
use crate::cases::{Bench, CaseError, Study};

/// Experiments with the relaxation times of `golden/ten_cate/study.csv`, and one further away.
const FALLS: [(&str, [f64; 2]); 2] = [("E1", [0.8, 1.2]), ("E4", [0.55, 0.6])];

pub(super) const SET: Set = Set {
    name: "ten_cate",
    about: &[
        "Ten Cate's sphere (golden/ten_cate/scene.toml, the oil by literature.csv there) with the operators that a free grain may",
        "have, at the relaxation times of golden/ten_cate/study.csv and a larger one each. error_of_largest: of the largest",
        "velocity, against the measured one. velocity_rms: root mean square of the velocity's difference above a gap of one",
        "diameter, over the largest measured one.",
    ],
    make,
};

const COLUMNS: [&str; 9] = [
    "case",
    "operator",
    "engine",
    "cells_per_diameter",
    "tau",
    "error_of_largest",
    "velocity_rms",
    "steps",
    "cell_updates",
];

fn make(golden: &Path, file: &Path, tell: &dyn Fn(&str)) -> Result<(), CaseError> {
    begin(&SET, file, &COLUMNS)?;
    let study = Study::new(file);
    let mut bench = Bench::new(golden, EngineName::Cpu, None, |_| {});
    let published = bench.literature("ten_cate", "literature.csv")?;
    let curves = bench.literature("ten_cate", "curves.csv")?;
    for cells in [6_u32, 8] {
        for (case, taus) in FALLS {
            for tau in taus {
                for operator in [BOUNCE_BACK, FULL] {
                    let engine = EngineName::Cpu.word();
                    let start = format!("{case},{operator},{engine},{cells},{tau},");
                    if study.row(&start)?.is_some() {
                        continue;
                    }
                    let oil = published.with(&[("case", case)])?;
                    let row =
                        start + &fall(&mut bench, (case, &oil), &curves, operator, (cells, tau))?;
                    study.add(&row)?;
                    tell(&row);
                }
            }
        }
    }
    Ok(())
}

/// The columns after the first five.
fn fall(
    bench: &mut Bench,
    (case, oil): (&str, &Table),
    curves: &Table,
    operator: &str,
    (cells, tau): (u32, f64),
) -> Result<String, CaseError> {
    let (density, si_largest) = (oil.number("rho_f")?, oil.number("umax_exp_m_s")?);
    let d = f64::from(cells);
    let [half, height] = [HALF_WIDTH, HEIGHT].map(|length| (length * d).round());
    let changes = [
        format!("domain.dx={:e}", SI_DIAMETER / d),
        format!("domain.cells=[{half}, {half}, {height}]"),
        format!("fluid.density={density}"),
        format!("fluid.kinematic_viscosity={:e}", oil.number("mu_Pa_s")? / density),
        format!("time.tau={tau}"),
        format!("solid.operator=\"{operator}\""),
        // Until it is at the bottom: 8 diameters at the largest velocity, and half as long again for the start.
        format!("stop.time={:.3}", 12.0 * SI_DIAMETER / si_largest),
    ];
    let before = bench.cell_updates();
    let (run, _) = bench.run("ten_cate/scene.toml", &changes)?;
    let rows = run.record("sphere")?;
    let course: Vec<(f64, f64)> = rows.points("time (s)", "velocity_z (m/s)")?;
    let course: Vec<(f64, f64)> = course.into_iter().map(|(time, v)| (time, -v)).collect();
    let gaps = rows.numbers("z (m)")?;
    let above = gaps.iter().take_while(|z| **z / SI_DIAMETER - 0.5 >= 1.0).count();
    let fastest = course.iter().map(|point| point.1).fold(0.0, f64::max);
    let off = differences(&course[..above], &measured(curves, case, "velocity_m_s")?);
    let squares = off.iter().map(|point| point.1.powi(2)).sum::<f64>();
    let rms = (squares / off.len() as f64).sqrt() / si_largest;
    let (made, steps) = (bench.cell_updates() - before, run.engine.steps());
    Ok(format!("{:.4},{rms:.4},{steps},{made}", fastest / si_largest - 1.0))
}
