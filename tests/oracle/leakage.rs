//! What leaks through a solid that should be tight: a slab of cells with B = 1.
//!
//! **Why it leaks, and how much.** A full cell of a resting solid leaves the collision without
//! momentum (`tests/oracle/limits.rs`): what it took away is the `j_before` that streamed in, whatever the
//! operator, the collision, `tau`. The mass flux through a cell is the mean of its momentum before and
//! after collision, `j = j_before/2`. So in a steady flow each cell takes away `2 j`, and for a slab of
//! `n` layers, between the momentum fluxes `P` (the pressure, in slow flow) on its two sides,
//!
//! ```text
//!   P_in - P_out = 2 n j          normal:      j = 1/2 of the pressure gradient
//!   tau_w        = Σ_layers 2 j   tangential:  both operators, shared out as shown below
//! ```
//!
//! In units of the fluid this is Darcy's law with the permeability `j nu/|dp/dz| = nu/2` cells²: the
//! leak matters more the larger `tau` is, only because all other flow then moves less.

use crate::common;

use common::Budget;
use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::{Vec3, density};
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;
use std::ops::Range;

const OPERATORS: [SolidOperator; 2] =
    [SolidOperator::NonEquilibriumBounceBack, SolidOperator::Superposition];
const TAUS: [f64; 6] = [0.51, 0.6, 0.8, 1.0, 1.5, 3.0];

/// SRT, and MRT with the two named sets of rates.
fn collisions(tau: f64) -> [Collision; 3] {
    let mrt = |rates: Result<Rates, _>| Collision::Mrt { rates: rates.unwrap() };
    [Collision::Srt { tau }, mrt(Rates::dhumieres(tau)), mrt(Rates::magic(tau, 3.0 / 16.0))]
}

/// A column of `height` cells along z with a slab of full cells in it.
fn column(
    height: usize,
    slab: Range<usize>,
    faces: [Face; 2],
    collision: Collision,
    operator: SolidOperator,
) -> Setup {
    let faces = Faces { z: faces, ..Faces::PERIODIC };
    let fractions = slab.map(|z| (z, 1.0)).collect();
    let solids = vec![Solid::fixed_cells(fractions)];
    let weighting = Weighting::NobleTorczynski;
    Setup::fluid(Domain::new([1, 1, height], faces).unwrap(), collision).with_solids(SolidPhase {
        solids,
        operator,
        weighting,
        ..SolidPhase::default()
    })
}

/// Mass flux along `axis`, cell by cell.
fn flux(solver: &Solver, axis: usize) -> Vec<f64> {
    solver.mass_flux_field().iter().map(|j| j[axis]).collect()
}

