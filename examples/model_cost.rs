//! What each model costs, switched on alone: `cargo run --example model_cost [repeats]`.
//!
//! Writes `golden/cost/cost.csv` anew. Each model is timed in turn with the fluid that it is added to, a
//! slice of some milliseconds each, many times over; the ratio is that of the two shortest times, so that
//! what else the machine does matters little. One thread each: set RAYON_NUM_THREADS=1 and, for Mesa's
//! software adapter, LP_NUM_THREADS=1. Bytes are what the process has grown by (Linux).

use std::error::Error;
use std::fmt::Write;
use std::sync::Arc;
use std::time::Instant;

use psmrt::cases::EngineName;
use psmrt::engine::{Engine, KernelEngine, ReferenceEngine};
use psmrt::kernel::Gpu;
use psmrt::scene::FreePart;
use psmrt_reference::collision::Collision;
use psmrt_reference::coupling::CouplingSettings;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::lubrication::Lubrication;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::guard::GuardSettings;
use psmrt_reference::lattice::{Vec3, viscosity};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;

const FILE: &str = "golden/cost/cost.csv";
const SIDE: usize = 32;
const CELLS: f64 = (SIDE * SIDE * SIDE) as f64;
const TAU: f64 = 0.8;

type Failure = Box<dyn Error>;

/// A model and what it is added to.
struct Model {
    name: &'static str,
    /// What it is held against: its place in the list.
    against: usize,
    setup: Setup,
    free: Option<FreePart>,
    /// Means over the box are recorded after so many steps.
    record_every: Option<u64>,
}

/// Steps of a slice: a multiple of the guard's 16 and of the record's 10.
const SLICE: u64 = 80;

fn main() -> Result<(), Failure> {
    let repeats: u32 = std::env::args().nth(1).map_or(Ok(15), |count| count.parse())?;
    let mut text = format!(
        "# What each model costs, switched on alone: cargo run --example model_cost {repeats}\n\
         # {SIDE}^3 cells, tau = {TAU}; slices of {SLICE} steps (the oracle's of 8), each model in turn with what it is\n\
         # added to, {repeats} times, the shortest of each; one thread (RAYON_NUM_THREADS=1, LP_NUM_THREADS=1), on two\n\
         # shared cores; load of the machine at the start and the end in the last lines. guard: off but in its own row\n\
         # and in `records`. Against: bare fluid with SRT or MRT, or the row of that name.\n\
         # bytes_per_cell: growth of the process's memory over cells; on a software adapter that is the device's too.\n\
         engine,model,against,time_ratio,ns_per_cell_update,bytes_per_cell\n"
    );
    let load = || std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let first_load = load();
    let gpu = Gpu::open(None)?;
    for engine in [EngineName::Reference, EngineName::Wgpu] {
        let models = models()?;
        for model in &models {
            let base = &models[model.against];
            let start = |model: &Model| start(engine, &gpu, model);
            let before = memory();
            let mut this = start(model)?;
            let mut other = None;
            time(this.as_mut(), model, 16)?;
            let bytes = memory().zip(before).map(|(after, before)| (after - before) / CELLS);
            let steps = if engine == EngineName::Reference { 8 } else { SLICE };
            let (mut mine, mut theirs) = (f64::INFINITY, f64::INFINITY);
            for _ in 0..repeats {
                let other = match &mut other {
                    Some(other) => other,
                    none => none.insert(start(base)?),
                };
                theirs = theirs.min(time(other.as_mut(), base, steps)?);
                mine = mine.min(time(this.as_mut(), model, steps)?);
            }
            let bytes = bytes.map_or("-".to_owned(), |bytes| format!("{bytes:.0}"));
            let row = format!(
                "{},{},{},{:.3},{:.2},{bytes}",
                engine.word(),
                model.name,
                base.name,
                mine / theirs,
                mine / (steps as f64 * CELLS) * 1e9,
            );
            println!("{row}");
            writeln!(text, "{row}")?;
        }
    }
    writeln!(text, "# adapter: {}", gpu.facts().name)?;
    writeln!(text, "# load at the start {} at the end {}", first_load.trim(), load().trim())?;
    std::fs::create_dir_all("golden/cost")?;
    std::fs::write(FILE, text)?;
    Ok(())
}

/// Seconds that `steps` steps take, with what is recorded.
fn time(engine: &mut dyn Engine, model: &Model, steps: u64) -> Result<f64, Failure> {
    let start = Instant::now();
    let batch = model.record_every.unwrap_or(steps).min(steps);
    for _ in 0..steps / batch {
        engine.step(batch)?;
        if model.record_every.is_some() {
            engine.look()?;
            engine.box_means();
        }
    }
    // A device may still be at work: what it is asked for now waits for it.
    engine.cells(&[0]);
    Ok(start.elapsed().as_secs_f64())
}

fn start(engine: EngineName, gpu: &Arc<Gpu>, model: &Model) -> Result<Box<dyn Engine>, Failure> {
    let state = |x: Vec3| (1.0, Vec3::new(1e-3 * (0.2 * x.y).sin(), 0.0, 0.0));
    let (setup, free) = (&model.setup, model.free.as_ref());
    Ok(match engine {
        EngineName::Reference => Box::new(ReferenceEngine::starting_from(setup, free, state)?),
        EngineName::Wgpu => Box::new(KernelEngine::starting_from(setup, free, gpu, state)?),
    })
}

