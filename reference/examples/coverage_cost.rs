//! What a solid fraction costs and how far off it is: sampled with `n × n × n` points, and exact.
//!
//! Prints `method,n,rms_error,max_error,ns_per_cell` for 2,000 random cells that the surface of a
//! sphere of radius 8 cuts. The truth is the exact fraction, whose own error is proved to lie below
//! 1e-12 at this radius by `tests/oracle/coverage.rs`; its row therefore has errors of 0 by definition.
//!
//! ```text
//! cargo run --release -p psmrt-reference --example coverage_cost
//! ```

use psmrt_reference::coverage::{exact_fraction, sampled_fraction};
use psmrt_reference::lattice::Vec3;
use std::hint::black_box;
use std::time::Instant;

const RADIUS: f64 = 8.0;
const CELLS: usize = 2000;
/// Passes over all cells; the fastest one counts, since others were held up by other programs.
const PASSES: usize = 20;

fn main() {
    let cells = cut_cells();
    let truth: Vec<f64> = cells.iter().map(|centre| exact_fraction(centre, RADIUS)).collect();
    println!("method,n,rms_error,max_error,ns_per_cell");
    for n in 2..=10 {
        report("sampled", &n.to_string(), &cells, &truth, |c| sampled_fraction(c, RADIUS, n));
    }
    report("exact", "", &cells, &truth, |c| exact_fraction(c, RADIUS));
}

/// Prints one row.
fn report(method: &str, n: &str, cells: &[Vec3], truth: &[f64], fraction: impl Fn(&Vec3) -> f64) {
    let errors = || cells.iter().zip(truth).map(|(centre, truth)| fraction(centre) - truth);
    let rms = (errors().map(|error| error * error).sum::<f64>() / cells.len() as f64).sqrt();
    let max = errors().fold(0.0, |max: f64, error| max.max(error.abs()));
    let pass = || {
        let start = Instant::now();
        for centre in cells {
            black_box(fraction(black_box(centre)));
        }
        start.elapsed().as_secs_f64()
    };
    let fastest = (0..PASSES).map(|_| pass()).fold(f64::INFINITY, f64::min);
    let ns = 1e9 * fastest / cells.len() as f64;
    println!("{method},{n},{rms:.3e},{max:.3e},{ns:.0}");
}

/// Centres, relative to the cell's, of spheres whose surface cuts the cell.
fn cut_cells() -> Vec<Vec3> {
    // A linear congruential generator with Knuth's constants: the same cells on every machine.
    let mut state = 1_u64;
    let mut random = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut cells = Vec::with_capacity(CELLS);
    while cells.len() < CELLS {
        let centre = Vec3::from_fn(|_, _| (2.0 * random() - 1.0) * (RADIUS + 1.0));
        let fraction = exact_fraction(&centre, RADIUS);
        if 0.0 < fraction && fraction < 1.0 {
            cells.push(centre);
        }
    }
    cells
}
