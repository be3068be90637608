//! Stokes drag of periodic arrays of spheres against Zick & Homsy and recomputed tables.
//!
//! `tests/common/arrays.rs` says what is measured and why. The full study, from 4 to 16 cells per
//! diameter, is `golden/sphere_arrays/study.csv`; here are the claims that it supports.
//!
//! **What limits PS.** Each full cell takes away twice its own mass flux per step
//! (`tests/oracle/leakage.rs`), so a sphere that must take the force `F` leaks `F/(2 V_sphere)`. Over the
//! superficial velocity `U` that is
//!
//! ```text
//!   x = 6π ν a K/(2 · 4/3 π a³) = 2.25 ν K/a²            K_measured/K - 1 ≈ -x/(1 + x)
//! ```
//!
//! in lattice units: second order in the cell size, in proportion to the viscosity (hence the
//! dependence on tau), and in proportion to `K`: worst in dense beds.

use crate::common;

use common::arrays::{Array, Flow, Lattice, Part};
use common::collisions::{dhumieres, magic, srt};
use common::{Budget, golden_rows, observed_order};
use psmrt_reference::collision::Collision;
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};

/// Steady enough: the flux is within 5e-5 of its end, and errors are claimed to 1e-3 at most.
const STEADY: f64 = 1e-4;

/// For what is claimed to 1e-4: within 1e-5.
const STEADIER: f64 = 2e-5;

/// An array of the table, by its solid fraction as spelled there.
#[derive(Clone, Copy)]
struct Case {
    lattice: Lattice,
    solid_fraction: &'static str,
}

/// Half the fraction at which the spheres touch, in the radius.
const SC: Case = Case { lattice: Lattice::Sc, solid_fraction: "0.06544984695" };
const BCC: Case = Case { lattice: Lattice::Bcc, solid_fraction: "0.0850218452" };
const FCC: Case = Case { lattice: Lattice::Fcc, solid_fraction: "0.09256006121" };
/// As dense as a bed of sand.
const DENSE: Case = Case { lattice: Lattice::Fcc, solid_fraction: "0.6" };

impl Case {
    /// `K` of the table.
    fn exact(self) -> f64 {
        let rows = golden_rows("sphere_arrays/literature.csv");
        let row = rows
            .iter()
            .find(|row| &row[0] == self.lattice.name() && &row[1] == self.solid_fraction);
        row.unwrap()[3].parse().unwrap()
    }

    /// The array with all defaults, a quarter of the cell.
    fn array(self, side: usize, collision: Collision) -> Array {
        Array {
            lattice: self.lattice,
            solid_fraction: self.solid_fraction.parse().unwrap(),
            side,
            part: Part::Quarter,
            collision,
            weighting: Weighting::default(),
            operator: SolidOperator::default(),
            reynolds: 0.005,
        }
    }

    fn flow(self, array: &Array, tolerance: f64, budget: &mut Budget) -> Flow {
        let steps = |solver: &mut _, count| {
            budget.run(solver, count);
            Ok(())
        };
        array.flow(self.exact(), tolerance, steps).unwrap()
    }

    /// Relative error of `K`.
    fn error(self, array: &Array, budget: &mut Budget) -> f64 {
        self.flow(array, STEADY, budget).k / self.exact() - 1.0
    }

    /// What the leak takes off `K`, relative.
    fn leak(self, array: &Array) -> f64 {
        // x = 2.25 ν K/a²
        let x = 2.25 * array.viscosity() * self.exact() / array.radius().powi(2);
        x / (1.0 + x)
    }
}

