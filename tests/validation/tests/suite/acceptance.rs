//! The acceptance cases on the CPU engine: every claim holds, no value has drifted, and no case lacks a part.
//! (On the kernel: `tests/device`.)

use crate::common::Budget;
use psmrt::engine::EngineName;
use psmrt_validation::cases::{Bench, CASES, Case, CaseError, Claim, Golden, drifts, steadiness};
use std::collections::BTreeSet;
use std::path::Path;

fn golden() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../golden"))
}

fn case(name: &str) -> &'static Case {
    CASES.iter().find(|case| case.name == name).unwrap()
}

/// Measures a case at its quick scale on `engine`; its claims hold, and in double precision its rows are the reviewed ones
/// of the oracle.
fn holds_on(name: &str, engine: EngineName, budget: &mut Budget) {
    let case = case(name);
    let files = Golden::of(case, golden());
    let mut bench = Bench::new(golden(), engine, None, |_| {});
    let mut rows = bench.measure(case).unwrap_or_else(|error| panic!("{name}: {error}"));
    budget.spend(bench.cell_updates());
    let steady = steadiness(engine.word(), &bench.settled());
    let claims = (case.judge)(&files, &rows).unwrap();
    assert!(!claims.is_empty(), "{name} claims nothing");
    for claim in claims.iter().chain(&steady) {
        let Claim { what, measured, allowed, why } = claim;
        println!("{name}: {what}: {measured:.3e} in {allowed:?}");
        assert!(claim.holds(), "{name}: {what}: {measured} is not in {allowed:?} ({why})");
    }
    if !case.scenes.is_empty() && engine.is_double() {
        let reference = EngineName::Reference.word();
        rows.rows.iter_mut().for_each(|row| row[0] = reference.to_owned());
        let found = drifts(&files.table(case.rows).unwrap(), &rows);
        assert!(found.is_empty(), "{name}: look at `cargo validate golden diff {name}`: {found:?}");
    }
    assert!(!(case.draw)(&files, &rows).unwrap().is_empty(), "{name} draws nothing");
    let read: BTreeSet<String> = bench.tables_read().union(&files.tables_read()).cloned().collect();
    let declared = case.literature.iter().chain(case.studies).chain([&case.rows]);
    let declared: BTreeSet<String> = declared.map(|&file| file.to_owned()).collect();
    let undeclared: Vec<_> = read.difference(&declared).collect();
    assert!(
        undeclared.is_empty(),
        "{name} rests on tables that it does not declare: {undeclared:?}"
    );
    for study in case.studies {
        assert!(read.contains(*study), "{name} declares {study} and does not read it");
    }
}

/// The same on the CPU engine in both precisions. The oracle itself, which takes ten times as long, is held to these
/// claims by `cargo validate report` and to its rows by `cargo validate golden diff`; that the CPU engine computes the
/// same is shown step by step in tests/device.
fn holds(name: &str, budget: &mut Budget) {
    holds_on(name, EngineName::Cpu, budget);
    if !case(name).scenes.is_empty() {
        holds_on(name, EngineName::CpuSingle, budget);
    }
}

#[test]
fn flow_in_a_duct_on_the_oracle_holds_its_claims() {
    holds_on("duct", EngineName::Reference, &mut Budget::oracle(6_000_000));
}

#[test]
fn poiseuille_flow_holds_its_claims() {
    holds("poiseuille", &mut Budget::kernel(5_600_000));
}

#[test]
fn flow_in_a_duct_holds_its_claims() {
    holds("duct", &mut Budget::kernel(12_000_000));
}

#[test]
fn oscillating_flows_hold_their_claims() {
    holds("oscillating", &mut Budget::kernel(72_000_000));
}

#[test]
fn a_sphere_in_a_stream_holds_its_claims() {
    holds("sphere_drag", &mut Budget::kernel(115_000_000));
}

#[test]
fn seepage_through_a_bed_holds_its_claims() {
    holds("seepage", &mut Budget::kernel(49_000_000));
}

#[test]
fn permeability_holds_its_claims() {
    holds("permeability", &mut Budget::kernel(95_000_000));
}

#[test]
fn images_of_porous_bodies_hold_their_claims() {
    holds("images", &mut Budget::kernel(300_000_000));
}

#[test]
fn a_sphere_thickens_sheared_water_as_einstein_derived() {
    holds("viscosity", &mut Budget::kernel(160_000_000));
}

#[test]
fn a_boiling_bed_holds_its_claims() {
    holds("boiling", &mut Budget::kernel(240_000_000));
}

#[test]
fn a_column_of_spheres_on_springs_holds_its_claims() {
    holds("spring_column", &mut Budget::kernel(46_600_000));
}

#[test]
fn a_fluidized_bed_holds_its_claims() {
    holds("fluidization", &mut Budget::kernel(111_600_000));
}

#[test]
fn sphere_arrays_hold_their_claims() {
    holds("sphere_arrays", &mut Budget::kernel(160_000_000));
}

#[test]
fn a_settling_grain_holds_its_claims() {
    holds("stokes_settling", &mut Budget::kernel(49_000_000));
}

#[test]
fn a_settling_cloud_holds_its_claims() {
    holds("cloud_settling", &mut Budget::kernel(132_000_000));
}

#[test]
fn a_sphere_in_a_tank_holds_its_claims() {
    holds("ten_cate", &mut Budget::kernel(36_000_000));
}

