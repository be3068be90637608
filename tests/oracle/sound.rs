//! Sound at open faces: how much of it comes back.

use crate::common;

use std::f64::consts::{PI, TAU};

use common::Budget;
use common::collisions::{dhumieres, magic};
use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::{CS2, Vec3, viscosity};
use psmrt_reference::setup::Setup;
use psmrt_reference::solver::Solver;

const PRESSURE: Face = Face::Pressure { density: 1.0 };

fn non_reflecting(memory: f64) -> Face {
    Face::NonReflectingPressure { density: 1.0, memory }
}

/// Steps that sound takes for `cells` cells.
fn crossing(cells: f64) -> f64 {
    cells / CS2.sqrt()
}

/// A fluid in which a wave packet runs along `k`, the wave vector: `cos(k·x)` in a bell of standard deviation
/// `sigma` about x = `at`. Density 1 and at rest but for a ten-thousandth, so that acoustics is linear.
fn packet(domain: Domain, collision: Collision, k: Vec3, at: f64, sigma: f64) -> Solver {
    let along = k.try_normalize(0.0).unwrap_or_else(Vec3::x);
    let setup = Setup::fluid(domain, collision);
    Solver::starting_from(setup, |x| {
        let bell = (-0.5 * ((x.x - at) / sigma).powi(2)).exp();
        let wave = 1e-4 * bell * k.dot(&x).cos();
        // δρ = δu/c_s
        (1.0 + wave, along * wave * CS2.sqrt())
    })
    .unwrap()
}

/// Energy of the sound.
fn energy(solver: &Solver) -> f64 {
    let (rho, u) = (solver.density_field(), solver.velocity_field());
    // Σ c_s² δρ²/(2 ρ) + ρ u²/2
    rho.iter().zip(&u).map(|(rho, u)| 0.5 * (CS2 * (rho - 1.0).powi(2) + u.norm_squared())).sum()
}

#[test]
fn pulse_leaves_through_a_non_reflecting_face_but_for_what_its_memory_sends_back() {
    // A bell of 10 cells in the middle of 200, and what is left of its energy when it would be there again.
    const L: f64 = 200.0;
    const SIGMA: f64 = 10.0;
    let memory = 4.0 * crossing(L);
    // What comes back is r(t) = -1/(2T) exp(-t/2T) after the bell has passed (the inverse of -1/(1 + 2iωT)): with
    // the bell's time integral √(2π) σ/c_s an energy of c_s (√(2π) σ/(2 T c_s))² T (1 - exp(-L/(2 T c_s))), beside
    // the bell's √π σ.
    let area = TAU.sqrt() * crossing(SIGMA);
    let sent_back = CS2.sqrt()
        * (area / (2.0 * memory)).powi(2)
        * memory
        * (1.0 - (-0.5 * crossing(L) / memory).exp())
        / (PI.sqrt() * SIGMA);
    assert!((sent_back - 1.30e-3).abs() < 1e-5, "by theory {sent_back:e}");
    let mut budget = Budget::oracle(700_000);
    for tau in [0.51, 1.0, 2.0] {
        let mut left = |face| {
            let still = Face::VelocityInlet { velocity: Vec3::zeros() };
            let faces = Faces { x: [still, face], ..Faces::PERIODIC };
            let domain = Domain::new([200, 1, 1], faces).unwrap();
            let mut solver = packet(domain, dhumieres(tau), Vec3::zeros(), 0.5 * L, SIGMA);
            let before = energy(&solver);
            budget.run(&mut solver, 346);
            energy(&solver) / before
        };
        let (open, held, free) =
            (left(non_reflecting(memory)), left(PRESSURE), left(Face::FreeOutflow));
        println!("tau = {tau}: non-reflecting {open:.2e}, pressure {held:.2}, outflow {free:.3}");
        // Why 5e-4: the face takes the velocity of a node half a cell away, which sends back up to k/4 of a wave of
        // number k: 1/(32 σ²) = 3e-4 of the bell's energy.
        assert!(
            (open - sent_back).abs() < 5e-4,
            "tau = {tau}: {open:e} of a pulse's energy is left in front of a non-reflecting face, by theory \
             {sent_back:e}"
        );
        assert!(
            held > 100.0 * open && free > 10.0 * open,
            "tau = {tau}: a pressure face leaves {held}, a free outflow {free}, so why have another: {open}"
        );
    }
}

