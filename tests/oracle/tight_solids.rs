//! Full bounce-back (SC3) and graded viscosity are tight, keep their mass, and put a plane wall where a closed form says.
//!
//! **The wall.** Flow along y, all gradients along x, slow. Of the 19 populations only those with `c_y` count: they hold
//! the momentum `j` and the moments `q` and `m`, odd in `c`, and the shear stress `p`, even. Those that cross to the next
//! cell are `(h + p)/2` and `(h - p)/2` with `h = (4 j + q - 5 m)/10`. A cut cell takes `κ j` from the momentum, with
//! `κ = 2 B`; it changes `q` by `-σ_q q - 2/3 (σ_q - κ) j`, `m` by `-σ_m m` and `p` by `-σ_p p`; the full cells behind it
//! turn everything back. In a steady linear flow this leaves the velocity zero at
//!
//! ```text
//! d = l / {(1/σ_p - 1/2) + κ/[2 (2/3 + κ D)]},   l = τ - 1/2,
//! D = (1/σ_q - 1/2)/3 + (1/σ_m - 1/2) - 1/3
//! ```
//!
//! from the face of the cut cell that lies towards the fluid. (Derived for this test by solving the three balances.) The
//! rates of cut cells are `(1 - B) s + 2 B` for `q` and `m` and `(1 - B) s_ν` for `p` under full bounce-back; under graded
//! viscosity `1/σ_p - 1/2 = l/(1 - ε)` and, of the other two, `1/σ - 1/2 = 0.002 (1 - ε)/l`.

use crate::common;

use common::Budget;
use common::arrays::{Array, Lattice, Part};
use common::collisions::dhumieres;
use common::solid_rules::{GRADED, WEIGHTINGS};
use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::{Vec3, momentum};
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

/// SRT, and MRT with the two named sets of rates.
fn collisions(tau: f64) -> [Collision; 3] {
    let magic = Rates::magic(tau, 3.0 / 16.0).unwrap();
    [Collision::Srt { tau }, dhumieres(tau), Collision::Mrt { rates: magic }]
}

/// The tight operators with their weights.
fn tight() -> Vec<(SolidOperator, Weighting)> {
    let whole = WEIGHTINGS.map(|weighting| (SolidOperator::FullBounceBack, weighting));
    whole.into_iter().chain([GRADED]).collect()
}

/// A column of cells along z, the lowest of which are filled as given.
fn column(
    height: usize,
    fractions: &[f64],
    z: [Face; 2],
    collision: Collision,
    (operator, weighting): (SolidOperator, Weighting),
) -> Setup {
    let faces = Faces { z, ..Faces::PERIODIC };
    let solids = vec![Solid::fixed_cells(fractions.iter().copied().enumerate().collect())];
    let phase = SolidPhase { solids, operator, weighting, ..SolidPhase::default() };
    Setup::fluid(Domain::new([1, 1, height], faces).unwrap(), collision).with_solids(phase)
}

#[test]
fn slab_of_full_cells_lets_nothing_through_and_gathers_no_mass() {
    let mut budget = Budget::oracle(1_000_000);
    let all = [0.51, 0.8, 1.5].into_iter().flat_map(collisions);
    for (collision, rule) in all.flat_map(|one| [tight()[1], GRADED].map(|rule| (one, rule))) {
        let setup = column(10, &[1.0; 4], [Face::Periodic; 2], collision, rule);
        let g = 1e-5;
        let mut solver = Solver::new(setup.with_body_force(Vec3::new(0.0, 0.0, g))).unwrap();
        budget.run(&mut solver, 5000);
        for (cell, j) in solver.mass_flux_field()[..4].iter().enumerate() {
            // Round-off of populations of 0.3 (sound still runs to and fro in the fluid at tau 0.51); SC1 lets half of the force on each layer through: 7.5e-6.
            assert!(
                j.norm() < 1e-12,
                "{collision:?}, {rule:?}, cell {cell}: the flux through a tight slab is {j:?}"
            );
        }
        let solid: f64 = solver.density_field()[..4].iter().sum();
        // Two of four layers share populations with the fluid, whose density falls along the force; none keeps any.
        let of_ends = solver.density_field()[0] + solver.density_field()[3];
        let inside = solid - of_ends;
        assert!(
            (inside - 2.0).abs() < 1e-10,
            "{collision:?}, {rule:?}: {inside} in two full cells amid others"
        );
    }
}

#[test]
fn load_on_a_sphere_at_rest_does_not_change_its_sign_from_step_to_step() {
    let mut budget = Budget::oracle(700_000);
    // From a stream, and from rest under a body force: both would leave momentum in full cells.
    let (stream, force) = (Vec3::new(0.02, 0.0, 0.0), Vec3::new(1e-5, 0.0, 0.0));
    for (velocity, g) in [(stream, Vec3::zeros()), (Vec3::zeros(), force)] {
        for rule in [tight()[1], GRADED] {
            let domain = Domain::new([12; 3], Faces::PERIODIC).unwrap();
            let (operator, weighting) = rule;
            let solids = vec![Solid::fixed_sphere(Vec3::new(6.3, 6.2, 6.1), 4.0)];
            let phase = SolidPhase { solids, operator, weighting, ..SolidPhase::default() };
            let setup = Setup::fluid(domain, dhumieres(0.8)).with_body_force(g).with_solids(phase);
            let mut solver = Solver::starting_from(setup, |_| (1.0, velocity)).unwrap();
            budget.run(&mut solver, 60);
            let forces: Vec<f64> = (0..40)
                .map(|_| {
                    budget.run(&mut solver, 1);
                    solver.loads()[0].force.x
                })
                .collect();
            // What a step differs by from the mean of its neighbours, over the largest force. Sound takes 20 steps through the
            // box: were the force nothing else, 1 - cos(2 π/20) = 0.05. Momentum in the 160 full cells makes more than 0.1 of it:
            // they start with -G/2 each and give twice that at each step, the whole box gets 1728 G.
            let largest = forces.iter().map(|force| force.abs()).fold(0.0, f64::max);
            let rough = forces.windows(3).map(|w| (0.5 * (w[0] + w[2]) - w[1]).abs() / largest);
            let rough = rough.fold(0.0, f64::max);
            println!("{rule:?}, {velocity:?}: {rough:.2e}");
            assert!(
                rough < 0.06,
                "{rule:?}, start {velocity:?}, body force {g:?}: the force of a step differs by {rough} of the largest from \
                 the mean of its neighbours'"
            );
        }
    }
}