#[test]
fn drag_of_all_three_lattices_converges_to_the_tables_with_second_order() {
    let mut budget = Budget::oracle(32_000_000);
    for (case, sides) in [(SC, [12, 16, 24]), (BCC, [12, 16, 24]), (FCC, [12, 16, 24])] {
        let errors = sides.map(|side| {
            let array = case.array(side, dhumieres(0.8));
            let error = case.error(&array, &mut budget);
            let (diameter, leak) = (2.0 * array.radius(), case.leak(&array));
            let name = case.lattice.name();
            println!("{name}, {diameter:.2} cells per diameter: {error:.4}, leak {leak:.4}");
            // The leak, and less than as much again for cells that are covered in part, as if the
            // sphere's surface lay a twentieth of a cell inside at 6 cells per diameter.
            assert!(
                (-2.0 * leak..-leak).contains(&error),
                "{name}, {diameter} cells a diameter: the drag errs by {error}, not by one to \
                 two times the leak {leak}"
            );
            (1.0 / diameter, error)
        });
        let order = observed_order(&errors);
        println!("{}: order {order:.3}", case.lattice.name());
        // The leak is of second order; x/(1 + x) takes a tenth off. A plane wall lies 0.02 cells in the
        // fluid at any resolution (`tests/oracle/ps_channel_wall.rs`): a small part of first order and of the
        // other sign, which makes the order look higher by as much.
        assert!(
            (order - 2.0).abs() < 0.3,
            "{}: the error of the drag falls with order {order}, not 2",
            case.lattice.name()
        );
    }
}

#[test]
fn whole_cell_and_its_quarter_between_mirror_planes_give_the_same_drag_for_all_three_lattices() {
    let mut budget = Budget::oracle(2_200_000);
    for (case, side) in [(SC, 8), (BCC, 12), (FCC, 12)] {
        let quarter = case.array(side, dhumieres(1.0));
        let whole = Array { part: Part::Whole { shift: [0.0; 3] }, ..quarter };
        let [quarter, whole] =
            [quarter, whole].map(|array| case.flow(&array, STEADIER, &mut budget));
        assert_eq!(quarter.steps, whole.steps);
        // The same sums in another order: U = 1e-4 of populations of 0.3, kept for 1000 steps.
        assert!(
            (quarter.k / whole.k - 1.0).abs() < 1e-9,
            "drag of the quarter between mirror planes {}, of the whole cell {}",
            quarter.k,
            whole.k
        );
        // The balance of forces: what the flux still changes by.
        assert!(
            whole.imbalance.abs() < 1e-4,
            "force on the spheres is off the driving force by {}: momentum is lost between fluid and solid",
            whole.imbalance
        );
    }
}

#[test]
fn position_between_the_nodes_changes_drag_by_a_tenth_of_its_error() {
    let mut budget = Budget::oracle(5_300_000);
    let at = |shift, budget: &mut Budget| {
        let array = SC.array(12, dhumieres(1.0));
        SC.error(&Array { part: Part::Whole { shift }, ..array }, budget)
    };
    let corner = at([0.0; 3], &mut budget);
    for shift in [[0.5; 3], [0.5, 0.0, 0.0], [0.3, 0.1, 0.4]] {
        let moved = at(shift, &mut budget);
        println!("{shift:?}: {moved:.4}, at a corner {corner:.4}");
        // Exact solid fractions see the volume alike everywhere; what is left is how many cells are
        // full. Six cells per diameter.
        assert!(
            (moved - corner).abs() < 0.1 * corner.abs(),
            "spheres moved by {shift:?} cells: their drag errs by {moved}, at the corner of \
             the grid by {corner}"
        );
    }
}

#[test]
fn drag_does_not_depend_on_a_small_reynolds_number() {
    let mut budget = Budget::oracle(1_900_000);
    let [slow, faster, fast] = [0.001, 0.01, 0.1].map(|reynolds| {
        SC.flow(&Array { reynolds, ..SC.array(12, dhumieres(0.8)) }, STEADIER, &mut budget)
    });
    assert!(slow.reynolds < 0.002 && (9.9..10.1).contains(&(faster.reynolds / slow.reynolds)));
    // By symmetry the drag of an array is even in U: inertia enters as Re², 1e-4 here and 1e-2 below.
    assert!(
        (faster.k / slow.k - 1.0).abs() < 1e-6,
        "ten times as fast the drag coefficient is {}, slow {}: the flow is not slow",
        faster.k,
        slow.k
    );
    assert!(
        (fast.k / slow.k - 1.0).abs() < 1e-4,
        "a hundred times as fast the drag coefficient is {}, slow {}: inertia shows more than it ought to",
        fast.k,
        slow.k
    );
}

