//! Each engine, by way of the library and the command line: free grains, saved states, the guard, the command line.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use crate::cli::{Folder, psmrt, stdout};
use crate::common::{Budget, golden_rows};
use crate::mixed;
use crate::moving_bodies;
use crate::scenes::{FLOOR_AND_LID, changed, free_sphere, saved, scene, water};
use crate::trials::{self, Claim, EngineClaim};
use psmrt::diagnosis::ExplainedStop;
use psmrt::engine::{Block, CellState, Coupled, EngineName, EngineStop, open};
use psmrt::scene::Scene;
use psmrt_reference::drive::FaceValue;
use psmrt_reference::solids::Shape;

/// Three free grains, one of them spinning, in a box with walls; far enough apart not to touch.
static GRAINS: LazyLock<String> = LazyLock::new(|| {
    let gravity = "[gravity]\nacceleration = [0.0, 0.0, -0.5]\n";
    let grains = [
        free_sphere("[5e-4, 5e-4, 9e-4]", "6e-4", "2650.0"),
        free_sphere("[14e-4, 5e-4, 9e-4]", "5e-4", "1200.0") + "spin = [0.0, 1.0, 0.0]\n",
        free_sphere("[10e-4, 12e-4, 8e-4]", "5e-4", "1800.0") + "velocity = [1e-3, 0.0, 0.0]\n",
    ]
    .concat();
    let rest = r#"
[[records]]
name = "box"
kind = "box"
every_steps = 20
[checkpoint]
every_steps = 40
[stop]
steps = 80
"#;
    water([20, 16, 18], 1e-4, &format!("{FLOOR_AND_LID}{gravity}{grains}{rest}"))
});

fn opened(engine: EngineName, scene: &Scene) -> Coupled {
    open(engine, scene, trials::device_of(engine).as_ref(), false).unwrap()
}

fn free_grains_move_as_in_the_oracle(engine: EngineName) {
    // The load of a step is off by about 1e-6 (tests/device/kernel_runs.rs: 2 ε of gauges below 0.3, times
    // √(10 · 200)), the grain weighs 65 or more: 2e-8 a step, independent from step to step.
    move_as_in_the_oracle(engine, 100, 2e-8, &[]);
}

fn free_grains_under_full_bounce_back_move_as_in_the_oracle(engine: EngineName) {
    // The operator takes twice as much of the momentum. So slow that no grain comes to a wall.
    let changes = ["solid.operator=\"full_bounce_back\"", "gravity.acceleration=[0.0,0.0,-0.05]"];
    move_as_in_the_oracle(engine, 200, 4e-8, &changes);
}

/// Velocities after so many steps are the oracle's but for `off` a step.
fn move_as_in_the_oracle(engine: EngineName, steps: u64, off: f64, changes: &[&str]) {
    let scene = changed(&GRAINS, changes);
    let mut budget = Budget::kernel(1_200_000);
    budget.spend(steps * scene.setup.domain.cell_count() as u64);
    let (mut kernel, mut oracle) = (opened(engine, &scene), opened(EngineName::Reference, &scene));
    kernel.step(steps).unwrap();
    oracle.step(steps).unwrap();
    let bound = off * (steps as f64).sqrt();
    for (found, expected) in kernel.solids().iter().zip(&oracle.solids()) {
        let speed = expected.velocity.norm();
        let off = (found.velocity - expected.velocity).norm();
        println!(
            "speed {speed:.2e}, off by {off:.1e}, place by {:.1e}",
            (found.centre - expected.centre).norm()
        );
        assert!(
            off < bound,
            "a grain's velocity on the kernel is off the oracle's by {off:e}; single precision \
             explains {bound:e}",
        );
        assert!((found.centre - expected.centre).norm() < bound * steps as f64);
        // A grain that were not driven at all would be off by all of its speed.
        assert!(speed > 100.0 * bound, "the grains must move for this to say anything");
    }
}

