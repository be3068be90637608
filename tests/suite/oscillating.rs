//! Flows that oscillate, by way of scenes, against exact solutions.

use std::f64::consts::{PI, TAU};

use crate::common::Budget;
use crate::common::womersley::{Oscillation, at_time};
use crate::scenes::{scene, water};
use psmrt::engine::{Block, Coupled, EngineName, open};
use psmrt_reference::lattice::Vec3;

/// Lattice units of these scenes: ν = 0.1 at tau 0.8, cells of 1e-5 m, steps of 1e-5 s, so that a velocity of 1 is 1 m/s and
/// an acceleration of 1 is 1e5 m/s².
const NU: f64 = 0.1;
const SI_ACCELERATION: f64 = 1e5;
const SI_STEP: f64 = 1e-5;

const MAGIC: &str = "[collision]\nrates = \"magic\"\nmagic = 0.1875\n";

fn opened(text: &str) -> Coupled {
    open(EngineName::Cpu, &scene(text), None, false).unwrap()
}

/// Steps of a period with which `√(ω/ν) n` is `womersley`.
fn period(womersley: f64, n: f64) -> f64 {
    (TAU * (n / womersley).powi(2) / NU).round()
}

/// Largest error of the velocity along x, over the largest exact one, sampled from step `from` to step `to`.
fn error(
    engine: &mut Coupled,
    budget: &mut Budget,
    [from, to]: [u64; 2],
    exact: impl Fn(&Vec3, f64) -> f64,
) -> f64 {
    let domain = engine.setup().domain.clone();
    budget.spend(to * domain.cell_count() as u64);
    engine.step(from).unwrap();
    let (mut error, mut largest) = (0.0_f64, 0.0_f64);
    while engine.steps() < to {
        engine.step((to - engine.steps()).min(16)).unwrap();
        let now = engine.steps() as f64;
        for (cell, state) in engine.cells(Block::whole(&domain)).iter().enumerate() {
            let right = exact(&domain.centre(domain.coordinates(cell)), now);
            error = error.max((state.velocity.x - right).abs());
            largest = largest.max(right.abs());
        }
    }
    println!("error {:.2e} of {largest:.2e}", error / largest);
    error / largest
}

/// Flow along x in a square duct of `n` cells under an acceleration `G cos ωt`, from rest.
fn duct(n: usize, budget: &mut Budget) -> f64 {
    let width = n as f64;
    let steps = period(4.0, width);
    let force = 2e-4 * (12.0 / width).powi(2);
    let text = water(
        [1, n, n],
        1e-5,
        &format!(
            "{MAGIC}[faces]\ny_low.kind = \"wall\"\ny_high.kind = \"wall\"\nz_low.kind = \"wall\"\nz_high.kind = \"wall\"\n\
             [body_force]\nacceleration = {{ amplitude = [{:e}, 0.0, 0.0], period = {:e}, phase = {} }}\n[stop]\nsteps = 9\n",
            force * SI_ACCELERATION,
            steps * SI_STEP,
            0.5 * PI
        ),
    );
    let omega = TAU / steps;
    let centres: Vec<f64> = (0..n).map(|cell| cell as f64 + 0.5).collect();
    let amplitudes = Oscillation { nu: NU, omega }.in_square_duct(force, width, &centres);
    let exact = |at: &Vec3, t: f64| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cell")]
        let [y, z] = [at.y, at.z].map(|x| x.floor() as usize);
        at_time(amplitudes[y + n * z], omega, t)
    };
    // What the start from rest adds decays with ν 2π²/n²: to exp(-2π³/16 · 4) = 2e-7 of itself in two periods.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some thousand")]
    let range = [2.0 * steps, 2.5 * steps].map(|step| step as u64);
    error(&mut opened(&text), budget, range, exact)
}

/// A second difference takes `κ (1 - (κh)²/24)` for a wave number `κ`: over the width that makes `κn (κh)²/24` of the
/// velocity, along each of two axes; the collision has terms of its own of that order, for which four times as much is
/// allowed, as in `tests/driven`.
#[test]
fn a_force_that_oscillates_gives_the_exact_flow_in_a_duct_in_second_order() {
    let mut budget = Budget::kernel(3_700_000);
    let errors = [12, 24].map(|n| duct(n, &mut budget));
    let bound = 4.0 * 2.0 * 4.0 * (4.0_f64 / 24.0).powi(2) / 24.0;
    assert!(errors[1] < bound, "{errors:?}: {bound} is allowed with 24 cells");
    let ratio = errors[0] / errors[1];
    assert!(
        (3.4..4.7).contains(&ratio),
        "errors {errors:?}, {ratio} times as large with half the cells"
    );
}

/// Flow between plates `n` apart, driven by the pressure at one end: `G = Δp/(ρ L)`.
#[test]
fn a_pressure_that_oscillates_at_one_end_gives_womersleys_flow() {
    let mut budget = Budget::kernel(1_300_000);
    let (n, length) = (16.0, 8.0);
    let steps = period(2.0, n);
    // Density 0.001 more or less: p = ρ/3.
    let si_pressure = 1000.0 * 0.001 / 3.0;
    let text = water(
        [8, 16, 1],
        1e-5,
        &format!(
            "{MAGIC}[faces]\ny_low.kind = \"wall\"\ny_high.kind = \"wall\"\n\
             x_low = {{ kind = \"pressure\", developed = true, pressure = {{ amplitude = {si_pressure:e}, period = {:e}, phase = {} }} }}\n\
             x_high = {{ kind = \"pressure\", developed = true, pressure = 0.0 }}\n[stop]\nsteps = 9\n",
            steps * SI_STEP,
            0.5 * PI
        ),
    );
    let omega = TAU / steps;
    let force = 0.001 / 3.0 / length;
    let flow = Oscillation { nu: NU, omega };
    let exact = |at: &Vec3, t: f64| at_time(flow.between_plates(force, n, at.y), omega, t);
    // The start decays with ν π²/n²: to exp(-2π π²/4 · 2) of itself in two periods. The grid, as above, a channel: 0.005;
    // the fluid is compressed by (ω L/c_s)²/2 = 2e-4 of the flow, and its density differs from 1 by 0.001.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some thousand")]
    let range = [2.0 * steps, 2.5 * steps].map(|step| step as u64);
    let error = error(&mut opened(&text), &mut budget, range, exact);
    assert!(error < 0.01, "velocities are off by {error} of the largest, 0.01 is allowed");
}