#[test]
fn error_with_noble_torczynskis_weight_falls_on_finer_grids_at_every_tau_and_grows_with_tau_as_the_leak()
 {
    let mut budget = Budget::oracle(10_500_000);
    let errors = [0.6, 0.8, 1.0, 1.5].map(|tau| {
        let [coarse, fine] =
            [8, 16].map(|side| SC.error(&SC.array(side, dhumieres(tau)), &mut budget));
        println!("tau {tau}: {coarse:.4} at 4 cells per diameter, {fine:.4} at 8");
        // Second order would leave a quarter; where x is not small (0.5 at tau = 1.5), a third.
        assert!(
            coarse < 0.0 && (0.1..0.35).contains(&(fine / coarse)),
            "tau {tau}: error of the drag ought to be negative and to fall to between 0.1 and \
             0.35 on twice the grid"
        );
        (tau, fine)
    });
    let leak = |tau| SC.leak(&SC.array(16, dhumieres(tau)));
    let (first, base) = errors[0];
    for (tau, error) in &errors[1..] {
        let (grown, expected) = (error - base, -(leak(*tau) - leak(first)));
        println!("tau {tau}: grown by {grown:.4}, the leak by {expected:.4}");
        // The estimate lets all of the force fall on full cells; a third of the volume is in cells
        // that are covered in part at 8 cells per diameter.
        assert!((1.0..1.33).contains(&(grown / expected)), "tau {tau}: {grown}, leak {expected}");
    }
}

#[test]
fn error_with_the_solid_fraction_as_weight_changes_sign_with_tau_and_does_not_fall_on_finer_grids()
{
    let mut budget = Budget::oracle(6_800_000);
    let mut error = |tau: f64, side: usize| {
        let array = SC.array(side, dhumieres(tau));
        SC.error(&Array { weighting: Weighting::SolidFraction, ..array }, &mut budget)
    };
    // The wall lies up to half a cell too far outside the sphere, which near tau = 1 and at 4 cells
    // per diameter makes up for the leak by chance: the error is small there, and larger at 8.
    let (coarse, fine) = (error(0.8, 8), error(0.8, 16));
    println!("tau 0.8: {coarse:.4} at 4 cells per diameter, {fine:.4} at 8");
    assert!(
        coarse.abs() < 0.05 && fine > 2.0 * coarse,
        "B = epsilon at tau near 1: errors {coarse} and {fine} on twice the grid: they ought \
         to start by cancelling and grow"
    );
    let (low, high) = (error(0.6, 16), error(1.5, 16));
    println!("8 cells per diameter: tau 0.6 {low:.4}, tau 1.5 {high:.4}");
    // Where Noble and Torczynski's weight is off by 3% (test above).
    assert!(
        low > 0.2 && high < -0.05,
        "B = epsilon: errors {low} at small and {high} at large tau: they ought to be of either sign"
    );
}

#[test]
fn dhumieres_rates_with_bounce_back_err_least_from_tau_0_6_up_in_dilute_and_dense_arrays() {
    let mut budget = Budget::oracle(4_200_000);
    for (case, side) in [(SC, 8), (DENSE, 16)] {
        // Below, in the dense array, SRT is as good: -17% against -19% at tau = 0.55.
        for tau in [0.6, 0.8, 1.0, 1.5] {
            let error = |collision, operator, budget: &mut Budget| {
                case.error(&Array { operator, ..case.array(side, collision) }, budget)
            };
            let bounce_back = SolidOperator::NonEquilibriumBounceBack;
            let best = error(dhumieres(tau), bounce_back, &mut budget);
            let others = [
                ("SRT", srt(tau), bounce_back),
                ("TRT", magic(tau, 3.0 / 16.0), bounce_back),
                ("MRT, superposition", dhumieres(tau), SolidOperator::Superposition),
            ];
            for (name, collision, operator) in others {
                let other = error(collision, operator, &mut budget);
                println!("{}, tau {tau}: {best:.4}, {name} {other:.4}", case.lattice.name());
                // Both too low, by different amounts; 1e-3 is twenty times what is open.
                assert!(
                    other < best - 1e-3 && best < 0.0,
                    "tau {tau}: {name} errs by {other}, d'Humieres' rates by {best}: they \
                     ought to err least, and below 0"
                );
            }
        }
    }
}
