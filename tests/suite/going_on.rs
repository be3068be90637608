//! A run that has come to its end goes on from its last state, longer or with changed values.

use std::fs;
use std::path::Path;

use crate::cli::runs::{bytes, checkpoints};
use crate::cli::{Folder, psmrt_in, stderr, stdout};
use crate::common::Budget;
use crate::scenes::{thick, water};

const CELLS: u64 = 12 * 10 * 12;

/// A free grain, a prescribed one whose velocity changes, a wall and a face whose pressure changes; in steps of 1.6e-5 s.
fn text(steps: u64) -> String {
    let rest = format!(
        r#"
[faces]
z_low.kind = "wall"
z_high = {{ kind = "pressure", pressure = {{ table = [[0.0, 0.0], [8e-4, 10.0]] }} }}
x_low = {{ kind = "wall", velocity = [0.0, 0.01, 0.0] }}
x_high.kind = "wall"
[body_force]
acceleration = [1.0, 0.0, 0.0]
[gravity]
acceleration = [0.0, 0.0, -9.81]
[[grains]]
kind = "sphere"
centre = [1.7e-4, 2e-4, 1.2e-4]
diameter = 2e-4
density = 2500.0
motion = "free"
[[grains]]
kind = "sphere"
centre = [3.7e-4, 2e-4, 3e-4]
diameter = 1.2e-4
motion = "prescribed"
velocity = {{ amplitude = [0.0, 0.02, 0.0], period = 5e-4 }}
[[records]]
name = "box"
kind = "box"
every_steps = 10
[[records]]
name = "loads"
kind = "loads"
every_steps = 10
[stop]
steps = {steps}
"#
    );
    thick(&water([12, 10, 12], 4e-5, &rest))
}

fn run(folder: &Folder, arguments: &[&str]) -> String {
    let output = psmrt_in(&folder.path(""), arguments);
    assert!(output.status.success(), "{arguments:?}: {}", stderr(&output));
    stdout(&output)
}

/// The lines of a table.
fn lines(out: &Path, table: &str) -> Vec<String> {
    let text = fs::read_to_string(out.join(table)).unwrap();
    text.lines().map(str::to_owned).collect()
}

/// The rows of both tables from step 40 on are those of the other run.
fn assert_same_rows(one: &Path, other: &Path) {
    for (table, rows) in [("box.csv", 5), ("loads.csv", 10)] {
        let [one, other] = [one, other].map(|out| lines(out, table));
        let last = |all: &[String]| all[all.len() - rows..].to_vec();
        assert_eq!(last(&one), last(&other), "{table}");
    }
}

#[test]
fn a_run_that_goes_on_to_a_longer_time_ends_with_the_same_bits_as_one_long_run() {
    let mut budget = Budget::kernel(260_000);
    budget.spend((80 + 40 + 40) * CELLS);
    let folder = Folder::new("longer");
    folder.write("short.toml", text(40));
    folder.write("long.toml", text(80));
    run(&folder, &["run", "long.toml", "--out", "long"]);
    let said = run(&folder, &["run", "short.toml", "--out", "short"]);
    assert!(
        said.contains("its last state is kept") && said.contains("resume short --set"),
        "{said}"
    );
    assert_eq!(checkpoints(&folder.path("short")).len(), 1, "the last state alone is kept");
    let before = bytes(&folder.path("short"));
    run(&folder, &["resume", "short", "--set", "stop.steps=80", "--out", "on"]);
    assert!(bytes(&folder.path("short")) == before, "the run that was gone on from has changed");
    assert_same_rows(&folder.path("on"), &folder.path("long"));
    // Its tables begin where it begins.
    assert_eq!(lines(&folder.path("on"), "box.csv").len(), 1 + 5);
    let origin = fs::read_to_string(folder.path("on").join("origin.json")).unwrap();
    assert!(origin.contains("\"step\": 40") && origin.contains("stop.steps=80"), "{origin}");
    // And goes on itself.
    let said = run(&folder, &["resume", "on"]);
    assert!(said.contains("has finished"), "{said}");
}

