//! What to record and how often.

use std::fmt;

use psmrt_reference::setup::Setup;

use super::Attachment;
use super::Trouble;
use super::free::FreePart;
use super::numbers::{absent, count, steps};
use super::record_kinds::{What, what};
use crate::scene::format_run::{AxisName, RecordKind, RecordSection};
use crate::scene::names::{self, Made, MadeBy};
use crate::units::Units;

/// A record of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Its name, and that of its file.
    pub name: String,
    /// What it holds.
    pub what: What,
    /// How often it is taken.
    pub interval: OutputInterval,
    /// The time between rows that the scene asks for, if it gives one, s.
    pub si_every: Option<f64>,
    /// Of loads: whether they are means over the time since the row before.
    pub averages: bool,
}

/// How often a record is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OutputInterval {
    /// At the start, and each time that this many steps have been made.
    Every(u64),
    /// Once, at the end.
    AtEnd,
}

impl OutputInterval {
    /// Whether a record is due after `step` steps, leaving the end aside.
    pub fn is_due(self, step: u64) -> bool {
        matches!(self, OutputInterval::Every(interval) if step.is_multiple_of(interval))
    }
}

impl fmt::Display for OutputInterval {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OutputInterval::Every(interval) => write!(out, "every {interval} steps"),
            OutputInterval::AtEnd => out.write_str("at the end"),
        }
    }
}

impl AxisName {
    /// 0, 1 or 2.
    pub fn index(self) -> usize {
        self as usize
    }
}

/// The records of a scene.
pub(super) fn records(
    sections: &[RecordSection],
    setup: &Setup,
    free: Option<&FreePart>,
    units: &Units,
) -> Result<Vec<Record>, Trouble> {
    let mut records: Vec<Record> = Vec::new();
    for (number, section) in sections.iter().enumerate() {
        let at = |key: &str| format!("records[{number}].{key}");
        check_name(&at("name"), &section.name)?;
        // Upper and lower case are the same to some file systems.
        let same = |other: &Record| other.name.eq_ignore_ascii_case(&section.name);
        if let Some(other) = records.iter().position(same) {
            let problem = format!(
                "records[{other}] has this name already (case does not count); each needs its own"
            );
            return Err(Trouble::new(at("name"), problem, "give it another name"));
        }
        let interval = match (section.every, section.every_steps) {
            (None, None) => OutputInterval::AtEnd,
            (Some(si_time), None) => {
                OutputInterval::Every(steps(&at("every"), si_time, units.si_dt)?)
            }
            (None, Some(every)) => OutputInterval::Every(count(&at("every_steps"), every)?),
            (Some(_), Some(_)) => {
                let problem = "the record has both `every` (s) and `every_steps`";
                return Err(Trouble::new(at("every_steps"), problem, "give one of them"));
            }
        };
        if section.kind != RecordKind::Loads || interval == OutputInterval::AtEnd {
            let belongs = "records of kind `loads` with `every` or `every_steps`";
            absent(&at("average"), section.average.as_ref(), belongs)?;
        }
        let what = what(section, &at, setup, free, units)?;
        records.push(Record {
            name: section.name.clone(),
            what,
            interval,
            si_every: section.every,
            averages: section.average == Some(true),
        });
    }
    Ok(records)
}

/// Errors if two of the files that a run makes would be the same.
pub(super) fn files_differ(
    records: &[Record],
    lists: &[Attachment],
    others: (bool, bool),
) -> Result<(), Trouble> {
    let made = names::all(records, lists, others);
    let Some([earlier, later]) = names::meeting(&made) else { return Ok(()) };
    let owner = |made: &Made| match made.by {
        MadeBy::Run => "every run makes one of that name".to_owned(),
        MadeBy::Comparison => "the comparison with the exact solution has that name".to_owned(),
        MadeBy::Copy(number) => format!("the copy of `{}` has that name", lists[number].key),
        MadeBy::Record(number) => format!("records[{number}] makes one of that name"),
    };
    let key = match later.by {
        MadeBy::Record(number) => format!("records[{number}].name"),
        _ => "records".to_owned(),
    };
    let problem =
        format!("it would make `{}` in the run's folder, but {}", later.name, owner(earlier));
    Err(Trouble::new(key, problem, "give the record another name"))
}

/// Names that Windows keeps for devices, whatever comes after a dot.
const DEVICES: [&str; 4] = ["con", "prn", "aux", "nul"];

fn check_name(key: &str, name: &str) -> Result<(), Trouble> {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if name.is_empty() || name.len() > 60 || !name.chars().all(plain) {
        let problem =
            "a name has 1 to 60 letters (a to z), digits, `-` and `_`: it becomes a file's";
        return Err(Trouble::new(key, problem, "for example \"box\" or \"profile_y\""));
    }
    let lower = name.to_ascii_lowercase();
    let numbered = ["com", "lpt"].iter().any(|port| {
        lower.strip_prefix(port).is_some_and(|n| n.len() == 1 && n.as_bytes()[0].is_ascii_digit())
    });
    if DEVICES.contains(&lower.as_str()) || numbered {
        let problem = "Windows keeps this name for a device: a file could not be called so there";
        return Err(Trouble::new(key, problem, format!("for example \"{name}_1\"")));
    }
    Ok(())
}