#[test]
fn plane_wall_stands_where_the_balances_of_a_cut_cell_put_it() {
    let mut budget = Budget::oracle(10_000_000);
    let (height, lid) = (9, 1e-4);
    for (tau, steps) in [(0.55, 30_000), (0.8, 6_000), (1.5, 3_000)] {
        for collision in collisions(tau) {
            for rule in tight() {
                for epsilon in [0.125, 0.5, 0.875] {
                    let top = Face::Wall { velocity: Vec3::new(lid, 0.0, 0.0) };
                    let faces = [Face::wall(), top];
                    let setup = column(height, &[1.0, 1.0, epsilon], faces, collision, rule);
                    let mut solver = Solver::new(setup).unwrap();
                    budget.run(&mut solver, steps);
                    let u = |z: usize| {
                        let f = &solver.populations()[z];
                        momentum(f).x
                    };
                    // Where the straight line through two cells of fluid reaches zero, below the top of the cut cell.
                    let zero = 5.5 - u(5) / (u(6) - u(5));
                    let expected = distance(collision, rule, epsilon);
                    let found = 3.0 - zero;
                    println!("{collision:?} {rule:?} {epsilon}: {found:.6} {expected:.6}");
                    // 1e-9 of the flow is left of the start; momenta of 1e-5 round off by 1e-11 of themselves.
                    assert!(
                        (found - expected).abs() < 1e-6,
                        "{collision:?}, {rule:?}, fraction {epsilon}: the velocity is zero {found} cells below \
                         the top of the cut cell, not {expected}"
                    );
                }
            }
        }
    }
}

/// How far below the top of a cut cell that is filled to `epsilon` the velocity is zero.
fn distance(
    collision: Collision,
    (operator, weighting): (SolidOperator, Weighting),
    epsilon: f64,
) -> f64 {
    let (tau, s_q, s_m) = match collision {
        Collision::Srt { tau } => (tau, 1.0 / tau, 1.0 / tau),
        Collision::Mrt { rates } => (collision.tau(), rates.q, rates.m),
    };
    let l = tau - 0.5;
    // B, and 1/σ - 1/2 of p, q and m
    let (b, [p, q, m]) = if operator == SolidOperator::GradedViscosity {
        let k = l * l / (4.0 * l + 0.4) * epsilon / (1.0 - epsilon);
        let odd = 0.002 * (1.0 - epsilon) / l;
        (k / (1.0 + k), [l / (1.0 - epsilon), odd, odd])
    } else {
        let b = weighting.weight(epsilon, tau);
        let left = |s: f64| 1.0 / ((1.0 - b) * s + 2.0 * b) - 0.5;
        (b, [(l + 0.5 * b) / (1.0 - b), left(s_q), left(s_m)])
    };
    let kappa = 2.0 * b;
    let d = q / 3.0 + m - 1.0 / 3.0;
    l / (p + kappa / (2.0 * (2.0 / 3.0 + kappa * d)))
}

#[test]
fn graded_viscosity_gives_the_drag_of_dense_arrays_within_the_aim_whatever_tau() {
    let mut budget = Budget::oracle(4_000_000);
    // The aims of the operator: 1.5 % at 13.9 cells per diameter in a simple cubic array, 5 % at 15.8 in a dense one, where
    // bounce-back of the non-equilibrium part is 1 to 11 % and 8 to 30 % off. Drag by Zick & Homsy (1982) and the
    // project's own integral equation (golden/sphere_arrays/literature.csv). Two parts were fitted to these arrays.
    let simple = (Lattice::Sc, 0.343, 16, 15.39948733, 0.015);
    let dense = (Lattice::Fcc, 0.6, 24, 107.6541427, 0.05);
    for (case, tau) in [(simple, 0.55), (simple, 1.0), (dense, 0.8), (dense, 1.0)] {
        let (lattice, solid_fraction, side, exact, allowed) = case;
        let (operator, weighting) = GRADED;
        let array = Array {
            lattice,
            solid_fraction,
            side,
            part: Part::Quarter,
            collision: dhumieres(tau),
            weighting,
            operator,
            reynolds: 0.005,
        };
        let steps = |solver: &mut _, count| {
            budget.run(solver, count);
            Ok(())
        };
        // Steady to a tenth of the smaller aim.
        let error = array.flow(exact, 1e-3, steps).unwrap().k / exact - 1.0;
        println!("{lattice:?}, {side} cells, tau {tau}: {error:+.4}");
        assert!(
            error.abs() < allowed,
            "{lattice:?}, {side} cells along the edge, tau {tau}: the drag is {error} off, the aim is {allowed}"
        );
    }
}