#[test]
fn changed_values_act_from_the_state_on() {
    let mut budget = Budget::kernel(350_000);
    budget.spend((40 + 3 * 40 + 80) * CELLS);
    let folder = Folder::new("changed");
    folder.write("scene.toml", text(40));
    run(&folder, &["run", "scene.toml", "--out", "first"]);
    let go_on = |set: &str, out: &str| {
        run(&folder, &["resume", "first", "--set", "stop.steps=80", "--set", set, "--out", out]);
    };
    go_on("stop.time=1e3", "same");
    // A table that is the same until then, and another afterwards.
    go_on("faces.x_low.velocity=[0.0, 0.03, 0.0]", "wall");
    go_on(
        "faces.x_low.velocity={ table = [[0.0, 0.0, 0.01, 0.0], [6.4e-4, 0.0, 0.01, 0.0], [6.4e-4, 0.0, 0.03, 0.0]] }",
        "table",
    );
    let whole = text(80).replace(
        "velocity = [0.0, 0.01, 0.0] }",
        "velocity = { table = [[0.0, 0.0, 0.01, 0.0], [6.4e-4, 0.0, 0.01, 0.0], [6.4e-4, 0.0, 0.03, 0.0]] } }",
    );
    folder.write("whole.toml", whole);
    run(&folder, &["run", "whole.toml", "--out", "whole"]);
    // The wall is faster from the step on that begins at 6.4e-4 s, step 40: as if that had been said from the start.
    assert_same_rows(&folder.path("wall"), &folder.path("whole"));
    assert_same_rows(&folder.path("table"), &folder.path("whole"));
    let last = |out: &str| lines(&folder.path(out), "box.csv").pop().unwrap();
    assert_ne!(last("same"), last("wall"), "the wall has not become faster");
}

#[test]
fn what_may_not_change_is_refused_and_nothing_is_made() {
    let mut budget = Budget::kernel(20_000);
    budget.spend(10 * CELLS);
    let folder = Folder::new("may_not_change");
    folder.write("scene.toml", text(10));
    folder
        .write("left_out.toml", text(1).replace("[stop]", "[checkpoint]\nat_end = false\n[stop]"));
    run(&folder, &["run", "scene.toml", "--out", "first"]);
    run(&folder, &["run", "left_out.toml", "--out", "left_out"]);
    let entries = folder.entries();
    let before = bytes(&folder.path("first"));
    for (set, told) in [
        ("domain.dx=2e-5", "grid, fluid and time step cannot change"),
        ("time.tau=0.9", "grid, fluid and time step cannot change"),
        ("fluid.density=900", "grid, fluid and time step cannot change"),
        ("collision.model=srt", "how it is computed cannot change"),
        ("solid.operator=superposition", "how it is computed cannot change"),
        ("engine.kind=reference", "in whose form the state is saved"),
        ("faces.z_low.kind=free_slip", "the kind of a face"),
        ("faces.z_high.developed=true", "the kind of a face"),
        ("grains[0].diameter=1e-4", "those that are prescribed"),
        ("grains[0].velocity=[0.0, 0.0, 0.0]", "is not prescribed is its own"),
        ("gravity.form=body_force", "this cannot change"),
        ("initial.velocity=[0.0, 0.0, 0.0]", "this cannot change"),
        ("stop.steps=10", "has come to step 10"),
        ("stop.steps=0", "at least 1"),
        ("faces.z_high.pressure=1e9", "Pa are allowed"),
    ] {
        let arguments = ["resume", "first", "--set", set, "--out", "on"];
        let output = psmrt_in(&folder.path(""), &arguments);
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{set}: {said}");
        assert!(said.contains(told), "{set}: {told}: {said}");
        assert_eq!(folder.entries(), entries, "{set}");
    }
    assert!(bytes(&folder.path("first")) == before, "a refused change has changed a file");
    for (arguments, told) in [
        (&["resume", "left_out", "--set", "stop.steps=20"] as &[&str], "checkpoint.at_end = false"),
        (&["resume", "first", "--out", "on"], "leave it out, or change something"),
        (&["resume", "first", "--set", "stop.steps=20", "--out", "first"], "not empty"),
    ] {
        let output = psmrt_in(&folder.path(""), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let said = stderr(&output);
        let is_told = said.contains(told) || said.contains("is writing into");
        assert!(is_told, "{arguments:?}: {said}");
    }
    assert_eq!(folder.entries(), entries);
}

#[test]
fn a_run_that_goes_on_and_was_ended_before_its_first_state_has_no_beginning() {
    let folder = Folder::new("no_beginning");
    folder.write("scene.toml", text(10));
    folder.write("origin.json", "{}");
    let output = psmrt_in(&folder.path(""), &["resume", "."]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("give the command again that made it"), "{output:?}");
}