#[test]
fn slab_leaks_half_the_force_on_each_layer_whatever_tau_operator_and_collision() {
    let mut budget = Budget::oracle(3_300_000);
    // A force G on each of the fluid cells, and nothing but the slab to take it.
    let g = 1e-8;
    for (fluid, layers) in [(6, 2), (4, 4), (6, 8)] {
        let expected = 0.5 * g * fluid as f64 / layers as f64;
        for collision in TAUS.into_iter().flat_map(collisions) {
            for operator in OPERATORS {
                let faces = [Face::Periodic; 2];
                let setup =
                    column(fluid + layers, fluid..fluid + layers, faces, collision, operator);
                let setup = setup.with_body_force(Vec3::new(0.0, 0.0, g));
                let mut solver = Solver::new(setup).unwrap();
                budget.run(&mut solver, 3000);
                for (cell, j) in flux(&solver, 2).into_iter().enumerate() {
                    // j = 1e-8 out of populations of 0.3 rounds off by 1e-8 of itself a step. What a
                    // full cell gathers (last test) is 4 j² a step and layer: 1e-7 of j.
                    assert!(
                        (j / expected - 1.0).abs() < 1e-6,
                        "{collision:?} {operator:?}, {layers} layers, cell {cell}: flux {j:e}, not {expected:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn slab_leaks_half_the_pressure_gradient_downhill() {
    let mut budget = Budget::oracle(7_800_000);
    let (height, slab) = (18, 6..12);
    for collision in TAUS.into_iter().flat_map(collisions) {
        for operator in OPERATORS {
            for drop in [1e-6, -2e-6] {
                let faces = [1.0 + drop, 1.0].map(|density| Face::Pressure { density });
                let setup = column(height, slab.clone(), faces, collision, operator);
                let mut solver = Solver::new(setup).unwrap();
                budget.run(&mut solver, 6000);
                // p = ρ/3 half-way between the faces and the slab.
                let pressure = |z: usize| density(&solver.populations()[z]) / 3.0;
                let gradient = (pressure(2) - pressure(height - 3)) / slab.len() as f64;
                assert!(gradient * drop > 0.0);
                for j in flux(&solver, 2) {
                    // What full cells gather (last test) is 4 j² = 1e-14 a step and layer: 2e-6 of j
                    // in all. As much again for waves that 6000 steps have not damped.
                    assert!(
                        (j / (0.5 * gradient) - 1.0).abs() < 4e-6,
                        "{collision:?} {operator:?}: flux through a slab {j:e}, not half of \
                         the pressure gradient {gradient:e}"
                    );
                }
            }
        }
    }
}

/// The steady flow along a slab of `layers` cells under a force `g` on each of `fluid` cells beside it:
/// mass flux of each layer.
fn sliding(
    collision: Collision,
    operator: SolidOperator,
    (fluid, layers): (usize, usize),
    g: f64,
    budget: &mut Budget,
) -> Vec<f64> {
    let setup = column(fluid + layers, 0..layers, [Face::Periodic; 2], collision, operator);
    let mut solver = Solver::new(setup.with_body_force(Vec3::new(g, 0.0, 0.0))).unwrap();
    budget.run(&mut solver, 30_000);
    flux(&solver, 0)[..layers].to_vec()
}

#[test]
fn thick_solid_slides_as_one_block_under_bounce_back_at_every_tau() {
    let mut budget = Budget::oracle(5_200_000);
    let operator = SolidOperator::NonEquilibriumBounceBack;
    let (g, fluid) = (1e-8, 4);
    for layers in [3, 8] {
        // Bounce-back keeps the shear stress (even in c) and takes all momentum: nothing tells one
        // layer from the next, so all share the force alike: G fluid = 2 j layers.
        let expected = 0.5 * g * fluid as f64 / layers as f64;
        for collision in [0.55, 0.8, 1.5].into_iter().flat_map(collisions) {
            for j in sliding(collision, operator, (fluid, layers), g, &mut budget) {
                // Round-off as above, and the approach: 30,000 steps are 30 times the slowest time.
                assert!(
                    (j / expected - 1.0).abs() < 1e-6,
                    "{collision:?}: flux through the slab {j:e}, not {expected:e}"
                );
            }
        }
    }
}

/// Ratio of the flux of one layer to that of the one before it, superposition operator with SRT.
///
/// With `g+`, `g-`, `g0` the momentum along x that moves up, down, or stays, each collision leaves
/// `a = 1 - 1/tau` of its distance from the equilibrium (1/6, 1/6, 2/3 of `j`) and no momentum. In the
/// steady state `g+(z+1) = a (g+ - j/6)`, `g-(z-1) = a (g- - j/6)`, `g0 = a (g0 - 2j/3)`, and all
/// three sum up to `j`. Solutions `lambda^z` have
/// `a/6 [1/(a - lambda) + 1/(a - 1/lambda)] = kappa = (3 - a)/(3 (1 - a))`: a quadratic equation.
fn layer_ratio(tau: f64) -> f64 {
    let a = 1.0 - 1.0 / tau;
    let kappa = (3.0 - a) / (3.0 * (1.0 - a));
    // λ + 1/λ
    let sum = (6.0 * kappa * (a * a + 1.0) / a - 2.0 * a) / (6.0 * kappa - 1.0);
    0.5 * (sum - sum.signum() * (sum * sum - 4.0).sqrt())
}

#[test]
fn superposition_keeps_the_sliding_to_the_surface_layers() {
    let mut budget = Budget::oracle(1_500_000);
    let (g, fluid, layers) = (1e-8, 4, 8);
    for tau in [0.55, 0.8, 1.5, 3.0] {
        let superposition = SolidOperator::Superposition;
        let collision = Collision::Srt { tau };
        let j = sliding(collision, superposition, (fluid, layers), g, &mut budget);
        let lambda = layer_ratio(tau);
        let power = |z: usize| lambda.powi(i32::try_from(z).unwrap());
        let shape = |z: usize| power(z) + power(layers - 1 - z);
        let total: f64 = (0..layers).map(shape).sum();
        for z in 0..layers {
            let expected = 0.5 * g * fluid as f64 * shape(z) / total;
            println!("tau {tau} lambda {lambda:.4} layer {z}: {:.6e} {expected:.6e}", j[z]);
            // Round-off as above, of the largest flux.
            assert!((j[z] - expected).abs() < 1e-6 * j[0].abs(), "tau {tau}, layer {z}: {}", j[z]);
        }
    }
}

#[test]
fn full_cell_of_bounce_back_gathers_mass_as_the_square_of_its_leak() {
    let mut budget = Budget::oracle(170_000);
    let (fluid, layers, steps) = (6, 4, 4000);
    let g = 1e-5;
    let expected_flux = 0.5 * g * fluid as f64 / layers as f64;
    let rise = |operator, budget: &mut Budget| {
        let setup =
            column(fluid + layers, 0..layers, [Face::Periodic; 2], collisions(0.8)[1], operator);
        let setup = setup.with_body_force(Vec3::new(0.0, 0.0, g));
        let mut solver = Solver::new(setup).unwrap();
        let mass = |solver: &Solver| solver.density_field()[..layers].iter().sum::<f64>();
        budget.run(&mut solver, steps);
        let before = mass(&solver);
        budget.run(&mut solver, steps);
        (mass(&solver) - before) / (layers as f64 * steps as f64)
    };
    // The rest population of a full cell has no partner to be exchanged with:
    // Λ_0 = f_0^eq(ρ, 0) - f_0^eq(ρ, u) = w_0 ρ 3/2 u², u = 2 j. With the directions across, which
    // bounce-back exchanges in vain, it adds up to u², step by step, for ever. In a closed box that
    // mass comes from the fluid, and from the third of the solid's own that does move.
    let (fluid, layers) = (fluid as f64, layers as f64);
    let expected = (2.0 * expected_flux).powi(2) * fluid / (fluid + layers / 3.0);
    let bounce_back = rise(SolidOperator::NonEquilibriumBounceBack, &mut budget);
    let superposition = rise(SolidOperator::Superposition, &mut budget);
    println!("per step: {bounce_back:e}, {superposition:e}, expected {expected:e}");
    // Next order: ρ is not 1 where the pressure falls, 1e-5 to 1e-4 of it.
    assert!(
        (bounce_back / expected - 1.0).abs() < 1e-3,
        "a step gathers {bounce_back:e} of mass in full cells of bounce-back, not {expected:e}"
    );
    // It relaxes what bounce-back keeps.
    assert!(
        superposition.abs() < 1e-3 * expected,
        "a step gathers {superposition:e} of mass in full cells of superposition, which ought to relax it"
    );
}
