//! `psmrt plan`: its proposals, what it writes, and its words when it cannot.

use crate::cli::{Folder, psmrt, stderr, stdout};
use crate::common::Budget;
use psmrt::advice::estimate::warnings;
use psmrt::advice::plan::facts::{Facts, Limit};
use psmrt::advice::plan::options::{PlanOption, Speed, cheapest, options};
use psmrt::advice::plan::write::text;
use psmrt::advice::tradeoff::models::Models;
use psmrt::engine::{EngineName, open};
use psmrt::scene::Scene;
use psmrt_reference::collision::Preset;
use std::fs;
use std::path::Path;

const SETTLING: &str = "golden/tradeoff/settling.toml";
const SCENES: [&str; 5] = [
    SETTLING,
    "golden/stokes_settling/scene.toml",
    "golden/sphere_arrays/scene.toml",
    "golden/cloud_settling/scene.toml",
    "golden/poiseuille/scene.toml",
];

fn models() -> &'static Models {
    Models::committed().unwrap()
}

/// Engines as fast as on the machine of the README.
fn speeds() -> Vec<Speed> {
    let speed = |engine, mrt, srt| Speed { engine, mrt, srt };
    vec![speed(EngineName::Reference, 1.6e-7, 1.2e-7), speed(EngineName::Wgpu, 1e-7, 9e-8)]
}

fn load(scene: &str) -> Scene {
    Scene::load(Path::new(scene), &[]).unwrap()
}

fn all_ways(scene: &str) -> (Facts, Vec<PlanOption>) {
    let facts = Facts::of(&load(scene)).unwrap().unwrap();
    let options = options(&facts, models(), &speeds());
    (facts, options)
}

#[test]
fn smaller_errors_are_never_cheaper_and_every_plan_keeps_its_word() {
    for scene in SCENES {
        let (facts, options) = all_ways(scene);
        let mut last: Option<f64> = None;
        let mut planned = 0;
        for percent in [80, 40, 30, 20, 15, 10, 8, 6, 5, 4, 3, 2, 1] {
            let wanted = f64::from(percent) / 100.0;
            let Some(best) = cheapest(&options, wanted) else { continue };
            planned += 1;
            assert!(best.band[0] <= best.error && best.error <= best.band[1], "{best:?}");
            assert!(best.band[1] <= wanted, "{scene}: {best:?} for {wanted}");
            assert!(last.is_none_or(|cost| best.seconds >= cost), "{scene}, {percent} %: {best:?}");
            last = Some(best.seconds);
            // The grid fills the box, the flow is slow, and nothing lies outside the evidence.
            for axis in (0..3).filter(|&axis| !facts.flat[axis]) {
                let si_length = best.cells[axis] as f64 * best.si_dx;
                let si_wanted = facts.cells[axis] as f64 * facts.si_dx;
                assert!((si_length / si_wanted - 1.0).abs() < 1e-12, "{scene}: {best:?}");
            }
            assert!(best.velocity.is_none_or(|u| u <= 0.1), "{best:?}");
            assert!((0.51..=2.0).contains(&best.tau), "{best:?}");
        }
        assert!(planned >= 4, "{scene}: only {planned}");
    }
}

#[test]
fn no_plan_lies_beyond_what_the_maps_of_stability_found() {
    // A bed of 0.6 and a channel, driven harder and harder: as `check` warns, so a plan must not be.
    let bed = ["grains[0].lattice=\"bcc\"", "grains[0].solid_fraction=0.6"].map(str::to_owned);
    for (scene, changes) in [("sphere_arrays", &bed[..]), ("poiseuille", &[])] {
        let scene = format!("golden/{scene}/scene.toml");
        let mut counts = vec![];
        for times in [1.0, 30.0, 1000.0, 30_000.0] {
            let gentle = Scene::load(Path::new(&scene), changes).unwrap();
            let si_force = gentle.setup.body_force.unwrap().x * gentle.units.si_acceleration();
            let force = format!("body_force.acceleration=[{:e}, 0.0, 0.0]", times * si_force);
            let hard = Scene::load(Path::new(&scene), &[changes, &[force]].concat()).unwrap();
            let facts = Facts::of(&hard).unwrap().unwrap();
            let options = options(&facts, models(), &speeds()[..1]);
            // Some of all that are coarse, where the flow is fastest: it has 1/dx cells per step.
            for option in options.iter().filter(|option| option.resolution < 16.0).step_by(7) {
                let planned = text(&hard, Path::new(""), option, "").unwrap();
                let planned =
                    Scene::from_bytes("planned", planned.into_bytes(), Path::new(""), &[]).unwrap();
                let all = warnings(&planned);
                let beyond = all.iter().find(|one| one.reason.contains("golden/stability"));
                assert_eq!(beyond, None, "{scene}, {times} times the force: {option:?}");
            }
            counts.push(options.len());
        }
        println!("{scene}: {counts:?}");
        // Fewer and fewer are left: the limits bind.
        assert!(counts.is_sorted_by(|a, b| a >= b) && counts[3] < counts[0], "{scene}: {counts:?}");
    }
}

