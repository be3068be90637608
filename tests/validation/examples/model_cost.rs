//! What each model costs, switched on alone: `cargo run -p psmrt-validation --example model_cost [repeats]`.
//!
//! Writes `golden/cost/cost.csv` anew. Each model is timed in turn with the fluid that it is added to, many
//! times over, by the processor time of all threads of this process (Linux), so that what else the machine
//! does matters little; the ratio is that of the two shortest times. One thread each: RAYON_NUM_THREADS=1
//! and, for Mesa's software adapter, LP_NUM_THREADS=1.
//!
//! Bytes are by how much more a process of its own grows for a box of 128³ cells than for one of 64³, set up and
//! run for two steps, each twice, the smaller. The growth for one box says too much, for the bare fluid on the
//! kernel 167 to 196 bytes per cell of 96³ where two copies of 19 populations of 4 bytes take 152. What is beyond
//! does not belong to cells: 11 MB of shaders whatever the box (15 bytes for each of 96³), 14 MB more where Mesa
//! has to compile them first, and up to 30 bytes per cell that the host has freed after the upload and the C
//! library keeps for later. So sizes are subtracted, and the library is told to give back at once.

use std::error::Error;
use std::fmt::Write;
use std::process::Command;
use std::sync::Arc;

use psmrt::engine::{Coupled, EngineName, starting_from};
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
/// Edge of the box that is timed, and of those whose memory is measured.
const SIDE: usize = 32;
const SIDES: [usize; 2] = [64, 128];

/// Settings of glibc's allocator (mallopt(3)): what is freed goes back to the system, whatever its size.
const GIVE_BACK: [(&str, &str); 2] =
    [("MALLOC_MMAP_THRESHOLD_", "65536"), ("MALLOC_TRIM_THRESHOLD_", "65536")];
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
const ENGINES: [EngineName; 2] = [EngineName::Reference, EngineName::Wgpu];

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [word, engine, model, side] = &arguments[..] {
        assert_eq!(word, "bytes", "usage: model_cost [repeats]");
        return bytes_here(engine, model, side.parse()?);
    }
    let repeats: u32 = arguments.first().map_or(Ok(10), |count| count.parse())?;
    let mut text = format!(
        "# What each model costs, switched on alone: cargo run -p psmrt-validation --example model_cost {repeats}\n\
         # {SIDE}^3 cells, tau = {TAU}; slices of {SLICE} steps, each model in turn with what it is added to,\n\
         # {repeats} times, the shortest of each by the processor time of the process; one thread\n\
         # (RAYON_NUM_THREADS=1, LP_NUM_THREADS=1) on two shared cores; the load at the start and the end stands in\n\
         # the last line. The guard is off but in its own row and in that of the record. against: the row that a\n\
         # model is added to. bytes_per_cell: growth of a process with {}^3 cells less that of one with {}^3 (the\n\
         # code of shaders is the same in both), over the difference of their cells; the allocator gives back at once\n\
         # what is freed. On a software adapter that is the device's memory too. Two copies of 19 populations take 304 bytes\n\
         # in double precision and 152 in single; the lists of what solids cover, on the host, are the rest of a bed.\n\
         engine,model,against,time_ratio,ns_per_cell_update,bytes_per_cell\n",
        SIDES[1], SIDES[0]
    );
    let load = || std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let first_load = load();
    let gpu = Gpu::open(None)?;
    let cells = (SIDE * SIDE * SIDE) as f64;
    for engine in ENGINES {
        let models = models(SIDE)?;
        for model in &models {
            let base = &models[model.against];
            let mut this = start(engine, &gpu, model)?;
            let mut other = start(engine, &gpu, base)?;
            let (mut mine, mut theirs) = (f64::INFINITY, f64::INFINITY);
            // The first pair warms up: shaders compile at their first use.
            for number in 0..=repeats {
                let pair = [time(&mut other, base)?, time(&mut this, model)?];
                if number > 0 {
                    theirs = theirs.min(pair[0]);
                    mine = mine.min(pair[1]);
                }
            }
            let row = format!(
                "{},{},{},{:.3},{:.2},{}",
                engine.word(),
                model.name,
                base.name,
                mine / theirs,
                mine / (SLICE as f64 * cells) * 1e9,
                bytes(engine, model)?
            );
            println!("{row}");
            writeln!(text, "{row}")?;
        }
    }
    writeln!(text, "# adapter: {}", gpu.facts().name)?;
    writeln!(text, "# load at the start {}, at the end {}", first_load.trim(), load().trim())?;
    std::fs::create_dir_all("golden/cost")?;
    std::fs::write(FILE, text)?;
    Ok(())
}

/// Seconds of the processor that a slice takes, with what is recorded.
fn time(engine: &mut Coupled, model: &Model) -> Result<f64, Failure> {
    let start = processor_seconds()?;
    let batch = model.record_every.unwrap_or(SLICE);
    for _ in 0..SLICE / batch {
        engine.step(batch)?;
        if model.record_every.is_some() {
            engine.check()?;
            engine.box_means();
        }
    }
    // A device may still be at work: what it is asked for now waits for it.
    engine.cells(psmrt::engine::Block::cell([0; 3]));
    Ok(processor_seconds()? - start)
}

