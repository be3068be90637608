//! Full bounce-back (SC3) is tight, keeps its mass, and puts a plane wall where a closed form says.
//!
//! **The wall.** Flow along y, all gradients along x, slow. Of the 19 populations only those with `c_y` count: they hold
//! the momentum `j` and the moments `q` and `m`, odd in `c`, and the shear stress `p`, even. Those that cross to the next
//! cell are `(h + p)/2` and `(h - p)/2` with `h = (4 j + q - 5 m)/10`. A cut cell takes `κ j` from the momentum, with
//! `κ = 2 B`; it relaxes `q` towards `-2/3 j` and `m` towards 0 with rates `σ = (1 - B) s + 2 B`, and `p` with
//! `(1 - B) s_ν`; the full cells behind it turn everything back. In a steady linear flow this leaves the velocity zero at
//!
//! ```text
//! d = l / {(l + B/2)/(1 - B) + κ/[2 (2/3 + κ D)]},   l = τ - 1/2,
//! D = (1/σ_q - 1/2)/3 + (1/σ_m - 1/2) - 1/3
//! ```
//!
//! from the face of the cut cell that lies towards the fluid. (Derived for this test by solving the three balances.)

use crate::common;

use common::Budget;
use common::collisions::dhumieres;
use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::{Vec3, momentum};
use psmrt_reference::partial_saturation::{SolidOperator, VISCOUS_FACTOR, Weighting};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

const WEIGHTINGS: [Weighting; 3] =
    [Weighting::SolidFraction, Weighting::NobleTorczynski, Weighting::Viscous];

/// SRT, and MRT with the two named sets of rates.
fn collisions(tau: f64) -> [Collision; 3] {
    let magic = Rates::magic(tau, 3.0 / 16.0).unwrap();
    [Collision::Srt { tau }, dhumieres(tau), Collision::Mrt { rates: magic }]
}

/// A column of cells along z, the lowest of which are filled as given.
fn column(height: usize, fractions: &[f64], z: [Face; 2], collision: Collision) -> Setup {
    let faces = Faces { z, ..Faces::PERIODIC };
    let solids = vec![Solid::fixed_cells(fractions.iter().copied().enumerate().collect())];
    let phase =
        SolidPhase { solids, operator: SolidOperator::FullBounceBack, ..SolidPhase::default() };
    Setup::fluid(Domain::new([1, 1, height], faces).unwrap(), collision).with_solids(phase)
}

#[test]
fn slab_of_full_cells_lets_nothing_through_and_gathers_no_mass() {
    let mut budget = Budget::oracle(500_000);
    for collision in [0.51, 0.8, 1.5].into_iter().flat_map(collisions) {
        let setup = column(10, &[1.0; 4], [Face::Periodic; 2], collision);
        let g = 1e-5;
        let mut solver = Solver::new(setup.with_body_force(Vec3::new(0.0, 0.0, g))).unwrap();
        budget.run(&mut solver, 5000);
        for (cell, j) in solver.mass_flux_field()[..4].iter().enumerate() {
            // Round-off of populations of 0.3 (sound still runs to and fro in the fluid at tau 0.51); SC1 lets half of the force on each layer through: 7.5e-6.
            assert!(
                j.norm() < 1e-12,
                "{collision:?}, cell {cell}: the flux through a tight slab is {j:?}"
            );
        }
        let solid: f64 = solver.density_field()[..4].iter().sum();
        // Two of four layers share populations with the fluid, whose density falls along the force; none keeps any.
        let of_ends = solver.density_field()[0] + solver.density_field()[3];
        let inside = solid - of_ends;
        assert!(
            (inside - 2.0).abs() < 1e-10,
            "{collision:?}: {inside} in two full cells amid others"
        );
    }
}

#[test]
fn plane_wall_stands_where_the_balances_of_a_cut_cell_put_it() {
    let mut budget = Budget::oracle(20_000_000);
    let (height, lid) = (9, 1e-4);
    for (tau, steps) in [(0.55, 30_000), (0.8, 6_000), (1.5, 3_000)] {
        for collision in collisions(tau) {
            for weighting in WEIGHTINGS {
                for epsilon in [0.125, 0.5, 0.875] {
                    let top = Face::Wall { velocity: Vec3::new(lid, 0.0, 0.0) };
                    let faces = [Face::wall(), top];
                    let mut setup = column(height, &[1.0, 1.0, epsilon], faces, collision);
                    if let Some(phase) = &mut setup.solid_phase {
                        phase.weighting = weighting;
                    }
                    let mut solver = Solver::new(setup).unwrap();
                    budget.run(&mut solver, steps);
                    let u = |z: usize| {
                        let f = &solver.populations()[z];
                        momentum(f).x
                    };
                    // Where the straight line through two cells of fluid reaches zero, below the top of the cut cell.
                    let zero = 5.5 - u(5) / (u(6) - u(5));
                    let expected = distance(collision, weighting.weight(epsilon, tau));
                    let found = 3.0 - zero;
                    println!("{collision:?} {weighting:?} {epsilon}: {found:.6} {expected:.6}");
                    // 1e-9 of the flow is left of the start; momenta of 1e-5 round off by 1e-11 of themselves.
                    assert!(
                        (found - expected).abs() < 1e-6,
                        "{collision:?}, {weighting:?}, fraction {epsilon}: the velocity is zero {found} cells below \
                         the top of the cut cell, not {expected}"
                    );
                }
            }
        }
    }
}

/// How far below the top of a cut cell of weight `b` the velocity is zero.
fn distance(collision: Collision, b: f64) -> f64 {
    let (tau, s_q, s_m) = match collision {
        Collision::Srt { tau } => (tau, 1.0 / tau, 1.0 / tau),
        Collision::Mrt { rates } => (collision.tau(), rates.q, rates.m),
    };
    let (l, kappa) = (tau - 0.5, 2.0 * b);
    let left = |s: f64| 1.0 / ((1.0 - b) * s + 2.0 * b) - 0.5;
    let d = left(s_q) / 3.0 + left(s_m) - 1.0 / 3.0;
    l / ((l + 0.5 * b) / (1.0 - b) + kappa / (2.0 * (2.0 / 3.0 + kappa * d)))
}

#[test]
fn viscous_weight_runs_from_zero_to_one_with_b_over_one_less_b_in_proportion_to_the_viscosity() {
    let weight = |epsilon: f64, tau: f64| Weighting::Viscous.weight(epsilon, tau);
    for tau in [0.5 + 1e-9, 0.6, 1.0, 100.0] {
        assert_eq!((weight(0.0, tau), weight(1.0, tau)), (0.0, 1.0));
        for step in 1..100 {
            let epsilon = f64::from(step) / 100.0;
            let b = weight(epsilon, tau);
            let ratio = b / (1.0 - b) * (1.0 - epsilon) / epsilon;
            let expected = VISCOUS_FACTOR * (tau - 0.5);
            // B next to 1 leaves 1 - B few digits: 1e-16 of 1e-4 at tau 100, and tau - 1/2 of 1e-9 has seven.
            assert!(
                (ratio / expected - 1.0).abs() < 1e-6,
                "tau {tau}, {epsilon}: {ratio}, not {expected}"
            );
        }
    }
    // Worked by hand: epsilon = 1/2, tau = 1: 0.6 · 1/4 = 0.15 over 0.65.
    assert!((weight(0.5, 1.0) - 0.15 / 0.65).abs() < 1e-15);
}
