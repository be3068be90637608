//! The paper's section 5 at its own size: a sphere of 30 cells in a stream, in a box of 150 x 300 x 150 cells.
//!
//! Adds one row per run to `golden/sphere_drag/paper.csv` as it goes; runs that have a row are left out, so that it can
//! be cut off and started again. Under an hour on two cores.
//!
//! ```text
//! cargo run --release -p psmrt-validation --example paper_drag
//! ```

use std::error::Error;
use std::fs;
use std::path::Path;

use psmrt::engine::EngineName;
use psmrt_reference::collision::Preset;
use psmrt_validation::cases::{Bench, Stream, Study};

const TABLE: &str = "golden/sphere_drag/paper.csv";

/// What stands at the head of the table when it is begun.
const HEAD: &str = "\
# Drag of a sphere in a stream at the size of the paper's section 5, 30 cells per diameter in 150 x 300 x 150 cells (a
# quarter is computed): cargo run --release -p psmrt-validation --example paper_drag
# Columns as in study.csv. The paper's operator (bounce-back of the non-equilibrium part, SC1), Noble and Torczynski's
# weight, exact coverage; the CPU engine in single precision. Steady: what is left to go is below 1e-3 of the
# force (1e-4 in the first row).
engine,collision,Re,cells_per_diameter,tau,width_d,outcome,CD,K,flux_over_inlet,lattice_velocity,max_speed,steps,cell_updates,change,left
";

/// Reynolds numbers, each with relaxation times: the larger ones take fewer steps, and bring the velocity nearer to where
/// it breaks (at most 0.07 cells per step).
const STREAMS: [(f64, &[f64]); 7] = [
    (100.0, &[0.55, 0.53]),
    (10.0, &[0.7, 0.55]),
    (1.0, &[1.0, 0.6]),
    (0.1, &[1.0, 0.6]),
    (150.0, &[0.53, 0.52]),
    (50.0, &[0.6]),
    (30.0, &[0.6]),
];

fn main() -> Result<(), Box<dyn Error>> {
    if !Path::new(TABLE).exists() {
        fs::write(TABLE, HEAD)?;
    }
    let mut bench = Bench::new(Path::new("golden"), EngineName::CpuSingle, None, |_| {});
    let study = Study::new(TABLE);
    let most = STREAMS.iter().map(|(_, taus)| taus.len()).max().unwrap_or(0);
    for number in 0..most {
        for (reynolds, taus) in STREAMS {
            let Some(&tau) = taus.get(number) else { continue };
            for collision in [Preset::DHumieres, Preset::Srt] {
                let stream = Stream {
                    operator: "bounce_back",
                    collision,
                    reynolds,
                    cells: 30,
                    tau,
                    width: 5.0,
                    tolerance: 1e-3,
                };
                let start = stream.start(bench.engine_name().word()).join(",") + ",";
                if study.row(&start)?.is_none() {
                    study.add(&stream.row(&mut bench)?.join(","))?;
                }
            }
        }
    }
    Ok(())
}
