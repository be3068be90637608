//! The full form of the sphere in a stream: resolution, relaxation time, collision, width of the box.
//!
//! Adds one row per run to `golden/sphere_drag/study.csv` as it goes; runs that have a row are left out, so
//! that it can be cut off and started again. An hour or two on one core, half of it for 16 cells per diameter;
//! the machine's cores share the work of each run.
//!
//! ```text
//! cargo run --release --example sphere_drag_study
//! ```

use std::error::Error;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::Path;

use psmrt::cases::{Bench, Stream};

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

fn main() -> Result<(), Box<dyn Error>> {
    let mut bench = Bench::new(Path::new("golden"), None, |_| {});
    for stream in runs() {
        let start = stream.start("reference").join(",") + ",";
        if fs::read_to_string(STUDY)?.lines().any(|line| line.starts_with(&start)) {
            continue;
        }
        let row = stream.row(&mut bench)?.join(",");
        OpenOptions::new().append(true).open(STUDY)?.write_all((row.clone() + "\n").as_bytes())?;
        println!("{row}");
    }
    Ok(())
}

/// All runs, the cheap ones first.
fn runs() -> Vec<Stream> {
    let paper =
        Stream { collision: "mrt", reynolds: 0.1, cells: 6, tau: 0.7, width: 5.0, tolerance: 3e-5 };
    let mut runs = Vec::new();
    let all = |cells: u32, collision: &'static str, streams: &[(f64, f64)]| -> Vec<Stream> {
        let tolerance = if cells < 12 { 3e-5 } else { 3e-4 };
        let one = |&(reynolds, tau)| Stream { collision, reynolds, cells, tau, tolerance, ..paper };
        streams.iter().map(one).collect()
    };
    runs.extend(all(4, "mrt", &STREAMS[..3]));
    runs.extend(all(6, "mrt", &STREAMS));
    runs.extend(all(6, "srt", &STREAMS[..5]));
    runs.extend(all(8, "mrt", &[STREAMS[0], STREAMS[1], STREAMS[2], STREAMS[5]]));
    // How much the box matters, at the relaxation times of `STREAMS`.
    let varied = |(reynolds, tau): (f64, f64), cells: u32, widths: &[f64]| -> Vec<Stream> {
        let one = |&width| Stream { reynolds, tau, cells, width, tolerance: 1e-4, ..paper };
        widths.iter().map(one).collect()
    };
    for stream in [STREAMS[2], STREAMS[0], STREAMS[1]] {
        runs.extend(varied(stream, 4, &[4.0, 6.0, 8.0]));
    }
    runs.extend(varied(STREAMS[5], 6, &[4.0, 6.0]));
    // How much the relaxation time matters.
    for tau in [1.5, 1.0, 0.8, 0.7, 0.6, 0.55] {
        for collision in ["mrt", "srt"] {
            runs.push(Stream { tau, collision, cells: 4, ..paper });
        }
    }
    runs.extend(varied(STREAMS[5], 6, &[8.0]));
    for stream in [STREAMS[1], STREAMS[2], STREAMS[0]] {
        runs.extend(varied(stream, 4, &[10.0]));
    }
    runs.extend(varied(STREAMS[2], 6, &[4.0, 6.0]));
    // Finer grids.
    runs.extend(all(12, "mrt", &[STREAMS[2], STREAMS[5], STREAMS[0]]));
    runs.extend(all(8, "mrt", &[STREAMS[6], STREAMS[3], STREAMS[4]]));
    runs.extend(all(12, "mrt", &[STREAMS[6], STREAMS[1], STREAMS[4]]));
    runs.extend(all(16, "mrt", &[STREAMS[5], STREAMS[2]]));
    runs.extend(all(8, "srt", &STREAMS[2..]));
    runs.extend(all(6, "srt", &STREAMS[5..]));
    runs
}
