//! Records of loads that are means over the steps since the row before.

use std::fs;
use std::path::Path;

use psmrt::engine::{EngineName, open};
use psmrt::output::folder::RunFolder;
use psmrt::run::End;
use psmrt::scene::Scene;

use crate::cli::runs::Until;
use crate::cli::{Folder, psmrt_in, stderr};
use crate::common::Budget;
use crate::scenes::{FLOOR_AND_LID, GRAVITY, free_sphere, water};

const CELLS: u64 = 10 * 10 * 16;

/// A grain that falls; its loads in rows of so many steps.
fn text(steps: u64, record: &str) -> String {
    let sphere = free_sphere("[1e-4, 1e-4, 2e-4]", "1e-4", "7800.0");
    let rest = format!(
        "{FLOOR_AND_LID}{GRAVITY}{sphere}[solid]\noperator = \"bounce_back\"\n[engine]\nkind = \"cpu\"\n\
         [[records]]\nname = \"loads\"\nkind = \"loads\"\n{record}\n[stop]\nsteps = {steps}\n"
    );
    water([10, 10, 16], 2e-5, &rest)
}

fn run(folder: &Folder, arguments: &[&str]) {
    let output = psmrt_in(&folder.path(""), arguments);
    assert!(output.status.success(), "{arguments:?}: {}", stderr(&output));
}

/// The rows of the table of a run, from the column of the force on.
fn forces(out: &Path) -> Vec<[f64; 6]> {
    let text = fs::read_to_string(out.join("loads.csv")).unwrap();
    let row = |line: &str| {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        std::array::from_fn(|number| cells[13 + number])
    };
    let head = text.lines().next().unwrap();
    assert_eq!(head.split(',').nth(13), Some("force_x (N)"), "{head}");
    text.lines().skip(1).map(row).collect()
}

#[test]
fn averaged_loads_are_the_means_of_those_of_every_step_also_after_an_interruption() {
    let mut budget = Budget::kernel(200_000);
    budget.spend((30 + 30 + 15 + 15) * CELLS);
    let folder = Folder::new("load_means");
    folder.write("each.toml", text(30, "every_steps = 1"));
    folder.write("means.toml", text(30, "every_steps = 10\naverage = true"));
    run(&folder, &["run", "each.toml", "--out", "each"]);
    run(&folder, &["run", "means.toml", "--out", "means"]);
    let (each, means) = (forces(&folder.path("each")), forces(&folder.path("means")));
    assert_eq!((each.len(), means.len()), (31, 4));
    for (row, found) in means.iter().enumerate().skip(1) {
        for number in 0..6 {
            let steps = &each[10 * (row - 1) + 1..=10 * row];
            let sum: f64 = steps.iter().map(|step| step[number]).sum();
            let size = steps.iter().map(|step| step[number].abs()).fold(0.0, f64::max);
            let off = (found[number] - sum / 10.0).abs();
            assert!(off <= 1e-14 * size, "row {row}, number {number}: off by {off:e} of {size:e}");
        }
    }
    // The load changes from step to step, so that a mean is no load of a single step.
    assert!((means[1][2] / each[10][2] - 1.0).abs() > 0.01, "{:e}, {:e}", means[1][2], each[10][2]);
    // Stopped half-way between two rows, it goes on with what it had summed.
    let scene = Scene::load(&folder.path("means.toml"), &[]).unwrap();
    let mut engine = open(EngineName::Cpu, &scene, None, false).unwrap();
    let held = RunFolder::make(Some(&folder.path("stopped")), "").unwrap();
    held.keep(&scene).unwrap();
    let end = psmrt::run::run(&scene, &mut engine, &held, None, &mut Until(15)).unwrap();
    assert_eq!((end, engine.steps()), (End::Interrupted, 15));
    drop(held);
    run(&folder, &["resume", "stopped"]);
    let whole = fs::read(folder.path("means/loads.csv")).unwrap();
    assert!(fs::read(folder.path("stopped/loads.csv")).unwrap() == whole, "the tables differ");
}
