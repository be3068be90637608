//! A file of values in time: CSV, a row each.

use std::path::Path;

use nalgebra::SVector;

use super::Trouble;
use super::list_text::{Fault, as_decimal_comma, as_fortran, cells, decoded, numbered_lines};
use crate::input;
use crate::quote::{self, quoted};

/// A key whose value may change: what it is called, the unit of its values, and the columns of a file of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Subject<'a, const N: usize> {
    /// The key.
    pub key: &'a str,
    /// The unit of its values.
    pub unit: &'a str,
    /// What they are called in a file.
    pub names: [&'a str; N],
}

impl<'a> Subject<'a, 3> {
    /// A vector.
    pub fn vector(key: &'a str, unit: &'a str) -> Self {
        Subject { key, unit, names: ["x", "y", "z"] }
    }
}

/// Bytes that such a file may have: some hundred thousand rows.
const LARGEST: u64 = 16 * input::MIB;

/// A row: its line in the file, the time, the value.
pub(super) type Row<const N: usize> = (usize, f64, SVector<f64, N>);

/// The contents of a file, and its rows.
pub(super) fn read<const N: usize>(
    key: &str,
    path: &Path,
    subject: Subject<N>,
) -> Result<(Vec<u8>, Vec<Row<N>>), Trouble> {
    let shown = quote::path(path);
    let bytes = input::read(path, LARGEST).map_err(|error| {
        let remedy =
            "give the name of a file of times and values (CSV), relative to the scene file";
        Trouble::new(key, format!("{shown}: {error}"), remedy)
    })?;
    let of_file =
        |(problem, remedy): Fault| Trouble::new(key, format!("{shown}: {problem}"), remedy);
    let rows =
        rows(decoded(&bytes).map_err(of_file)?, subject).map_err(|(line, (problem, remedy))| {
            Trouble::new(key, format!("{shown}, line {line}: {problem}"), remedy)
        })?;
    Ok((bytes, rows))
}

/// The rows of a text, or the line that is wrong.
fn rows<const N: usize>(text: &str, subject: Subject<N>) -> Result<Vec<Row<N>>, (usize, Fault)> {
    let is_left_out = |line: &str| line.trim().is_empty() || line.trim_start().starts_with('#');
    let mut lines = numbered_lines(text).filter(|(_, line)| !is_left_out(line));
    let mut columns = vec!["time (s)".to_owned()];
    columns.extend(subject.names.iter().map(|name| format!("{name} ({})", subject.unit)));
    let header = columns.join(",");
    let remedy =
        format!("let the first line be {header}; each further line is a time and its value");
    let Some((first, names)) = lines.next() else {
        return Err((1, ("there is nothing in it".to_owned(), remedy)));
    };
    if cells(names) != columns {
        return Err((
            first,
            (format!("it is {}, not the names of the columns", quoted(names)), remedy),
        ));
    }
    lines.map(|(line, text)| row(text, line, &header).map_err(|fault| (line, fault))).collect()
}

fn row<const N: usize>(text: &str, line: usize, header: &str) -> Result<Row<N>, Fault> {
    let cells = cells(text);
    if cells.len() != N + 1 {
        let problem =
            format!("it has {} values, the first line names {} columns", cells.len(), N + 1);
        let remedy =
            format!("give a value for each of {header}, separated by commas, decimals with points");
        return Err((problem, remedy));
    }
    let numbers: Vec<f64> = cells.into_iter().map(number).collect::<Result<_, _>>()?;
    Ok((line, numbers[0], SVector::from_fn(|i, _| numbers[i + 1])))
}

fn number(cell: &str) -> Result<f64, Fault> {
    if let Some(value) = cell.parse().ok().filter(|value: &f64| value.is_finite()) {
        return Ok(value);
    }
    let remedy = match as_fortran(cell).or_else(|| as_decimal_comma(cell)) {
        Some(written) => format!("write {written}"),
        None => "write a finite number, as 0.5 or 1e-3".to_owned(),
    };
    Err((format!("{} is no number", quoted(cell)), remedy))
}