#[test]
fn amplitude_that_comes_back_falls_with_the_frequency_as_theory_says() {
    // A short bell holds all frequencies; a probe between it and the face sees it go and come back.
    const T: f64 = 50.0;
    const PROBE: usize = 300;
    const STEPS: u64 = 1250;
    let mut budget = Budget::oracle(1_500_000);
    for tau in [0.51, 1.0, 2.0] {
        let faces = Faces { x: [Face::wall(), non_reflecting(T)], ..Faces::PERIODIC };
        let domain = Domain::new([360, 1, 1], faces).unwrap();
        let mut solver = packet(domain, dhumieres(tau), Vec3::zeros(), 220.0, 10.0);
        let omegas = [0.5, 1.0, 2.0, 4.0].map(|twice| twice / (2.0 * T));
        // Of each frequency the waves to the face and from it, cosine and sine.
        let mut sums = [[[0.0_f64; 2]; 2]; 4];
        for step in 0..STEPS {
            let drho = solver.density_field()[PROBE] - 1.0;
            let u = solver.velocity_field()[PROBE].x / CS2.sqrt();
            for (omega, waves) in omegas.iter().zip(&mut sums) {
                let (sine, cosine) = (omega * step as f64).sin_cos();
                for (sum, wave) in waves.iter_mut().zip([drho + u, drho - u]) {
                    sum[0] += cosine * wave;
                    sum[1] += sine * wave;
                }
            }
            budget.run(&mut solver, 1);
        }
        for (omega, waves) in omegas.iter().zip(&sums) {
            let [to, from] = waves.map(|[cosine, sine]| cosine.hypot(sine));
            // Friction takes exp(-α) a cell, α = ω² (4/3 ν + ζ)/(2 c_s³), ζ = 2/9 (1/s_e - 1/2), on 120 cells.
            let bulk = 2.0 / 9.0 * (1.0 / 1.19 - 0.5);
            let alpha = omega.powi(2) * (4.0 / 3.0 * viscosity(tau) + bulk) / (2.0 * CS2.powf(1.5));
            let r = from / to * (120.0 * alpha).exp();
            let theory = 1.0 / (1.0 + (2.0 * omega * T).powi(2)).sqrt();
            // Why: the velocity is that of a node half a cell before the face, a phase of k/2.
            let allowed = 0.5 * omega / CS2.sqrt();
            println!(
                "tau = {tau}, 2 ω T = {}: |r| = {r:.4}, by theory {theory:.4}",
                2.0 * omega * T
            );
            assert!(
                (r - theory).abs() < allowed,
                "tau = {tau}, 2 ω T = {}: |r| = {r}, by theory {theory} to {allowed}",
                2.0 * omega * T
            );
        }
    }
}

#[test]
fn of_sound_that_arrives_obliquely_the_share_of_theory_comes_back() {
    // Waves of 20 cells that fit into a periodic width, in a bell of 16 cells.
    const L: f64 = 160.0;
    let mut budget = Budget::oracle(3_900_000);
    for (degrees, width) in [(30.0_f64, 40_usize), (45.0, 28)] {
        let (k, k_y) = (TAU / 20.0, TAU / width as f64);
        let k = Vec3::new((k * k - k_y * k_y).sqrt(), k_y, 0.0);
        let cosine = k.x / k.norm();
        assert!((cosine.acos().to_degrees() - degrees).abs() < 1.0);
        let faces =
            Faces { x: [Face::wall(), non_reflecting(4.0 * crossing(L))], ..Faces::PERIODIC };
        let domain = Domain::new([160, width, 1], faces).unwrap();
        let mut solver = packet(domain, magic(0.51, 0.1875), k, 0.5 * L, 16.0);
        let before = energy(&solver);
        // Until the bell would be where it was.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "hundreds")]
        budget.run(&mut solver, (crossing(L) / cosine).round() as u64);
        let r = (energy(&solver) / before).sqrt();
        // 1 + r = cos θ (1 - r), so that |r| = tan²(θ/2)
        let theory = (1.0 - cosine) / (1.0 + cosine);
        println!("{degrees} degrees: {:.3} of the energy, by theory {:.3}", r * r, theory * theory);
        // Why k/4: as for the pulse, of a wave that is 20 cells long.
        assert!(
            (r - theory).abs() < 0.25 * k.x,
            "{degrees} degrees to the normal: |r| = {r}, by theory {theory}"
        );
    }
}