#[test]
fn crowding_and_walls_are_found_from_the_scene() {
    let drag = |scene: &str| match Facts::of(&load(scene)).unwrap().unwrap().limit {
        Limit::Grains { cells, drag, .. } => (cells, drag),
        limit => panic!("{scene} has grains, not {limit:?}"),
    };
    // A shaft four diameters wide: 1.82268 (golden/stokes_settling/literature.csv); a quarter of it alike.
    let (cells, shaft) = drag("golden/stokes_settling/scene.toml");
    assert!((cells - 8.0).abs() < 1e-9 && (shaft / 1.8226828 - 1.0).abs() < 1e-9, "{shaft}");
    assert!((drag(SETTLING).1 / shaft - 1.0).abs() < 1e-9);
    // A simple cubic array of 0.216 has 7.442; the face-centred one that stands for all crowds has 7.758.
    let (_, array) = drag("golden/sphere_arrays/scene.toml");
    assert!((array / 7.757676907 - 1.0).abs() < 1e-6, "{array}");
    // A quarter between mirror planes is as crowded as the whole: 0.2, 7.053.
    let (_, quarter) = drag("golden/tradeoff/bcc.toml");
    assert!((quarter / 7.053179633 - 1.0).abs() < 1e-4, "{quarter}");
}

#[test]
fn no_plan_has_a_grain_lighter_than_those_that_stayed_alive() {
    // golden/stability/movers.csv: of 0.5 times the fluid's density all with the inside given back broke, and
    // with the inside kept those at tau = 0.55 and more; at 0.51 it was right.
    for (inside, density, taus) in [
        ("lagged", 500.0, &[][..]),
        ("kept", 500.0, &[0.51]),
        ("kept", 300.0, &[]),
        ("lagged", 800.0, &[0.51, 0.52, 0.55, 0.6, 0.65, 0.7, 0.8, 0.9, 1.0, 1.25, 1.5, 1.75, 2.0]),
    ] {
        let changes = [
            format!("coupling.internal_fluid=\"{inside}\""),
            format!("grains[0].density={density:.1}"),
        ];
        let scene = Scene::load(Path::new("golden/stokes_settling/scene.toml"), &changes).unwrap();
        let facts = Facts::of(&scene).unwrap().unwrap();
        let mut found: Vec<f64> =
            options(&facts, models(), &speeds()[..1]).iter().map(|option| option.tau).collect();
        found.sort_by(f64::total_cmp);
        found.dedup();
        assert_eq!(found, taus, "relaxation times planned for {density} kg/m3, {inside}");
    }
}

