//! What a fluid starts from: flows by formula against their exact course, velocities from a file, the state of another run.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use psmrt::engine::{Block, CellState, Coupled, EngineName, open};
use psmrt::npy;
use psmrt_reference::lattice::{CS2, Vec3};

use crate::cli::{Folder, psmrt_in, stderr};
use crate::common::Budget;
use crate::scenes::{free_sphere, scene, water};

/// Of these scenes: tau = 0.8; a step takes 1e-5 s in cells of 1e-5 m, so that a velocity of 1 is 1 m/s.
const NU: f64 = 0.1;

fn opened(text: &str) -> Coupled {
    open(EngineName::Cpu, &scene(&format!("{text}[stop]\nsteps = 1\n")), None, false).unwrap()
}

/// The largest of `of` over all cells, with their centres.
fn largest(engine: &Coupled, of: impl Fn(&Vec3, &CellState) -> f64) -> f64 {
    let domain = &engine.setup().domain;
    let states = engine.cells(Block::whole(domain)).into_iter().enumerate();
    states
        .map(|(cell, state)| of(&domain.centre(domain.coordinates(cell)), &state).abs())
        .fold(0.0, f64::max)
}

/// Whether all cells have these velocities, to round-off.
fn assert_velocities(engine: &Coupled, exact: impl Fn(&Vec3) -> Vec3) {
    let off = largest(engine, |centre, state| (state.velocity - exact(centre)).norm());
    assert!(off < 1e-14, "a cell starts with a velocity that is wrong by {off:e}");
}

/// How much of the largest speed is left from step 40 on after so many steps more.
fn decay(engine: &mut Coupled, budget: &mut Budget, steps: u64) -> f64 {
    budget.spend((40 + steps) * engine.setup().domain.cell_count() as u64);
    let speed = |engine: &Coupled| largest(engine, |_, state| state.velocity.norm());
    engine.step(40).unwrap();
    let before = speed(engine);
    engine.step(steps).unwrap();
    speed(engine) / before
}

/// The rate of decay is as it should be to 1 %: with waves of 32 cells k² = 0.04, and the error of the scheme is k² times a
/// coefficient below 1/4.
fn assert_rate(left: f64, rate: f64, steps: u64) {
    let found = -left.ln() / steps as f64;
    assert!(
        (found / rate - 1.0).abs() < 0.01,
        "it decays with {found:.4e} a step, exact {rate:.4e}"
    );
}

#[test]
fn a_shear_wave_starts_as_a_sine_and_decays_with_the_viscosity() {
    let mut budget = Budget::kernel(31_000);
    let rest = "[initial]\nflow = \"shear_wave\"\nacross = \"y\"\nvelocity = [0.01, 0.0, -0.02]\n";
    let mut engine = opened(&water([2, 32, 2], 1e-5, rest));
    let k = 2.0 * PI / 32.0;
    assert_velocities(&engine, |centre| (k * centre.y).sin() * Vec3::new(0.01, 0.0, -0.02));
    assert_rate(decay(&mut engine, &mut budget, 200), NU * k * k, 200);
}

#[test]
fn vortices_of_taylor_and_green_start_with_their_pressure_and_decay_with_the_viscosity() {
    let mut budget = Budget::kernel(630_000);
    let rest = "[initial]\nflow = \"taylor_green\"\nacross = \"y\"\nspeed = 0.03\n";
    let mut engine = opened(&water([32, 2, 48], 1e-5, rest));
    let [k_x, k_z] = [32.0, 48.0].map(|length| 2.0 * PI / length);
    assert_velocities(&engine, |centre| {
        let (along, up) = (k_x * centre.x, k_z * centre.z);
        0.03 * Vec3::new(along.sin() * up.cos(), 0.0, -k_x / k_z * along.cos() * up.sin())
    });
    // Density against that of the exact pressure: an error as large as the pressure itself would be sound, which a start
    // without it makes.
    let swing = |centre: &Vec3, left: f64| {
        let ratio = k_x / k_z;
        let shape = (2.0 * k_x * centre.x).cos() + ratio * ratio * (2.0 * k_z * centre.z).cos();
        0.25 * (0.03 * left).powi(2) * shape / CS2
    };
    let full = largest(&engine, |centre, _| swing(centre, 1.0));
    for step in 0..60 {
        let left = (-NU * (k_x * k_x + k_z * k_z) * f64::from(step)).exp();
        let off = largest(&engine, |centre, state| state.density - 1.0 - swing(centre, left));
        assert!(
            off < 0.25 * full,
            "step {step}: the density is off by {off:e}, swings by {full:e}"
        );
        engine.step(1).unwrap();
    }
    budget.spend(60 * engine.setup().domain.cell_count() as u64);
    let rate = NU * (k_x * k_x + k_z * k_z);
    assert_rate(decay(&mut engine, &mut budget, 100), rate, 100);
}

