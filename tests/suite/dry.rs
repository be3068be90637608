//! Scenes without fluid: free grains alone, by what is exact of their motion, and what of a scene then works as with one.
//! What is refused: `dry_refused.rs`.

use std::fs;

use psmrt::engine::{Coupled, EngineName, open};
use psmrt::scene::Scene;
use psmrt_reference::grains::grain::Grain;

use crate::cli::{Folder, psmrt_in, stderr, stdout};
use crate::scenes::{BOX, FLOOR_AND_LID, GRAVITY, dry, free_sphere, saved, scene};

const G: f64 = 9.81;

fn opened(scene: &Scene) -> Coupled {
    open(EngineName::Reference, scene, None, false).unwrap()
}

fn grain(engine: &Coupled, number: usize) -> Grain {
    engine.free_grains().unwrap().grains()[number]
}

/// Millimetres, and the velocity of 1 m/s, in lattice units.
const MM: f64 = 1.0;
const M_S: f64 = 0.1;

#[test]
fn a_grain_falls_exactly_in_a_domain_of_a_billion_cells_that_costs_nothing() {
    let text = dry(
        [1000; 3],
        &format!("{FLOOR_AND_LID}{GRAVITY}{}", free_sphere("[0.5, 0.5, 0.9]", "2e-3", "2500.0")),
    );
    let scene = scene(&text);
    let mut engine = opened(&scene);
    for _ in 0..10 {
        engine.step(40).unwrap();
        let (found, t) = (grain(&engine, 0), engine.steps() as f64 * 1e-4);
        let fallen = 900.0 * MM - found.position.z;
        assert!((fallen / (0.5e3 * G * t * t) - 1.0).abs() < 1e-9, "{fallen} mm in {t} s");
        assert!(
            (found.velocity.z / (-G * t * M_S) - 1.0).abs() < 1e-12,
            "{} in {t} s",
            found.velocity
        );
    }
}

#[test]
fn a_weight_that_grows_in_time_gives_the_velocity_that_is_its_integral() {
    let ramp =
        "[gravity]\nacceleration = { from = [0.0, 0.0, 0.0], to = [0.0, 0.0, -9.81], end = 0.1 }\n";
    let ball = free_sphere("[5e-3, 5e-3, 15e-3]", "2e-3", "2500.0");
    let mut engine = opened(&scene(&dry([10, 10, 20], &format!("{ramp}{ball}"))));
    for _ in 0..4 {
        engine.step(50).unwrap();
        let t = engine.steps() as f64 * 1e-4;
        let found = grain(&engine, 0).velocity.z;
        assert!((found / (-0.5 * G * t * t / 0.1 * M_S) - 1.0).abs() < 1e-12, "{found} in {t} s");
    }
}

#[test]
fn a_ball_bounces_to_its_height_times_the_square_of_its_restitution() {
    for restitution in [0.5, 0.8, 1.0] {
        let contact = format!("[contact]\nstiffness = 1e5\nrestitution = {restitution:?}\n");
        let ball = free_sphere("[5e-3, 5e-3, 21e-3]", "2e-3", "2500.0");
        let scene = scene(&dry([10, 10, 30], &format!("{FLOOR_AND_LID}{GRAVITY}{contact}{ball}")));
        let mut engine = opened(&scene);
        let mut height = 20.0 * MM;
        for bounce in 0..3 {
            // Down, and up until it falls again.
            while grain(&engine, 0).velocity.z <= 0.0 {
                engine.step(1).unwrap();
            }
            let mut highest = 0.0_f64;
            while grain(&engine, 0).velocity.z > 0.0 {
                highest = highest.max(grain(&engine, 0).position.z - 1.0 * MM);
                engine.step(1).unwrap();
            }
            // Sub-steps of a 25th of the contact leave 0.3 % of the restitution; weight acts during the contact too.
            let wanted = restitution * restitution * height;
            assert!(
                (highest / wanted - 1.0).abs() < 0.02,
                "bounce {bounce}: {highest} mm, exact {wanted} mm"
            );
            height = highest;
        }
    }
}

