//! Grains from a CSV file.

use std::path::Path;

use super::Trouble;
use super::foreign_lists::as_list;
pub use super::list_header::{COLUMNS, MOTION_COLUMNS};
use super::list_header::{ListColumn, columns, wanted};
use super::list_text::{Fault, as_decimal_comma, as_fortran, cells, decoded, numbered_lines};
use super::listed::Ball;
use crate::input;
use crate::quote::{self, quoted};

/// Bytes that a list may have: some ten million grains.
const LARGEST: u64 = 1024 * input::MIB;

/// The contents of a file and the grains in it.
pub(super) fn read(key: &str, path: &Path) -> Result<(Vec<u8>, Vec<Ball>), Trouble> {
    let shown = quote::path(path);
    let bytes = input::read(path, LARGEST).map_err(|error| {
        let remedy = "give the name of a list of grains (CSV), relative to the scene file";
        Trouble::new(key, format!("{shown}: {error}"), remedy)
    })?;
    let of_file =
        |(problem, remedy): Fault| Trouble::new(key, format!("{shown}: {problem}"), remedy);
    let text = decoded(&bytes).and_then(as_list).map_err(of_file)?;
    let balls = balls(&text).map_err(|(line, (problem, remedy))| {
        Trouble::new(key, format!("{shown}, line {line}: {problem}"), remedy)
    })?;
    Ok((bytes, balls))
}

/// The grains of a list, or the line that is wrong.
fn balls(text: &str) -> Result<Vec<Ball>, (usize, Fault)> {
    let is_comment = |line: &str| line.trim_start().starts_with('#');
    let mut lines =
        numbered_lines(text).filter(|(_, line)| !line.trim().is_empty() && !is_comment(line));
    let Some((first, header)) = lines.next() else {
        let remedy = format!("let it begin with {}; each further line is a grain", wanted());
        return Err((1, ("there is nothing in it".to_owned(), remedy)));
    };
    let columns = columns(header).map_err(|(problem, remedy)| {
        // numpy.savetxt writes the header as a comment.
        let commented = numbered_lines(text).take(first).any(|(_, line)| {
            is_comment(line) && columns(line.trim_start().trim_start_matches('#')).is_ok()
        });
        let remedy = match commented {
            true => "take the # off the line with the names (numpy.savetxt: comments=\"\")".into(),
            false => remedy,
        };
        (first, (problem, remedy))
    })?;
    let balls: Vec<Ball> = lines
        .map(|(line, row)| ball(row, &columns, line).map_err(|fault| (line, fault)))
        .collect::<Result<_, _>>()?;
    if balls.is_empty() {
        let last = numbered_lines(text).count();
        return Err((last, ("there are no grains in it".into(), "add a line for each".into())));
    }
    Ok(balls)
}

fn ball(row: &str, columns: &[ListColumn], line: usize) -> Result<Ball, Fault> {
    let cells = cells(row);
    if cells.iter().all(|cell| cell.is_empty()) {
        let problem = "there are only commas in it: an empty row of a spreadsheet";
        return Err((problem.to_owned(), "remove the line".to_owned()));
    }
    if cells.len() != columns.len() {
        let (found, needed) = (cells.len(), columns.len());
        let problem = format!("it has {found} values, the first line names {needed} columns");
        let remedy = match found {
            found if found == 2 * needed => {
                "write decimals with points (0.5, not 0,5), and commas between values only"
            }
            found if found > needed => "remove what is too much, commas at the end too",
            _ if row.contains(';') => "separate values by commas, not by semicolons",
            _ => "each line has a value for each column, separated by commas",
        };
        return Err((problem, remedy.to_owned()));
    }
    let mut ball = Ball { line: Some(line), ..Ball::of([0.0; 3], 0.0) };
    for (column, cell) in columns.iter().zip(cells) {
        let value = number(*column, cell)?;
        match *column {
            ListColumn::Place(axis) => ball.si_centre[axis] = value,
            ListColumn::Diameter => ball.si_diameter = value,
            ListColumn::Radius => ball.si_diameter = 2.0 * value,
            ListColumn::Density => ball.si_density = Some(value),
            ListColumn::Velocity(axis) => {
                ball.si_velocity.get_or_insert_default()[axis] = value;
            }
            ListColumn::Spin(axis) => ball.si_spin.get_or_insert_default()[axis] = value,
        }
    }
    Ok(ball)
}

fn number(column: ListColumn, cell: &str) -> Result<f64, Fault> {
    let is_size = matches!(column, ListColumn::Diameter | ListColumn::Radius | ListColumn::Density);
    match cell.parse::<f64>() {
        Ok(value) if value.is_finite() && (!is_size || value > 0.0) => return Ok(value),
        _ => {}
    }
    let name = match column {
        ListColumn::Place(axis) => COLUMNS[axis],
        ListColumn::Diameter => COLUMNS[3],
        ListColumn::Radius => "radius (m)",
        ListColumn::Density => COLUMNS[4],
        ListColumn::Velocity(axis) => MOTION_COLUMNS[axis],
        ListColumn::Spin(axis) => MOTION_COLUMNS[3 + axis],
    };
    let problem = format!("{name} = {} is not allowed", quoted(cell));
    let remedy = if let Some(number) = as_fortran(cell) {
        format!("write Fortran's D as E: {number}; sed '2,$ s/[dD]/E/g' old.csv > new.csv")
    } else if let Some(number) = as_decimal_comma(cell) {
        format!("write decimals with points: {number}")
    } else {
        "give finite numbers in SI units, and sizes and densities above 0".to_owned()
    };
    Err((problem, remedy))
}
