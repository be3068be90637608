//! The oracle's numbers to the last bit: a change of the code that is meant to change no number is held to that.
//!
//! `golden/bits/oracle.csv` has a sum over the state of each golden scene after some steps. It is made here by
//! the oracle's own solvers, without the product; that the engine `reference` has the very same state is asked
//! beside it. Where numbers are meant to change, the ignored test leaves the new table in `target/tmp`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use psmrt::engine::{Block, EngineName, open};
use psmrt::scene::{FreePart, Scene};
use psmrt_reference::coupling::CoupledSolver;
use psmrt_reference::forcing::forced_velocity;
use psmrt_reference::lattice::{Vec3, density, momentum};
use psmrt_reference::solids::{Load, Solid};
use psmrt_reference::solver::Solver;
use xxhash_rust::xxh3::Xxh3Default;

use crate::common::Budget;

/// Steps of a scene, and the cell updates that it may take: large ones make fewer steps.
const STEPS: u64 = 50;
const UPDATES: u64 = 2_000_000;

/// A scene with more cells is left out: its steps are those of its smaller sisters.
const LARGEST: u64 = 200_000;

/// Scenes of more cell updates are left to the ignored test.
const QUICK: u64 = 900_000;

/// The oracle's solver of a scene, without the product's engine around it.
enum Oracle {
    Fluid(Box<Solver>),
    Coupled(Box<CoupledSolver>),
}

impl Oracle {
    fn new(scene: &Scene) -> Self {
        let start = |centre| scene.initial.at(centre);
        match scene.free.clone() {
            None => {
                Oracle::Fluid(Box::new(Solver::starting_from(scene.setup.clone(), start).unwrap()))
            }
            Some(FreePart { setup, grains, planes, settings, .. }) => {
                let mut fluid = scene.setup.clone();
                fluid.solid_phase.as_mut().unwrap().solids.clear();
                let solver =
                    CoupledSolver::new(fluid, start, setup, grains, planes, settings).unwrap();
                Oracle::Coupled(Box::new(solver))
            }
        }
    }

    fn run(&mut self, steps: u64) {
        match self {
            Oracle::Fluid(solver) => solver.run(steps).unwrap(),
            Oracle::Coupled(solver) => solver.run(steps).unwrap(),
        }
    }

    fn fluid(&self) -> &Solver {
        match self {
            Oracle::Fluid(solver) => solver,
            Oracle::Coupled(solver) => solver.fluid(),
        }
    }
}

/// The sum over the bits of numbers.
fn sum<'a>(values: impl IntoIterator<Item = &'a f64>) -> u64 {
    let mut sum = Xxh3Default::new();
    values.into_iter().for_each(|value| sum.update(&value.to_le_bytes()));
    sum.digest()
}

fn sum_of_solids(solids: &[Solid]) -> u64 {
    sum(solids.iter().flat_map(|solid| {
        solid.centre.iter().chain(solid.velocity.iter()).chain(solid.angular_velocity.iter())
    }))
}

fn sum_of_loads(loads: &[Load]) -> u64 {
    sum(loads.iter().flat_map(|load| load.force.iter().chain(load.torque.iter())))
}

/// Steps that the table has of a scene, none if it is left out.
fn steps_of(scene: &Scene) -> Option<u64> {
    let cells = scene.setup.domain.cell_count() as u64;
    (cells <= LARGEST).then(|| (UPDATES / cells).min(STEPS))
}

/// The scenes of `golden/`, sorted, by their paths there.
fn golden_scenes() -> Vec<String> {
    let golden = golden();
    let mut found = Vec::new();
    for folder in std::fs::read_dir(&golden).unwrap().map(|entry| entry.unwrap().path()) {
        let Ok(files) = std::fs::read_dir(&folder) else { continue };
        for path in files.map(|entry| entry.unwrap().path()) {
            if path.extension().is_some_and(|suffix| suffix == "toml") {
                found.push(path.strip_prefix(&golden).unwrap().to_str().unwrap().to_owned());
            }
        }
    }
    found.sort();
    found
}

fn golden() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("golden")
}

