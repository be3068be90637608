//! Values that may change in time: from what a scene says to a function of time in lattice units.

use std::path::Path;

use nalgebra::SVector;
use psmrt_reference::lattice::Vec3;

use super::numbers::{finite, needed, positive};
use super::signal_file::{self, Subject};
use super::{Attachment, Trouble};
use crate::in_time::Signal;
use crate::scene::format_time::{NumberInTime, NumberSignal, VectorInTime, VectorSignal};
use crate::units::Units;

/// A sine of fewer time steps is none.
const SHORTEST_PERIOD: f64 = 4.0;

/// Where files of values lie, and what has been read of them.
#[derive(Debug)]
pub(super) struct Files<'a> {
    /// The folder of the scene.
    pub folder: &'a Path,
    /// What a run keeps copies of.
    pub attachments: Vec<Attachment>,
}

/// What a scene says of a value that changes, whatever it is.
struct Given<'a, const N: usize> {
    table: Option<Vec<(f64, SVector<f64, N>)>>,
    file: Option<&'a str>,
    from: Option<SVector<f64, N>>,
    to: Option<SVector<f64, N>>,
    start: Option<f64>,
    end: Option<f64>,
    mean: Option<SVector<f64, N>>,
    amplitude: Option<SVector<f64, N>>,
    period: Option<f64>,
    phase: Option<f64>,
}

/// A pressure or another number in lattice units; `convert` checks each SI value and turns it into lattice units, and is a
/// straight line.
pub(super) fn number(
    subject: Subject<1>,
    value: &NumberInTime,
    units: &Units,
    files: &mut Files,
    convert: impl Fn(f64) -> Result<f64, Trouble>,
) -> Result<Signal<f64>, Trouble> {
    match value {
        NumberInTime::Constant(si_value) => Ok(Signal::Constant(convert(*si_value)?)),
        NumberInTime::Changing(section) => {
            let si_signal = si_signal(subject, &of_number(section), units, files)?;
            converted(subject.key, &si_signal, units, |si_value| convert(si_value.x))
        }
    }
}

/// A vector in lattice units; `convert` as for [`number`].
pub(super) fn vector(
    subject: Subject<3>,
    value: &VectorInTime,
    units: &Units,
    files: &mut Files,
    convert: impl Fn([f64; 3]) -> Result<Vec3, Trouble>,
) -> Result<Signal<Vec3>, Trouble> {
    match value {
        VectorInTime::Constant(si_value) => Ok(Signal::Constant(convert(*si_value)?)),
        VectorInTime::Changing(section) => {
            let si_signal = si_signal(subject, &of_vector(section), units, files)?;
            converted(subject.key, &si_signal, units, |si_value| convert((*si_value).into()))
        }
    }
}

fn of_number(section: &NumberSignal) -> Given<'_, 1> {
    let NumberSignal { table, file, from, to, start, end, mean, amplitude, period, phase } =
        section;
    let of = |value: &Option<f64>| value.map(|value| SVector::from([value]));
    let row = |&[time, value]: &[f64; 2]| (time, SVector::from([value]));
    Given {
        table: table.as_ref().map(|rows| rows.iter().map(row).collect()),
        file: file.as_deref(),
        from: of(from),
        to: of(to),
        start: *start,
        end: *end,
        mean: of(mean),
        amplitude: of(amplitude),
        period: *period,
        phase: *phase,
    }
}

fn of_vector(section: &VectorSignal) -> Given<'_, 3> {
    let VectorSignal { table, file, from, to, start, end, mean, amplitude, period, phase } =
        section;
    let row = |&[time, x, y, z]: &[f64; 4]| (time, SVector::from([x, y, z]));
    Given {
        table: table.as_ref().map(|rows| rows.iter().map(row).collect()),
        file: file.as_deref(),
        from: from.map(SVector::from),
        to: to.map(SVector::from),
        start: *start,
        end: *end,
        mean: mean.map(SVector::from),
        amplitude: amplitude.map(SVector::from),
        period: *period,
        phase: *phase,
    }
}

