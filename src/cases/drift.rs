//! How new results differ from the reviewed ones.

use super::Table;

/// Values that drift by less are the same: another compiler or mathematical library changes the last
/// digits of each operation, which a steady flow does not amplify; errors that are themselves
/// rounding (1e-13) may change by anything below 1e-9.
const RELATIVE: f64 = 1e-4;
const ABSOLUTE: f64 = 1e-9;

/// The same in words.
pub const DRIFT_WORDS: &str = "1e-4 of itself, and by 1e-9 in any case";

/// A value that differs.
#[derive(Clone, Debug, PartialEq)]
pub struct Drift {
    /// Number of the row, from 1.
    pub row: usize,
    /// Name of the column.
    pub column: String,
    /// The reviewed value.
    pub old: String,
    /// The new one.
    pub new: String,
    /// By how much, in words.
    pub change: String,
}

/// All values that differ; rows or columns more or less count as differing.
pub fn drifts(old: &Table, new: &Table) -> Vec<Drift> {
    let mut found = Vec::new();
    let whole = |old: String, new: String| Drift {
        row: 0,
        column: "table".to_owned(),
        old,
        new,
        change: "its form has changed".to_owned(),
    };
    if old.columns != new.columns {
        found.push(whole(old.columns.join(","), new.columns.join(",")));
        return found;
    }
    if old.rows.len() != new.rows.len() {
        let rows = |table: &Table| format!("{} rows", table.rows.len());
        found.push(whole(rows(old), rows(new)));
    }
    for (number, (before, after)) in old.rows.iter().zip(&new.rows).enumerate() {
        for (column, (before, after)) in old.columns.iter().zip(before.iter().zip(after)) {
            if let Some(change) = change(before, after) {
                found.push(Drift {
                    row: number + 1,
                    column: column.clone(),
                    old: before.clone(),
                    new: after.clone(),
                    change,
                });
            }
        }
    }
    found
}

/// How two values differ, if they do.
fn change(before: &str, after: &str) -> Option<String> {
    match (before.parse::<f64>(), after.parse::<f64>()) {
        (Ok(old), Ok(new)) => {
            let off = (new - old).abs();
            let same = off <= (RELATIVE * old.abs()).max(ABSOLUTE);
            (!same).then(|| format!("by {:.2e} of itself", off / old.abs()))
        }
        _ => (before != after).then(|| "another word".to_owned()),
    }
}
