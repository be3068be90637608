//! `cargo validate golden`: what has drifted is shown with its tolerance, and what is written says where it comes from.

use crate::common::Budget;
use psmrt::table::Table;
use psmrt_validation::cases::CASES;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// Cell updates of the case `poiseuille` on the oracle, which `acceptance.rs` counts.
const POISEUILLE: u64 = 2_800_000;

fn golden(arguments: &[&str], folder: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_validate"));
    command.arg("golden").args(arguments).arg("--golden").arg(folder).output().unwrap()
}

/// A copy of the files of a case, outside any checkout.
fn copy(case: &str) -> tempfile::TempDir {
    let temp = tempfile::tempdir().unwrap();
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden").join(case);
    let to = temp.path().join(case);
    fs::create_dir(&to).unwrap();
    for entry in fs::read_dir(from).unwrap().map(|entry| entry.unwrap()) {
        fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
    }
    temp
}

#[test]
fn a_drift_is_shown_over_its_tolerance_and_what_is_written_anew_names_its_origin() {
    let temp = copy("poiseuille");
    let (reviewed, mut budget) =
        (temp.path().join("poiseuille/expected.csv"), Budget::oracle(5_600_000));
    let before = Table::read(&reviewed).unwrap();
    // The last of a column, one percent off: a hundred times the tolerance of 1e-4.
    let text = fs::read_to_string(&reviewed).unwrap();
    let last = before.numbers("wall_outwards").unwrap().pop().unwrap();
    let word = before.values("wall_outwards").unwrap().pop().unwrap();
    fs::write(&reviewed, text.replace(&word, &format!("{:.6e}", last / 1.01))).unwrap();
    budget.spend(POISEUILLE);
    let output = golden(&["diff", "poiseuille"], temp.path());
    let told = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(told.contains("poiseuille: 1 values differ"), "{told}");
    assert!(told.contains(&format!("-> {word} (by ")) && told.contains(", 100."), "{told}");
    assert!(told.contains(" times the tolerance of "), "{told}");

    budget.spend(POISEUILLE);
    let output = golden(&["write", "poiseuille"], temp.path());
    assert!(output.status.success(), "{output:?}");
    assert_eq!(Table::read(&reviewed).unwrap(), before, "the value is the old one again");
    let text = fs::read_to_string(&reviewed).unwrap();
    let made = text.lines().find(|line| line.starts_with("# Made by: ")).unwrap();
    assert!(
        made.contains(" golden write poiseuille, at ") && made.contains("engine reference"),
        "{made}"
    );
    // Git knows nothing of the copied scenes, so that no commit can be named alone.
    let doubts = ["+ changes", "perhaps with changes", "an unknown commit"];
    assert!(doubts.iter().any(|doubt| made.contains(doubt)), "{made}");
}

#[test]
fn an_unknown_case_is_refused_with_those_that_there_are() {
    let output = golden(&["diff", "ducts"], Path::new("golden"));
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        told.contains("ducts") && told.contains("poiseuille") && !told.contains("tradeoff"),
        "{told}"
    );
}

#[test]
fn every_reviewed_table_of_the_oracle_says_its_command_its_day_and_the_units_of_its_case() {
    let mut seen = 0;
    for case in CASES.iter().filter(|case| !case.scenes.is_empty()) {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../golden")
            .join(case.name)
            .join(case.rows);
        let text = fs::read_to_string(&path).unwrap();
        let name = path.display();
        assert!(text.contains(&format!("# Units: {}.", case.units)), "{name}: other units");
        let made = text.lines().find(|line| line.starts_with("# Made by: ")).unwrap();
        assert!(
            made.contains(&format!("golden write {}, at commit ", case.name)),
            "{name}: {made}"
        );
        let before =
            made.strip_suffix("; engine reference.").unwrap_or_else(|| panic!("{name}: {made}"));
        let day = before.rsplit(", ").next().unwrap();
        let parts: Vec<_> = day.split('-').map(|part| part.parse::<u32>().is_ok()).collect();
        assert_eq!(parts, [true; 3], "{name}: {day:?} is no day");
        seen += 1;
    }
    assert!(seen >= 7, "{seen}");
}
