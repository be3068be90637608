//! How often the state of a run is saved.

use std::time::Duration;

use super::Trouble;
use super::numbers::count;
use crate::scene::format_run::CheckpointSection;

/// How often the state of a run is saved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Interval {
    /// Each time that this many steps have been made.
    Steps(u64),
    /// After so much computing.
    Time(Duration),
}

/// Where a scene says nothing.
const DEFAULT: Interval = Interval::Time(Duration::from_secs(600));

pub(super) fn interval(section: Option<&CheckpointSection>) -> Result<Interval, Trouble> {
    let Some(section) = section else { return Ok(DEFAULT) };
    match (section.every_steps, section.every_minutes) {
        (None, None) => Ok(DEFAULT),
        (Some(steps), None) => Ok(Interval::Steps(count("checkpoint.every_steps", steps)?)),
        (None, Some(minutes)) if minutes > 0.0 && minutes <= 1e6 => {
            Ok(Interval::Time(Duration::from_secs_f64(60.0 * minutes)))
        }
        (None, Some(_)) => {
            let problem = "it must be above 0 and at most 1e6 minutes";
            Err(Trouble::new("checkpoint.every_minutes", problem, "10 is usual"))
        }
        (Some(_), Some(_)) => {
            let problem = "the section has both `every_steps` and `every_minutes`";
            Err(Trouble::new("checkpoint.every_minutes", problem, "give one of them"))
        }
    }
}
