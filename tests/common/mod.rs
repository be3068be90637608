//! What the tests of all packages share: budgets of cell updates, steady states, slopes. It knows the
//! oracle only; what needs a device is in `tests/trials`.

#![allow(dead_code, reason = "each test binary is a crate of its own and uses a part of this")]

pub mod arrays;
pub mod broken;
pub mod collisions;
pub mod cuts;
pub mod random;
pub mod settling;
pub mod solid_rules;
pub mod sphere_quadrature;
pub mod suspension;
pub mod womersley;

use psmrt_reference::solver::Solver;
use std::path::Path;

/// The cell updates that a test may spend on the oracle; `tests/suite/tidy.rs` adds up the literals of all
/// tests. A run that would need more fails instead of passing unconverged.
pub struct Budget {
    allowed: u64,
    used: u64,
}

impl Budget {
    /// A budget of cell updates of the oracle.
    pub fn oracle(cell_updates: u64) -> Self {
        Budget { allowed: cell_updates, used: 0 }
    }

    /// A budget of cell updates of the kernel, which the suite adds up by themselves.
    pub fn kernel(cell_updates: u64) -> Self {
        Budget { allowed: cell_updates, used: 0 }
    }

    /// Counts cell updates that the caller is about to make.
    pub fn spend(&mut self, cell_updates: u64) {
        self.used += cell_updates;
        assert!(
            self.used <= self.allowed,
            "needs {} cell updates, declared {}: raise the declaration or shorten the test",
            self.used,
            self.allowed
        );
    }

    /// Makes `steps` steps.
    pub fn run(&mut self, solver: &mut Solver, steps: u64) {
        self.spend(steps * solver.domain().cell_count() as u64);
        solver.run(steps).unwrap_or_else(|stopped| panic!("{stopped}"));
    }

    /// Runs until `observe` is steady and returns its value: until three windows of `window` steps
    /// in a row each change it by less than `tolerance` of itself. The distance still to go is about
    /// the last change over one minus the ratio of successive changes, so choose windows of at least
    /// a tenth of the slowest time scale and `tolerance` ten times below what the test claims.
    pub fn run_to_steady(
        &mut self,
        solver: &mut Solver,
        window: u64,
        tolerance: f64,
        observe: impl Fn(&Solver) -> f64,
    ) -> f64 {
        let mut last = observe(solver);
        let mut steady = 0;
        while steady < 3 {
            self.run(solver, window);
            let now = observe(solver);
            steady = if (now - last).abs() <= tolerance * now.abs() { steady + 1 } else { 0 };
            last = now;
        }
        last
    }
}

impl Drop for Budget {
    /// Prints what was used, for `cargo test -- --nocapture`.
    fn drop(&mut self) {
        println!("cell updates: used {:.3e} of {:.3e}", self.used as f64, self.allowed as f64);
    }
}

/// Slope of the least-squares line through `(ln x, ln |y|)`: the observed order of an error.
pub fn observed_order(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs: Vec<(f64, f64)> = points.iter().map(|&(x, y)| (x.ln(), y.abs().ln())).collect();
    let mean_x = logs.iter().map(|p| p.0).sum::<f64>() / n;
    let mean_y = logs.iter().map(|p| p.1).sum::<f64>() / n;
    let covariance: f64 = logs.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum();
    let variance: f64 = logs.iter().map(|p| (p.0 - mean_x).powi(2)).sum();
    covariance / variance
}

/// The rows of a CSV file under `golden/` (lines that start with `#` are comments), the first being
/// the header.
pub fn golden_rows(file: &str) -> Vec<csv::StringRecord> {
    // The package under test lies in the repository or is its root.
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let golden = package.ancestors().map(|folder| folder.join("golden")).find(|g| g.is_dir());
    let path = golden.expect("no folder golden/ around the package").join(file);
    csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .has_headers(false)
        .from_path(&path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
        .records()
        .map(|row| row.unwrap_or_else(|error| panic!("{}: {error}", path.display())))
        .collect()
}
