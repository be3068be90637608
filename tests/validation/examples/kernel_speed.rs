//! How fast the kernel is, with the oracle on the same processor beside it, and what each model costs that
//! a scene may leave out: `cargo run -p psmrt-validation --example kernel_speed [largest side] [adapter] > FILE`.
//!
//! Million cell updates per second, the best of three runs after a warm-up (shaders compile at their first
//! use). On a software adapter a second is one of processor time of each thread: what the machine does
//! where nothing else keeps its processors from it and no thread waits. That hardly depends on what else
//! the machine does. On hardware, or where processor time is not known, it is a second on the clock.
//! The bed is a body-centred array of spheres that
//! fill 0.6 of the box; the few solids are two.

use std::sync::Arc;

use psmrt::kernel::{Gpu, Kernel, KernelError};
use psmrt::machine::{Beginning, Spent};
use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

/// Seconds that one timed run takes, at least.
const SECONDS: f64 = 0.4;

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

/// A body-centred array of pitch 16, filled to `solid_fraction`, moving or held.
fn bed(side: usize, solid_fraction: f64, velocity: Vec3) -> SolidPhase {
    // 2 · 4/3 π a³ = φ · 16³
    let radius = 16.0 * (solid_fraction * 3.0 / (8.0 * std::f64::consts::PI)).cbrt();
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

/// Seconds that `work` takes: of the processor for each thread on software adapters, else on the clock.
fn seconds(on_processor: bool, work: impl FnOnce()) -> f64 {
    let since = Beginning::now();
    work();
    let mut spent = Spent::default();
    spent.add(since);
    if on_processor && !spent.processor.is_zero() {
        return spent.processor.as_secs_f64() / psmrt::machine::threads() as f64;
    }
    spent.clock.as_secs_f64()
}

/// Million cell updates per second of `run(steps)`, the best of three.
fn speed(on_processor: bool, cells: usize, mut run: impl FnMut(u64)) -> f64 {
    let mut steps = 2;
    run(steps);
    while seconds(on_processor, || run(steps)) < SECONDS {
        steps *= 2;
    }
    let updates = cells as f64 * steps as f64;
    (0..3).map(|_| updates / seconds(on_processor, || run(steps)) / 1e6).fold(0.0, f64::max)
}

/// What is done besides the steps.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Besides {
    Nothing,
    /// The loads are worked out at every step.
    Loads,
    /// So they are, and the solids move by a thousandth of a cell: all that they cover is listed anew.
    LoadsAndMotion,
}

fn kernel_speed(
    gpu: &Arc<Gpu>,
    setup: &Setup,
    besides: Besides,
) -> Result<f64, Box<dyn std::error::Error>> {
    let mut kernel = Kernel::new(gpu, setup.clone(), besides == Besides::LoadsAndMotion)?;
    kernel.set_velocity(Vec3::new(0.01, 0.0, 0.0))?;
    let mut solids = setup.solid_phase.as_ref().map_or_else(Vec::new, |phase| phase.solids.clone());
    let mut failure = None;
    let found = speed(gpu.facts().is_software(), setup.domain.cell_count(), |steps| {
        let mut make = || -> Result<(), KernelError> {
            if besides == Besides::Nothing {
                kernel.advance(steps, false)?;
            } else {
                for _ in 0..steps {
                    kernel.advance(1, true)?;
                    if besides == Besides::LoadsAndMotion {
                        kernel.loads()?;
                        solids.iter_mut().for_each(|solid| solid.centre.x += 1e-3);
                        kernel.place_solids(solids.clone())?;
                    }
                }
            }
            kernel.wait()
        };
        let made = make();
        failure = failure.take().or(made.err());
    });
    match failure {
        Some(error) => Err(error.into()),
        None => Ok(found),
    }
}

fn oracle_speed(on_processor: bool, setup: &Setup) -> Result<f64, Box<dyn std::error::Error>> {
    let mut solver = Solver::new(setup.clone())?;
    let mut failure = None;
    let found = speed(on_processor, setup.domain.cell_count(), |steps| {
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
    let software = facts.is_software();
    println!("# Million cell updates per second; ratio: kernel over oracle.");
    if software {
        println!(
            "# A second is one of processor time of each thread: of a machine that does nothing else."
        );
    }
    println!("# Made by: cargo run -p psmrt-validation --example kernel_speed {largest}");
    println!("# Adapter: {} ({}, {}; {})", facts.name, facts.kind, facts.backend, facts.driver);
    let processor = psmrt::machine::processor().unwrap_or_else(|| "unknown".to_owned());
    println!("# Processor: {processor}, {} threads", psmrt::machine::threads());
    println!(
        "# A cell update moves 152 bytes (19 read, 19 written, 4 each); with solids in every cell 4 more"
    );
    println!("# where they stay; where they move 4 and, in cells that they touch, 16 more.");
    println!("# cost: time of a cell update of the kernel over that of plain MRT.");
    println!("cells,scene,kernel,cost,oracle,ratio");
    let (still, velocity) = (Vec3::zeros(), Vec3::new(1e-3, 0.0, 0.0));
    let force = Vec3::new(1e-6, 0.0, 0.0);
    for side in [16, 32, 64, 128].into_iter().filter(|&side| side <= largest) {
        let periodic = Domain::new([side; 3], Faces::PERIODIC)?;
        let walls = Faces { z: [Face::wall(); 2], ..Faces::PERIODIC };
        let channel = Domain::new([side; 3], walls)?;
        let fluid = |collision| Setup::fluid(periodic.clone(), collision);
        let held = fluid(mrt()?).with_solids(bed(side, 0.6, still));
        let driven = fluid(mrt()?).with_solids(bed(side, 0.6, velocity));
        let loose = fluid(mrt()?).with_solids(bed(side, 0.3, velocity));
        let two = fluid(mrt()?).with_solids(few(side));
        let forced = fluid(mrt()?).with_body_force(force);
        let rows = [
            ("MRT", fluid(mrt()?), Besides::Nothing),
            ("SRT", fluid(srt()), Besides::Nothing),
            ("MRT; body force", forced, Besides::Nothing),
            ("MRT; two walls", Setup::fluid(channel, mrt()?), Besides::Nothing),
            ("PS-MRT; two spheres", two, Besides::Nothing),
            ("PS-MRT; held bed", held.clone(), Besides::Nothing),
            ("PS-MRT; held bed; loads at every step", held, Besides::Loads),
            ("PS-MRT; bed of 0.3 with velocities; no cell has two", loose, Besides::Nothing),
            ("PS-MRT; bed with velocities", driven.clone(), Besides::Nothing),
            ("PS-MRT; bed with velocities; loads at every step", driven.clone(), Besides::Loads),
            (
                "PS-MRT; bed on the move; loads and coverage at every step",
                driven,
                Besides::LoadsAndMotion,
            ),
        ];
        let mut plain = None;
        for (name, setup, besides) in rows {
            let kernel = kernel_speed(&gpu, &setup, besides)?;
            // The oracle's speed hardly depends on the size, and it works out the loads at every step: it
            // is measured where that is quick.
            let beside = if side == 64 && besides != Besides::LoadsAndMotion {
                let oracle = oracle_speed(software, &setup)?;
                format!("{oracle:.2},{:.1}", kernel / oracle)
            } else {
                ",".to_owned()
            };
            let plain = *plain.get_or_insert(kernel);
            println!("{side},{name},{kernel:.2},{:.2},{beside}", plain / kernel);
        }
    }
    Ok(())
}
