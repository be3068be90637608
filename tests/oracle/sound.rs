//! Sound at open faces: how much of it comes back.

use crate::common;

use common::Budget;
use common::collisions::{dhumieres, magic};
use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::{CS2, Vec3};
use psmrt_reference::setup::Setup;
use psmrt_reference::solver::Solver;

fn along_x(u: f64) -> Vec3 {
    Vec3::new(u, 0.0, 0.0)
}

fn non_reflecting(memory: f64) -> Face {
    Face::NonReflectingPressure { density: 1.0, memory }
}

/// Steps that sound takes for `cells` cells.
fn crossing(cells: f64) -> f64 {
    cells / CS2.sqrt()
}

/// Energy of the sound in a fluid whose density is 1 and that is at rest but for it.
fn energy(solver: &Solver) -> f64 {
    let rho = solver.density_field();
    let u = solver.velocity_field();
    // e = c_s² δρ²/(2 ρ) + ρ u²/2
    rho.iter().zip(&u).map(|(rho, u)| 0.5 * (CS2 * (rho - 1.0).powi(2) + u.norm_squared())).sum()
}

#[test]
fn explore_pulse() {
    let (l, sigma) = (200.0_f64, 10.0_f64);
    let mut budget = Budget::oracle(10_000_000);
    for tau in [0.51, 1.0, 2.0] {
        for (name, collision) in [("magic", magic(tau, 0.1875)), ("dh", dhumieres(tau))] {
            for face in [
                Face::Pressure { density: 1.0 },
                Face::DevelopedPressure { density: 1.0 },
                Face::FreeOutflow,
                non_reflecting(4.0 * crossing(l)),
                non_reflecting(1e6),
            ] {
                let inlet = Face::VelocityInlet { velocity: Vec3::zeros() };
                let domain =
                    Domain::new([l as usize, 1, 1], Faces { x: [inlet, face], ..Faces::PERIODIC })
                        .unwrap();
                let mut solver = Solver::starting_from(Setup::fluid(domain, collision), |x| {
                    let g = 1e-4 * (-0.5 * ((x.x - 0.5 * l) / sigma).powi(2)).exp();
                    (1.0 + g, along_x(g * CS2.sqrt()))
                })
                .unwrap();
                let before = energy(&solver);
                budget.run(&mut solver, crossing(l).round() as u64);
                println!("tau {tau} {name} {face:?}: {:.3e}", energy(&solver) / before);
            }
        }
    }
}

#[test]
fn explore_frequencies() {
    let mut budget = Budget::oracle(10_000_000);
    for tau in [0.51, 1.0, 2.0] {
        let (n, memory, steps) = (1000_usize, 50.0_f64, 1600_u64);
        let at = n - 60;
        let start = at as f64 - 80.0;
        let domain = Domain::new(
            [n, 1, 1],
            Faces { x: [Face::wall(), non_reflecting(memory)], ..Faces::PERIODIC },
        )
        .unwrap();
        let mut solver = Solver::starting_from(Setup::fluid(domain, dhumieres(tau)), |x| {
            let g = 1e-4 * (-0.5 * ((x.x - start) / 10.0).powi(2)).exp();
            (1.0 + g, along_x(g * CS2.sqrt()))
        })
        .unwrap();
        let omegas = [0.25, 0.5, 1.0, 2.0, 4.0].map(|x| x / (2.0 * memory));
        let mut sums = [[[0.0_f64; 2]; 2]; 5];
        for step in 0..steps {
            let (rho, u) =
                (solver.density_field()[at] - 1.0, solver.velocity_field()[at].x / CS2.sqrt());
            for (omega, sums) in omegas.iter().zip(&mut sums) {
                let (s, c) = (omega * step as f64).sin_cos();
                for (sum, wave) in sums.iter_mut().zip([0.5 * (rho + u), 0.5 * (rho - u)]) {
                    sum[0] += c * wave;
                    sum[1] += s * wave;
                }
            }
            budget.run(&mut solver, 1);
        }
        for (omega, sums) in omegas.iter().zip(&sums) {
            let [out, back] = sums.map(|s| s[0].hypot(s[1]));
            let theory = 1.0 / (1.0 + (2.0 * omega * memory).powi(2)).sqrt();
            println!(
                "tau {tau} 2wT {}: |r| {:.4} theory {theory:.4}",
                2.0 * omega * memory,
                back / out
            );
        }
    }
}

#[test]
fn explore_oblique() {
    let mut budget = Budget::oracle(40_000_000);
    for tau in [0.51, 1.0] {
        for degrees in [0.0_f64, 30.0, 45.0, 60.0] {
            let angle = degrees.to_radians();
            let wave = 20.0;
            let k = std::f64::consts::TAU / wave;
            let ny = if degrees == 0.0 { 1.0 } else { (wave / angle.sin()).round() };
            let ky = if degrees == 0.0 { 0.0 } else { std::f64::consts::TAU / ny };
            let kx = (k * k - ky * ky).sqrt();
            let n = Vec3::new(kx / k, ky / k, 0.0);
            let (l, sigma) = (160.0_f64, 16.0);
            for face in [
                Face::Pressure { density: 1.0 },
                Face::DevelopedPressure { density: 1.0 },
                Face::FreeOutflow,
                non_reflecting(4.0 * crossing(l)),
            ] {
                let inlet = Face::VelocityInlet { velocity: Vec3::zeros() };
                let domain = Domain::new(
                    [l as usize, ny as usize, 1],
                    Faces { x: [inlet, face], ..Faces::PERIODIC },
                )
                .unwrap();
                let mut solver =
                    Solver::starting_from(Setup::fluid(domain, magic(tau, 0.1875)), |x| {
                        let g = 1e-4
                            * (-0.5 * ((x.x - 0.5 * l) / sigma).powi(2)).exp()
                            * (kx * x.x + ky * x.y).cos();
                        (1.0 + g, n * g * CS2.sqrt())
                    })
                    .unwrap();
                let before = energy(&solver);
                budget.run(&mut solver, (crossing(l) / n.x).round() as u64);
                println!(
                    "tau {tau} {degrees} {face:?} theory {:.3e}: {:.3e}",
                    (0.5 * n.x.acos()).tan().powi(4),
                    energy(&solver) / before
                );
            }
        }
    }
}
