//! Grains from a file: a table of our own (CSV), one whose columns the scene names, or what another program wrote.

use std::borrow::Cow;
use std::path::Path;

use super::foreign_lists::as_list;
pub use super::list_header::{COLUMNS, MOTION_COLUMNS};
use super::list_header::{Layout, ListColumn, ReadColumn, wanted};
use super::list_text::{
    Fault, as_decimal_comma, as_fortran, cells_between, decoded, numbered_lines,
};
use super::listed::Ball;
use super::{Trouble, mapped_columns, vtk_file, vtk_list};
use crate::input;
use crate::quote::{self, quoted};
use crate::scene::format_lists::{ColumnsSection, DelimiterName};

/// Bytes that a list may have: some ten million grains.
const LARGEST: u64 = 1024 * input::MIB;

/// The contents of a file and the grains in it. `at` gives the full name of a key of the section that names it; `mapping` says
/// which column of it is what.
pub(super) fn read(
    at: &dyn Fn(&str) -> String,
    path: &Path,
    mapping: Option<&ColumnsSection>,
) -> Result<(Vec<u8>, Vec<Ball>), Trouble> {
    let key = at("file");
    let at_columns = |key: &str| at(&format!("columns.{key}"));
    mapping.map_or(Ok(()), |section| mapped_columns::check(section, &at_columns))?;
    let shown = quote::path(path);
    let bytes = input::read(path, LARGEST).map_err(|error| {
        let remedy = "give the name of a list of grains (CSV), relative to the scene file";
        Trouble::new(&key, format!("{shown}: {error}"), remedy)
    })?;
    let of_file =
        |(problem, remedy): Fault| Trouble::new(&key, format!("{shown}: {problem}"), remedy);
    let names_its_own = || {
        let problem = format!("{shown}: the file says itself what its numbers are");
        Err(Trouble::new(at("columns"), problem, "remove `columns`: it is for tables"))
    };
    if vtk_file::is_vtk(&bytes) {
        if mapping.is_some() {
            return names_its_own();
        }
        let balls = vtk_list::balls(&bytes).map_err(of_file)?;
        return Ok((bytes, balls));
    }
    let text = decoded(&bytes).and_then(as_list).map_err(of_file)?;
    if mapping.is_some() && matches!(text, Cow::Owned(_)) {
        return names_its_own();
    }
    let on_line = |line: usize, (problem, remedy): Fault| {
        Trouble::new(&key, format!("{shown}, line {line}: {problem}"), remedy)
    };
    let layout = |line: usize, names: &str| match mapping {
        None => Layout::own(names).map_err(|fault| on_line(line, hinted(fault, &text, line))),
        Some(section) => {
            let names = cells_between(names, section.delimiter);
            let file_and_line = format!("{shown}, line {line}");
            mapped_columns::layout(section, &at_columns, &names, &file_and_line)
        }
    };
    let balls = balls(&text, layout, on_line)?;
    Ok((bytes, balls))
}

/// The fault of a first line; numpy.savetxt writes the one that is meant as a comment above it.
fn hinted((problem, remedy): Fault, text: &str, first: usize) -> Fault {
    let commented = numbered_lines(text).take(first).any(|(_, line)| {
        is_comment(line) && Layout::own(line.trim_start().trim_start_matches('#')).is_ok()
    });
    let remedy = match commented {
        true => "take the # off the line with the names (numpy.savetxt: comments=\"\")".into(),
        false => remedy,
    };
    (problem, remedy)
}

fn is_comment(line: &str) -> bool {
    line.trim_start().starts_with('#')
}

/// The grains of a list, or what is wrong with a line. `layout` reads the first.
fn balls(
    text: &str,
    layout: impl Fn(usize, &str) -> Result<Layout, Trouble>,
    on_line: impl Fn(usize, Fault) -> Trouble,
) -> Result<Vec<Ball>, Trouble> {
    let mut lines =
        numbered_lines(text).filter(|(_, line)| !line.trim().is_empty() && !is_comment(line));
    let Some((first, header)) = lines.next() else {
        let remedy = format!("let it begin with {}; each further line is a grain", wanted());
        return Err(on_line(1, ("there is nothing in it".to_owned(), remedy)));
    };
    let layout = layout(first, header)?;
    let balls: Vec<Ball> = lines
        .map(|(line, row)| ball(row, &layout, line).map_err(|fault| on_line(line, fault)))
        .collect::<Result<_, _>>()?;
    if balls.is_empty() {
        let last = numbered_lines(text).count();
        let fault = ("there are no grains in it".into(), "add a line for each".into());
        return Err(on_line(last, fault));
    }
    Ok(balls)
}

fn ball(row: &str, layout: &Layout, line: usize) -> Result<Ball, Fault> {
    let cells = cells_between(row, layout.delimiter);
    let columns = &layout.columns;
    let separators = match layout.delimiter {
        DelimiterName::Comma => "commas",
        DelimiterName::Semicolon => "semicolons",
        DelimiterName::Tab => "tabulators",
        DelimiterName::Blanks => "blanks",
    };
    if cells.iter().all(|cell| cell.is_empty()) {
        let problem = format!("there are only {separators} in it: an empty row of a spreadsheet");
        return Err((problem, "remove the line".to_owned()));
    }
    if cells.len() != columns.len() {
        let (found, needed) = (cells.len(), columns.len());
        let problem = format!("it has {found} values, the first line names {needed} columns");
        let remedy = match found {
            found if found == 2 * needed => {
                format!(
                    "write decimals with points (0.5, not 0,5), and {separators} between values only"
                )
            }
            found if found > needed => {
                format!("remove what is too much, {separators} at the end too")
            }
            _ if row.contains(';') && layout.delimiter == DelimiterName::Comma => {
                "separate values by commas, not by semicolons".to_owned()
            }
            _ => format!("each line has a value for each column, separated by {separators}"),
        };
        return Err((problem, remedy));
    }
    let mut ball = Ball { line: Some(line), ..Ball::of([0.0; 3], 0.0) };
    for (column, cell) in columns.iter().zip(cells) {
        let Some(column) = column else { continue };
        let value = number(column, cell)? * column.si_unit;
        match column.what {
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

fn number(column: &ReadColumn, cell: &str) -> Result<f64, Fault> {
    let is_size =
        matches!(column.what, ListColumn::Diameter | ListColumn::Radius | ListColumn::Density);
    match cell.parse::<f64>() {
        Ok(value) if value.is_finite() && (!is_size || value > 0.0) => return Ok(value),
        _ => {}
    }
    let problem = format!("{} = {} is not allowed", quote::shown(&column.name), quoted(cell));
    let remedy = if let Some(number) = as_fortran(cell) {
        format!("write Fortran's D as E: {number}; sed '2,$ s/[dD]/E/g' old.csv > new.csv")
    } else if let Some(number) = as_decimal_comma(cell) {
        format!("write decimals with points: {number}")
    } else if column.what.title() == column.name {
        "give finite numbers in SI units, and sizes and densities above 0".to_owned()
    } else {
        "give finite numbers, and sizes and densities above 0".to_owned()
    };
    Err((problem, remedy))
}
