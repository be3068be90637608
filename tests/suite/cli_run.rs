//! The command line as a newcomer uses it.

use std::fs;
use std::path::Path;

use crate::cli::{Folder, psmrt, psmrt_in, stderr, stdout};
use crate::common::Budget;
use serde_json::Value;

const POISEUILLE: &str = "golden/poiseuille/scene.toml";

fn json(output: &std::process::Output) -> Value {
    let text = stdout(output);
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// Runs the Poiseuille scene with changes; its comparison.
fn poiseuille(budget: &mut Budget, folder: &Folder, name: &str, changes: &[&str]) -> Value {
    let out = folder.path(name);
    let mut arguments = vec!["run", POISEUILLE, "--json", "--out", out.to_str().unwrap()];
    changes.iter().for_each(|change| arguments.extend(["--set", change]));
    let output = psmrt(&arguments);
    assert!(output.status.success(), "{}", stderr(&output));
    let found = json(&output);
    // A column of 32 cells.
    budget.spend(32 * found["run"]["steps"].as_u64().unwrap());
    found["comparison"].clone()
}

#[test]
fn the_poiseuille_scene_is_exact_and_other_rates_err_by_the_known_slip() {
    let folder = Folder::new("poiseuille");
    let mut budget = Budget::oracle(4_000_000);
    let error = |found: &Value, key: &str| found[key].as_f64().unwrap();
    let magic = poiseuille(&mut budget, &folder, "magic", &[]);
    // The run stops when 1e-12 of the flow is left to go.
    assert!(error(&magic, "relative_l2") < 1e-12, "{magic}");
    for (name, changes) in [
        ("dhumieres", &["collision={ rates = \"dhumieres\" }"] as &[&str]),
        ("srt", &["collision={ model = \"srt\" }", "time.tau=1.5"]),
    ] {
        let found = poiseuille(&mut budget, &folder, name, changes);
        let (l2, explained) = (error(&found, "relative_l2"), error(&found, "explained_l2"));
        assert!(l2 > 1e-4 && (l2 / explained - 1.0).abs() < 1e-5, "{name}: {found}");
    }
    for file in ["box.csv", "profile.csv", "comparison.csv", "comparison.svg", "profile.svg"] {
        assert!(folder.path("magic").join(file).is_file(), "{file}");
    }
    let table = fs::read_to_string(folder.path("magic").join("comparison.csv")).unwrap();
    assert!(table.starts_with("position (m),velocity (m/s),exact_velocity (m/s)\n"), "{table}");
    assert_eq!(table.lines().count(), 1 + 32);
    let facts = fs::read_to_string(folder.path("magic").join("run.json")).unwrap();
    let facts: Value = serde_json::from_str(&facts).unwrap();
    assert_eq!(facts["state"], "steady");
    assert_eq!(facts["engine"], "cpu");
    assert!(facts["program"]["version"].is_string() && facts["wall_seconds"].is_number());
}

#[test]
fn a_run_ends_once_the_force_on_its_grain_is_steady() {
    let folder = Folder::new("steady_force");
    let mut budget = Budget::oracle(1_500_000);
    let out = folder.path("run");
    let coarse = ["domain.dx=7.5e-5", "stop.steady.tolerance=1e-2"];
    let mut arguments = vec!["run", "golden/sphere_drag/scene.toml", "--json", "--out"];
    arguments.push(out.to_str().unwrap());
    coarse.iter().for_each(|change| arguments.extend(["--set", change]));
    let output = psmrt(&arguments);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(json(&output)["run"]["state"], "steady", "{}", stdout(&output));
    let loads = csv::Reader::from_path(out.join("loads.csv")).unwrap();
    let forces: Vec<f64> = loads
        .into_deserialize::<std::collections::HashMap<String, String>>()
        .map(|row| row.unwrap()["force_y (N)"].parse().unwrap())
        .collect();
    // A quarter of the box: 10 x 40 x 10 cells, 50 steps from row to row.
    budget.spend(4000 * 50 * (forces.len() as u64 - 1));
    // The box rings: the force lies within the tolerance of its last value for an eighth of the time at least,
    // and the first half of the run was wider.
    let last = forces[forces.len() - 1];
    let farthest = |rows: &[f64]| rows.iter().map(|f| (f / last - 1.0).abs()).fold(0.0, f64::max);
    let (first, rest) = (&forces[..forces.len() / 2], &forces[forces.len() * 8 / 9..]);
    assert!(farthest(rest) <= 1e-2 && farthest(first) > 1e-2, "{forces:?}");
}

#[test]
fn a_run_that_is_not_steady_says_so_and_by_how_much() {
    let folder = Folder::new("not_steady");
    // Startup of the plates: the slowest part falls by e in H²/(π² ν), the 1038 steps of 32 cells at tau 0.8; the
    // fastest of the rest by as much in a ninth of that.
    Budget::oracle(576_000).spend(3 * 32 * 6000);
    let run = |name: &str, more: &[&str]| {
        let out = folder.path(name);
        let mut arguments = vec!["run", POISEUILLE, "--out", out.to_str().unwrap()];
        arguments.extend(more);
        (psmrt(&arguments), fs::read_to_string(out.join("run.json")).unwrap())
    };
    let short = ["--set", "stop.steps=6000", "--set", "stop.steady.tolerance=1e-4"];
    let (output, facts) = run("text", &short);
    assert_eq!(output.status.code(), Some(3), "{}{}", stdout(&output), stderr(&output));
    let said = stdout(&output);
    // 96/π⁴ e^(-6000/1038) = 3.0e-3: thirty times what is allowed. A tenth of it for the discrete modes.
    let number = |before: &str| -> f64 {
        let rest = said.split(before).nth(1).unwrap_or_else(|| panic!("no {before:?}: {said}"));
        rest.split(' ').next().unwrap().parse().unwrap()
    };
    assert!(said.starts_with("at its limit and NOT steady after 6000 steps"), "{said}");
    assert!((number(" and has ") / 3.04e-3 - 1.0).abs() < 0.1, "{said}");
    assert!((number("to go, ") / 30.4 - 1.0).abs() < 0.1, "{said}");
    let facts: Value = serde_json::from_str(&facts).unwrap();
    assert_eq!(facts["state"], "not steady", "{facts}");
    assert!((facts["steady"]["left"].as_f64().unwrap() / 3.04e-3 - 1.0).abs() < 0.1, "{facts}");
    assert!(folder.path("text/comparison.csv").is_file(), "results are written all the same");
    // The same for scripts; and with nothing asked for, nothing is missed.
    let (output, _) = run("json", &[&short[..], &["--json"]].concat());
    assert_eq!(output.status.code(), Some(3));
    let run_facts = &json(&output)["run"];
    assert_eq!(run_facts["state"], "not steady");
    // The results of the flow, and how its files are to be read. 1/12 G H²/ν (1 + 1/(2 H²)), less what is missing.
    let mean = &run_facts["results"]["box"]["superficial_velocity_x (m/s)"];
    assert!((mean.as_f64().unwrap() / 1.66748e-3 - (1.0 - 3.04e-3)).abs() < 1e-4, "{run_facts}");
    assert!(run_facts["files"]["npy"].as_str().unwrap().contains("z, y, x"), "{run_facts}");
    let (output, _) = run("limit", &["--set", "stop={ steps = 6000 }"]);
    assert!(output.status.success() && stdout(&output).starts_with("at its limit after"));
}

#[test]
fn a_run_can_be_repeated_from_its_folder() {
    let folder = Folder::new("repeated");
    let mut budget = Budget::oracle(48_000);
    poiseuille(&mut budget, &folder, "first", &["time.tau=0.7", "stop={ steps = 1500 }"]);
    let scene = folder.path("first/scene.toml");
    let out = folder.path("again");
    let arguments = ["run", scene.to_str().unwrap(), "--out", out.to_str().unwrap()];
    assert!(psmrt(&arguments).status.success());
    for file in ["box.csv", "profile.csv", "comparison.csv", "scene.toml"] {
        let bytes = |name: &str| fs::read(folder.path(name).join(file)).unwrap();
        assert_eq!(bytes("first"), bytes("again"), "{file}");
    }
}

#[test]
fn results_go_to_a_fresh_folder_each_time() {
    let folder = Folder::new("fresh");
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join(POISEUILLE);
    let arguments = ["run", scene.to_str().unwrap(), "--set", "stop={ steps = 10 }"];
    for expected in ["out/poiseuille", "out/poiseuille-2", "out/poiseuille-3"] {
        let output = psmrt_in(&folder.path(""), &arguments);
        assert!(output.status.success(), "{}", stderr(&output));
        assert!(stdout(&output).contains(&format!("results in {expected}\n")), "{output:?}");
        assert!(folder.path(expected).join("scene.toml").is_file());
    }
}

#[test]
fn check_tells_numbers_models_and_warnings_and_makes_nothing() {
    let output = psmrt(&["check", POISEUILLE]);
    let said = stdout(&output);
    assert!(output.status.success());
    for part in ["tau ", "Mach number", "Reynolds number", "memory", "MRT", "face -y: wall"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert!(said.contains("no warnings"), "{said}");
    let found = json(&psmrt(&["check", POISEUILLE, "--json", "--set", "time.tau=0.505"]));
    let tau = found["numbers"].as_array().unwrap().iter().find(|n| n["name"] == "tau").unwrap();
    assert!((tau["value"].as_f64().unwrap() - 0.505).abs() < 1e-12);
    // The magic rates are exact between plates, near tau = 0.5 too.
    assert_eq!(found["warnings"].as_array().map(Vec::len), Some(0), "{found}");
    assert!(found["engines"][0]["cell_updates_per_second"].as_f64().unwrap() > 0.0);
}

#[test]
fn a_run_says_the_warnings_of_the_check_once_each() {
    let folder = Folder::new("warned");
    let mut budget = Budget::oracle(4_000);
    // A sphere of 2 cells in a stream of Mach 0.29: whatever else is warned of, this is.
    let changes = ["--set", "domain.dx=1.5e-4", "--set", "stop={ time = 3e-3 }"];
    let scene = "golden/sphere_drag/scene.toml";
    let checked = json(&psmrt(&[&["check", scene, "--json"], &changes[..]].concat()));
    let wanted = checked["warnings"].as_array().unwrap().clone();
    assert!(!wanted.is_empty(), "{checked}");
    let holds_once = |said: &str| {
        for warning in &wanted {
            let reason = warning["reason"].as_str().unwrap();
            assert_eq!(said.matches(reason).count(), 1, "not once: {reason}\nsaid: {said}");
        }
    };
    let out = folder.path("text");
    let output = psmrt(&[&["run", scene, "--out", out.to_str().unwrap()], &changes[..]].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    holds_once(&stderr(&output));
    let facts: Value =
        serde_json::from_str(&fs::read_to_string(out.join("run.json")).unwrap()).unwrap();
    assert_eq!(facts["warnings"].as_array(), Some(&wanted), "run.json");
    let out = folder.path("json");
    let arguments = ["run", scene, "--json", "--out", out.to_str().unwrap()];
    let output = psmrt(&[&arguments, &changes[..]].concat());
    assert_eq!(json(&output)["run"]["warnings"].as_array(), Some(&wanted), "--json");
    assert!(!stderr(&output).contains("warning"), "{}", stderr(&output));
    // Two runs of four steps, and what the check tries for half a second is not counted.
    budget.spend(2 * 4 * 500);
}

#[test]
fn every_golden_scene_passes_the_check() {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden");
    let scenes: Vec<_> = fs::read_dir(golden)
        .unwrap()
        .map(|entry| entry.unwrap().path().join("scene.toml"))
        .filter(|path| path.exists())
        .collect();
    assert!(scenes.len() >= 2);
    for scene in scenes {
        let output = psmrt(&["check", scene.to_str().unwrap()]);
        assert!(output.status.success(), "{}", stderr(&output));
    }
}

#[test]
fn a_broken_run_says_why_and_exits_with_1() {
    let folder = Folder::new("broken");
    let out = folder.path("out");
    let output = psmrt(&[
        "run",
        POISEUILLE,
        "--out",
        out.to_str().unwrap(),
        "--set",
        "body_force.acceleration=[60.0, 0.0, 0.0]",
    ]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains("Probable cause: the body force"), "{}", stderr(&output));
    let facts = fs::read_to_string(out.join("run.json")).unwrap();
    assert!(facts.contains("\"failed\""), "{facts}");
}

#[test]
fn info_schema_and_completions_print_what_they_should() {
    let info = json(&psmrt(&["info", "--json"]));
    assert!(info["machine"]["threads"].as_u64().unwrap() >= 1);
    // Known where there is git; a run's folder has it too, as part of the program.
    assert!(info["program"]["modified"].is_boolean() || info["program"]["modified"].is_null());
    assert!(info["program"]["commit"].is_string() || info["program"]["modified"].is_null());
    assert!(stdout(&psmrt(&["info"])).contains("engines"));
    let schema = json(&psmrt(&["schema"]));
    assert_eq!(schema["title"], "psmrt scene");
    for shell in ["bash", "zsh", "fish", "powershell"] {
        assert!(stdout(&psmrt(&["completions", shell])).contains("psmrt"), "{shell}");
    }
    for command in ["run", "check", "resume", "pack", "schema", "completions"] {
        assert!(stdout(&psmrt(&[command, "--help"])).contains("Example"), "{command}");
    }
}

#[test]
fn the_reference_of_scene_files_is_up_to_date() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/scene/REFERENCE.md");
    let written = fs::read_to_string(path).unwrap();
    assert!(
        written == psmrt::command::scene_reference::reference(),
        "run: cargo run -- schema --markdown > src/scene/REFERENCE.md"
    );
}
