//! The conformance kit: does its judge name the mistakes that people make?

use psmrt_report::{Axis, Figure, Series};

use super::{Bench, Case, CaseError, Claim, Golden};
use psmrt::table::Table;

/// The judge of other people's kernels.
pub const CASE: Case = Case {
    name: "conformance",
    title: "Planted mistakes, named by the judge of the conformance kit",
    about: &[
        "An independent implementation in NumPy, written from the paper, answers the conformance kit with one \
         mistake planted at a time: every misprint of the paper, and what people really get wrong. The judge \
         sees nothing but the numbers and says which single mistake makes them. The table is the confusion \
         table in double precision (cargo run -p psmrt-validation --example confusion f64); `cargo test` makes it anew.",
    ],
    scenes: &[],
    literature: &[],
    rows: "confusion.csv",
    studies: &[],
    units: "numbers of answers and of mistakes",
    full: "cargo run --release -p psmrt-validation --example confusion made these rows; minutes",
    measure,
    judge,
    draw,
};

/// Making the table takes Python and is the test `tests/device/conformance_candidates.rs`.
fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    bench.literature(CASE.name, CASE.rows)
}

fn judge(_: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let right = rows.words("planted", "named")?.iter().filter(|(a, b)| a == b).count();
    let others = rows.numbers("others_that_fit")?;
    let all = rows.rows.len() as f64;
    Ok(vec![
        Claim {
            what: "mistakes that are named as planted".to_owned(),
            measured: right as f64,
            allowed: all.max(25.0)..=all.max(25.0),
            why: "every mistake of the catalogue, which has at least 25",
        },
        Claim {
            what: "other mistakes that fit as well, at most".to_owned(),
            measured: others.into_iter().fold(0.0, f64::max),
            allowed: 0.0..=0.0,
            why: "a diagnosis names one",
        },
    ])
}

fn draw(_: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let mut wrong = rows.numbers("wrong_answers")?;
    wrong.sort_by(|a, b| b.total_cmp(a));
    let points = (1..).map(f64::from).zip(wrong).collect();
    let figure = Figure::new(
        "How many of the kit's answers a mistake spoils",
        Axis::linear("planted mistakes, the most harmful first"),
        Axis::linear("wrong answers").range(0.0, 80.0),
    );
    let note = "a mistake that spoils one answer is named by that one; names in the table below";
    Ok(vec![figure.with(Series::points("NumPy candidate, f64", points)).note(note)])
}