fn balanced_grains_settle_as_in_the_oracle(engine: EngineName) {
    let mut budget = Budget::kernel(300_000);
    const STEPS: u64 = 50;
    let text = GRAINS.replace(FLOOR_AND_LID, "").replace("-0.5]", "-0.5]\nbalance = true");
    let scene = scene(&text);
    budget.spend(STEPS * scene.setup.domain.cell_count() as u64);
    let (mut kernel, mut oracle) = (opened(engine, &scene), opened(EngineName::Reference, &scene));
    // What the body force lacks in the cells of grains, as the device has it. A solid fraction is off by 2e-6 and
    // 2 ε r (kernel_fractions.rs), the weight by (τ + 1/2)/(τ - 1/2) as much; a grain touches fewer than (2 r + 2)³
    // cells.
    let tau = scene.setup.collision.tau();
    for ((found, expected), solid) in
        kernel.displaced().iter().zip(&oracle.displaced()).zip(oracle.solids())
    {
        let Shape::Sphere { radius } = solid.shape else { panic!("grains are spheres") };
        let each = 2e-6 + 2.0 * f64::from(f32::EPSILON) * radius;
        let bound = (2.0 * radius + 2.0).powi(3) * (tau + 0.5) / (tau - 0.5) * each;
        assert!(
            (found - expected).abs() < bound,
            "Σ B_s {found}, in the oracle {expected}, allowed {bound:e}"
        );
    }
    kernel.step(STEPS).unwrap();
    oracle.step(STEPS).unwrap();
    for (found, expected) in kernel.solids().iter().zip(&oracle.solids()) {
        let off = (found.velocity - expected.velocity).norm();
        println!("velocity {:.2e}, off by {off:.1e}", expected.velocity.z);
        // As in `free_grains_move_as_in_the_oracle`.
        assert!(off < 2e-8 * (STEPS as f64).sqrt(), "{off:e}");
    }
}

/// Half of a grain that spins in fluid at rest; 8 cells across, in a box of three diameters.
fn spinning() -> String {
    let faces = "[faces]\nz_low.kind = \"free_slip\"\nz_high.kind = \"free_slip\"\n";
    let grain = free_sphere("[12e-5, 12e-5, 0.0]", "8e-5", "2650.0");
    let rest = "spin = [0.0, 0.0, 30.0]\n[stop]\nsteps = 144\n";
    water([24, 24, 12], 1e-5, &format!("{faces}{grain}{rest}")).replace("tau = 0.8", "tau = 0.6")
}

fn grain_that_starts_spinning_slows_down_as_the_exact_curve_says(engine: EngineName) {
    let mut budget = Budget::kernel(1_000_000);
    let scene = scene(&spinning());
    let mut kernel = opened(engine, &scene);
    let angular_velocity = |kernel: &Coupled| kernel.solids()[0].angular_velocity.z;
    let start = angular_velocity(&kernel);
    // T = 0.1, 0.2 and 0.3: 48 steps each, since ν = 1/30 and a = 4.
    let rows = golden_rows("free_start/exact.csv");
    for time in ["0.1", "0.2", "0.3"] {
        budget.spend(48 * scene.setup.domain.cell_count() as u64);
        kernel.step(48).unwrap();
        let row = rows.iter().find(|row| &row[0] == "2.65" && &row[1] == time).unwrap();
        let (found, exact) = (angular_velocity(&kernel) / start, row[2].parse::<f64>().unwrap());
        println!("T = {time}: spin over its start {found:.4}, exact {exact:.4}");
        // As in tests/oracle/free_start.rs.
        assert!((found - exact).abs() < 0.015, "T = {time}: {found:.4} of the spin, exact {exact}");
    }
}

/// Cells of the largest golden scene that is tried here; the paper's own sizes are runs by command.
const LARGEST: usize = 70_000;

/// The scene files under `golden/`.
fn golden_scenes() -> Vec<PathBuf> {
    let folders = fs::read_dir("golden").unwrap().map(|entry| entry.unwrap().path());
    let files =
        folders.filter(|path| path.is_dir()).flat_map(|folder| fs::read_dir(folder).unwrap());
    let mut scenes: Vec<PathBuf> = files
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|end| end == "toml"))
        .collect();
    scenes.sort();
    scenes
}

