//! Poiseuille flow in a rectangular duct against its exact series.
//!
//! A quarter of the section is computed, between two walls (half-way bounce-back) and two mirror
//! planes (free slip); `tests/oracle/couette.rs` shows that a mirror plane gives the flow of the whole.

use crate::common;

use common::collisions::{dhumieres, magic, srt};
use common::{Budget, golden_rows, observed_order};
use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::{Vec3, viscosity};
use psmrt_reference::setup::Setup;
use psmrt_reference::solver::Solver;
use std::f64::consts::PI;

/// The smallest number of steps that is not below `time`.
fn steps(time: f64) -> u64 {
    (0_u32..).find(|&steps| f64::from(steps) >= time).unwrap().into()
}

/// The series: velocity at (`y`, `z`) from the axis, in units of `G h²/mu` with `h` half the short
/// side (along y) as the unit of length; `half_long` is half the long side (along z).
fn exact(y: f64, z: f64, half_long: f64) -> f64 {
    // u = (1 - y²)/2 - 16/π³ Σ_{k odd} (-1)^((k-1)/2)/k³ cosh(kπz/2)/cosh(kπb/2) cos(kπy/2)
    let terms = (0..400).map(|i| {
        let k = f64::from(2 * i + 1);
        let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
        // The quotient of the two cosh, without their overflow.
        let (at, wall) = (0.5 * k * PI * z.abs(), 0.5 * k * PI * half_long);
        let quotient = (at - wall).exp() * (1.0 + (-2.0 * at).exp()) / (1.0 + (-2.0 * wall).exp());
        sign / k.powi(3) * quotient * (0.5 * k * PI * y).cos()
    });
    0.5 * (1.0 - y * y) - 16.0 / PI.powi(3) * terms.sum::<f64>()
}

/// The steady flow in a quarter duct of `n` by `n * aspect` cells, in units of `G h²/mu`: the root
/// mean square error at the nodes over the largest velocity, and the mean velocity.
fn duct(budget: &mut Budget, collision: Collision, n: usize, aspect: usize) -> (f64, f64) {
    let nu = viscosity(collision.tau());
    let h = n as f64;
    // Diffusive scaling: the largest velocity, about 0.3 G h²/nu, is 0.2/n.
    let g = 0.7 * nu / h.powi(3);
    let half_long = aspect as f64;
    let sides = [Face::FreeSlip, Face::wall()];
    let faces = Faces { x: [Face::Periodic; 2], y: sides, z: sides };
    let domain = Domain::new([1, n, n * aspect], faces).unwrap();
    let setup = Setup::fluid(domain.clone(), collision).with_body_force(Vec3::x() * g);
    let unit = g * h * h / nu;
    let reference: Vec<f64> = (0..domain.cell_count())
        .map(|cell| domain.centre(domain.coordinates(cell)) / h)
        .map(|at| exact(at.y, at.z, half_long))
        .collect();
    let mut solver = Solver::starting_from(setup, |centre| {
        (1.0, Vec3::x() * unit * exact(centre.y / h, centre.z / h, half_long))
    })
    .unwrap();
    let mean = |solver: &Solver| {
        solver.velocity_field().iter().map(|u| u.x / unit).sum::<f64>() / reference.len() as f64
    };
    // The slowest mode falls by e in this many steps; 2e-7 is left to go, a three-hundredth of the smallest
    // error here.
    let window = 4.0 * h * h / (nu * PI * PI * (1.0 + half_long.powi(-2)));
    let mean = budget.run_to_steady(&mut solver, steps(window), 3e-7, mean);
    let squares = solver.velocity_field().into_iter().zip(&reference);
    let squares: f64 = squares.map(|(u, exact)| (u.x / unit - exact).powi(2)).sum();
    ((squares / reference.len() as f64).sqrt() / exact(0.0, 0.0, half_long), mean)
}

