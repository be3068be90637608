//! `psmrt permeability`, and what runs conclude from their records.

use std::f64::consts::PI;
use std::fs;
use std::process::{Command, Output};

use crate::cli::{Folder, psmrt, stderr, stdout};
use crate::common::Budget;
use crate::scenes::water;
use psmrt::scene::columns::PERMEABILITY_COLUMNS;
use serde_json::Value;

fn json(output: &Output) -> Value {
    let text = stdout(output);
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// A sphere in the middle of a cube of 8 periodic cells: a simple cubic array.
const SPHERE: &str =
    "[[grains]]\nkind = \"sphere\"\ncentre = [4e-5, 4e-5, 4e-5]\ndiameter = 7e-5\n";

fn array(more: &str) -> String {
    water([8, 8, 8], 1e-5, &format!("{SPHERE}{more}"))
}

const FORCE: &str = "[body_force]\nacceleration = [0.5, 0.0, 0.0]\n[stop]\nsteps = 3000\n";

#[test]
fn tensor_of_a_cubic_array_is_the_same_along_all_axes_to_round_off() {
    let mut budget = Budget::kernel(5_000_000);
    let folder = Folder::new("tensor");
    let file = folder.write("scene.toml", array(FORCE));
    let out = folder.path("out");
    let names = [file.to_str().unwrap(), out.to_str().unwrap()];
    let output = psmrt(&["permeability", names[0], "--tensor", "--json", "--out", names[1]]);
    assert!(output.status.success(), "{}", stderr(&output));
    let found = json(&output);
    let runs = found["runs"].as_array().unwrap();
    assert_eq!(runs.len(), 3);
    for run in runs {
        budget.spend(512 * run["steps"].as_u64().unwrap());
    }
    let k = |i: usize, j: usize| number(&found["tensor"]["k_m2"][i][j]);
    for i in 0..3 {
        for j in 0..3 {
            let expected = if i == j { k(0, 0) } else { 0.0 };
            // Sums of populations near 0.3 beside a velocity of 1e-6 cells a step, over 1e3 steps: 1e-16/1e-6 each.
            let error = (k(i, j) - expected).abs() / k(0, 0);
            assert!(error < 1e-7, "k[{i}][{j}] = {:e}, {expected:e} expected: {error:e}", k(i, j));
        }
        let principal = number(&found["tensor"]["principal"][i]["k_m2"]);
        assert!((principal / k(0, 0) - 1.0).abs() < 1e-7, "{principal:e}");
    }
    // Each run is an ordinary one, and the file says what was printed.
    let facts = fs::read_to_string(out.join("permeability.json")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&facts).unwrap()["tensor"], found["tensor"]);
    let resumed = psmrt(&["resume", out.join("y_1").to_str().unwrap()]);
    assert!(resumed.status.success() || stderr(&resumed).contains("finished"), "{resumed:?}");
}

#[test]
fn refined_grids_keep_the_grains_and_approach_what_richardson_says() {
    let mut budget = Budget::kernel(40_000_000);
    let folder = Folder::new("refined");
    let file = folder.write("scene.toml", array(FORCE));
    let out = folder.path("out");
    let names = [file.to_str().unwrap(), out.to_str().unwrap()];
    let arguments = ["permeability", names[0], "--refine", "2", "--json", "--out", names[1]];
    let output = psmrt(&arguments);
    assert!(output.status.success(), "{}", stderr(&output));
    let found = json(&output);
    let runs = found["runs"].as_array().unwrap();
    let cells: Vec<u64> = runs.iter().map(|run| run["cells"][0].as_u64().unwrap()).collect();
    // 8 times the square root of 2 is 11.3.
    assert_eq!(cells, [8, 11, 16]);
    for (run, cells) in runs.iter().zip(cells) {
        budget.spend(cells.pow(3) * run["steps"].as_u64().unwrap());
        assert!((number(&run["diameter_m"]) / 7e-5 - 1.0).abs() < 1e-12);
        let size = number(&run["bed_m"][1]) - number(&run["bed_m"][0]);
        assert!((size / 8e-5 - 1.0).abs() < 1e-12, "{size}");
    }
    let grid = &found["grids"][0];
    let [k, best, gci] = [&runs[2]["k_m2"], &grid["richardson_m2"], &grid["gci"]].map(number);
    // The index has a factor of 1.25 on what Richardson's extrapolation adds.
    assert!((gci / (1.25 * (best / k - 1.0).abs()) - 1.0).abs() < 1e-9, "{grid}");
    // It is printed for people too.
    let again = folder.path("again");
    let text =
        psmrt(&["permeability", names[0], "--refine", "2", "--out", again.to_str().unwrap()]);
    let text = stdout(&text);
    for word in ["darcy", "K = ", "Kozeny-Carman", "Richardson", "GCI", "8 x 8 x 8", "steady"] {
        assert!(text.contains(word), "{word} is missing: {text}");
    }
    budget.spend(
        runs.iter()
            .map(|run| run["cells"][0].as_u64().unwrap().pow(3) * run["steps"].as_u64().unwrap())
            .sum(),
    );
}