/// Of each golden scene the state after a few steps on the oracle, made once for all engines.
static ON_THE_ORACLE: LazyLock<Vec<(PathBuf, Scene, Vec<CellState>)>> = LazyLock::new(|| {
    let mut budget = Budget::oracle(3_600_000);
    let mut all = Vec::new();
    for path in golden_scenes() {
        let scene = Scene::load(&path, &[]).unwrap_or_else(|error| panic!("{error}"));
        let count = scene.setup.domain.cell_count();
        if count > LARGEST {
            println!("{}: {count} cells, not here", path.display());
            continue;
        }
        budget.spend(GOLDEN_STEPS * count as u64);
        let mut oracle = opened(EngineName::Reference, &scene);
        oracle.step(GOLDEN_STEPS).unwrap();
        let cells = oracle.cells(Block::whole(&scene.setup.domain));
        all.push((path, scene, cells));
    }
    assert!(all.len() >= 15, "there are only {} scenes: were they moved?", all.len());
    all
});

const GOLDEN_STEPS: u64 = 8;

fn every_golden_scene_starts_and_steps_as_on_the_oracle(engine: EngineName) {
    let mut budget = Budget::kernel(3_600_000);
    for (path, scene, expected) in ON_THE_ORACLE.iter() {
        budget.spend(GOLDEN_STEPS * expected.len() as u64);
        let mut engine = opened(engine, scene);
        engine.step(GOLDEN_STEPS).unwrap();
        // As in tests/device/kernel_runs.rs: populations are off by 2 (√n ε + δB) g, and ten of them make a
        // momentum. The gauge g, the sum of the populations less their weights, is below |ρ - 1| + 5 |u|;
        // δB is that of tau = 1/2 + 0.2 and more, which the golden scenes with free grains have.
        let gauge = expected
            .iter()
            .map(|cell| (cell.density - 1.0).abs() + 5.0 * cell.velocity.norm())
            .fold(0.0, f64::max);
        let weight_error = if scene.free.is_some() { 6.0 * 3e-6 } else { 0.0 };
        let each =
            2.0 * ((GOLDEN_STEPS as f64).sqrt() * f64::from(f32::EPSILON) + weight_error) * gauge;
        let bound = 10.0_f64.sqrt() * each;
        let found = engine.cells(Block::whole(&scene.setup.domain));
        let errors = found.into_iter().zip(expected).map(|(found, expected)| {
            (found.velocity - expected.velocity)
                .norm()
                .max((found.density - expected.density).abs())
        });
        let worst = errors.fold(0.0, f64::max);
        println!("{}: off by {worst:.1e}, allowed {bound:.1e}", path.display());
        assert!(gauge > 0.0, "{}: nothing moves", path.display());
        assert!(
            worst < bound,
            "{}: states of the engine are off the oracle's by {worst:e}, round-off of single \
             precision explains {bound:e}",
            path.display(),
        );
    }
}

fn saved_state_goes_on_bit_for_bit(engine: EngineName) {
    let mut budget = Budget::kernel(3_000_000);
    let fixed = std::fs::read_to_string("golden/sphere_arrays/scene.toml").unwrap();
    // Faces whose state is saved too, and grains that come close to one.
    let inlet = "faces.x_low={kind=\"velocity_inlet\",velocity=[1e-3,0.0,0.0]}";
    let open = "faces.x_high={kind=\"pressure\",pressure=0.0,non_reflecting=true}";
    let scenes = [
        scene(&GRAINS),
        changed(&fixed, &["domain.cells=[12,12,12]"]),
        changed(&GRAINS, &[inlet, open]),
    ];
    for scene in scenes {
        let cells = scene.setup.domain.cell_count() as u64;
        // Also at the start, where the state is kept in another form, and off the guard's interval.
        for first in [0, 1, 37] {
            budget.spend((first + 2 * 30) * cells);
            let mut straight = opened(engine, &scene);
            straight.step(first).unwrap();
            // Faces of another value from now on: those of the step before are saved too.
            let mut drive = straight.setup().drive();
            for value in drive.faces.as_flattened_mut() {
                match value {
                    FaceValue::None => {}
                    FaceValue::Velocity(velocity) => velocity.x += 1e-3,
                    FaceValue::Density(density) => *density += 1e-3,
                }
            }
            straight.set_drive(&drive).unwrap();
            let state = saved(&straight);
            let mut resumed = opened(engine, &scene);
            resumed.load(&mut &state[..]).unwrap();
            assert!(saved(&resumed) == state, "what is loaded is what was saved");
            straight.step(30).unwrap();
            resumed.step(30).unwrap();
            assert!(saved(&straight) == saved(&resumed), "from step {first}");
        }
    }
}

