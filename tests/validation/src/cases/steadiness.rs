//! How steady a run was when it was taken for steady, by its own record: part of every verdict.

use super::bench::Finished;
use super::{CaseError, Claim};
use psmrt::run::steady::History;
use psmrt::table::Table;

/// A run that its criterion has ended, and what the last rows of its record say.
#[derive(Clone, Debug, PartialEq)]
pub struct Settled {
    /// The scene and its changes.
    pub run: String,
    /// Steps made.
    pub steps: u64,
    /// What the criterion allows: relative distance from the final value.
    pub tolerance: f64,
    /// Relative change from the row before the last one to the last.
    pub change: f64,
    /// What is still to go, see [`History::left`].
    pub left: f64,
}

impl Settled {
    /// Reads the last rows of the record that has ended the run.
    pub(super) fn of(run: String, finished: &Finished) -> Result<Self, CaseError> {
        let scene = &finished.scene;
        let Some(steady) = &scene.stop.steady else {
            return Err(CaseError::table(format!("{run}: the scene has no `stop.steady`")));
        };
        let values = values(
            &finished.record(&scene.records[steady.record].name)?,
            steady.column_name(&scene.records),
        )?;
        let (&[.., last, now], Some(left)) = (values.as_slice(), History::of(&values).left())
        else {
            return Err(CaseError::table(format!("{run}: too few rows to be steady")));
        };
        let change = ((now - last) / now).abs();
        let (steps, tolerance) = (finished.engine.steps(), steady.tolerance);
        Ok(Settled { run, steps, tolerance, change, left })
    }
}

/// The values of a column, time by time, summed over the rows (grains) of each.
fn values(rows: &Table, column: &str) -> Result<Vec<f64>, CaseError> {
    let heading = rows.columns.iter().find(|name| name.split(' ').next() == Some(column));
    let heading = heading.ok_or_else(|| CaseError::table(format!("no column {column:?}")))?;
    let mut sums: Vec<(f64, f64)> = Vec::new();
    for (step, value) in rows.points("step", heading)? {
        match sums.last_mut() {
            Some((last, sum)) if *last == step => *sum += value,
            _ => sums.push((step, value)),
        }
    }
    Ok(sums.into_iter().map(|(_, sum)| sum).collect())
}

/// That runs were steady; none if there were none. `engine` made them.
pub fn steadiness(engine: &str, runs: &[Settled]) -> Option<Claim> {
    let worst = runs.iter().map(|run| run.left / run.tolerance).reduce(f64::max)?;
    Some(Claim {
        what: format!(
            "{engine}: steady runs: what was still to go, over the tolerance of the criterion, at most"
        ),
        measured: worst,
        allowed: 0.0..=1.0,
        why: "the criterion allows no more, or there is no result; here the rows of the record are asked, all of them. \
              How good the estimate is: tests/suite/steady.rs",
    })
}

/// That the steady rows of a study had little left to go.
pub(super) fn of_study(study: &Table) -> Result<Claim, CaseError> {
    let left = study.with(&[("outcome", "steady")])?.numbers("left")?;
    Ok(Claim {
        what: "study: steady rows: what was still to go, relative, at most".to_owned(),
        measured: left.into_iter().reduce(f64::max).unwrap_or(f64::NAN),
        allowed: 0.0..=2e-3,
        why: "a tenth of what most claims about the study allow, a fifth of the narrowest, 1 %; not less, since in fast flow \
              at small viscosity full cells gather mass (reference/ERRATA.md) and it creeps on for ever",
    })
}