/// Bytes of the process in memory.
fn memory() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/statm").ok()?;
    let pages: f64 = text.split_whitespace().nth(1)?.parse().ok()?;
    Some(4096.0 * pages)
}

/// The models. The first two are what others are added to.
fn models() -> Result<Vec<Model>, Failure> {
    let (bare_srt, bare) = (0, 1);
    let srt = Collision::Srt { tau: TAU };
    let mrt = Collision::Mrt { rates: Rates::dhumieres(TAU)? };
    let off = GuardSettings { interval: u64::MAX, ..GuardSettings::default() };
    let fluid = |collision, faces| -> Result<Setup, Failure> {
        let setup = Setup::fluid(Domain::new([SIDE; 3], faces)?, collision);
        Ok(Setup { guard: off, ..setup })
    };
    let plain = || fluid(mrt, Faces::PERIODIC);
    let walls = Faces { z: [Face::wall(); 2], ..Faces::PERIODIC };
    let inlet = Face::VelocityInlet { velocity: Vec3::new(1e-3, 0.0, 0.0) };
    let through = Faces { x: [inlet, Face::Pressure { density: 1.0 }], ..Faces::PERIODIC };
    let solids = |solids: Vec<Solid>| SolidPhase { solids, ..SolidPhase::default() };
    let model =
        |name, against, setup| Model { name, against, setup, free: None, record_every: None };
    let still = Vec3::zeros();
    let mut models = vec![
        model("SRT", bare_srt, fluid(srt, Faces::PERIODIC)?),
        model("MRT", bare_srt, plain()?),
        model("body force", bare, plain()?.with_body_force(Vec3::new(1e-7, 0.0, 0.0))),
        model("two walls", bare, fluid(mrt, walls)?),
        model("inlet and pressure", bare, fluid(mrt, through)?),
        model("two fixed grains", bare, plain()?.with_solids(solids(few()))),
        model("bed of fixed grains", bare, plain()?.with_solids(solids(bed(still)))),
        model("bed that moves", bare, plain()?.with_solids(solids(bed(Vec3::new(1e-3, 0.0, 0.0))))),
        model("guard", bare, Setup { guard: GuardSettings::default(), ..plain()? }),
    ];
    let recorded = Setup { guard: GuardSettings::default(), ..plain()? };
    models.push(Model {
        record_every: Some(10),
        ..model("record box every 10 steps", bare, recorded)
    });
    for (name, pitch, lubricated) in [
        ("free grains apart", 16.0, false),
        ("free grains that touch", 9.99, false),
        ("free grains apart with lubrication", 10.5, true),
    ] {
        let free = free(pitch, lubricated)?;
        let as_solid = |grain: &Grain| Solid::fixed_sphere(grain.position, grain.radius);
        let setup = plain()?.with_solids(solids(free.grains.iter().map(as_solid).collect()));
        models.push(Model { free: Some(free), ..model(name, bare, setup) });
    }
    Ok(models)
}

/// Two spheres of 8 cells.
fn few() -> Vec<Solid> {
    [10.3, 22.3].map(|x| Solid::fixed_sphere(Vec3::new(x, 16.2, 16.1), 4.0)).into()
}

/// A body-centred array of pitch 16 that fills 0.6 of the box.
fn bed(velocity: Vec3) -> Vec<Solid> {
    let radius = 16.0 * (0.9_f64 / (4.0 * std::f64::consts::PI)).cbrt();
    let place = |i: usize| {
        let cube = i / 2;
        let corner = [cube % 2, cube / 2 % 2, cube / 4].map(|c| 16.0 * c as f64);
        Vec3::from(corner).add_scalar(0.3 + if i.is_multiple_of(2) { 0.0 } else { 8.0 })
    };
    let sphere = |i| Solid { velocity, ..Solid::fixed_sphere(place(i), radius) };
    (0..16).map(sphere).collect()
}

/// Eight free grains of 10 cells in a cube of that pitch, moving slowly through each other's fluid.
fn free(pitch: f64, lubricated: bool) -> Result<FreePart, Failure> {
    let radius = 5.0;
    let place = |i: usize| Vec3::from([i % 2, i / 2 % 2, i / 4].map(|c| 6.3 + pitch * c as f64));
    let grains: Vec<Grain> = (0..8)
        .map(|i| Grain::sphere(place(i), radius, 2.65).moving(Vec3::new(1e-4, 0.0, 0.0)))
        .collect();
    let law = ContactLaw::from_duration_and_restitution(10.0, 0.5, 0.5 * grains[0].mass)?
        .with_friction(0.5)?;
    let lubrication = lubricated.then(|| Lubrication {
        viscosity: viscosity(TAU),
        cutoff_gap: 1.0,
        smallest_gap: 0.005,
    });
    let sides = PeriodicBox::all([SIDE as f64; 3]);
    Ok(FreePart {
        setup: GrainSetup { sides, lubrication, ..GrainSetup::new(law) },
        grains,
        planes: Vec::new(),
        settings: CouplingSettings::default(),
    })
}
