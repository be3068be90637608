//! Two exact solutions of the Navier–Stokes equations in a periodic box: the two-dimensional
//! Taylor–Green vortices and the three-dimensional Beltrami (ABC) flow, which mixes all three axes.
//! Both keep their shape and decay by `exp(-nu K² t)`; their pressure balances their inertia.
//!
//! Diffusive scaling: tau is the same on every grid and the speed falls as 1/N, so that the errors
//! of the grid (k²) and of compressibility (Mach number squared) both fall as 1/N².

use crate::common;

use common::{Budget, observed_order};
use psmrt_reference::collision::Collision;
use psmrt_reference::directions::Q;
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::equilibrium::equilibrium;
use psmrt_reference::lattice::{Populations, Vec3, W, c, viscosity};
use psmrt_reference::moments::{CellMatrix, inverse_moment_matrix, moment_matrix};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::Setup;
use psmrt_reference::solver::Solver;
use std::f64::consts::{LN_2, PI};

/// A flow of period 2 pi and unit amplitude.
struct Flow {
    name: &'static str,
    dimensions: usize,
    velocity: fn(Vec3) -> Vec3,
    pressure: fn(Vec3) -> f64,
    /// `K²` over the `k²` of the box: how many times faster it decays than a wave along an axis.
    decay: f64,
}

const TAYLOR_GREEN: Flow = Flow {
    name: "Taylor-Green",
    dimensions: 2,
    // u = (-cos x sin y, sin x cos y, 0),  p = -(cos 2x + cos 2y)/4
    velocity: |x| Vec3::new(-x.x.cos() * x.y.sin(), x.x.sin() * x.y.cos(), 0.0),
    pressure: |x| -0.25 * ((2.0 * x.x).cos() + (2.0 * x.y).cos()),
    decay: 2.0,
};

const ABC: Flow = Flow {
    name: "ABC",
    dimensions: 3,
    velocity: abc_velocity,
    // p = -(|u|² - mean of |u|²)/2
    pressure: |x| -0.5 * (abc_velocity(x).norm_squared() - (1.0 + 0.7 * 0.7 + 0.4 * 0.4)),
    decay: 1.0,
};

fn abc_velocity(x: Vec3) -> Vec3 {
    let (a, b, c) = (1.0, 0.7, 0.4);
    // u = (A sin z + C cos y, B sin x + A cos z, C sin y + B cos x)
    Vec3::new(
        a * x.z.sin() + c * x.y.cos(),
        b * x.x.sin() + a * x.z.cos(),
        c * x.y.sin() + b * x.x.cos(),
    )
}

const TAU: f64 = 0.8;

/// The rates, and the collision with them.
fn srt() -> (Rates, Collision) {
    (Rates::srt(TAU).unwrap(), Collision::Srt { tau: TAU })
}

fn dhumieres() -> (Rates, Collision) {
    let rates = Rates::dhumieres(TAU).unwrap();
    (rates, Collision::Mrt { rates })
}

#[derive(Clone, Copy, PartialEq)]
enum Start {
    /// Populations in equilibrium.
    Equilibrium,
    /// Equilibrium and the first-order part that carries the viscous stress.
    WithStress,
}

/// First-order part of the populations where the velocity is `u(x)`, x in cells (Chapman & Enskog):
/// `f_1 = -M⁻¹ Ŝ⁻¹ M [3 w_a c_a·(c_a·∇)u]`, of which the conserved moments are zero.
fn first_order_part(rates: &Rates, u: impl Fn(Vec3) -> Vec3, x: Vec3) -> Populations {
    // Central difference along c_a over 1e-3 cells: good to 1e-7.
    let h = 1e-3;
    let change = |a: usize| c(a).dot(&(u(x + h * c(a)) - u(x - h * c(a)))) / (2.0 * h);
    let drive = std::array::from_fn(|a| 3.0 * W[a] * change(a));
    let mut moments = CellMatrix::from_faer(&moment_matrix()).times(&drive);
    for (moment, rate) in moments.iter_mut().zip(rates.diagonal()) {
        *moment = if rate > 0.0 { -*moment / rate } else { 0.0 };
    }
    CellMatrix::from_faer(&inverse_moment_matrix()).times(&moments)
}