#[test]
fn permeability_command_says_what_it_cannot_do() {
    let folder = Folder::new("refused");
    let wall = "[faces]\nz_low.kind = \"wall\"\nz_high.kind = \"wall\"\n";
    let odd = water([8, 9, 7], 1e-5, &format!("{SPHERE}{FORCE}"));
    let still = array("[stop]\nsteps = 10\n");
    let cases: [(&str, String, &[&str], &str); 7] = [
        ("walls", array(&format!("{wall}{FORCE}")), &["--tensor"], "not periodic along z"),
        ("still", still.clone(), &["--tensor"], "no body force drives the fluid"),
        ("no_flow", still, &[], "no flow goes through the domain"),
        ("empty", water([8, 8, 8], 1e-5, FORCE), &[], "no grains"),
        ("odd", odd, &["--refine", "2"], "take --refine 3"),
        ("once", array(FORCE), &["--refine", "1"], "whole number from 2 to 8"),
        ("half", array(FORCE), &["--refine", "1.5"], "whole number from 2 to 8"),
    ];
    for (name, text, more, said) in cases {
        let file = folder.write(&format!("{name}.toml"), text);
        let out = folder.path(name);
        let fixed = ["permeability", file.to_str().unwrap(), "--out", out.to_str().unwrap()];
        let output = psmrt(&[&fixed[..], more].concat());
        assert_eq!(output.status.code(), Some(2), "{name}: {}", stderr(&output));
        let error = stderr(&output).replace('\n', " ");
        assert!(error.contains(said), "{name}: {error}");
        assert!(!out.exists(), "{name}: nothing is made for a command that is refused");
    }
    // A run that is cut off is no result.
    let file = folder.write("short.toml", array(FORCE));
    let out = folder.path("short");
    let names = [file.to_str().unwrap(), out.to_str().unwrap()];
    let output = psmrt(&["permeability", names[0], "--set", "stop.steps=10", "--out", names[1]]);
    assert_eq!(output.status.code(), Some(3));
    assert!(stdout(&output).contains("NOT steady"), "{}", stdout(&output));
}

const PYTHON: &str = r#"
import sys, numpy as np, pandas as pd
path = sys.argv[1]
table = pd.read_csv(path)
assert list(table.columns) == sys.argv[2].split(","), list(table.columns)
assert np.array_equal(np.genfromtxt(path, delimiter=",", skip_header=1), table.to_numpy(dtype=float), equal_nan=True)
last = table.iloc[-1]
k = 1e-6 * 1000 * last["superficial_velocity (m/s)"] / last["pressure_gradient (Pa/m)"]
assert np.isclose(last["permeability (m2)"], k) and np.isfinite(last["psi"]), table
print("read by pandas", pd.__version__)
"#;

#[test]
#[ignore = "needs Python with `pip install pandas numpy`"]
fn pandas_and_numpy_read_the_record() {
    let folder = Folder::new("pandas");
    let record = "[[records]]\nname = \"k\"\nkind = \"permeability\"\nevery_steps = 5\n";
    let file = folder.write("scene.toml", array(&format!("{record}{FORCE}")));
    let out = folder.path("out");
    Budget::kernel(30_000).spend(50 * 512);
    let names = [file.to_str().unwrap(), out.to_str().unwrap()];
    let output = psmrt(&["run", names[0], "--set", "stop.steps=50", "--out", names[1]]);
    assert!(output.status.success(), "{}", stderr(&output));
    let titles = PERMEABILITY_COLUMNS.iter().map(|column| column.title());
    let titles: Vec<String> =
        ["time (s)".to_owned(), "step".to_owned()].into_iter().chain(titles).collect();
    let table = out.join("k.csv");
    let arguments = ["-c", PYTHON, table.to_str().unwrap(), &titles.join(",")];
    let output = Command::new("python3").args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stdout(&output).contains("read by pandas"));
}