#[test]
fn a_shear_between_two_walls_starts_as_the_flow_that_they_hold() {
    let mut budget = Budget::kernel(80_000);
    budget.spend(800 * 4 * 24);
    let faces = "[faces]\nz_low = { kind = \"wall\", velocity = [-0.02, 0.0, 0.0] }\n\
                 z_high = { kind = \"wall\", velocity = [0.03, 0.01, 0.0] }\n";
    let rest = format!("{faces}[initial]\nflow = \"shear\"\nacross = \"z\"\n");
    let mut engine = opened(&water([2, 2, 24], 1e-5, &rest));
    let exact = |centre: &Vec3| {
        let (low, high) = (Vec3::new(-0.02, 0.0, 0.0), Vec3::new(0.03, 0.01, 0.0));
        low + (high - low) * (centre.z / 24.0)
    };
    assert_velocities(&engine, exact);
    // Until its stresses have appeared, each wall pushes for some tau steps against none: nu tau/H of the velocity.
    for _ in 0..80 {
        engine.step(10).unwrap();
        let off = largest(&engine, |centre, state| (state.velocity - exact(centre)).norm());
        assert!(off < 0.02 * 0.05, "the shear is off by {off:e} at step {}", engine.steps());
    }
}

/// The bytes of a field of so many cells along x, y and z.
fn field([nx, ny, nz]: [usize; 3], value: impl Fn(usize) -> f64) -> Vec<u8> {
    let mut bytes = Vec::new();
    let values = (0..3 * nx * ny * nz).map(value);
    psmrt::output::npy::array(&mut bytes, &[nz, ny, nx, 3], values).unwrap();
    bytes
}

fn run(folder: &Folder, arguments: &[&str]) {
    let output = psmrt_in(&folder.path(""), arguments);
    assert!(output.status.success(), "{arguments:?}: {}", stderr(&output));
}

/// The only file of that name's beginning, as an array.
fn array(folder: &Path, begins: &str) -> Vec<f64> {
    let mut files: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.file_name().unwrap().to_str().unwrap().starts_with(begins));
    files.sort();
    let last = files.last().unwrap_or_else(|| panic!("no {begins} in {}", folder.display()));
    npy::read(&fs::read(last).unwrap()).unwrap().1
}

const FIELDS: &str = "[[records]]\nname = \"all\"\nkind = \"fields\"\nformats = [\"npy\"]\n";

#[test]
fn each_cell_starts_with_its_velocity_of_a_file_and_a_run_keeps_a_copy() {
    let mut budget = Budget::kernel(400);
    budget.spend(2 * 4 * 5 * 6);
    let folder = Folder::new("velocity_field");
    folder.write("u.npy", field([4, 5, 6], |number| 1e-4 * ((37 * number) % 101) as f64));
    let rest = format!("[initial]\nvelocity_field = \"u.npy\"\n{FIELDS}[stop]\nsteps = 1\n");
    folder.write("scene.toml", water([4, 5, 6], 1e-5, &rest));
    run(&folder, &["run", "scene.toml", "--engine", "cpu", "--out", "out"]);
    let copy = fs::read(folder.path("out/initial_velocity.npy")).unwrap();
    assert!(copy == fs::read(folder.path("u.npy")).unwrap(), "the copy differs");
    let kept = fs::read_to_string(folder.path("out/scene.toml")).unwrap();
    assert!(kept.contains("velocity_field = \"initial_velocity.npy\""), "{kept}");
    let scene = psmrt::scene::Scene::load(&folder.path("out/scene.toml"), &[]).unwrap();
    let engine = open(EngineName::Reference, &scene, None, false).unwrap();
    let states = engine.cells(Block::whole(&engine.setup().domain));
    for (number, found) in states.iter().flat_map(|state| state.velocity.data.0[0]).enumerate() {
        let given = 1e-4 * ((37 * number) % 101) as f64;
        assert!((found - given).abs() < 1e-15, "value {number} is {found:e}, given {given:e}");
    }
}