/// The error of the velocity on a grid of `n` cells along each axis when it has decayed to one half:
/// root mean square over root mean square.
fn error(
    budget: &mut Budget,
    flow: &Flow,
    (rates, collision): (Rates, Collision),
    start: Start,
    n: usize,
) -> f64 {
    let k = 2.0 * PI / n as f64;
    let speed = 0.4 / n as f64;
    let u = |x: Vec3| speed * (flow.velocity)(k * x);
    let cells = [n, n, if flow.dimensions == 3 { n } else { 1 }];
    let domain = Domain::new(cells, Faces::PERIODIC).unwrap();
    let centres: Vec<Vec3> =
        (0..domain.cell_count()).map(|cell| domain.centre(domain.coordinates(cell))).collect();
    let populations = centres.iter().map(|&x| {
        let rho = 1.0 + 3.0 * speed * speed * (flow.pressure)(k * x);
        let mut f = equilibrium(rho, &u(x));
        if start == Start::WithStress {
            let first = first_order_part(&rates, u, x);
            (0..Q).for_each(|a| f[a] += first[a]);
        }
        f
    });
    let setup = Setup::fluid(domain, collision);
    let mut solver = Solver::from_populations(setup, populations.collect()).unwrap();
    let decay = flow.decay * viscosity(TAU) * k * k;
    let steps = (1_u32..).find(|&steps| decay * f64::from(steps) >= LN_2).unwrap();
    budget.run(&mut solver, steps.into());
    let left = (-decay * f64::from(steps)).exp();
    let (mut difference, mut whole) = (0.0, 0.0);
    for (computed, &x) in solver.velocity_field().iter().zip(&centres) {
        difference += (computed - left * u(x)).norm_squared();
        whole += (left * u(x)).norm_squared();
    }
    (difference / whole).sqrt()
}

/// Errors on three grids, and their order.
fn convergence(
    budget: &mut Budget,
    flow: &Flow,
    collision: (Rates, Collision),
    start: Start,
) -> ([f64; 3], f64) {
    let errors = [8, 16, 32].map(|n| error(budget, flow, collision, start, n));
    let order = observed_order(&[(1.0, errors[0]), (0.5, errors[1]), (0.25, errors[2])]);
    println!("{}, {:?}: errors {errors:.6?}, order {order:.3}", flow.name, collision.1);
    (errors, order)
}

/// `k²` of the finest grid.
const K2: f64 = (2.0 * PI / 32.0) * (2.0 * PI / 32.0);

/// Asserts second order from a start with stress, and that the error at the finest grid is that of
/// the lattice's viscosity, `nu (1 + viscosity_error K²)`, in shear waves of the same kind.
fn assert_second_order(
    budget: &mut Budget,
    flow: &Flow,
    collision: (Rates, Collision),
    viscosity_error: f64,
) {
    let (errors, order) = convergence(budget, flow, collision, Start::WithStress);
    // At N = 8 (k² = 0.6) the fourth-order terms are a few tenths of the second-order ones.
    assert!(
        (order - 2.0).abs() < 0.3,
        "{}: the error of the velocity falls with order {order}, not 2",
        flow.name
    );
    // An amplitude that has halved is wrong by ln 2 times the relative error of the viscosity. The
    // Mach number adds a part of its own, a tenth of Ma² = 3 (0.4/32)² = 5e-4: 4% of 1.4e-3.
    let expected = LN_2 * viscosity_error * flow.decay * K2;
    println!("  finest over that of the viscosity alone: {:.3}", errors[2] / expected);
    assert!(
        (errors[2] / expected - 1.0).abs() < 0.06,
        "{}: errors {errors:?}: the finest is not what the error of the viscosity explains",
        flow.name
    );
}

#[test]
fn taylor_green_vortices_decay_with_second_order() {
    let mut budget = Budget::oracle(250_000);
    // Waves along the diagonals, motion in their plane: the coefficients of `tests/oracle/viscosity.rs`.
    assert_second_order(&mut budget, &TAYLOR_GREEN, srt(), 0.0150);
    assert_second_order(&mut budget, &TAYLOR_GREEN, dhumieres(), 0.0268);
}

#[test]
fn abc_flow_decays_with_second_order() {
    let mut budget = Budget::oracle(12_500_000);
    // Waves along the axes: the coefficients of `tests/oracle/viscosity.rs`.
    assert_second_order(&mut budget, &ABC, srt(), 0.0533);
    assert_second_order(&mut budget, &ABC, dhumieres(), 0.0959);
}

#[test]
fn start_in_equilibrium_is_of_second_order_too_and_costs_what_its_missing_stress_explains() {
    let mut budget = Budget::oracle(450_000);
    for collision in [srt(), dhumieres()] {
        let flow = &TAYLOR_GREEN;
        let (with_stress, _) = convergence(&mut budget, flow, collision, Start::WithStress);
        let (errors, order) = convergence(&mut budget, flow, collision, Start::Equilibrium);
        assert!((order - 2.0).abs() < 0.3, "{}: order {order}", flow.name);
        // The stress builds up as 1 - (1 - 1/τ)^t; until then K² τ (1 - τ)/3 of the momentum is lost
        // once more (or less, if τ > 1). The next term is of order K² = 0.08 of that.
        let cost = errors[2] - with_stress[2];
        let expected = flow.decay * K2 * TAU * (1.0 - TAU) / 3.0;
        println!("  cost of the start over the expected one: {:.3}", cost / expected);
        assert!((cost / expected - 1.0).abs() < 0.1, "cost {cost}, expected {expected}");
    }
}