fn scene(name: &str) -> Scene {
    Scene::load(&golden().join(name), &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// The row of a scene: cells, steps, and the sums over populations, solids and loads.
fn row(name: &str, scene: &Scene, steps: u64) -> String {
    let mut oracle = Oracle::new(scene);
    oracle.run(steps);
    let fluid = oracle.fluid();
    let populations = sum(fluid.populations().iter().flatten());
    let solids = fluid.setup().solid_phase.as_ref().map_or(&[][..], |phase| &phase.solids);
    let (solids, loads) = (sum_of_solids(solids), sum_of_loads(fluid.loads()));
    let cells = fluid.domain().cell_count();
    format!("{name},{cells},{steps},{populations:016x},{solids:016x},{loads:016x}")
}

/// The committed row of a scene.
fn committed(name: &str) -> Option<String> {
    let table = std::fs::read_to_string(golden().join("bits/oracle.csv")).unwrap();
    let start = format!("{name},");
    table.lines().find(|line| line.starts_with(&start)).map(str::to_owned)
}

#[test]
fn small_golden_scenes_have_the_bits_that_are_committed() {
    let mut budget = Budget::oracle(6_800_000);
    let mut compared = 0;
    for name in golden_scenes() {
        let scene = scene(&name);
        let updates = |steps: u64| steps * scene.setup.domain.cell_count() as u64;
        let Some(steps) = steps_of(&scene).filter(|&steps| updates(steps) <= QUICK) else {
            continue;
        };
        budget.spend(updates(steps));
        assert_eq!(Some(row(&name, &scene, steps)), committed(&name), "bits of {name}");
        compared += 1;
    }
    assert!(compared >= 8, "only {compared} scenes were compared");
}

#[test]
fn engine_reference_has_the_state_of_the_oracles_own_solvers_to_the_last_bit() {
    let mut budget = Budget::oracle(2_000_000);
    // Fluid alone, held solids, free grains with and without a body force that balances their weight.
    for name in
        ["duct/scene.toml", "tradeoff/sc.toml", "tradeoff/settling.toml", "suspension/scene.toml"]
    {
        let scene = scene(name);
        let cells = scene.setup.domain.cell_count();
        let steps = 20;
        budget.spend(2 * steps * cells as u64);
        let mut oracle = Oracle::new(&scene);
        let mut engine = open(EngineName::Reference, &scene, None, false).unwrap();
        oracle.run(steps);
        // On another thread: an engine is not bound to the one that opened it.
        let stepped = move || engine.step(steps).map(|()| engine);
        let engine = std::thread::spawn(stepped).join().unwrap().unwrap();
        let fluid = oracle.fluid();
        let g = scene.setup.body_force.unwrap_or_else(Vec3::zeros);
        let all = Block::whole(&scene.setup.domain);
        for (cell, (seen, f)) in engine.cells(all).iter().zip(fluid.populations()).enumerate() {
            let expected = (density(f), forced_velocity(density(f), &momentum(f), &g));
            assert!((seen.density, seen.velocity) == expected, "{name}: cell {cell} differs");
        }
        assert_eq!(engine.loads(), fluid.loads(), "{name}: loads");
        let solids = fluid.setup().solid_phase.as_ref().map_or(&[][..], |phase| &phase.solids);
        assert_eq!(sum_of_solids(&engine.solids()), sum_of_solids(solids), "{name}: solids");
    }
}

#[test]
#[ignore = "half a minute; before it, the quick one"]
fn all_golden_scenes_have_the_bits_that_are_committed() {
    let (mut table, mut differing) = (String::new(), Vec::new());
    for name in golden_scenes() {
        let scene = scene(&name);
        let Some(steps) = steps_of(&scene) else { continue };
        let row = row(&name, &scene, steps);
        writeln!(table, "{row}").unwrap();
        if committed(&name).as_ref() != Some(&row) {
            differing.push(name);
        }
    }
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("oracle.csv");
    std::fs::write(&path, &table).unwrap();
    assert!(
        differing.is_empty(),
        "the bits of {differing:?} differ; the rows as they are now: {}",
        path.display()
    );
}