/// The numbers of a golden table.
fn numbers(file: &str) -> Vec<Vec<f64>> {
    let rows = golden_rows(file);
    rows.iter().skip(1).map(|row| row.iter().map(|cell| cell.parse().unwrap()).collect()).collect()
}

/// The mean velocity that the literature table gives for a ratio of short to long side.
fn literature_mean(aspect: f64) -> f64 {
    numbers("duct/literature.csv").iter().find(|row| row[0] == aspect).unwrap()[1]
}

/// The value at spacing 0 of what is `values` at the two spacings, for an error of second order.
fn extrapolated(coarse: (f64, f64), fine: (f64, f64)) -> f64 {
    let ratio = (coarse.0 / fine.0).powi(2);
    (ratio * fine.1 - coarse.1) / (ratio - 1.0)
}

#[test]
fn series_of_the_duct_agrees_with_the_tables() {
    for row in numbers("duct/square_profile.csv") {
        // The table is good to 1e-10 (its README); the series is cut where its terms are 1e-9 of
        // the first and alternate, at the wall itself as 1/k², so that 2e-10 is left.
        let error = exact(row[0], row[1], 1.0) - row[2];
        assert!(
            error.abs() < 1e-9,
            "the series for the velocity in a square duct at {}, {}: off the table by {error:e}",
            row[0],
            row[1]
        );
    }
    for row in numbers("duct/literature.csv") {
        // Twelve printed digits.
        let error = exact(0.0, 0.0, 1.0 / row[0]) / row[2] - 1.0;
        assert!(
            error.abs() < 2e-12,
            "the series for the velocity in the middle of a duct of aspect ratio {}: off the \
             table by {error:e}",
            row[0]
        );
    }
}

/// Runs four grids, asserts second order of the profile and of the mean and the limit of the mean.
fn assert_second_order(
    budget: &mut Budget,
    collision: Collision,
    aspect: usize,
    halves: [usize; 4],
) {
    let mean = literature_mean(1.0 / aspect as f64);
    let grids = halves.map(|n| {
        let (profile, computed) = duct(budget, collision, n, aspect);
        (1.0 / n as f64, profile, computed / mean - 1.0)
    });
    println!("{collision:.3?}: spacing, error of profile, of mean {grids:.6?}");
    let profile = grids.map(|(spacing, error, _)| (spacing, error));
    let means = grids.map(|(spacing, _, error)| (spacing, error));
    for (what, errors) in [("profile", profile), ("mean", means)] {
        let (all, finest) = (observed_order(&errors), observed_order(&errors[2..]));
        println!("  {what}: order {all:.3}, of the finest two {finest:.3}");
        // The coarsest duct has 6 cells across: its fourth-order term, a tenth of the second-order
        // one, turns the slope by up to 0.15; between the finest two it is below a hundredth.
        assert!((all - 2.0).abs() < 0.2, "{what}: the error falls with order {all}, not 2");
        assert!((finest - 2.0).abs() < 0.06, "{what}: order between the finest two {finest}");
    }
    // What extrapolation leaves is of fourth order: a fraction of (1/12)^4 = 5e-5.
    let limit = extrapolated(means[2], means[3]);
    println!("  mean, extrapolated: {limit:.1e} off");
    assert!(limit.abs() < 1e-5, "extrapolated mean is {limit:e} off");
}

#[test]
fn square_duct_converges_to_the_series_with_second_order() {
    let mut budget = Budget::oracle(9_200_000);
    for collision in [srt(0.8), dhumieres(0.8), magic(1.4, 3.0 / 16.0)] {
        assert_second_order(&mut budget, collision, 1, [3, 6, 12, 20]);
    }
}

#[test]
fn duct_twice_as_wide_as_high_converges_to_the_tabulated_mean() {
    let mut budget = Budget::oracle(7_300_000);
    for collision in [srt(1.1), dhumieres(1.4)] {
        assert_second_order(&mut budget, collision, 2, [3, 6, 12, 18]);
    }
}
