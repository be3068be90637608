//! Values of a scene that change in time: when they act, and what is said of them. Exact flows: `oscillating.rs`.

use std::f64::consts::TAU;

use crate::cli::{Folder, psmrt, psmrt_in, stderr, stdout};
use crate::common::Budget;
use crate::driven::in_time as driven;
use crate::scenes::{read, scene, thick, water};
use psmrt::engine::{Block, EngineName, open};
use psmrt::in_time::Signal;
use psmrt_reference::drive::FaceValue;
use psmrt_reference::lattice::{Vec3, momentum};

#[test]
fn a_run_with_values_that_change_goes_on_from_any_step_with_the_same_bits() {
    let mut budget = Budget::oracle(200_000);
    driven::a_run_with_values_that_change_goes_on_from_any_step_with_the_same_bits(
        EngineName::Reference,
        None,
        &mut budget,
    );
}

#[test]
fn a_table_of_one_value_gives_the_bits_of_the_value() {
    let mut budget = Budget::oracle(220_000);
    driven::a_table_of_one_value_gives_the_bits_of_the_value(
        EngineName::Reference,
        None,
        &mut budget,
    );
}

#[test]
fn a_table_is_linear_between_its_rows_jumps_where_two_have_one_time_and_keeps_its_ends() {
    let table = Signal::Table(vec![(1.0, 2.0), (3.0, 6.0), (3.0, -1.0), (4.0, -1.0), (6.0, 3.0)]);
    for (time, value) in [
        (-5.0, 2.0),
        (1.0, 2.0),
        (2.0, 4.0),
        (2.5, 5.0),
        (3.0, -1.0),
        (3.7, -1.0),
        (5.0, 1.0),
        (6.0, 3.0),
        (1e9, 3.0),
    ] {
        assert_eq!(table.at(time), value, "at {time}");
    }
    assert_eq!((table.end(), table.largest(|value| value.abs())), (6.0, 6.0));
    let sine = Signal::Sine { mean: 1.0, amplitude: 2.0, period: 8.0, phase: 0.25 * TAU };
    for (time, value) in [(0.0, 3.0), (2.0, 1.0), (4.0, -1.0), (8.0, 3.0)] {
        let found: f64 = sine.at(time);
        assert!((found - value).abs() < 1e-14, "{found} at {time}, {value} is right");
    }
    assert_eq!((sine.end(), sine.corners()), (f64::INFINITY, vec![3.0, -1.0]));
}

/// A prescribed sphere of 4 cells in a periodic domain, with these keys; steps of 1e-5 s, a velocity of 1 is 1 m/s.
fn prescribed(keys: &str) -> String {
    let grain = "[[grains]]\nkind = \"sphere\"\ncentre = [6e-5, 4e-5, 4e-5]\ndiameter = 4e-5\n\
                 motion = \"prescribed\"\n";
    water([12, 8, 8], 1e-5, &format!("{grain}{keys}[stop]\nsteps = 100\n"))
}

#[test]
fn a_prescribed_sphere_is_where_the_integral_of_its_velocity_says_in_second_order() {
    let mut budget = Budget::kernel(160_000);
    let errors = [40.0, 80.0].map(|period: f64| {
        let si_period = period * 1e-5;
        let keys = format!(
            "velocity = {{ amplitude = [0.02, 0.0, 0.01], period = {si_period:e}, phase = 0.3 }}\n"
        );
        let scene = scene(&prescribed(&keys));
        let mut engine = open(EngineName::Cpu, &scene, None, false).unwrap();
        let mut error = 0.0_f64;
        for step in 1..=100 {
            budget.spend(12 * 8 * 8);
            engine.step(1).unwrap();
            let omega = TAU / period;
            let at = |step: f64| (omega * step + 0.3).cos();
            // ∫ sin(ωt + φ) dt = (cos φ - cos(ωt + φ))/ω
            let along = (at(0.0) - at(f64::from(step))) / omega;
            let right = Vec3::new(6.0, 4.0, 4.0) + along * Vec3::new(0.02, 0.0, 0.01);
            let solid = &engine.solids()[0];
            error = error.max((solid.centre - right).norm());
            let right = (omega * f64::from(step) + 0.3).sin() * Vec3::new(0.02, 0.0, 0.01);
            assert!((solid.velocity - right).norm() < 1e-15, "step {step}: {}", solid.velocity);
        }
        error
    });
    // The trapezoidal rule takes cot(ω/2)/2 for 1/ω: (ω²/12) of the amplitude u/ω, half of it to each side.
    let bound = |period: f64| (TAU / period) * 0.0224 / 12.0 * 2.0;
    assert!(errors[0] < bound(40.0), "{errors:?}: {:e} is allowed", bound(40.0));
    assert!((1.8..2.2).contains(&(errors[0] / errors[1])), "u/ω ω² falls by two: {errors:?}");
}

