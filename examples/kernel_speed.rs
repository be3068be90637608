//! How fast the kernel is, with the oracle on the same processor beside it:
//! `cargo run --release --example kernel_speed [largest side] [adapter]`.
//!
//! Prints million cell updates per second, the best of three runs after a warm-up (shaders compile at
//! their first use), and the bytes that a cell update moves. The bed is a body-centred array of spheres
//! of 16 cells that fill 0.6 of the box; the few solids are two of them.

use std::sync::Arc;
use std::time::Instant;

use psmrt::kernel::{Gpu, Kernel};
use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

/// Seconds that one timed run takes, about.
const SECONDS: f64 = 1.0;

fn srt() -> Collision {
    Collision::Srt { tau: 0.8 }
}

fn mrt() -> Result<Collision, psmrt_reference::rates::RateError> {
    Ok(Collision::Mrt { rates: Rates::dhumieres(0.8)? })
}

/// Centres of a body-centred array with two spheres in each cube of `pitch` cells.
fn array(side: usize, pitch: usize) -> Vec<Vec3> {
    let cubes = side / pitch;
    let mut centres = Vec::new();
    for i in 0..cubes * cubes * cubes {
        let cube = [i % cubes, i / cubes % cubes, i / cubes / cubes];
        let corner = Vec3::from(cube.map(|c| (c * pitch) as f64)).add_scalar(0.3);
        centres.extend([corner, corner.add_scalar(0.5 * pitch as f64)]);
    }
    centres
}

/// A body-centred array of pitch 16 filled to 0.6, moving or held.
fn bed(side: usize, velocity: Vec3) -> SolidPhase {
    // 2 · 4/3 π a³ = 0.6 · 16³
    let radius = 16.0 * (0.9_f64 / (4.0 * std::f64::consts::PI)).cbrt();
    let solids = array(side, 16)
        .into_iter()
        .map(|centre| Solid { velocity, ..Solid::fixed_sphere(centre, radius) });
    SolidPhase { solids: solids.collect(), ..SolidPhase::default() }
}

fn few(side: usize) -> SolidPhase {
    let middle = Vec3::repeat(0.5 * side as f64);
    let solids = [0.25, -0.25]
        .map(|x| Solid::fixed_sphere(middle + Vec3::x() * (x * side as f64), side as f64 / 12.0));
    SolidPhase { solids: solids.into(), ..SolidPhase::default() }
}

/// Million cell updates per second of `run(steps)`, the best of three.
fn speed(cells: usize, mut run: impl FnMut(u64)) -> f64 {
    let mut steps = 2;
    run(steps);
    loop {
        let start = Instant::now();
        run(steps);
        let seconds = start.elapsed().as_secs_f64();
        if seconds > 0.25 * SECONDS {
            break;
        }
        steps *= 2;
    }
    let once = |run: &mut dyn FnMut(u64)| {
        let start = Instant::now();
        run(steps);
        (cells as f64 * steps as f64) / start.elapsed().as_secs_f64() / 1e6
    };
    (0..3).map(|_| once(&mut run)).fold(0.0, f64::max)
}

fn kernel_speed(gpu: &Arc<Gpu>, setup: &Setup) -> Result<f64, Box<dyn std::error::Error>> {
    let mut kernel = Kernel::new(gpu, setup.clone(), false)?;
    kernel.set_velocity(Vec3::new(0.01, 0.0, 0.0))?;
    let mut failure = None;
    let found = speed(setup.domain.cell_count(), |steps| {
        let made = kernel.advance(steps, false).and_then(|()| kernel.wait());
        failure = failure.take().or(made.err());
    });
    match failure {
        Some(error) => Err(error.into()),
        None => Ok(found),
    }
}

fn oracle_speed(setup: &Setup) -> Result<f64, Box<dyn std::error::Error>> {
    let mut solver = Solver::new(setup.clone())?;
    let mut failure = None;
    let found = speed(setup.domain.cell_count(), |steps| {
        failure = failure.take().or(solver.run(steps).err());
    });
    match failure {
        Some(error) => Err(error.into()),
        None => Ok(found),
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let largest: usize = arguments.next().map_or(Ok(128), |side| side.parse())?;
    let gpu = Gpu::open(arguments.next().as_deref())?;
    let facts = gpu.facts();
    println!("{} ({}, {}; {})", facts.name, facts.kind, facts.backend, facts.driver);
    println!("| cells | scene | kernel | oracle | ratio |");
    println!("|---|---|---|---|---|");
    let still = Vec3::zeros();
    for side in [16, 32, 64, 128].into_iter().filter(|&side| side <= largest) {
        let periodic = Domain::new([side; 3], Faces::PERIODIC)?;
        let walls = Faces { z: [Face::wall(); 2], ..Faces::PERIODIC };
        let channel = Domain::new([side; 3], walls)?;
        let force = Vec3::new(1e-6, 0.0, 0.0);
        let scenes = [
            ("SRT", Setup::fluid(periodic.clone(), srt())),
            ("MRT", Setup::fluid(periodic.clone(), mrt()?)),
            ("MRT, force", Setup::fluid(periodic.clone(), mrt()?).with_body_force(force)),
            ("MRT, two walls, force", Setup::fluid(channel, mrt()?).with_body_force(force)),
            ("PS-MRT, two spheres", Setup::fluid(periodic.clone(), mrt()?).with_solids(few(side))),
            ("PS-MRT, bed", Setup::fluid(periodic.clone(), mrt()?).with_solids(bed(side, still))),
            (
                "PS-MRT, bed with velocities",
                Setup::fluid(periodic, mrt()?).with_solids(bed(side, Vec3::new(1e-3, 0.0, 0.0))),
            ),
        ];
        for (name, setup) in scenes {
            let kernel = kernel_speed(&gpu, &setup)?;
            // The oracle's speed hardly depends on the size: it is measured where it is quick.
            let oracle =
                if side == 64 || side == largest { Some(oracle_speed(&setup)?) } else { None };
            let (oracle, ratio) = oracle.map_or_else(
                || ("".to_owned(), "".to_owned()),
                |oracle| (format!("{oracle:.1}"), format!("{:.1}", kernel / oracle)),
            );
            println!("| {side}³ | {name} | {kernel:.1} | {oracle} | {ratio} |");
        }
        if side == 16 {
            let setup = Setup::fluid(Domain::new([16; 3], Faces::PERIODIC)?, mrt()?);
            let steps = kernel_speed(&gpu, &setup)? * 1e6 / 4096.0;
            println!("| 16³ | MRT, steps per second | {steps:.0} | | |");
        }
    }
    println!("bytes per cell update: 152 (19 read, 19 written, 4 each); with solids in every cell");
    println!("4 more where they stay, 4 to 20 more where they move");
    Ok(())
}
