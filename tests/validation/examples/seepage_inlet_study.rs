//! How fast water can enter a bed of spheres through a velocity inlet, with either collision:
//! `golden/seepage/inlet.toml` with other values.
//!
//! Adds one row per run to `golden/seepage/inlet.csv` as it goes; runs that have a row are left out. The
//! Reynolds number is doubled until the run is stopped or has no room left for its pressure.
//!
//! ```text
//! cargo run --release -p psmrt-validation --example seepage_inlet_study
//! ```

use psmrt_reference::collision::Preset;
use std::error::Error;
use std::path::Path;

use psmrt::engine::EngineName;
use psmrt::kernel::Gpu;
use psmrt::run::{End, RunError};
use psmrt::scene::preset_changes;
use psmrt_validation::cases::{Bench, CaseError, Study};

const STUDY: &str = "golden/seepage/inlet.csv";

/// Diameter, m, viscosity, m2/s, and solid fraction by which `inlet.toml` defines Re.
const SI_DIAMETER: f64 = 1.6e-4;
const SI_VISCOSITY: f64 = 1e-6;
const FRACTION: f64 = 0.6;

/// Relaxation times with the Reynolds numbers tried at each.
const LADDERS: [(f64, &[f64]); 3] = [
    (0.6, &[2.0, 4.0, 8.0, 16.0]),
    (0.55, &[8.0, 16.0, 32.0, 64.0]),
    (0.51, &[32.0, 64.0, 128.0, 256.0]),
];

fn main() -> Result<(), Box<dyn Error>> {
    let oracle = Bench::new(Path::new("golden"), EngineName::Reference, None, |_| {});
    let kernel = Bench::new(Path::new("golden"), EngineName::Wgpu, Some(Gpu::open(None)?), |_| {});
    for mut bench in [oracle, kernel] {
        for (tau, numbers) in LADDERS {
            // The oracle where the pressure is largest; the kernel, which is faster, everywhere.
            if bench.engine_name() == EngineName::Reference && tau < 0.6 {
                continue;
            }
            for collision in [Preset::Srt, Preset::DHumieres] {
                for &reynolds in numbers {
                    add(&mut bench, collision, tau, reynolds)?;
                }
            }
        }
    }
    Ok(())
}

fn add(
    bench: &mut Bench,
    collision: Preset,
    tau: f64,
    reynolds: f64,
) -> Result<(), Box<dyn Error>> {
    let mut row = format!("{},{},{tau},{reynolds},", bench.engine_name().word(), collision.word());
    let study = Study::new(STUDY);
    if study.row(&row)?.is_some() {
        return Ok(());
    }
    let velocity = reynolds * SI_VISCOSITY * FRACTION / SI_DIAMETER;
    let vector = format!("[0.0, 0.0, {velocity:e}]");
    let mut changes = vec![
        format!("time.tau={tau}"),
        format!("faces.z_low.velocity={vector}"),
        format!("initial.velocity={vector}"),
    ];
    changes.extend(preset_changes(collision));
    let lattice = reynolds * (tau - 0.5) / 3.0 * FRACTION / 8.0;
    row += &match bench.run("seepage/inlet.toml", &changes) {
        Err(CaseError::Run(RunError::Stopped(why))) => {
            format!("{},{lattice:.5},0,0,0,0", why.to_string().replace(',', ";"))
        }
        Err(error) => return Err(error.into()),
        Ok((run, end)) => {
            let rows = run.record("box")?;
            let density = rows.numbers("density (kg/m3)")?;
            let [.., before, last] = density[..] else { return Err("too few rows".into()) };
            let (steps, max) = (run.engine.steps(), run.engine.box_means().max_speed);
            let change = (last - before) / last;
            // What the scene's criterion asks of the force.
            let is_steady = matches!(end, End::Steady { .. }) && change.abs() < 1e-3;
            let outcome = if is_steady { "steady" } else { "drifts" };
            format!("{outcome},{lattice:.5},{steps},{:.4},{max:.4},{change:.1e}", last / 1000.0)
        }
    };
    study.add(&row)?;
    println!("{row}");
    Ok(())
}