/// What a run concludes, by `what`.
fn concluded(folder: &Folder, name: &str, text: &str, what: &str) -> (Value, Value, String) {
    let file = folder.write(&format!("{name}.toml"), text);
    let out = folder.path(name);
    let output = psmrt(&["run", file.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    let facts = fs::read_to_string(out.join("run.json")).unwrap();
    let facts: Value = serde_json::from_str(&facts).unwrap();
    let all = facts["conclusions"].as_array().unwrap();
    let own = all.iter().find(|found| found["what"] == what);
    let own = own.unwrap_or_else(|| panic!("no {what} among {all:?}")).clone();
    (own, facts, stdout(&output))
}

#[test]
fn a_run_concludes_permeability_drag_and_settling_velocity_from_its_records() {
    let mut budget = Budget::kernel(1_000_000);
    let folder = Folder::new("concluded");
    let record = |kind: &str| format!("[[records]]\nname = \"r\"\nkind = \"{kind}\"\n");

    budget.spend(200 * 512);
    let force = FORCE.replace("3000", "200");
    let text = array(&format!("{}{force}", record("box")));
    let (found, facts, said) = concluded(&folder, "bed", &text, "permeability");
    let flux = number(&facts["results"]["r"]["superficial_velocity_x (m/s)"]);
    // k = ν U/a
    assert!((number(&found["k_m2"]) / (1e-6 * flux / 0.5) - 1.0).abs() < 1e-9, "{found}");
    assert_eq!(found["steady"], Value::Null);
    assert!(said.contains("permeability along x: k = ") && said.contains("not judged"), "{said}");

    budget.spend(100 * 16 * 512);
    let stream = "[faces]\nx_low = { kind = \"velocity_inlet\", velocity = [1e-2, 0.0, 0.0] }\n\
                  x_high = { kind = \"pressure\", pressure = 0.0 }\n[stop]\nsteps = 100\n";
    let sphere = SPHERE.replace("7e-5", "4e-5");
    let text = water([16, 16, 16], 1e-5, &format!("{sphere}{}{stream}", record("loads")));
    let (found, facts, said) = concluded(&folder, "stream", &text, "drag_coefficient");
    let drag = number(&facts["results"]["r"]["force_x (N)"]);
    // C_D = F/(ρ U²/2 π d²/4)
    let by_hand = drag / (0.5 * 1000.0 * 1e-4 * PI / 4.0 * 16e-10);
    assert!((number(&found["drag_coefficient"]) / by_hand - 1.0).abs() < 1e-9, "{found}");
    assert!(
        (number(&found["reynolds"]) - 0.4).abs() < 1e-9
            && said.contains("NOT steady") ^ said.contains("not judged")
    );

    budget.spend(20 * 512);
    let grain = format!("{SPHERE}motion = \"free\"\ndensity = 2650.0\n").replace("7e-5", "4e-5");
    let gravity = "[gravity]\nacceleration = [0.0, 0.0, -9.81]\n[faces]\nz_low.kind = \"wall\"\nz_high.kind = \"wall\"\n";
    let text =
        water([8, 8, 8], 1e-5, &format!("{grain}{gravity}{}[stop]\nsteps = 20\n", record("loads")));
    let (found, facts, said) = concluded(&folder, "fall", &text, "settling_velocity");
    // What is left of (ρ_s - ρ_f) V g.
    let weight = 1650.0 * PI / 6.0 * 64e-15 * 9.81;
    let drag = number(&facts["results"]["r"]["force_z (N)"]);
    let left = number(&found["share_of_weight_left"]);
    assert!((left - (1.0 - drag / weight)).abs() < 1e-6, "{found}: {drag:e} of {weight:e}");
    assert!(number(&found["velocity_m_per_s"]) > 0.0 && said.contains("NOT final"), "{said}");
}