#[test]
fn fluid_that_nothing_holds_back_has_the_velocity_that_a_table_of_accelerations_gives_it() {
    let mut budget = Budget::kernel(11_000);
    let folder = Folder::new("table_of_accelerations");
    let rows = "# made by hand\ntime (s),x (m/s2),y (m/s2),z (m/s2)\n\
                0,0,0,0\n2e-4,100,-50,0\n2e-4,0,0,30\n5e-4,0,0,0\n";
    folder.write("push.csv", rows);
    let text = water(
        [4, 4, 4],
        1e-5,
        "[body_force]\nacceleration = { file = \"push.csv\" }\n[[records]]\nname = \"box\"\nkind = \"box\"\n\
         every_steps = 10\n[checkpoint]\nevery_steps = 20\n[stop]\nsteps = 80\n",
    );
    let path = folder.write("scene.toml", text);
    let out = folder.path("out");
    budget.spend(2 * 80 * 64);
    let run = |scene: &str, out: &str| {
        let output = psmrt_in(&folder.path(""), &["run", scene, "--out", out]);
        assert!(output.status.success(), "{}", stderr(&output));
    };
    run(path.to_str().unwrap(), "out");
    let mut table = csv::Reader::from_path(out.join("box.csv")).unwrap();
    let names = table.headers().unwrap().clone();
    let at = |name: &str| names.iter().position(|known| known == name).unwrap();
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    let last = rows.last().unwrap();
    let right = [0.5 * 2e-4 * 100.0, -0.5 * 2e-4 * 50.0, 0.5 * 3e-4 * 30.0];
    for (axis, right) in ["x", "y", "z"].into_iter().zip(right) {
        let found: f64 = last[at(&format!("superficial_velocity_{axis} (m/s)"))].parse().unwrap();
        // The jump is at a step, of which the force is that after it: half of it is missing there.
        let jump = [100.0, -50.0, -30.0][["x", "y", "z"].iter().position(|a| *a == axis).unwrap()];
        let right = right - 0.5 * 1e-5 * jump;
        assert!((found - right).abs() < 1e-12, "{axis}: {found} m/s, {right} is right");
    }
    // A run keeps a copy of the file, from which it can be made again.
    let copy = std::fs::read(out.join("body_force_acceleration.csv")).unwrap();
    assert_eq!(copy, std::fs::read(folder.path("push.csv")).unwrap());
    run("out/scene.toml", "again");
    let bytes = |run: &str| std::fs::read(folder.path(run).join("box.csv")).unwrap();
    assert!(bytes("out") == bytes("again"), "the copy of the scene is another scene");
}

#[test]
fn the_momentum_of_fluid_and_grains_stays_under_a_balanced_gravity_that_changes() {
    let mut budget = Budget::kernel(110_000);
    let text = thick(&water(
        [12, 12, 12],
        4e-5,
        "[gravity]\nacceleration = { mean = [0.0, 0.0, -9.81], amplitude = [30.0, 0.0, 40.0], period = 5e-4 }\n\
         balance = true\n[coupling]\ninternal_fluid = \"kept\"\n[[grains]]\nkind = \"sphere\"\n\
         centre = [2.3e-4, 2.4e-4, 2.5e-4]\ndiameter = 2.4e-4\ndensity = 2500.0\nmotion = \"free\"\n[stop]\nsteps = 60\n",
    ));
    let scene = scene(&text);
    let mut engine = open(EngineName::Cpu, &scene, None, false).unwrap();
    let domain = scene.setup.domain;
    let cells = domain.cell_count() as f64;
    let mut first = None;
    for step in 0..60 {
        let all = Block::whole(&domain);
        let fluid: Vec3 = engine.populations(all).iter().map(momentum).sum();
        let grains = engine.free_grains().unwrap().grains();
        let grains: Vec3 = grains.iter().map(|grain| grain.mass * grain.velocity).sum();
        // What is observed has half of the body force of the coming step.
        let whole = fluid + 0.5 * cells * engine.setup().body_force.unwrap() + grains;
        let start = *first.get_or_insert(whole);
        // Round-off of 1728 cells of 19 populations in each step.
        let off = (whole - start).norm();
        assert!(off < 1e-10, "step {step}: momentum has changed by {off:e}");
        budget.spend(12 * 12 * 12);
        engine.step(1).unwrap();
    }
}