#[test]
fn planned_scene_is_the_same_in_si_units() {
    let scene = load("golden/stokes_settling/scene.toml");
    let (_, options) = all_ways("golden/stokes_settling/scene.toml");
    let folder = Path::new("golden/stokes_settling");
    for wanted in [0.3, 0.1, 0.04] {
        let best = cheapest(&options, wanted).unwrap();
        let written = text(&scene, folder, best, "a comment").unwrap();
        assert!(written.starts_with("# a comment\n"), "{written}");
        let again = Scene::from_bytes("planned", written.into_bytes(), folder, &[]).unwrap();
        assert_eq!(again.setup.domain.cells(), best.cells);
        assert!((again.setup.collision.tau() - best.tau).abs() < 1e-12);
        let nu =
            |scene: &Scene| (scene.setup.collision.tau() - 0.5) / 3.0 * scene.units.si_viscosity();
        let gravity = |scene: &Scene| {
            let settings = &scene.free.as_ref().unwrap().settings;
            let Some(psmrt_reference::coupling::Gravity::Reduced { acceleration }) =
                settings.gravity
            else {
                panic!("reduced gravity")
            };
            acceleration.z * scene.units.si_acceleration()
        };
        let diameter =
            |scene: &Scene| 2.0 * scene.free.as_ref().unwrap().grains[0].radius * scene.units.si_dx;
        for (name, si_of) in [
            ("viscosity", &nu as &dyn Fn(&Scene) -> f64),
            ("gravity", &gravity),
            ("diameter", &diameter),
        ] {
            let (old, new) = (si_of(&scene), si_of(&again));
            assert!((new / old - 1.0).abs() < 1e-12, "{name}: {old} {new}");
        }
        let si_end = |scene: &Scene| scene.stop.steps as f64 * scene.units.si_dt;
        // To a step.
        let steps_off = (si_end(&again) - si_end(&scene)).abs() / again.units.si_dt;
        assert!(steps_off <= 1.0 + 1e-6, "{steps_off}");
    }
}

#[test]
fn every_operator_is_planned_with_and_a_plan_keeps_the_one_of_its_scene() {
    let bed = "golden/sphere_arrays/scene.toml";
    let set = |operator: &str| format!("solid.operator=\"{operator}\"");
    for (scene, operator) in [
        (bed, "bounce_back"),
        (bed, "superposition"),
        (bed, "full_bounce_back"),
        (bed, "graded_viscosity"),
        (SETTLING, "full_bounce_back"),
    ] {
        let scene = Scene::load(Path::new(scene), &[set(operator)]).unwrap();
        let facts = Facts::of(&scene).unwrap().unwrap();
        let options = options(&facts, models(), &speeds()[..1]);
        let best = cheapest(&options, 0.2).unwrap_or_else(|| panic!("{operator}: no plan"));
        let written = text(&scene, Path::new(""), best, "").unwrap();
        assert!(written.contains(&format!("operator = \"{operator}\"")), "{written}");
        let again = Scene::from_bytes("planned", written.into_bytes(), Path::new(""), &[]).unwrap();
        let phases = [&scene, &again].map(|scene| scene.setup.solid_phase.as_ref().unwrap());
        assert_eq!(phases[0].operator, phases[1].operator);
        assert_eq!(phases[0].weighting, phases[1].weighting);
    }
}

#[test]
fn a_plan_says_what_the_more_accurate_operator_would_buy() {
    let usual = ["--set", "solid.operator=\"bounce_back\""];
    let bed = psmrt(
        &[&["plan", "golden/sphere_arrays/scene.toml", "--error", "10%"][..], &usual].concat(),
    );
    let said = stdout(&bed);
    assert!(said.contains("with graded_viscosity"), "{said} {}", stderr(&bed));
    let grain = psmrt(&[&["plan", SETTLING, "--error", "10%"][..], &usual].concat());
    let said = stdout(&grain);
    assert!(said.contains("with full_bounce_back"), "{said} {}", stderr(&grain));
    let graded = ["--set", "solid.operator=\"graded_viscosity\""];
    let bed = psmrt(
        &[&["plan", "golden/sphere_arrays/scene.toml", "--error", "10%"][..], &graded].concat(),
    );
    let said = stdout(&bed);
    assert!(
        bed.status.success() && !said.contains("with graded_viscosity"),
        "{said} {}",
        stderr(&bed)
    );
    assert!(said.contains("golden/tradeoff/operators.csv"), "what it rests on: {said}");
}

