//! Fluids of which one cell is broken from the start.

use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::Setup;
use psmrt_reference::solver::Solver;

/// The cell that is broken.
pub const CELL: [usize; 3] = [2, 1, 0];

/// Periodic boxes of 3³ cells in which all but [`CELL`] are sound, each with the density of that cell and its velocity
/// along x.
pub fn at_the_start() -> impl Iterator<Item = ((f64, f64), Solver)> {
    [(-1.0, 0.0), (0.0, 0.0), (f64::NAN, 0.0), (1.0, f64::INFINITY), (1.0, 0.7)].into_iter().map(
        |(rho, u)| {
            let domain = Domain::new([3, 3, 3], Faces::PERIODIC).unwrap();
            let centre = Vec3::from(CELL.map(|i| i as f64 + 0.5));
            let state = |x| match x == centre {
                true => (rho, Vec3::new(u, 0.0, 0.0)),
                false => (1.0, Vec3::zeros()),
            };
            let setup = Setup::fluid(domain, Collision::Srt { tau: 0.8 });
            ((rho, u), Solver::starting_from(setup, state).unwrap())
        },
    )
}