#[test]
fn a_step_has_the_force_of_its_beginning_and_the_wall_and_pressure_of_its_middle() {
    let mut budget = Budget::kernel(500);
    // Steps of 1e-5 s; a velocity of 1 is 1 m/s, an acceleration of 1 is 1e5 m/s², a pressure of 1 is 1000 Pa: p = ρ/3.
    let scene = scene(&water(
        [2, 4, 4],
        1e-5,
        "[faces]\nz_low = { kind = \"wall\", velocity = { from = [0.0, 0.0, 0.0], to = [0.1, 0.0, 0.0], end = 1e-4 } }\n\
         z_high = { kind = \"pressure\", pressure = { from = 0.0, to = 10.0, end = 1e-4 } }\n[body_force]\n\
         acceleration = { from = [0.0, 0.0, 0.0], to = [100.0, 0.0, 0.0], end = 1e-4 }\n[stop]\nsteps = 9\n",
    ));
    let mut engine = open(EngineName::Cpu, &scene, None, false).unwrap();
    for step in 0..12_u32 {
        let drive = engine.setup().drive();
        let share = |time: f64| (time / 10.0).min(1.0);
        let (start, middle) = (share(f64::from(step)), share(f64::from(step) + 0.5));
        let force = drive.body_force.unwrap().x;
        assert!((force - 1e-3 * start).abs() < 1e-17, "step {step}: force {force}");
        let (FaceValue::Velocity(wall), FaceValue::Density(density)) =
            (drive.faces[2][0], drive.faces[2][1])
        else {
            panic!("{drive:?}")
        };
        assert!((wall.x - 0.1 * middle).abs() < 1e-15, "step {step}: wall {wall}");
        assert!((density - 1.0 - 0.03 * middle).abs() < 1e-14, "step {step}: density {density}");
        budget.spend(32);
        engine.step(1).unwrap();
    }
}

#[test]
fn a_sphere_that_comes_too_near_to_a_wall_in_time_stops_the_run_there() {
    let mut budget = Budget::kernel(100_000);
    let folder = Folder::new("in_time_wall");
    let text =
        prescribed("velocity = { from = [0.0, 0.0, 0.0], to = [0.0, 0.0, 0.1], end = 1e-3 }\n")
            .replace("[stop]", "[faces]\nz_low.kind = \"wall\"\nz_high.kind = \"wall\"\n[stop]");
    let path = folder.write("scene.toml", text);
    // u = 0.1 n/100, way = 0.1 n²/200: the gap of 2 cells and 0.04 that may overlap take 63.9 steps.
    budget.spend(70 * 12 * 8 * 8);
    let out = folder.path("out");
    let arguments = ["run", path.to_str().unwrap(), "--out", out.to_str().unwrap()];
    let output = psmrt(&arguments);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    for part in ["grain 0", "z_high (wall)", "after step 64"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let checked = psmrt(&["check", path.to_str().unwrap()]);
    assert!(stdout(&checked).contains("after step 64"), "{}", stdout(&checked));
}

/// What `check` prints of a scene of water with these sections.
fn checked(more: &str) -> String {
    let folder = Folder::new("in_time_check");
    let path = folder.write("scene.toml", water([8, 8, 8], 1e-5, more));
    let output = psmrt(&["check", path.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    stdout(&output)
}

#[test]
fn check_says_what_changes_until_when_and_what_is_not_resolved() {
    let wall = |velocity: &str| {
        checked(&format!(
            "[faces]\nz_low.kind = \"wall\"\nz_high = {{ kind = \"wall\", velocity = {velocity} }}\n[stop]\ntime = 1e-2\n"
        ))
    };
    let said = wall("{ table = [[0.0, 0.0, 0.0, 0.0], [5e-3, 0.05, 0.0, 0.0]] }");
    for part in [
        "faces.z_high.velocity: a table, until 5.0000e-3 s",
        "faces.z_high.velocity changes until 5.0000e-3 s and keeps its last value then; the run ends at 1.0000e-2 s",
        // The largest value, at its end.
        "velocity            5.0000e-2 m/s",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let said = wall("{ amplitude = [0.01, 0.0, 0.0], period = 2e-4 }");
    for part in ["is 20.0 time steps", "boundary layer of the oscillation", "0.8 cells"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let said = wall("{ amplitude = [0.01, 0.0, 0.0], period = 2e-2 }");
    assert!(!said.contains("oscillation of") && !said.contains("time steps: its"), "{said}");
}

#[test]
fn a_value_is_too_large_at_its_peak_and_not_at_the_start() {
    let scene = |velocity: &str| {
        read(&water(
            [8, 8, 8],
            1e-5,
            &format!(
                "[faces]\nz_low.kind = \"wall\"\nz_high = {{ kind = \"wall\", velocity = {velocity} }}\n[stop]\nsteps = 9\n"
            ),
        ))
    };
    for (velocity, told) in [
        (
            "{ table = [[0.0, 0.0, 0.0, 0.0], [1e-3, 0.3, 0.0, 0.0]] }",
            "at 1e-3 s its speed is 0.300",
        ),
        ("{ amplitude = [0.3, 0.0, 0.0], period = 1e-3 }", "at its peak its speed is 0.300"),
        (
            "{ from = [0.0, 0.0, 0.0], to = [0.0, 0.0, 0.1], end = 1.0 }",
            "moves along its own normal",
        ),
    ] {
        let error = scene(velocity).err().unwrap();
        assert!(error.contains(told), "{told}: {error}");
    }
    assert!(scene("{ amplitude = [0.1, 0.0, 0.0], period = 1e-3 }").is_ok());
}