#[test]
fn grains_without_fluid_may_fall_by_many_cells_a_step_and_down_a_chute() {
    // Cells are a unit of length: 1.9 m at up to 6 m/s in steps of 1 ms and cells of 1 mm are 6 cells a step.
    let ball = free_sphere("[0.05, 0.05, 1.95]", "0.02", "2500.0");
    let contact = "[contact]\nyoungs_modulus = 1e8\nrestitution = 0.9\n";
    let text = dry([100, 100, 2000], &format!("{FLOOR_AND_LID}{GRAVITY}{contact}{ball}"))
        .replace("dt = 1e-4", "dt = 1e-3");
    let scene = scene(&text);
    let mut engine = opened(&scene);
    let fall = (2.0 * 1.94 / G).sqrt();
    // Up again for half of the time of the fall: 1.5 times 0.6289 s.
    engine.step(943).unwrap_or_else(|stop| panic!("{stop}"));
    let found = grain(&engine, 0);
    let speed = 0.9 * G * fall - 0.5 * G * fall;
    let scale = scene.units.si_velocity();
    // The contact takes some 3 ms of 0.9 s.
    assert!(
        (found.velocity.z * scale / speed - 1.0).abs() < 0.02,
        "{} m/s, {speed} expected",
        found.velocity.z * scale
    );

    // A chute whose axis along x repeats itself: contacts by default are as hard as for a fall of its height.
    let ball = free_sphere("[5e-3, 5e-3, 45e-3]", "4e-3", "2500.0");
    let stiffness = |gravity: &str| {
        let text = dry(
            [10, 10, 50],
            &format!("{FLOOR_AND_LID}[gravity]\nacceleration = {gravity}\n{ball}"),
        );
        let scene = crate::scenes::scene(&text);
        scene.free.unwrap().setup.law.linear().unwrap().stiffness
    };
    let ratio = stiffness("[1e-6, 0.0, -9.81]") / stiffness("[0.0, 0.0, -9.81]");
    assert!(
        (ratio - 1.0).abs() < 1e-3,
        "a push along a periodic axis changes the stiffness {ratio} times"
    );
}

#[test]
fn a_ball_that_slides_comes_to_roll_at_five_sevenths_of_its_velocity_when_it_should() {
    let (radius, friction, stiffness) = (1e-3, 0.3, 1000.0);
    let mass = 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * f64::powi(radius, 3);
    // As deep in the floor as its weight presses it.
    let centre = format!("[5e-3, 5e-3, {:?}]", radius - mass * G / stiffness);
    let ball = free_sphere(&centre, "2e-3", "2500.0") + "velocity = [0.1, 0.0, 0.0]\n";
    let contact = format!("[contact]\nstiffness = {stiffness:?}\nfriction = {friction:?}\n");
    let text = dry([10, 10, 10], &format!("{FLOOR_AND_LID}{GRAVITY}{contact}{ball}"));
    let mut engine = opened(&scene(&text));
    // v = v0 - μ g t and ω a = 5/2 μ g t meet at t = 2 v0/(7 μ g)
    let rolls = 2.0 * 0.1 / (7.0 * friction * G);
    let near = |found: f64, wanted: f64| {
        assert!((found / wanted - 1.0).abs() < 5e-3, "{found}, exact {wanted}");
    };
    while engine.steps() as f64 * 1e-4 < 0.9 * rolls {
        engine.step(10).unwrap();
        let (ball, t) = (grain(&engine, 0), engine.steps() as f64 * 1e-4);
        if t < 0.95 * rolls {
            near(ball.velocity.x / M_S, 0.1 - friction * G * t);
            near(ball.angular_velocity.y * ball.radius / M_S, 2.5 * friction * G * t);
        }
    }
    engine.step(200).unwrap();
    let ball = grain(&engine, 0);
    near(ball.velocity.x / M_S, 0.5 / 7.0);
    near(ball.angular_velocity.y * ball.radius / M_S, 0.5 / 7.0);
}

