//! A sphere in a stream, in the paper's box, at Reynolds numbers from 0.1 to 100.

use std::path::Path;

use psmrt::engine::EngineName;
use psmrt_reference::collision::Preset;

use super::OPERATORS;
use super::set::{Set, begin};
use crate::cases::{Bench, CaseError, Stream, Study};

/// Reynolds number and relaxation times, the first of them for both grids.
pub const STREAMS: [(f64, [f64; 3]); 6] = [
    (0.1, [0.7, 0.6, 1.0]),
    (1.0, [0.7, 0.6, 1.0]),
    (10.0, [0.6, 0.55, 0.7]),
    (30.0, [0.54, 0.52, 0.56]),
    (50.0, [0.53, 0.515, 0.54]),
    (100.0, [0.515, 0.508, 0.525]),
];

pub(super) const SET: Set = Set {
    name: "stream",
    about: &[
        "A sphere in a stream (golden/sphere_drag/scene.toml) with each operator of the solid; weight: the operator's own",
        "default. The columns after the operator are those of golden/sphere_drag/study.csv, where they are explained.",
        "Steady: 3e-5 of the force is left to go.",
    ],
    make,
};

fn make(golden: &Path, file: &Path, tell: &dyn Fn(&str)) -> Result<(), CaseError> {
    begin(&SET, file, &[&["operator"][..], &Stream::COLUMNS].concat())?;
    let study = Study::new(file);
    let bench = |engine| Bench::new(golden, engine, None, |_| {});
    let (mut double, mut single) = (bench(EngineName::Cpu), bench(EngineName::CpuSingle));
    for (engine, stream) in runs() {
        let bench = if engine.is_double() { &mut double } else { &mut single };
        let start = format!("{},{},", stream.operator, stream.start(engine.word()).join(","));
        if study.row(&start)?.is_some() {
            continue;
        }
        let row = format!("{},{}", stream.operator, stream.row(bench)?.join(","));
        study.add(&row)?;
        tell(&row);
    }
    Ok(())
}

/// The runs, the cheap ones first.
fn runs() -> Vec<(EngineName, Stream)> {
    let stream = |reynolds, tau, cells, collision, operator| {
        let (width, tolerance) = (5.0, 3e-5);
        Stream { collision, operator, reynolds, cells, tau, width, tolerance }
    };
    let mut runs = Vec::new();
    let mut add = |engine, cells, collision, taus: &[usize]| {
        for (reynolds, all) in STREAMS {
            for tau in taus.iter().map(|&number| all[number]) {
                let one = |operator| (engine, stream(reynolds, tau, cells, collision, operator));
                runs.extend(OPERATORS.map(one));
            }
        }
    };
    for cells in [6, 8] {
        add(EngineName::Cpu, cells, Preset::DHumieres, &[0]);
    }
    add(EngineName::CpuSingle, 6, Preset::DHumieres, &[0]);
    add(EngineName::Cpu, 6, Preset::DHumieres, &[1, 2]);
    add(EngineName::Cpu, 6, Preset::Srt, &[0]);
    runs
}