/// A heavy grain that falls between periodic sides, 40 steps.
fn falling(engine: &str, tau: f64, initial: &str, grains: &str) -> String {
    let rest = format!(
        "{initial}[faces]\nz_low.kind = \"wall\"\nz_high.kind = \"wall\"\n\
         [gravity]\nacceleration = [0.5, 0.0, -9.81]\n[solid]\noperator = \"bounce_back\"\n\
         [engine]\nkind = \"{engine}\"\n{grains}{FIELDS}\
         [[records]]\nname = \"loads\"\nkind = \"loads\"\nevery_steps = 40\n[stop]\nsteps = 40\n"
    );
    water([10, 10, 16], 2e-5, &rest).replace("tau = 0.8", &format!("tau = {tau}"))
}

#[test]
fn a_scene_starts_from_the_fluid_and_the_grains_of_another_run() {
    let mut budget = Budget::oracle(70_000);
    budget.spend(40 * 1600);
    let mut others = Budget::kernel(70_000);
    others.spend(40 * 1600);
    let folder = Folder::new("from_run");
    let sphere =
        free_sphere("[1.9e-4, 1e-4, 2e-4]", "1e-4", "7800.0") + "velocity = [0.02, 0.0, -0.02]\n";
    folder.write("first.toml", falling("reference", 0.8, "", &sphere));
    run(&folder, &["run", "first.toml", "--out", "first"]);
    // Another engine, another time step, and the start alone is recorded.
    let list =
        "[[grains]]\nkind = \"csv\"\nfile = \"first/grains_at_end.csv\"\nmotion = \"free\"\n";
    let second = falling("cpu", 0.6, "[initial]\nfrom = \"first\"\n", list)
        .replace("kind = \"fields\"\n", "kind = \"fields\"\nevery_steps = 1000\n");
    folder.write("second.toml", second);
    run(&folder, &["run", "second.toml", "--out", "second"]);
    for (name, what) in [("velocity", "m/s"), ("pressure", "Pa")] {
        let [end, start] = ["first/all", "second/all"].map(|all| folder.path(all));
        let end = array(&end, name);
        let first = fs::read_dir(&start).unwrap().map(|entry| entry.unwrap().path());
        let first =
            first.filter(|p| p.file_name().unwrap().to_str().unwrap().starts_with(name)).min();
        let start = npy::read(&fs::read(first.unwrap()).unwrap()).unwrap().1;
        let size = end.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        assert!(size > 0.0 && end.len() == start.len());
        // Cells that the grain covers start with the grain.
        let off = end.iter().zip(&start).filter(|(a, b)| (*a - *b).abs() > 1e-9 * size).count();
        let covered = if name == "velocity" { 3 * 150 } else { 150 };
        assert!(off < covered, "{off} values of the {name} ({what}) differ of {}", end.len());
        assert!(end.len() - off > 3 * covered, "too few values are compared");
    }
    let rows = |run: &str| -> Vec<Vec<f64>> {
        let text = fs::read_to_string(folder.path(run).join("loads.csv")).unwrap();
        let row = |line: &str| line.split(',').map(|cell| cell.parse().unwrap()).collect();
        text.lines().skip(1).map(row).collect()
    };
    let (end, start) = (rows("first")[1].clone(), rows("second")[0].clone());
    // Time, step and number of the grain; then place, diameter, velocity and spin. It has left through a side by now.
    assert!(end[3] > 2e-4 && start[3] < 1e-4, "x: {} and {}", end[3], start[3]);
    for column in 3..13 {
        let (end, start) = (end[column] - if column == 3 { 2e-4 } else { 0.0 }, start[column]);
        assert!((end - start).abs() <= 1e-12 * end.abs().max(1e-7), "{column}: {end:e}, {start:e}");
    }
    // What it says of where it has begun.
    let origin = fs::read_to_string(folder.path("second/origin.json")).unwrap();
    assert!(origin.contains("\"step\": 40") && origin.contains("the fluid"), "{origin}");
    // It is done, and its own state goes on without the other run.
    fs::remove_dir_all(folder.path("first")).unwrap();
    others.spend(1600);
    run(&folder, &["resume", "second", "--set", "stop.steps=41", "--out", "third"]);
}