#[test]
fn a_prescribed_ball_throws_a_free_one_forward_at_twice_its_velocity() {
    let text = dry(
        [40, 10, 10],
        &format!(
            "[[grains]]\nkind = \"sphere\"\ncentre = [5e-3, 5e-3, 5e-3]\ndiameter = 2e-3\nmotion = \"prescribed\"\n\
             velocity = [0.2, 0.0, 0.0]\n{}[contact]\nstiffness = 1000.0\nrestitution = 1.0\n",
            free_sphere("[8e-3, 5e-3, 5e-3]", "2e-3", "2500.0")
        ),
    );
    let mut engine = opened(&scene(&text));
    engine.step(150).unwrap();
    let (pushing, pushed) = (engine.solids()[0].clone(), grain(&engine, 1));
    assert!((pushing.centre.x - 8.0 * MM).abs() < 1e-9, "{pushing:?}");
    assert!((pushed.velocity.x / (0.4 * M_S) - 1.0).abs() < 5e-3, "{}", pushed.velocity);
}

/// Three balls of different sizes and densities above one another in a box, with records, until they rest.
fn column(more: &str) -> String {
    let balls = [
        ("2e-3", "2.05e-3", "2500.0"),
        ("3e-3", "4.6e-3", "2000.0"),
        ("2.4e-3", "7.4e-3", "7800.0"),
    ];
    let balls: String = balls
        .iter()
        .map(|(diameter, z, density)| free_sphere(&format!("[5e-3, 5e-3, {z}]"), diameter, density))
        .collect();
    dry(
        [10, 10, 20],
        &format!("{BOX}{GRAVITY}{balls}[contact]\nfriction = 0.0\nrestitution = 0.2\n{more}"),
    )
}

const RECORDS: &str = "[[records]]\nname = \"means\"\nkind = \"grain_means\"\nevery_steps = 20\n\
    [[records]]\nname = \"walls\"\nkind = \"walls\"\n[[records]]\nname = \"grains\"\nkind = \"grains\"\nevery_steps = 1000\n\
    [[records]]\nname = \"contacts\"\nkind = \"contacts\"\n\
    [[records]]\nname = \"stresses\"\nkind = \"contact_means\"\nevery_steps = 50\n";

fn run(folder: &Folder, arguments: &[&str]) -> String {
    let output = psmrt_in(&folder.path(""), arguments);
    assert!(output.status.success(), "{arguments:?}: {}", stderr(&output));
    stdout(&output) + &stderr(&output)
}

/// The last rows of a table, with the numbers of their cells; words are left out.
fn rows(folder: &Folder, table: &str) -> Vec<Vec<f64>> {
    let text = fs::read_to_string(folder.path(table)).unwrap();
    let numbers = |line: &str| line.split(',').filter_map(|cell| cell.parse().ok()).collect();
    text.lines().skip(1).map(numbers).collect()
}

#[test]
fn a_column_comes_to_rest_on_the_floor_with_just_its_weight() {
    let folder = Folder::new("dry_column");
    let steady =
        "steps = 20000\n[stop.steady]\nrecord = \"means\"\ncolumn = \"z\"\ntolerance = 1e-9\n";
    folder.write("scene.toml", column(RECORDS).replace("steps = 100\n", steady));
    let said = run(&folder, &["run", "scene.toml", "--out", "out"]);
    assert!(said.contains("steady after") && said.contains("grain steps a second"), "{said}");
    // Long after, to the last digits.
    let text = column(RECORDS).replace("steps = 100\n", "steps = 20000\n");
    folder.write("long.toml", text.replace("every_steps = 20\n", "every_steps = 2000\n"));
    run(&folder, &["run", "long.toml", "--out", "long"]);
    let density_and_size = [(2500.0, 2e-3), (2000.0, 3e-3), (7800.0, 2.4e-3)];
    let volume = |diameter: f64| std::f64::consts::PI / 6.0 * diameter.powi(3);
    let weight: f64 =
        density_and_size.map(|(density, size)| density * volume(size) * G).iter().sum();
    // Time, step, fluid, grains; faces in their order, the floor last but one.
    let walls = rows(&folder, "long/walls.csv");
    let floor = &walls[walls.len() - 2];
    assert_eq!(&floor[2..5], &[0.0; 3], "there is no fluid");
    assert!((floor[7] / -weight - 1.0).abs() < 1e-12, "{floor:?}: the weight is {weight} N");
    let means = rows(&folder, "long/means.csv").pop().unwrap();
    assert!(means[9] < 1e-20, "they still move: {means:?}");
    assert_eq!(means[10], 3.0, "contacts");
}

