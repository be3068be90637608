//! How steady a run was when it was taken for steady: part of every verdict. The criterion compares parts of the
//! time (`run/steady.rs`); here the last rows are asked, so that one checks the other.

use super::bench::Finished;
use super::{CaseError, Claim, Table};

/// A run that its criterion has ended, and what the last rows of its record say.
#[derive(Clone, Debug, PartialEq)]
pub struct Settled {
    /// The scene and its changes.
    pub run: String,
    /// Steps made.
    pub steps: u64,
    /// What the criterion allows: relative distance from the final value.
    pub tolerance: f64,
    /// Relative change over the last window, from one row to the next.
    pub change: f64,
    /// What is still to go, relative: the sum of as many changes again as there are rows, if they go on falling
    /// at their last ratio, or stay as they are where they go one way and do not fall. Where they go to and
    /// fro, how far the last rows lie from the last one.
    pub left: f64,
}

impl Settled {
    /// Reads the last rows of the record that has ended the run.
    pub(super) fn of(run: String, finished: &Finished) -> Result<Self, CaseError> {
        let scene = &finished.scene;
        let Some(steady) = &scene.stop.steady else {
            return Err(CaseError::Table(format!("{run}: the scene has no `stop.steady`")));
        };
        let values = values(
            &finished.record(&scene.records[steady.record].name)?,
            steady.column_name(&scene.records),
        )?;
        let Some((change, left)) = drift(&values) else {
            return Err(CaseError::Table(format!("{run}: too few rows to be steady")));
        };
        let (steps, tolerance) = (finished.engine.steps(), steady.tolerance);
        Ok(Settled { run, steps, tolerance, change, left })
    }
}

/// The last values, which tell a flow that creeps from one that swings, or
/// from rounding: chance gives three changes of one sign once in four times.
const WINDOW: usize = 4;

/// Change over the last window, and what is still to go; `None` of fewer than three values.
pub(super) fn drift(values: &[f64]) -> Option<(f64, f64)> {
    let &[.., before, last, now] = values else { return None };
    let change = ((now - last) / now).abs();
    let ratio = (now - last) / (last - before);
    let window = &values[values.len().saturating_sub(WINDOW)..];
    let one_way = window.windows(2).all(|pair| (pair[1] - pair[0]) * (now - last) > 0.0);
    let rows = i32::try_from(values.len()).unwrap_or(i32::MAX);
    let left = if ratio > 0.0 && ratio < 1.0 {
        // c (r + r² + ... + rⁿ)
        change * ratio * (1.0 - ratio.powi(rows)) / (1.0 - ratio)
    } else if one_way {
        change * f64::from(rows)
    } else {
        window.iter().map(|value| ((now - value) / now).abs()).fold(0.0, f64::max)
    };
    Some((change, left))
}

/// The values of a column, time by time, summed over the rows (grains) of each.
fn values(rows: &Table, column: &str) -> Result<Vec<f64>, CaseError> {
    let heading = rows.columns.iter().find(|name| name.split(' ').next() == Some(column));
    let heading = heading.ok_or_else(|| CaseError::Table(format!("no column {column:?}")))?;
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
        allowed: 0.0..=10.0,
        why: "the criterion has found less than the tolerance to go, from parts of the time; here the ratio of the \
              last changes is asked as well, and changes that do not fall are taken to go on for as long as the run \
              has. Ten times the tolerance is below what each case allows for other reasons",
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

#[cfg(test)]
mod tests {
    use super::{Settled, drift, steadiness};

    /// A run whose value approaches 1 by the factor `ratio` from row to row, taken at the first row that
    /// changes by less than `tolerance`.
    fn approach(ratio: f64, tolerance: f64) -> (Settled, f64) {
        let mut values = vec![0.0, 1.0 - ratio];
        while (values[values.len() - 1] / values[values.len() - 2] - 1.0).abs() > tolerance {
            let away = 1.0 - values[values.len() - 1];
            values.push(1.0 - ratio * away);
        }
        let (change, left) = drift(&values).unwrap();
        let run = Settled { run: String::new(), steps: 0, tolerance, change, left };
        (run, 1.0 - values[values.len() - 1])
    }

    #[test]
    fn what_is_left_to_go_is_what_a_geometric_approach_has_left() {
        for ratio in [0.3, 0.9, 0.99] {
            let (run, left) = approach(ratio, 1e-4);
            // Relative to the last value instead of the limit, 1: another 1 % at most.
            assert!((run.left / left - 1.0).abs() < 0.02, "{ratio}: {} {left}", run.left);
        }
    }

    #[test]
    fn a_flow_that_creeps_on_without_slowing_down_is_judged_by_what_its_time_adds() {
        for growth in [1.0_f64, 1.1] {
            let mut values = vec![1.0];
            for i in 0..6 {
                values.push(values[i] + 1e-5 * growth.powi(i32::try_from(i).unwrap()));
            }
            let (change, left) = drift(&values).unwrap();
            assert!((left / (7.0 * change) - 1.0).abs() < 1e-12, "{growth}");
        }
        // From rest at a constant rate: a row changes it by 1e-4 after 10,000 of them, and all is still to come.
        let values: Vec<f64> = (0..=10_000).map(f64::from).collect();
        let (change, left) = drift(&values).unwrap();
        assert!(change <= 1e-4 && left > 0.99);
    }

    #[test]
    fn a_value_that_swings_is_as_unsteady_as_its_last_rows_lie_apart() {
        // To and fro, and the last two changes go one way and grow.
        let values = [1.0, 1.001, 0.998, 0.999, 1.0005];
        let (_, left) = drift(&values).unwrap();
        assert!((left - 0.0025 / 1.0005).abs() < 1e-12, "{left}");
    }

    #[test]
    fn a_flow_that_creeps_fails_the_claim() {
        let (quick, creeping) = (approach(0.5, 1e-4).0, approach(0.99, 1e-4).0);
        assert!(steadiness("reference", std::slice::from_ref(&quick)).unwrap().holds());
        assert!(!steadiness("reference", &[quick, creeping]).unwrap().holds());
        assert!(steadiness("reference", &[]).is_none());
    }
}
