//! The full form of ten Cate's settling sphere: four experiments at 8, 12 and 16 cells per diameter.
//!
//! Adds one row per fall to `golden/ten_cate/study.csv`, and its course to `golden/ten_cate/falls.csv`,
//! as it goes; falls that have a row are left out, so that it can be cut off and started again. Hours
//! on two cores, most of them for 16 cells.
//!
//! ```text
//! cargo run --release -p psmrt-validation --example ten_cate_study
//! ```
//!
//! With the folder of a run of `golden/ten_cate/scene.toml` and the name of its experiment it adds that run's row
//! instead, whatever engine made it:
//!
//! ```text
//! cargo run --release -p psmrt-validation --example ten_cate_study out/e1_16 E1
//! ```

#![allow(dead_code, reason = "the tests use more of the shared modules")]

#[path = "../../common/mod.rs"]
mod common;

use common::settling::{Experiment, Fall, Moment, compare};
use psmrt::scene::{EngineKind, Scene};
use psmrt::table::Table;
use psmrt_validation::cases::Study;
use std::error::Error;
use std::io;
use std::path::Path;

const STUDY: &str = "golden/ten_cate/study.csv";
const FALLS: &str = "golden/ten_cate/falls.csv";

/// Experiment and relaxation time, the same on all grids: so that the largest velocity at 8 cells is
/// between 0.02 and 0.07 cells per step, and the error of the drag by leaking stays small.
const CASES: [(&str, f64); 4] = [("E4", 0.55), ("E3", 0.58), ("E2", 0.65), ("E1", 0.8)];

/// Moments of a fall that are kept.
const KEPT: usize = 150;

fn main() -> Result<(), Box<dyn Error>> {
    if let [_, folder, name] = &std::env::args().collect::<Vec<_>>()[..] {
        return add_run(Path::new(folder), name);
    }
    for cells in [8, 12, 16] {
        for (name, tau) in CASES {
            let start = format!("{name},{cells},{tau},");
            if Study::new(STUDY).row(&start)?.is_some() {
                continue;
            }
            let experiment = Experiment::named(name);
            let mut fall = Fall::new(&experiment, f64::from(cells), tau);
            let path = until_it_touches(&mut fall)?;
            let fluid = fall.solver.fluid();
            let made = (fluid.domain().cell_count(), fluid.steps(), "reference");
            add(&experiment, &start, &path, made)?;
        }
    }
    Ok(())
}

/// Adds the fall of a run's record, until the gap is 1/250 of the diameter.
fn add_run(folder: &Path, name: &str) -> Result<(), Box<dyn Error>> {
    let scene = Scene::load(&folder.join("scene.toml"), &[])?;
    let experiment = Experiment::named(name);
    let cells = (experiment.si_diameter / scene.units.si_dx).round();
    let start = format!("{name},{cells},{},", scene.setup.collision.tau());
    let rows = Table::read(&folder.join("sphere.csv"))?;
    let (times, heights) = (rows.numbers("time (s)")?, rows.numbers("z (m)")?);
    let velocities = rows.numbers("velocity_z (m/s)")?;
    let moments = times.iter().zip(&heights).zip(&velocities).map(|((time, z), velocity)| Moment {
        si_time: *time,
        gap: z / experiment.si_diameter - 0.5,
        si_velocity: -velocity,
    });
    let all: Vec<Moment> = moments.collect();
    let touches = all.iter().position(|moment| moment.gap <= 0.004);
    let touches =
        touches.ok_or("the run ends before the sphere is at the bottom: raise stop.time")?;
    #[expect(clippy::cast_possible_truncation, reason = "below a million")]
    #[expect(clippy::cast_sign_loss, reason = "time goes forwards")]
    let steps = (all[touches].si_time / scene.units.si_dt).round() as u64;
    let engine = if scene.engine == EngineKind::Wgpu { "wgpu" } else { "reference" };
    let made = (scene.setup.domain.cell_count(), steps, engine);
    Ok(add(&experiment, &start, &all[..=touches], made)?)
}

/// Adds a fall's row and its course; `made` are cells, steps and engine.
fn add(
    experiment: &Experiment,
    start: &str,
    path: &[Moment],
    (cells, steps, engine): (usize, u64, &str),
) -> io::Result<()> {
    let kept: String = path
        .iter()
        .step_by(path.len().div_ceil(KEPT))
        .map(|m| format!("{start}{:.5},{:.5},{:.6}\n", m.si_time, m.gap, m.si_velocity))
        .collect();
    Study::new(FALLS).add(&kept)?;
    let found = compare(experiment, path);
    let row = format!(
        "{start}{cells},{steps},{:.5},{:.4},{:.4},{:.4},{:.4},{:.4},{:.4},{engine}",
        experiment.si_largest * (1.0 + found.largest),
        found.largest,
        found.velocity,
        found.gap_offset,
        found.gap,
        found.si_delay,
        found.braking,
    );
    Study::new(STUDY).add(&row)?;
    println!("{row}");
    Ok(())
}

/// The fall until the gap is 1/500 of the diameter.
fn until_it_touches(fall: &mut Fall) -> io::Result<Vec<Moment>> {
    let mut path = vec![fall.moment()];
    while path.last().is_none_or(|moment| moment.gap > 0.002) {
        fall.solver.step().map_err(io::Error::other)?;
        path.push(fall.moment());
    }
    Ok(path)
}
