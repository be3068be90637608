//! The numbers that `psmrt check` and `psmrt plan` predict by: a small table (`coefficients.csv`), a row a model, a limit or a
//! curve, with what its numbers mean and where they come from; and the runs that a prediction is shown beside
//! (`runs.csv`). Both are made from golden tables by `cargo validate coefficients`, and a test of the validation makes
//! them again.

use std::sync::OnceLock;

use crate::table::{Table, TableError};

const TABLE: &str = include_str!("coefficients.csv");
const RUNS: &str = include_str!("runs.csv");

/// Columns of the table.
pub const COLUMNS: [&str; 5] = ["name", "of", "numbers", "meaning", "source"];

/// What stands for a number that was not found.
pub const NONE: &str = "-";

/// Groups of numbers: a group for each point of a curve or limit.
pub type Groups = Vec<Vec<Option<f64>>>;

/// The groups of numbers of a row. Errors if there is no such row, or one of its numbers is none.
pub fn groups(name: &str, of: &str) -> Result<Groups, TableError> {
    static ROWS: OnceLock<Table> = OnceLock::new();
    let table = match ROWS.get() {
        Some(table) => table,
        None => {
            let table = Table::parse("src/advice/coefficients.csv", TABLE)?;
            ROWS.get_or_init(|| table)
        }
    };
    let wrong = |what: &str| TableError(format!("coefficients of {name}, {of}: {what}"));
    let row = table.rows.iter().find(|row| row[0] == name && row[1] == of);
    let text = &row.ok_or_else(|| wrong("there are none"))?[2];
    parse(text).ok_or_else(|| wrong(&format!("{text:?} is no list of numbers")))
}

/// Groups of numbers as the table has them: `1 2;3 -`.
pub fn parse(text: &str) -> Option<Groups> {
    let number = |word: &str| match word {
        NONE => Some(None),
        word => word.parse().ok().map(Some),
    };
    text.split(';').map(|group| group.split_whitespace().map(number).collect()).collect()
}

/// The numbers of a row that has one group of `N`. Errors likewise.
pub fn numbers<const N: usize>(name: &str, of: &str) -> Result<[f64; N], TableError> {
    let flat: Vec<f64> = groups(name, of)?.into_iter().flatten().flatten().collect();
    let count = flat.len();
    flat.try_into()
        .map_err(|_| TableError(format!("coefficients of {name}, {of}: {count} numbers, not {N}")))
}

/// The points of a row that is a curve. Errors likewise.
pub fn curve(name: &str, of: &str) -> Result<Vec<(f64, f64)>, TableError> {
    let point = |group: Vec<Option<f64>>| match group[..] {
        [Some(x), Some(y)] => Ok((x, y)),
        _ => Err(TableError(format!("coefficients of {name}, {of}: {group:?} is no point"))),
    };
    groups(name, of)?.into_iter().map(point).collect()
}

/// The table of runs.
pub fn runs() -> Result<Table, TableError> {
    Table::parse("src/advice/runs.csv", RUNS)
}
