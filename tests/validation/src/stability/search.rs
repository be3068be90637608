//! Goes along lines: all values, or only those that find where it ceases to be stable and to be right.

use super::record::RunLog;
use super::{Flow, Found, Lab, LabError, Outcome, Search};
use psmrt::engine::EngineName;

/// Maps a flow on an engine: makes the runs that its record lacks. `tell` is told of each.
pub fn map(
    flow: &Flow,
    engine: EngineName,
    lab: &Lab,
    record: &mut RunLog,
    tell: impl Fn(&str),
) -> Result<(), LabError> {
    for line in (flow.lines)(engine) {
        let mut run = |value: f64| -> Result<Outcome, LabError> {
            if let Some(known) = record.outcome(&line, value) {
                return Ok(known);
            }
            let found = (flow.run)(lab, &line, value).or_else(Found::of)?;
            tell(&record.add(&line, value, &found)?);
            Ok(found.outcome)
        };
        if let Some(value) = (flow.also)(&line) {
            run(value)?;
        }
        let mut outcome = |number: usize| run(flow.values[number]);
        match flow.search {
            Search::All => {
                for number in 0..flow.values.len() {
                    outcome(number)?;
                }
            }
            Search::Frontiers => {
                let count = flow.values.len();
                let lived = last(count, |number| Ok(outcome(number)?.lived()))?;
                last(lived, |number| Ok(outcome(number)? != Outcome::Wrong))?;
            }
        }
    }
    Ok(())
}

/// How many of the first `count` numbers hold, by halving: it is taken for granted that those that hold
/// come first.
fn last(
    count: usize,
    mut holds: impl FnMut(usize) -> Result<bool, LabError>,
) -> Result<usize, LabError> {
    // All below `good` hold, none from `bad` on.
    let (mut good, mut bad) = (0, count);
    while good < bad {
        let middle = (good + bad) / 2;
        if holds(middle)? {
            good = middle + 1;
        } else {
            bad = middle;
        }
    }
    Ok(good)
}
