//! When a run ends.

use super::Trouble;
use super::numbers::{count, steps};
use super::record_kinds::What;
use super::records::{OutputInterval, Record};
use crate::scene::columns::{
    BOX_COLUMNS, CONTACT_MEAN_COLUMNS, Column, FORCE_COLUMNS, GRAIN_MEAN_COLUMNS,
    PERMEABILITY_COLUMNS,
};
use crate::scene::format_run::{SteadySection, StopSection};
use crate::units::Units;

/// When a run ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// After this many steps at the latest.
    pub steps: u64,
    /// Sooner, if this is met.
    pub steady: Option<Steady>,
}

/// A steady-state criterion: what a column has still to go is estimated to be less than `tolerance`.
#[derive(Clone, Debug, PartialEq)]
pub struct Steady {
    /// Number of the record, of kind [`What::Box`], [`What::GrainMeans`], [`What::ContactMeans`], [`What::Loads`] or
    /// [`What::Permeability`].
    pub record: usize,
    /// Number of the column in [`BOX_COLUMNS`], [`GRAIN_MEAN_COLUMNS`], [`PERMEABILITY_COLUMNS`] or, summed over all grains,
    /// [`FORCE_COLUMNS`].
    pub column: usize,
    /// Largest distance from the final value, relative.
    pub tolerance: f64,
}

/// The end of a run.
pub(super) fn stop(
    section: &StopSection,
    records: &[Record],
    units: &Units,
) -> Result<Stop, Trouble> {
    let by_time =
        section.time.map(|si_time| steps("stop.time", si_time, units.si_dt)).transpose()?;
    let by_steps = section.steps.map(|value| count("stop.steps", value)).transpose()?;
    let limit = match (by_time, by_steps) {
        (Some(a), Some(b)) => a.min(b),
        (Some(limit), None) | (None, Some(limit)) => limit,
        (None, None) => {
            let problem = "nothing limits the run; a steady-state criterion may never be met";
            let remedy = "add `time` (s) or `steps`, as the longest that the run may take";
            return Err(Trouble::new("stop", problem, remedy));
        }
    };
    let steady = section.steady.as_ref().map(|section| steady(section, records)).transpose()?;
    Ok(Stop { steps: limit, steady })
}

fn steady(section: &SteadySection, records: &[Record]) -> Result<Steady, Trouble> {
    let SteadySection { record: name, column, tolerance } = section;
    let named = records.iter().position(|record| record.name == *name);
    let Some(record) = named.filter(|&number| can_be_steady(&records[number])) else {
        let (problem, remedy) = unfit(named.map(|number| &records[number]), records);
        return Err(Trouble::new("stop.steady.record", problem, remedy));
    };
    let columns = columns(&records[record]).unwrap_or_default();
    let Some(number) = columns.iter().position(|known| known.name == column) else {
        let known: Vec<_> = columns.iter().map(|column| column.name).collect();
        let problem = "that record has no such column";
        return Err(Trouble::new(
            "stop.steady.column",
            problem,
            format!("its columns are: {}", known.join(", ")),
        ));
    };
    if !(*tolerance > 0.0 && *tolerance < 1.0) {
        let problem = "it must lie between 0 and 1 (exclusive)";
        return Err(Trouble::new("stop.steady.tolerance", problem, "1e-6 is usual"));
    }
    Ok(Steady { record, column: number, tolerance: *tolerance })
}

fn can_be_steady(record: &Record) -> bool {
    columns(record).is_some() && matches!(record.interval, OutputInterval::Every(_))
}

/// Why the record that is named cannot become steady, and what to do.
fn unfit(named: Option<&Record>, records: &[Record]) -> (String, String) {
    let fit: Vec<_> = records.iter().filter(|r| can_be_steady(r)).map(|r| &r.name).collect();
    let others = match fit.is_empty() {
        true => {
            "add one of kind `box`, `grain_means`, `contact_means`, `loads` or `permeability` with `every_steps = 100`, say"
        }
        false => &format!("those that can become steady are: {fit:?}"),
    };
    let (problem, remedy) = match named {
        None => ("there is no record of that name", others),
        Some(record) if columns(record).is_none() => (
            "that record is not of kind `box`, `grain_means`, `contact_means`, `loads` or `permeability`",
            others,
        ),
        Some(_) => (
            "that record is taken only once, at the end: steady is what no longer changes from row \
             to row",
            "add `every_steps = 100`, say, or `every` (s) to that record",
        ),
    };
    (problem.to_owned(), remedy.to_owned())
}

impl Steady {
    /// The column, in a scene whose records are `records`.
    pub fn column(&self, records: &[Record]) -> Column {
        columns(&records[self.record]).map_or(Column::new("", ""), |columns| columns[self.column])
    }

    /// Its name.
    pub fn column_name(&self, records: &[Record]) -> &'static str {
        self.column(records).name
    }
}

/// The columns of a record that can become steady.
fn columns(record: &Record) -> Option<&'static [Column]> {
    match record.what {
        What::Box => Some(&BOX_COLUMNS),
        What::GrainMeans => Some(&GRAIN_MEAN_COLUMNS),
        What::Loads => Some(&FORCE_COLUMNS),
        What::ContactMeans => Some(&CONTACT_MEAN_COLUMNS),
        What::Permeability { .. } => Some(&PERMEABILITY_COLUMNS),
        What::Profile { .. }
        | What::Layers { .. }
        | What::Walls
        | What::Fields { .. }
        | What::Slice { .. }
        | What::Grains
        | What::Contacts => None,
    }
}