/// A force without anything that holds the fluid back.
fn runaway() -> String {
    let rest = "[body_force]\nacceleration = [0.5, 0.0, 0.0]\n[stop]\nsteps = 10000\n";
    water([8, 9, 10], 1e-4, rest)
}

fn guard_stops_a_run_where_and_why_the_oracles_does(engine: EngineName) {
    let mut budget = Budget::kernel(150_000);
    // 5e-3 a step reach the limit of 0.5 after 100.
    budget.spend(720 * 200);
    let scene = scene(&runaway());
    let stopped = |engine: &mut Coupled| -> ExplainedStop {
        match engine.step(200) {
            Err(EngineStop::Broken(diagnosis)) => *diagnosis,
            other => panic!("not stopped by the guard: {other:?}"),
        }
    };
    let found = stopped(&mut opened(engine, &scene));
    let expected = stopped(&mut opened(EngineName::Reference, &scene));
    println!("{found}\n{expected}");
    assert_eq!(
        (found.stopped.step, found.stopped.cell),
        (expected.stopped.step, expected.stopped.cell)
    );
    assert_eq!(
        std::mem::discriminant(&found.stopped.failure),
        std::mem::discriminant(&expected.stopped.failure)
    );
    assert_eq!(std::mem::discriminant(&found.cause), std::mem::discriminant(&expected.cause));
}

fn run_on_the_command_line_keeps_its_engine_and_goes_on_with_it(engine: EngineName) {
    let folder = Folder::new("kernel_engine");
    let file = folder.write("scene.toml", &*GRAINS);
    let (file, out) = (file.to_str().unwrap(), folder.path("run"));
    let run = ["run", file, "--engine", engine.word(), "--profile", "--out", out.to_str().unwrap()];
    let output = psmrt(&run);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let parts = match engine {
        EngineName::Reference => [].as_slice(),
        EngineName::Cpu | EngineName::CpuSingle => &["fluid", "grains", "coverage"],
        EngineName::Wgpu => &["fluid", "forces", "grains", "coverage", "transfers"],
    };
    for part in parts {
        assert!(stdout(&output).contains(part), "no {part:?} in: {}", stdout(&output));
    }
    let facts = |out: &Path| -> serde_json::Value {
        serde_json::from_slice(&std::fs::read(out.join("run.json")).unwrap()).unwrap()
    };
    let first = facts(&out);
    assert_eq!(first["engine"], engine.word());
    let adapter = first["adapter"].as_str().is_some_and(|adapter| !adapter.is_empty());
    assert_eq!(adapter, engine.needs_device());
    let before = std::fs::read(out.join("box.csv")).unwrap();
    // From step 40 again.
    let output = psmrt(&["resume", out.to_str().unwrap()]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(facts(&out)["engine"], engine.word());
    assert!(std::fs::read(out.join("box.csv")).unwrap() == before, "the same bits in the record");
}

fn unknown_adapter_is_an_error_that_lists_the_known_ones() {
    let scene = "golden/poiseuille/scene.toml";
    let output = psmrt(&["run", scene, "--engine", "wgpu", "--adapter", "no such thing"]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2));
    let known = &trials::gpu().unwrap().facts().name.clone();
    assert!(message.contains("no such thing") && message.contains(known.as_str()), "{message}");
    assert!(stdout(&psmrt(&["info"])).contains(known.as_str()));
}

