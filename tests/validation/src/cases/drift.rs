//! How new results differ from the reviewed ones.

use psmrt::table::Table;

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
    /// By how much, and how often the tolerance that is, in words.
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
    // Equal words need no arithmetic, NaN least of all.
    if before == after {
        return None;
    }
    match (before.parse::<f64>(), after.parse::<f64>()) {
        (Ok(old), Ok(new)) => {
            let (off, tolerance) = ((new - old).abs(), (RELATIVE * old.abs()).max(ABSOLUTE));
            let same = off <= tolerance;
            let times = || format!("{:.1} times the tolerance of {tolerance:.1e}", off / tolerance);
            (!same).then(|| format!("by {off:.2e}, {}", times()))
        }
        _ => Some("another word".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::drifts;
    use psmrt::table::Table;

    fn found(old: &str, new: &str) -> Vec<String> {
        let table = |value: &str| Table::parse("a", &format!("v\n{value}\n")).unwrap();
        drifts(&table(old), &table(new)).into_iter().map(|drift| drift.change).collect()
    }

    #[test]
    fn a_drift_says_how_often_its_tolerance_it_is() {
        assert_eq!(found("2.0", "2.0001"), [""; 0]);
        // 1e-4 of 2, twelve times.
        assert_eq!(found("2.0", "1.9976"), ["by 2.40e-3, 12.0 times the tolerance of 2.0e-4"]);
        // Of values that are rounding 1e-9 is allowed.
        assert_eq!(found("0", "5e-9"), ["by 5.00e-9, 5.0 times the tolerance of 1.0e-9"]);
        assert_eq!(found("1e-13", "3e-10"), [""; 0]);
        assert_eq!(found("NaN", "NaN"), [""; 0]);
        assert_eq!(found("1", "NaN").len(), 1);
        assert_eq!(found("steady", "drifts"), ["another word"]);
    }
}
