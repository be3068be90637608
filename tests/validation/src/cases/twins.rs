//! Studies in which some runs were made by both engines: those stand for the rest, which only one made.

use super::{CaseError, Claim};
use psmrt::engine::EngineName;
use psmrt::table::Table;

/// The words that tell a run from all others: the columns after the first, which is the engine.
fn run<'a>(row: &'a [String], columns: &[&str]) -> &'a [String] {
    &row[1..columns.len().min(row.len())]
}

/// The rows of a study less those of the kernel that the oracle has made too. `columns` are the engine
/// and what tells runs apart, as the study begins.
pub fn without_twins(study: &Table, columns: &[&str]) -> Table {
    let oracle = |row: &Vec<String>| row[0] == EngineName::Reference.word();
    let has = |row: &Vec<String>| {
        let mut own = study.rows.iter().filter(|other| oracle(other));
        own.any(|other| run(other, columns) == run(row, columns))
    };
    let rows = study.rows.iter().filter(|row| oracle(row) || !has(row)).cloned().collect();
    Table { columns: study.columns.clone(), rows }
}

/// That the kernel's results in `column` are the oracle's wherever both have made a run.
pub fn twins_claim(study: &Table, columns: &[&str], column: &str) -> Result<Claim, CaseError> {
    let engine = |name: EngineName| study.with(&[("engine", name.word()), ("outcome", "steady")]);
    let (oracle, kernel) = (engine(EngineName::Reference)?, engine(EngineName::Wgpu)?);
    let (theirs, ours) = (oracle.numbers(column)?, kernel.numbers(column)?);
    let mut pairs = Vec::new();
    for (row, found) in kernel.rows.iter().zip(ours) {
        let twin = oracle.rows.iter().position(|other| run(other, columns) == run(row, columns));
        pairs.extend(twin.map(|i| (found / theirs[i] - 1.0).abs()));
    }
    Ok(Claim {
        what: format!(
            "study: {column} of the {} runs that both engines made: largest relative difference",
            pairs.len()
        ),
        // Without any there is nothing to hold the kernel's rows to.
        measured: pairs.into_iter().reduce(f64::max).unwrap_or(f64::NAN),
        allowed: 0.0..=1e-4,
        why: "single precision with shifted populations leaves a steady mean of many cells some 1e-6; the tolerance of the \
              steady state is 3e-5 to 1e-4",
    })
}

#[cfg(test)]
mod tests {
    use super::{twins_claim, without_twins};
    use psmrt::table::Table;

    fn study() -> Table {
        let rows = "engine,cells,outcome,CD\nreference,4,steady,1.0\nwgpu,4,steady,1.1\n\
                    wgpu,8,steady,3\nwgpu,9,broken,0\n";
        Table::parse("study", rows).unwrap()
    }

    #[test]
    fn rows_of_the_kernel_give_way_to_those_of_the_oracle() {
        let left = without_twins(&study(), &["engine", "cells"]);
        assert_eq!(left.values("CD").unwrap(), ["1.0", "3", "0"]);
    }

    #[test]
    fn twins_that_differ_fail_the_claim_and_so_do_none() {
        let claim = twins_claim(&study(), &["engine", "cells"], "CD").unwrap();
        assert!((claim.measured - 0.1).abs() < 1e-12 && !claim.holds());
        let alone = study().with(&[("cells", "8")]).unwrap();
        assert!(!twins_claim(&alone, &["engine", "cells"], "CD").unwrap().holds());
    }
}
