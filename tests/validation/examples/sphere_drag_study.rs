//! The full form of the sphere in a stream: resolution, relaxation time, collision, width of the box.
//!
//! Adds one row per run to `golden/sphere_drag/study.csv` as it goes; runs that have a row are left out, so
//! that it can be cut off and started again. An hour or two on one core, half of it for 16 cells per diameter;
//! the machine's cores share the work of each run. The long runs are the kernel's, twice as fast as the oracle
//! even on one core; two runs are made by both.
//!
//! ```text
//! cargo run --release -p psmrt-validation --example sphere_drag_study
//! ```

use psmrt::engine::EngineName;
use psmrt_reference::collision::Preset;
use std::error::Error;
use std::path::Path;

use psmrt::kernel::Gpu;
use psmrt_validation::cases::{Bench, Stream, Study};

const STUDY: &str = "golden/sphere_drag/study.csv";

/// Reynolds number and relaxation time, the same on all grids: the velocity falls with the cell size, and
/// is at most 0.07 cells per step at 8 cells per diameter.
const STREAMS: [(f64, f64); 7] = [
    (0.1, 0.7),
    (1.0, 0.7),
    (10.0, 0.6),
    (30.0, 0.54),
    (50.0, 0.53),
    (100.0, 0.515),
    (150.0, 0.51),
];

/// In the paper's box.
const PAPER: Stream = Stream {
    collision: Preset::DHumieres,
    operator: "bounce_back",
    reynolds: 0.1,
    cells: 6,
    tau: 0.7,
    width: 5.0,
    tolerance: 3e-5,
};

fn main() -> Result<(), Box<dyn Error>> {
    add_rows(
        &mut Bench::new(Path::new("golden"), EngineName::Reference, None, |_| {}),
        &oracle_runs(),
    )?;
    let gpu = Gpu::open(None)?;
    add_rows(
        &mut Bench::new(Path::new("golden"), EngineName::Wgpu, Some(gpu), |_| {}),
        &kernel_runs(),
    )
}

fn add_rows(bench: &mut Bench, runs: &[Stream]) -> Result<(), Box<dyn Error>> {
    let study = Study::new(STUDY);
    for stream in runs {
        let start = stream.start(bench.engine_name().word()).join(",") + ",";
        if study.row(&start)?.is_some() {
            continue;
        }
        let row = stream.row(bench)?.join(",");
        study.add(&row)?;
        println!("{row}");
    }
    Ok(())
}

/// In the paper's box, each Reynolds number at its relaxation time.
fn grid(cells: u32, collision: Preset, streams: &[(f64, f64)]) -> Vec<Stream> {
    let tolerance = if cells < 12 { 3e-5 } else { 1e-4 };
    let one = |&(reynolds, tau)| Stream { collision, reynolds, cells, tau, tolerance, ..PAPER };
    streams.iter().map(one).collect()
}

/// How much the box matters.
fn widths((reynolds, tau): (f64, f64), cells: u32, widths: &[f64]) -> Vec<Stream> {
    let one = |&width| Stream { reynolds, tau, cells, width, tolerance: 1e-4, ..PAPER };
    widths.iter().map(one).collect()
}

/// The oracle's runs, the cheap ones first.
fn oracle_runs() -> Vec<Stream> {
    let mut runs = Vec::new();
    runs.extend(grid(4, Preset::DHumieres, &STREAMS[..3]));
    runs.extend(grid(6, Preset::DHumieres, &STREAMS));
    runs.extend(grid(6, Preset::Srt, &STREAMS));
    runs.extend(grid(8, Preset::DHumieres, &[STREAMS[0], STREAMS[1], STREAMS[2], STREAMS[5]]));
    for stream in [STREAMS[2], STREAMS[0], STREAMS[1]] {
        runs.extend(widths(stream, 4, &[4.0, 6.0, 8.0, 10.0]));
    }
    runs.extend(widths(STREAMS[2], 6, &[4.0, 6.0]));
    runs.extend(widths(STREAMS[5], 6, &[4.0, 6.0, 8.0, 10.0]));
    // How much the relaxation time matters.
    for tau in [1.5, 1.0, 0.8, 0.7, 0.6, 0.55] {
        for collision in [Preset::DHumieres, Preset::Srt] {
            runs.push(Stream { tau, collision, cells: 4, tolerance: 3e-6, ..PAPER });
        }
    }
    runs
}

/// The kernel's runs: finer grids, wider boxes; the first two are the oracle's too.
fn kernel_runs() -> Vec<Stream> {
    let mut runs = Vec::new();
    runs.extend(grid(8, Preset::DHumieres, &[STREAMS[2]]));
    runs.extend(widths(STREAMS[5], 6, &[8.0]));
    runs.extend(grid(12, Preset::DHumieres, &[STREAMS[5], STREAMS[0], STREAMS[2], STREAMS[1]]));
    runs.extend(widths(STREAMS[1], 4, &[12.0, 16.0]));
    runs.extend(grid(8, Preset::DHumieres, &[STREAMS[3], STREAMS[4], STREAMS[6]]));
    runs.extend(grid(16, Preset::DHumieres, &[STREAMS[5]]));
    runs.extend(grid(12, Preset::DHumieres, &[STREAMS[6]]));
    runs.extend(grid(16, Preset::DHumieres, &[STREAMS[0], STREAMS[2], STREAMS[1]]));
    runs.extend(widths(STREAMS[1], 4, &[20.0]));
    // Re = 100 further from tau = 1/2, and so faster in cells per step.
    let fast = |cells: u32, tau: f64| grid(cells, Preset::DHumieres, &[(100.0, tau)]);
    runs.extend([fast(8, 0.53), fast(12, 0.53), fast(12, 0.5075)].concat());
    runs.extend(grid(8, Preset::Srt, &STREAMS[2..]));
    runs
}