#[test]
fn a_start_that_does_not_fit_is_refused_with_the_way_out() {
    let folder = Folder::new("bad_starts");
    folder.write("u.npy", field([4, 5, 6], |_| 0.0));
    folder.write("nan.npy", field([4, 4, 4], |number| if number == 100 { f64::NAN } else { 0.0 }));
    folder.write("fast.npy", field([4, 4, 4], |number| if number == 100 { 0.3 } else { 0.0 }));
    folder.write("no.npy", "nothing");
    let first = water([4, 4, 5], 1e-5, "[stop]\nsteps = 1\n[checkpoint]\nat_end = false\n");
    folder.write("other.toml", &first);
    run(&folder, &["run", "other.toml", "--engine", "cpu", "--out", "other"]);
    folder.write("stateless.toml", first.replace("[4, 4, 5]", "[4, 4, 4]"));
    run(&folder, &["run", "stateless.toml", "--engine", "cpu", "--out", "stateless"]);
    for (initial, key, said) in [
        ("", "initial.velocity", "velocity = [1e-3, 0.0, 0.0]"),
        ("flow = \"shear\"", "initial.across", "across = \"z\""),
        ("flow = \"shear\"\nacross = \"z\"", "initial.flow", "shear_wave"),
        (
            "flow = \"shear\"\nacross = \"z\"\nvelocity = [0.1, 0.0, 0.0]",
            "initial.velocity",
            "shear_wave",
        ),
        ("flow = \"shear_wave\"\nacross = \"z\"", "initial.velocity", "where it is largest"),
        (
            "flow = \"shear_wave\"\nacross = \"z\"\nvelocity = [0.0, 0.0, 0.1]",
            "initial.velocity",
            "along z to 0",
        ),
        ("flow = \"taylor_green\"\nacross = \"z\"", "initial.speed", "m/s"),
        ("flow = \"taylor_green\"\nacross = \"z\"\nspeed = 0.3", "initial.speed", "at most 0.2"),
        ("flow = \"vortex\"\nacross = \"z\"", "initial.flow", "taylor_green"),
        ("velocity = [0.0, 0.0, 0.0]\nspeed = 0.1", "initial.speed", "taylor_green"),
        ("velocity = [0.0, 0.0, 0.0]\nacross = \"x\"", "initial.across", "flow"),
        ("velocity = [0.0, 0.0, 0.0]\nfrom = \"other\"", "initial.velocity", "initial.from"),
        ("velocity_field = \"u.npy\"\nfrom = \"other\"", "initial.from", "initial.velocity_field"),
        ("velocity_field = \"u.npy\"", "initial.velocity_field", "needs (4, 4, 4, 3)"),
        ("velocity_field = \"nan.npy\"", "initial.velocity_field", "[2, 0, 1]"),
        ("velocity_field = \"fast.npy\"", "initial.velocity_field", "at most 0.2"),
        ("velocity_field = \"no.npy\"", "initial.velocity_field", "numpy.save"),
        ("velocity_field = \"none.npy\"", "initial.velocity_field", "cannot be read"),
        ("from = \"nowhere\"", "initial.from", "no folder of a run"),
        ("from = \"other\"", "initial.from", "4 x 4 x 5 cells"),
        ("from = \"stateless\"", "initial.from", "no saved state"),
    ] {
        let text = water([4, 4, 4], 1e-5, &format!("[initial]\n{initial}\n[stop]\nsteps = 1\n"));
        folder.write("bad.toml", text);
        let output = psmrt_in(&folder.path(""), &["run", "bad.toml", "--out", "bad"]);
        let told = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{initial}: {told}");
        assert!(told.contains(key) && told.contains(said), "{initial}: {key}, {said}: {told}");
        assert!(!folder.path("bad").exists(), "{initial}: a folder was made");
    }
}
