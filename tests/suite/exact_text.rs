//! Exact text that others read or copy: the matrix `M`, the diagonal of `S-hat`, the help. These guard
//! against drift only; that `M` and `S-hat` are right is in `moments.rs`.
//!
//! To take over a wanted change: `INSTA_UPDATE=always cargo test --test suite exact_text::`, and review the diff.

use psmrt_reference::directions::{C, ORDER};
use psmrt_reference::moments::{NAMES, moment_matrix};
use psmrt_reference::rates::Rates;
use std::fmt::Write;
use std::process::Command;

#[test]
fn moment_matrix_reads_as_reviewed() {
    let m = moment_matrix();
    let mut text = format!("columns: {ORDER}, c = {C:?}\n");
    for (row, name) in NAMES.iter().enumerate() {
        let entries: Vec<String> = (0..NAMES.len()).map(|a| format!("{:3}", m[(row, a)])).collect();
        writeln!(text, "{name:>5} {}", entries.join(" ")).unwrap();
    }
    insta::assert_snapshot!(text);
}

#[test]
fn relaxation_rates_read_as_reviewed() {
    let mut text = String::new();
    let tau = 0.8;
    for (preset, rates) in [
        ("SRT", Rates::srt(tau)),
        ("d'Humieres 2002", Rates::dhumieres(tau)),
        ("magic 3/16", Rates::magic(tau, 3.0 / 16.0)),
    ] {
        let entries = rates.unwrap().diagonal().map(|rate| format!("{rate:.4}"));
        writeln!(text, "tau = {tau}, {preset}: {}", entries.join(" ")).unwrap();
    }
    insta::assert_snapshot!(text);
}

fn help(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_psmrt")).args(arguments).output().unwrap();
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn help_of_plan_reads_as_reviewed() {
    insta::assert_snapshot!(help(&["plan", "--help"]));
}

#[test]
fn help_reads_as_reviewed() {
    insta::assert_snapshot!(format!("{}\n{}", help(&["--help"]), help(&["run", "--help"])));
}