/// Time that the threads of this process have run (proc(5), `schedstat`).
fn processor_seconds() -> Result<f64, Failure> {
    let mut nanoseconds = 0.0;
    for thread in std::fs::read_dir("/proc/self/task")? {
        let text = std::fs::read_to_string(thread?.path().join("schedstat"))?;
        nanoseconds += text.split_whitespace().next().unwrap_or("0").parse::<f64>()?;
    }
    Ok(nanoseconds / 1e9)
}

/// Bytes per cell of a model, found by processes of their own.
fn bytes(engine: EngineName, model: &Model) -> Result<String, Failure> {
    let grown = |side: usize| -> Result<f64, Failure> {
        let mut command = Command::new(std::env::current_exe()?);
        command.args(["bytes", engine.word(), model.name, &side.to_string()]).envs(GIVE_BACK);
        let output = command.output()?;
        if !output.status.success() {
            return Err(String::from_utf8_lossy(&output.stderr).into_owned().into());
        }
        Ok(String::from_utf8(output.stdout)?.trim().parse()?)
    };
    let growth = |side: usize| -> Result<f64, Failure> { Ok(grown(side)?.min(grown(side)?)) };
    let [small, large] = SIDES;
    let cells = (large.pow(3) - small.pow(3)) as f64;
    Ok(format!("{:.0}", (growth(large)? - growth(small)?) / cells))
}

/// Prints by how many bytes this process grows with a model in a box of `side` cells.
fn bytes_here(engine: &str, model: &str, side: usize) -> Result<(), Failure> {
    let engine =
        ENGINES.into_iter().find(|known| known.word() == engine).ok_or("no such engine")?;
    let models = models(side)?;
    let model = models.iter().find(|known| known.name == model).ok_or("no such model")?;
    let gpu = Gpu::open(None)?;
    let before = memory()?;
    let mut made = start(engine, &gpu, model)?;
    made.step(2)?;
    made.box_means();
    println!("{:.0}", memory()? - before);
    Ok(())
}

fn start(engine: EngineName, gpu: &Arc<Gpu>, model: &Model) -> Result<Coupled, Failure> {
    let state = |x: Vec3| (1.0, Vec3::new(1e-3 * (0.2 * x.y).sin(), 0.0, 0.0));
    let (setup, free) = (&model.setup, model.free.as_ref());
    Ok(starting_from(engine, setup, free, Some(gpu), state)?)
}

/// Bytes of this process in memory (proc(5), `statm`).
fn memory() -> Result<f64, Failure> {
    let text = std::fs::read_to_string("/proc/self/statm")?;
    let pages: f64 = text.split_whitespace().nth(1).unwrap_or("0").parse()?;
    Ok(4096.0 * pages)
}

/// The models in a box of `side` cells. The first two are what others are added to.
fn models(side: usize) -> Result<Vec<Model>, Failure> {
    let (bare_srt, bare) = (0, 1);
    let srt = Collision::Srt { tau: TAU };
    let mrt = Collision::Mrt { rates: Rates::dhumieres(TAU)? };
    let off = GuardSettings { interval: u64::MAX, ..GuardSettings::default() };
    let fluid = |collision, faces| -> Result<Setup, Failure> {
        let setup = Setup::fluid(Domain::new([side; 3], faces)?, collision);
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
        model("bed of fixed grains", bare, plain()?.with_solids(solids(bed(side, still)))),
        model(
            "bed that moves",
            bare,
            plain()?.with_solids(solids(bed(side, Vec3::new(1e-3, 0.0, 0.0)))),
        ),
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
        let free = free(side, pitch, lubricated)?;
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
fn bed(side: usize, velocity: Vec3) -> Vec<Solid> {
    let radius = 16.0 * (0.9_f64 / (4.0 * std::f64::consts::PI)).cbrt();
    let place = |i: usize| {
        let (cube, n) = (i / 2, side / 16);
        let corner = [cube % n, cube / n % n, cube / n / n].map(|c| 16.0 * c as f64);
        Vec3::from(corner).add_scalar(0.3 + if i.is_multiple_of(2) { 0.0 } else { 8.0 })
    };
    let sphere = |i| Solid { velocity, ..Solid::fixed_sphere(place(i), radius) };
    (0..2 * (side / 16).pow(3)).map(sphere).collect()
}

/// Eight free grains of 10 cells in a cube of that pitch, moving slowly through each other's fluid.
fn free(side: usize, pitch: f64, lubricated: bool) -> Result<FreePart, Failure> {
    let radius = 5.0;
    let place = |i: usize| Vec3::from([i % 2, i / 2 % 2, i / 4].map(|c| 6.3 + pitch * c as f64));
    let grains: Vec<Grain> = (0..8)
        .map(|i| Grain::sphere(place(i), radius, 2.65).moving(Vec3::new(1e-4, 0.0, 0.0)))
        .collect();
    let law = ContactLaw::from_duration_and_restitution(10.0, 0.5, 0.5 * grains[0].mass)?
        .with_friction(0.5)?;
    let lubrication = lubricated.then(|| Lubrication {
        while_touching: true,
        viscosity: viscosity(TAU),
        cutoff_gap: 1.0,
        smallest_gap: 0.005,
    });
    let sides = PeriodicBox::all([side as f64; 3]);
    Ok(FreePart {
        setup: GrainSetup { sides, lubrication, ..GrainSetup::new(law) },
        solids: (0..grains.len()).collect(),
        grains,
        planes: Vec::new(),
        settings: CouplingSettings::default(),
    })
}
