//! What the grains cost beside the fluid: the paper's 12,000 grains of 4 cells in 150 x 300 x 150 cells,
//! first apart from each other (solid fraction 6 %), then as a bed.
//!
//! Prints seconds per fluid step of each part: the fluid's collision and streaming with the forces on
//! the grains, the grains' own motion, and the listing of the cells that they cover. A few minutes.
//!
//! ```text
//! cargo run --release --example grain_cost > golden/cloud_settling/cost.csv
//! ```

use psmrt_reference::collision::Collision;
use psmrt_reference::coupling::{CouplingSettings, FreeGrains, Gravity};
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::GrainSetup;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solver::Solver;
use std::error::Error;
use std::time::Instant;

const CELLS: [u16; 3] = [150, 300, 150];
const GRAINS: usize = 12_000;
const STEPS: u32 = 5;

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "# What 12,000 grains of 4 cells cost beside the fluid in 150 x 300 x 150 cells, oracle:"
    );
    println!("# cargo run --release --example grain_cost, {} threads", threads());
    println!("# Seconds per fluid step, mean of {STEPS} steps; contacts last 10 fluid steps.");
    println!("spacing_cells,solids_touch,substeps,fluid_s,grains_s,coverage_s");
    // Regular places, a little disturbed: 25 x 40 x 12 of them.
    for (spacing, touch) in [(5.5, "no"), (3.96, "yes")] {
        let [mut fluid, mut motion, mut coverage] = [0.0; 3];
        let (mut solver, mut grains) = set_up(spacing)?;
        let mut substeps = 0;
        for _ in 0..STEPS {
            let start = Instant::now();
            solver.advance_fluid()?;
            fluid += start.elapsed().as_secs_f64();
            let start = Instant::now();
            substeps = grains.step(solver.loads())?;
            motion += start.elapsed().as_secs_f64();
            let start = Instant::now();
            let solids = grains.solids();
            solver.place_solids(|number, solid| *solid = solids[number].clone());
            coverage += start.elapsed().as_secs_f64();
        }
        let [fluid, motion, coverage] = [fluid, motion, coverage].map(|s| s / f64::from(STEPS));
        println!("{spacing},{touch},{substeps},{fluid:.4},{motion:.4},{coverage:.4}");
    }
    Ok(())
}

fn set_up(spacing: f64) -> Result<(Solver, FreeGrains), Box<dyn Error>> {
    let walls = [Face::wall(); 2];
    let domain = Domain::new(CELLS.map(usize::from), Faces { x: walls, y: walls, z: walls })?;
    let place = |number: usize| {
        let at = [number % 25, number / 25 % 40, number / 1000];
        // A shift of each grain of its own, below a twentieth of a cell.
        Vec3::from_fn(|axis, _| {
            let shift = 0.05 * ((number * (axis + 7)) as f64).sin();
            3.0 + spacing * at[axis] as f64 + shift
        })
    };
    let moving = |number: usize| Vec3::new(0.0, 0.0, -0.02 - 0.01 * (number as f64).sin());
    let grain = |number| Grain::sphere(place(number), 2.0, 2.65).moving(moving(number));
    let grains: Vec<_> = (0..GRAINS).map(grain).collect();
    let law = ContactLaw::from_duration_and_restitution(10.0, 0.5, 0.5 * grains[0].mass)?
        .with_friction(0.3)?;
    let high = Vec3::from_fn(|axis, _| f64::from(CELLS[axis]));
    let planes = Plane::box_walls(Vec3::zeros(), high, &[0, 1, 2], law);
    let gravity = Some(Gravity::Reduced { acceleration: Vec3::new(0.0, 0.0, -1e-4) });
    let settings = CouplingSettings { gravity, ..Default::default() };
    let grains = FreeGrains::new(&domain, GrainSetup::new(law), grains, planes, settings)?;
    let phase = SolidPhase { solids: grains.solids(), ..Default::default() };
    let collision = Collision::Mrt { rates: Rates::dhumieres(0.8)? };
    let solver = Solver::new(Setup::fluid(domain, collision).with_solids(phase))?;
    Ok((solver, grains))
}

fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}