#[test]
fn planned_grain_settles_as_predicted() {
    let mut budget = Budget::oracle(14_000_000);
    // 4 x 4 x 16 of 8 cells a diameter: a grid of any number of cells per diameter fills it.
    let (_, options) = all_ways(SETTLING);
    let speeds = speeds();
    let oracle = |option: &&PlanOption| {
        option.engine == speeds[0].engine && option.collision == Preset::DHumieres
    };
    let options: Vec<PlanOption> = options.iter().filter(oracle).cloned().collect();
    let best = cheapest(&options, 0.2).unwrap();
    println!("{best:?}");
    let scene = load(SETTLING);
    let planned = text(&scene, Path::new("golden/tradeoff"), best, "").unwrap();
    let planned = Scene::from_bytes("planned", planned.into_bytes(), Path::new(""), &[]).unwrap();
    let cells = planned.setup.domain.cell_count() as u64;
    budget.spend(cells * planned.stop.steps);
    let mut engine = open(EngineName::Reference, &planned, None, false).unwrap();
    engine.step(planned.stop.steps).unwrap();
    let free = engine.free_grains().unwrap();
    let si_velocity = -free.grains()[0].velocity.z * planned.units.si_velocity();
    // Stokes' velocity 5e-4 m/s (the scene's grain in an endless fluid) over the exact drag of the shaft.
    let error = si_velocity / (5e-4 / 1.8226828) - 1.0;
    println!("error {error}, predicted {:?}", best.band);
    assert!((best.band[0]..=best.band[1]).contains(&error), "{error}, {best:?}");
}

/// Runs `plan` and returns what it says about its failure.
fn refused(arguments: &[&str]) -> String {
    let output = psmrt(&[&["plan"], arguments].concat());
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    stderr(&output)
}

#[test]
fn what_cannot_be_planned_is_said_with_a_way_out() {
    let folder = Folder::new("plan_refusals");
    let open = folder.write(
        "open.toml",
        "[domain]\ncells = [8, 8, 8]\ndx = 1e-5\n[fluid]\ndensity = 1000.0\n\
         kinematic_viscosity = 1e-6\n[time]\ntau = 0.8\n[stop]\nsteps = 10\n",
    );
    let error = refused(&[open.to_str().unwrap(), "--error", "5%"]);
    assert!(error.contains("neither grains nor two walls"), "{error}");
    let error = refused(&[SETTLING, "--error", "5"]);
    assert!(error.contains("500 %") && error.contains("5%"), "{error}");
    let error = refused(&[SETTLING, "--error", "0%"]);
    assert!(error.contains("between 0 and 100 %"), "{error}");
    let error = refused(&[SETTLING, "--error", "small"]);
    assert!(error.contains("5% or 0.05"), "{error}");
    let error = refused(&[SETTLING, "--error", "0.5%"]);
    assert!(error.contains("below what the evidence reaches"), "{error}");
    // A dense bed of which a grain takes most of the box: 23 cells are not enough.
    let dense = ["golden/sphere_arrays/scene.toml", "--set", "grains[0].lattice=\"fcc\""];
    let dense = [&dense[..], &["--set", "grains[0].solid_fraction=0.7", "--error", "1%"]].concat();
    let error = refused(&dense);
    assert!(error.contains("out of reach") && error.contains("ask for more than"), "{error}");
    assert!(error.contains("as it is: "), "what the scene itself errs by: {error}");
    // As it is the scene may lie outside the evidence: then which parameter does is said.
    let error = refused(&[&dense[..], &["--set", "time.tau=2.5"]].concat());
    assert!(error.contains("as it is: tau = 2.5 is outside the evidence"), "{error}");
    let light = ["golden/stokes_settling/scene.toml", "--error", "5%"];
    let error = refused(&[&light[..], &["--set", "grains[0].density=300.0"]].concat());
    assert!(error.contains("0.30 times the density of the fluid"), "{error}");
}

#[test]
fn planned_scene_is_written_once_and_runs() {
    let folder = Folder::new("plan_write");
    let file = folder.path("planned.toml");
    let name = file.to_str().unwrap();
    let output = psmrt(&["plan", SETTLING, "--error", "30%", "--write", name]);
    assert!(output.status.success(), "{}", stderr(&output));
    let said = stdout(&output);
    for part in ["plan for 30 %", "twice as fast", "half the error", "the evidence", "near it"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let written = fs::read_to_string(&file).unwrap();
    Scene::load(&file, &[]).unwrap();
    let error = refused(&[SETTLING, "--error", "30%", "--write", name]);
    assert!(error.contains("there already"), "{error}");
    assert_eq!(fs::read_to_string(&file).unwrap(), written);
}