fn adapter_for_the_oracle_is_an_error() {
    let scene = "golden/poiseuille/scene.toml";
    let output = psmrt(&["check", scene, "--engine", "reference", "--adapter", "llvmpipe"]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2));
    assert!(message.contains("llvmpipe") && message.contains("--engine wgpu"), "{message}");
}

fn box_that_does_not_fit_is_refused_with_the_bytes_needed_and_available() {
    let gpu = psmrt::kernel::Gpu::open_like_hardware(1 << 16).unwrap();
    // One direction of 32³ cells needs 128 KiB and a little, a binding has 64.
    let scene = changed(&runaway(), &["domain.cells=[32,32,32]"]);
    let message = open(EngineName::Wgpu, &scene, Some(&gpu), false).unwrap_err().to_string();
    assert!(message.contains("65536") && message.contains("13"), "{message}");
    assert!(message.contains("larger dx"), "{message}");
}

fn grains_among_other_solids_move_the_same_in_whatever_order_they_are_listed(engine: EngineName) {
    let mut budget = Budget::kernel(600_000);
    let gpu = trials::device_of(engine);
    // Single precision of forces, should another order of sums round them otherwise, over the mass of a grain.
    mixed::grains_among_other_solids_move_the_same_in_whatever_order_they_are_listed(
        engine,
        gpu.as_ref(),
        &mut budget,
        1e-8,
    );
}

fn bodies_move_and_turn_as_on_the_oracle(engine: EngineName) {
    let mut budget = Budget::kernel(400_000);
    let gpu = trials::device_of(engine);
    // Populations are kept less their weight, to 6e-8 of some 0.02, at 40 steps; loads as sums of a hundred cells.
    moving_bodies::bodies_move_and_turn_as_on_the_oracle(engine, gpu.as_ref(), &mut budget, 1e-7);
}

/// What is claimed of each engine.
pub const CLAIMS: &[EngineClaim] = &[
    ("bodies_move_and_turn_as_on_the_oracle", bodies_move_and_turn_as_on_the_oracle),
    (
        "grains_among_other_solids_move_the_same_in_whatever_order_they_are_listed",
        grains_among_other_solids_move_the_same_in_whatever_order_they_are_listed,
    ),
    ("free_grains_move_as_in_the_oracle", free_grains_move_as_in_the_oracle),
    (
        "free_grains_under_full_bounce_back_move_as_in_the_oracle",
        free_grains_under_full_bounce_back_move_as_in_the_oracle,
    ),
    ("balanced_grains_settle_as_in_the_oracle", balanced_grains_settle_as_in_the_oracle),
    (
        "grain_that_starts_spinning_slows_down_as_the_exact_curve_says",
        grain_that_starts_spinning_slows_down_as_the_exact_curve_says,
    ),
    (
        "every_golden_scene_starts_and_steps_as_on_the_oracle",
        every_golden_scene_starts_and_steps_as_on_the_oracle,
    ),
    ("saved_state_goes_on_bit_for_bit", saved_state_goes_on_bit_for_bit),
    (
        "guard_stops_a_run_where_and_why_the_oracles_does",
        guard_stops_a_run_where_and_why_the_oracles_does,
    ),
    (
        "run_on_the_command_line_keeps_its_engine_and_goes_on_with_it",
        run_on_the_command_line_keeps_its_engine_and_goes_on_with_it,
    ),
];

/// What is claimed of the kernel alone.
pub const OF_KERNEL: &[Claim] = &[
    (
        "box_that_does_not_fit_is_refused_with_the_bytes_needed_and_available",
        box_that_does_not_fit_is_refused_with_the_bytes_needed_and_available,
    ),
    ("adapter_for_the_oracle_is_an_error", adapter_for_the_oracle_is_an_error),
    (
        "unknown_adapter_is_an_error_that_lists_the_known_ones",
        unknown_adapter_is_an_error_that_lists_the_known_ones,
    ),
];
