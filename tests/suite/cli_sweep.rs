//! `psmrt sweep`: all combinations run, one table, and the same command goes on.

use std::fs;

use psmrt::table::Table;

use crate::cli::{Folder, psmrt_in, stderr, stdout};
use crate::common::Budget;
use crate::scenes::water;

/// Flow between plates, whose superficial velocity is H² g/(12 nu) with rates that put the walls half-way.
fn text() -> String {
    let rest = "[collision]\nrates = \"magic\"\nmagic = 0.1875\n[faces]\ny_low.kind = \"wall\"\ny_high.kind = \"wall\"\n\
                [body_force]\nacceleration = [0.02, 0.0, 0.0]\n[engine]\nkind = \"cpu\"\n\
                [[records]]\nname = \"b\"\nkind = \"box\"\nevery_steps = 10\n[stop]\nsteps = 20000\n\
                steady = { record = \"b\", column = \"superficial_velocity_x\", tolerance = 1e-6 }\n";
    water([1, 8, 1], 1e-4, rest)
}

const VELOCITY: &str = "b.superficial_velocity_x (m/s)";

#[test]
fn every_combination_runs_and_one_table_has_what_they_have_shown() {
    let mut budget = Budget::kernel(400_000);
    budget.spend(6 * 8 * 8_000);
    let folder = Folder::new("sweep");
    folder.write("plates.toml", text());
    let over_force = "body_force.acceleration=[0.02,0,0],[0.04,0,0]";
    let sweep = |taus: &str| {
        let over = format!("time.tau={taus}");
        let asked = ["sweep", "plates.toml", "--over", &over, "--over", over_force, "--out", "s"];
        psmrt_in(&folder.path(""), &asked)
    };
    let done = sweep("0.6,0.8");
    assert!(done.status.success(), "{}", stderr(&done));
    assert!(stdout(&done).contains("4 runs, 0 of them failed"), "{}", stdout(&done));
    let table = || Table::read(&folder.path("s/sweep.csv")).unwrap();
    let found = table();
    assert_eq!(found.rows.len(), 4);
    assert_eq!(found.columns[..4], ["time.tau", "body_force.acceleration", "folder", "state"]);
    // H² g/(12 nu) plus, for the nodes at y = 1/2, 3/2, ..., g/(24 nu): in lattice units as in SI units.
    for (force, velocity) in
        found.values("body_force.acceleration").unwrap().iter().zip([0.02_f64, 0.04])
    {
        let rows = found.with(&[("body_force.acceleration", force)]).unwrap();
        assert_eq!(rows.values("state").unwrap(), ["steady"]);
        let exact = velocity / 1e-6 * (8e-4_f64.powi(2) / 12.0 + 1e-8 / 24.0);
        for number in rows.numbers(VELOCITY).unwrap() {
            assert!((number / exact - 1.0).abs() < 1e-5, "{number:e}, exact {exact:e}");
        }
    }
    // The same command finds all of them done; with a value more it makes the runs that are missing.
    let before = fs::read(folder.path("s/sweep.csv")).unwrap();
    let again = sweep("0.6,0.8");
    assert!(again.status.success() && stderr(&again).matches("has finished before").count() == 4);
    assert!(fs::read(folder.path("s/sweep.csv")).unwrap() == before, "the table has changed");
    let more = sweep("0.6,0.8,1.0");
    assert!(more.status.success() && stderr(&more).matches("has finished before").count() == 4);
    assert_eq!(table().rows.len(), 6);
    // Of another scene nothing is mixed in.
    folder.write("plates.toml", text().replace("0.1875", "0.25"));
    let other = sweep("0.6,0.8");
    assert_eq!(other.status.code(), Some(2));
    assert!(stderr(&other).contains("holds a run of another scene"), "{}", stderr(&other));
    assert_eq!(table().rows.len(), 6, "the table was touched");
}

#[test]
fn a_sweep_that_was_cut_off_goes_on_and_a_run_that_fails_is_a_row_of_the_table() {
    let mut budget = Budget::kernel(200_000);
    budget.spend(2 * 8 * 8_000);
    let folder = Folder::new("sweep_cut_off");
    folder.write("plates.toml", text());
    let sweep = |over: &str, set: &str| {
        let asked = ["sweep", "plates.toml", "--over", over, "--set", set, "--out", "s", "--json"];
        psmrt_in(&folder.path(""), &asked)
    };
    // A run that was killed when it had its scene and no state yet.
    let over = "time.tau=0.7,0.9";
    assert!(sweep(over, "title=cut").status.success());
    let facts = folder.path("s/time.tau=0.9/run.json");
    fs::remove_file(&facts).unwrap();
    fs::remove_dir_all(folder.path("s/time.tau=0.9/checkpoints")).unwrap();
    let again = sweep(over, "title=cut");
    assert!(again.status.success(), "{}", stderr(&again));
    assert!(facts.exists() && folder.path("s/time.tau=0.9/b.csv.old").exists());
    let found: serde_json::Value = serde_json::from_slice(&again.stdout).unwrap();
    assert_eq!(found["runs"][1]["changes"]["time.tau"], "0.9");
    assert_eq!(found["runs"][1]["run"]["state"], "steady");
    // Too strong a force breaks the flow: the others run all the same.
    fs::remove_dir_all(folder.path("s")).unwrap();
    let broken = sweep("body_force.acceleration=[15.0,0,0],[0.02,0,0]", "title=\"broken\"");
    assert_eq!(broken.status.code(), Some(1), "{}", stderr(&broken));
    let table = Table::read(&folder.path("s/sweep.csv")).unwrap();
    assert_eq!(table.values("state").unwrap(), ["failed", "steady"]);
    assert!(
        table.values("trouble").unwrap()[0].contains("stopped"),
        "{:?}",
        table.values("trouble")
    );
}

#[test]
fn a_sweep_that_makes_no_sense_runs_nothing() {
    let folder = Folder::new("sweep_refused");
    folder.write("plates.toml", text());
    for (over, said) in [
        (&["time.tau"][..], "has no `=`"),
        (&["time.tau=0.6,0.6"], "twice"),
        (&["time.tau=0.6,0.4"], "above 0.5"),
        (&["time.tua=0.6"], "did you mean"),
        (&["time.tau=0.6", "time.tau=0.8"], "the same key is set twice"),
        (&["stop.steps=1,2", "engine.kind=cpu,reference", "time.tau=0.6,warm"], "a number"),
    ] {
        let mut asked = vec!["sweep", "plates.toml", "--out", "s"];
        over.iter().for_each(|over| asked.extend(["--over", over]));
        let output = psmrt_in(&folder.path(""), &asked);
        assert_eq!(output.status.code(), Some(2), "{over:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(said), "{over:?}: {}", stderr(&output));
        assert!(!folder.path("s").exists(), "{over:?}: a folder was made");
    }
}
