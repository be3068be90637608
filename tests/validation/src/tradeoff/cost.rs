//! What a cell update costs: engines, collisions and kinds of scene in turn, many times, and the best of
//! each, so that other work on the machine spoils little. One thread (RAYON_NUM_THREADS=1, and
//! LP_NUM_THREADS=1 for Mesa's software adapter) gives the steadiest figures.

use psmrt_reference::collision::Preset;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::cases::{Bench, CaseError};
use crate::tradeoff::parameters::{Flow, Parameters};
use psmrt::engine::{self, Coupled, EngineName};
use psmrt::kernel::Gpu;
use psmrt::scene::preset_changes;
use psmrt::table::Table;

/// Rounds, and how long one scene runs in each: short enough to fall between what else the machine does.
const ROUNDS: usize = 80;
const SLICE: Duration = Duration::from_millis(15);

/// Names of the columns; the threads are the oracle's, an adapter has its own.
pub const COLUMNS: [&str; 6] =
    ["engine", "collision", "scene", "ns_per_cell_update", "threads", "machine"];

/// A kind of scene: fluid alone, a bed of held spheres, a grain that moves.
const SCENES: [(&str, &str, &[&str]); 3] = [
    ("fluid", "tradeoff/poiseuille.toml", &["domain.dx=4e-5", "domain.size=[1e-3, 1e-3, 1e-3]"]),
    ("bed", "tradeoff/fcc.toml", &["domain.cells=[48, 24, 24]", "domain.dx=5e-6"]),
    ("free", "tradeoff/settling.toml", &[]),
];

/// Which of them a flow is.
pub fn kind(flow: Flow) -> &'static str {
    match flow {
        Flow::Poiseuille => "fluid",
        Flow::Settling => "free",
        _ => "bed",
    }
}

/// Measures all. Errors if a scene cannot be run.
pub fn measure(golden: &Path, gpu: Option<&Arc<Gpu>>) -> Result<Table, CaseError> {
    struct Entry {
        words: [&'static str; 3],
        engine: Coupled,
        cells: f64,
        best: f64,
    }
    let bench = Bench::new(golden, EngineName::Reference, None, |_| {});
    let mut entries: Vec<Entry> = Vec::new();
    for (kind, scene, changes) in SCENES {
        for collision in [Preset::Srt, Preset::DHumieres] {
            let mut changes: Vec<String> = changes.iter().map(|&text| text.to_owned()).collect();
            changes.extend(preset_changes(collision));
            let scene = bench.load(scene, &changes)?;
            let cells = scene.setup.domain.cell_count() as f64;
            let mut add = |name, engine: Coupled| {
                let words = [name, collision.word(), kind];
                entries.push(Entry { words, engine, cells, best: f64::INFINITY });
            };
            add("reference", engine::open(EngineName::Reference, &scene, None, false)?);
            if let Some(gpu) = gpu {
                add("wgpu", engine::open(EngineName::Wgpu, &scene, Some(gpu), false)?);
            }
        }
    }
    for round in 0..=ROUNDS {
        for entry in &mut entries {
            let (start, first) = (Instant::now(), entry.engine.steps());
            while start.elapsed() < SLICE {
                if entry.words[0] == "wgpu" {
                    // Only what a device is asked for waits for it.
                    entry.engine.step(4)?;
                    entry.engine.box_means();
                } else {
                    entry.engine.step(1)?;
                }
            }
            let steps = (entry.engine.steps() - first) as f64;
            let cost = start.elapsed().as_secs_f64() / (steps * entry.cells);
            // In the first round shaders compile.
            if round > 0 {
                entry.best = entry.best.min(cost);
            }
        }
    }
    let mut table = Table::new(&COLUMNS);
    for entry in entries {
        let [engine, collision, scene] = entry.words.map(str::to_owned);
        let cost = format!("{:.1}", 1e9 * entry.best);
        let threads = rayon::current_num_threads().to_string();
        table.add(vec![engine, collision, scene, cost, threads, super::machine_words()]);
    }
    Ok(table)
}

/// Seconds per cell update of some parameters, by a table of [`measure`]. Many relaxation times cost the same
/// with any rates. Errors if the table has no such row.
pub fn seconds_per_update(costs: &Table, parameters: &Parameters) -> Result<f64, CaseError> {
    let collision = match parameters.collision {
        Preset::Srt => Preset::Srt,
        Preset::DHumieres | Preset::Trt => Preset::DHumieres,
    };
    let wanted = [
        ("engine", &*parameters.engine),
        ("collision", collision.word()),
        ("scene", kind(parameters.flow)),
    ];
    Ok(1e-9 * costs.with(&wanted)?.number("ns_per_cell_update")?)
}