#[test]
fn grains_without_fluid_are_the_same_on_every_engine_and_after_a_checkpoint() {
    let scene = scene(&column(""));
    let states = EngineName::ALL.map(|name| {
        let mut engine = open(name, &scene, None, false).unwrap();
        engine.step(150).unwrap();
        let half = saved(&engine);
        engine.step(150).unwrap();
        let whole = saved(&engine);
        let mut resumed = open(name, &scene, None, false).unwrap();
        resumed.load(&mut half.as_slice()).unwrap();
        resumed.step(150).unwrap();
        assert!(saved(&resumed) == whole, "{}: other bits after a checkpoint", name.word());
        assert_eq!(engine.name(), name.word());
        whole
    });
    assert!(states.iter().all(|state| *state == states[0]), "the engines differ");
    assert!(states[0].len() < 10_000, "{} bytes of three grains", states[0].len());
}

#[test]
fn a_run_without_fluid_goes_on_where_it_was_and_a_wet_scene_starts_from_its_grains() {
    let folder = Folder::new("dry_list");
    folder.write("scene.toml", column(RECORDS));
    run(&folder, &["run", "scene.toml", "--out", "out"]);
    let more = run(&folder, &["resume", "out", "--set", "stop.steps=200", "--out", "more"]);
    assert!(more.contains("at its limit after 200 steps"), "{more}");
    let facts = fs::read_to_string(folder.path("more/run.json")).unwrap();
    assert!(facts.contains("\"tau\": null"), "{facts}");
    let grains =
        "[[grains]]\nkind = \"csv\"\nfile = \"out/grains_at_end.csv\"\nmotion = \"free\"\n";
    let wet = format!(
        "[domain]\ncells = [20, 20, 40]\ndx = 5e-4\n[fluid]\ndensity = 1000.0\nkinematic_viscosity = 1e-6\n\
         [time]\ndt = 1e-4\n{BOX}{GRAVITY}{grains}[stop]\nsteps = 10\n"
    );
    folder.write("wet.toml", wet);
    let wet = Scene::load(&folder.path("wet.toml"), &[]).unwrap_or_else(|error| panic!("{error}"));
    let (grains, units) = (wet.free.unwrap().grains, wet.units);
    let mut dry = opened(&scene(&column("")));
    dry.step(100).unwrap();
    for (number, wet) in grains.iter().enumerate() {
        let dry = grain(&dry, number);
        assert!((wet.position * units.si_dx * 1e3 - dry.position).norm() < 1e-12);
        assert!((wet.velocity * units.si_velocity() * M_S - dry.velocity).norm() < 1e-12);
        // The density over that of water, here and there.
        assert!((wet.mass / dry.mass * (dry.radius / wet.radius).powi(3) - 1.0).abs() < 1e-12);
    }
    let from_none = "[initial]\nfrom = \"out\"\n";
    let text = fs::read_to_string(folder.path("wet.toml")).unwrap();
    folder.write("from.toml", text.replace("[stop]", &format!("{from_none}[stop]")));
    let output = psmrt_in(&folder.path(""), &["run", "from.toml", "--out", "from"]);
    assert!(stderr(&output).contains("had no fluid"), "{}", stderr(&output));
}