#[test]
fn a_wet_rebound_holds_its_claims() {
    holds("wet_rebound", &mut Budget::kernel(40_000_000));
}

#[test]
fn a_settling_suspension_holds_its_claims() {
    holds("suspension", &mut Budget::kernel(39_400_000));
}

#[test]
fn committed_sweep_of_speed_and_accuracy_holds_its_claims() {
    holds("tradeoff", &mut Budget::kernel(0));
}

#[test]
fn committed_comparison_of_operators_holds_its_claims() {
    holds("operators", &mut Budget::kernel(0));
}

#[test]
fn committed_confusion_table_holds_its_claims() {
    holds("conformance", &mut Budget::kernel(0));
}

#[test]
fn committed_errors_of_the_kernel_stay_within_their_bounds() {
    holds("kernel_parity", &mut Budget::kernel(0));
}

#[test]
fn committed_speeds_of_the_kernel_are_above_the_oracles() {
    holds("kernel_speed", &mut Budget::kernel(0));
}

#[test]
fn committed_speeds_of_the_cpu_engine_stand_beside_generated_code() {
    holds("cpu_speed", &mut Budget::kernel(0));
}

#[test]
fn committed_maps_of_stability_hold_their_claims() {
    holds("stability", &mut Budget::kernel(0));
}

#[test]
fn committed_costs_hold_their_claims() {
    holds("cost", &mut Budget::kernel(0));
}

/// Cases that run no scene of their own, and why not: they judge rows that another command has made.
const WITHOUT_SCENES: [(&str, &str); 8] = [
    ("conformance", "it judges programs that make planted mistakes"),
    ("tradeoff", "its sweep runs its scenes with every setting, for hours"),
    ("operators", "its runs take half an hour"),
    ("kernel_parity", "it compares two engines step by step"),
    ("kernel_speed", "it measures speeds of a machine"),
    ("cpu_speed", "it measures speeds of a machine"),
    ("stability", "its maps take thousands of runs, most of which are meant to break"),
    ("cost", "it measures times of a machine"),
];

/// The names of the files in a folder.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
fn every_case_has_scenes_literature_reviewed_results_and_a_test() {
    let tests = include_str!("acceptance.rs");
    for case in CASES {
        let (name, files) = (case.name, Golden::of(case, golden()));
        let excused =
            WITHOUT_SCENES.iter().any(|(without, why)| *without == name && !why.is_empty());
        assert!(excused == case.scenes.is_empty(), "{name}: scenes, or a reason why it has none");
        for scene in case.scenes {
            assert!(files.path(scene).exists(), "{name}: no {scene}");
        }
        // Rows with values, and above them where these come from.
        assert!(case.scenes.is_empty() || !case.literature.is_empty(), "{name} has no literature");
        for file in case.literature.iter().chain([&case.rows]) {
            let text = std::fs::read_to_string(files.path(file)).unwrap_or_default();
            assert!(text.starts_with('#'), "{name}: {file} does not say where it comes from");
            assert!(!files.table(file).unwrap().rows.is_empty(), "{name}: {file} has no rows");
        }
        assert!(!case.about.is_empty() && !case.title.is_empty() && !case.full.is_empty());
        assert!(tests.contains(&format!("holds(\"{name}\"")), "{name} has no test");
    }
}

#[test]
fn every_scene_and_literature_file_belongs_to_a_case_that_names_it() {
    for folder in names(golden()) {
        // Cases without scenes judge what other programs have made, from scenes of their own.
        let is_own = |case: &&Case| case.name == folder && !case.scenes.is_empty();
        let Some(case) = CASES.iter().find(is_own) else { continue };
        let text = [case.about.join(" "), case.full.to_owned()].join(" ");
        for file in names(&golden().join(&folder)) {
            let known = case.scenes.iter().chain(case.literature).any(|own| *own == file);
            let is_one = file.ends_with(".toml") || file == "literature.csv";
            assert!(!is_one || known || text.contains(&file), "{folder}: nothing names {file}");
        }
    }
}

#[test]
fn a_run_that_does_not_settle_says_what_still_changes_and_who_limits_it() {
    let (mut bench, mut budget) =
        (Bench::new(golden(), EngineName::Cpu, None, |_| {}), Budget::kernel(200_000));
    let mut told = |changes: &[&str]| {
        let changes: Vec<_> = changes.iter().map(|&change| change.to_owned()).collect();
        let error = bench.steady("poiseuille/scene.toml", &changes).err().unwrap();
        assert!(matches!(error, CaseError::NotSteady { .. }), "{error}");
        error.to_string()
    };
    // Four rows, 500 steps apart, of a flow that needs ten times as long.
    let text = told(&["stop.steps=2000", "stop.steady.tolerance=1e-7"]);
    for part in [
        "not steady after 2000 steps",
        "superficial_velocity_x has 1.7e-1 of itself still to go",
        "1e-7 of itself",
        "Raise the `stop.steps` that the case sets in its own code",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    // Of two limits the smaller one is named: here that of the changes is not the one that ends the run.
    let text = told(&["stop.steps=100000000", "stop.time=0.1"]);
    assert!(text.contains("Raise the `stop.time` that the case sets"), "{text}");
    // Too short for anything to be known.
    let text = told(&["stop.steps=600"]);
    assert!(text.contains("fewer than four rows"), "{text}");
    budget.spend(bench.cell_updates());
}