/// The function of time in SI units.
fn si_signal<const N: usize>(
    subject: Subject<N>,
    given: &Given<N>,
    units: &Units,
    files: &mut Files,
) -> Result<Signal<SVector<f64, N>>, Trouble> {
    let at = |key: &str| format!("{}.{key}", subject.key);
    let Given { table, file, from, to, start, end, mean, amplitude, period, phase } = given;
    let first = |keys: [(&'static str, bool); 4]| {
        keys.into_iter().find(|(_, is_there)| *is_there).map(|(key, _)| key)
    };
    let ramp = [
        ("from", from.is_some()),
        ("to", to.is_some()),
        ("start", start.is_some()),
        ("end", end.is_some()),
    ];
    let sine = [
        ("amplitude", amplitude.is_some()),
        ("mean", mean.is_some()),
        ("period", period.is_some()),
        ("phase", phase.is_some()),
    ];
    let forms = [
        ("a table", table.as_ref().map(|_| "table")),
        ("a table from a file", file.map(|_| "file")),
        ("a ramp", first(ramp)),
        ("a sine", first(sine)),
    ];
    let mut chosen = forms.iter().filter_map(|(form, key)| Some((form, (*key)?)));
    let Some((form, _)) = chosen.next() else {
        let problem = "it says nothing of how the value changes";
        let remedy = "give a `table`, a `file`, a ramp (`from`, `to`, `end`) or a sine (`amplitude`, `period`)";
        return Err(Trouble::new(subject.key, problem, remedy));
    };
    if let Some((other, key)) = chosen.next() {
        let problem = format!("it belongs to {other}, and the value is {form} already");
        return Err(Trouble::new(at(key), problem, "keep the keys of one of them"));
    }
    if let Some(rows) = table {
        return rows_in_order(&at("table"), rows.clone(), |number| format!("row {number}"));
    }
    if let Some(file) = file {
        let (bytes, rows) = signal_file::read(&at("file"), &files.folder.join(file), subject)?;
        let lines: Vec<usize> = rows.iter().map(|(line, ..)| *line).collect();
        let rows = rows.into_iter().map(|(_, time, value)| (time, value)).collect();
        let signal = rows_in_order(&at("file"), rows, |number| format!("line {}", lines[number]))?;
        files.attachments.push(Attachment::of_values(&at("file"), bytes));
        return Ok(signal);
    }
    if *form == "a ramp" { ramp_of(subject.key, given) } else { sine_of(subject.key, given, units) }
}

/// The value of a key that `of` needs.
fn part<T>(key: &str, name: &str, value: Option<T>, of: &str) -> Result<T, Trouble> {
    let key = format!("{key}.{name}");
    needed(&key, value, &format!("{of} needs it"), &format!("add `{name}`"))
}

fn ramp_of<const N: usize>(
    key: &str,
    given: &Given<N>,
) -> Result<Signal<SVector<f64, N>>, Trouble> {
    let (from, to) =
        (part(key, "from", given.from, "a ramp")?, part(key, "to", given.to, "a ramp")?);
    let (start, end) = (given.start.unwrap_or(0.0), part(key, "end", given.end, "a ramp")?);
    finite(&format!("{key}.start"), &[start], "s")?;
    finite(&format!("{key}.end"), &[end], "s")?;
    if end < start {
        let problem = format!("it is before the ramp begins, at {start:e} s");
        let remedy = "give a later `end`, or an earlier `start`";
        return Err(Trouble::new(format!("{key}.end"), problem, remedy));
    }
    Ok(Signal::Table(vec![(start, from), (end, to)]))
}

fn sine_of<const N: usize>(
    key: &str,
    given: &Given<N>,
    units: &Units,
) -> Result<Signal<SVector<f64, N>>, Trouble> {
    let amplitude = part(key, "amplitude", given.amplitude, "a sine")?;
    let period = part(key, "period", given.period, "a sine")?;
    let (mean, phase) = (given.mean.unwrap_or_else(SVector::zeros), given.phase.unwrap_or(0.0));
    positive(&format!("{key}.period"), period, "s")?;
    finite(&format!("{key}.phase"), &[phase], "radians")?;
    if period < SHORTEST_PERIOD * units.si_dt {
        let problem = format!(
            "it is {:.2} time steps of {:.3e} s; at least {SHORTEST_PERIOD} are needed, 50 or more are good",
            period / units.si_dt,
            units.si_dt
        );
        let si_dt = period / 50.0;
        let remedy =
            format!("shorten the time step (`time.dt = {si_dt:.3e}`), or give a longer period");
        return Err(Trouble::new(format!("{key}.period"), problem, remedy));
    }
    Ok(Signal::Sine { mean, amplitude, period, phase })
}

/// A table, if it is one: rows in the order of time. `name` says which row it is.
fn rows_in_order<const N: usize>(
    key: &str,
    rows: Vec<(f64, SVector<f64, N>)>,
    name: impl Fn(usize) -> String,
) -> Result<Signal<SVector<f64, N>>, Trouble> {
    let trouble = |problem: String, remedy: &str| Err(Trouble::new(key, problem, remedy));
    if rows.is_empty() {
        return trouble("it has no rows".to_owned(), "give at least one row: time and value");
    }
    for (number, (time, _)) in rows.iter().enumerate() {
        if !time.is_finite() {
            return trouble(
                format!("{}: its time must be finite", name(number)),
                "give a time in s",
            );
        }
        let before = |steps: usize| number.checked_sub(steps).map(|number| rows[number].0);
        if let Some(last) = before(1).filter(|last| last > time) {
            let problem = format!(
                "{}: time {time:e} s is before that of the row above, {last:e} s",
                name(number)
            );
            return trouble(problem, "sort the rows by time");
        }
        if before(2) == Some(*time) {
            let problem = format!("{}: it is the third row of the time {time:e} s", name(number));
            return trouble(problem, "keep two: the value jumps from the first to the second");
        }
    }
    Ok(Signal::Table(rows))
}

/// The function in lattice units and steps.
fn converted<const N: usize, T>(
    key: &str,
    si_signal: &Signal<SVector<f64, N>>,
    units: &Units,
    convert: impl Fn(&SVector<f64, N>) -> Result<T, Trouble>,
) -> Result<Signal<T>, Trouble>
where
    T: Copy + std::ops::Sub<Output = T>,
{
    match si_signal {
        Signal::Constant(value) => Ok(Signal::Constant(convert(value)?)),
        Signal::Table(rows) => {
            let row = |(si_time, value): &(f64, SVector<f64, N>)| {
                let value = convert(value).map_err(|trouble| {
                    let problem = format!("at {si_time:e} s {}", trouble.problem);
                    Trouble { problem, ..trouble }
                })?;
                Ok((si_time / units.si_dt, value))
            };
            Ok(Signal::Table(rows.iter().map(row).collect::<Result<_, Trouble>>()?))
        }
        Signal::Sine { mean, amplitude, period, phase } => {
            let of_peak = |trouble: Trouble| Trouble {
                key: key.to_owned(),
                problem: format!("at its peak {}", trouble.problem),
                ..trouble
            };
            let highest = convert(&(mean + amplitude)).map_err(of_peak)?;
            convert(&(mean - amplitude)).map_err(of_peak)?;
            let mean = convert(mean)?;
            let amplitude = highest - mean;
            Ok(Signal::Sine { mean, amplitude, period: period / units.si_dt, phase: *phase })
        }
    }
}
