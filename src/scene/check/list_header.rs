//! The first line of a list of grains: which column is what, in which unit.

use super::list_text::{Fault, cells, is_number};
use crate::quote::quoted;
use crate::scene::format_lists::DelimiterName;

/// The first line of a list of grains; the last column may be absent.
pub const COLUMNS: [&str; 5] = ["x (m)", "y (m)", "z (m)", "diameter (m)", "density (kg/m3)"];

/// Columns that it may have besides, all three of a vector together: how a free grain moves at the start.
pub const MOTION_COLUMNS: [&str; 6] = [
    "velocity_x (m/s)",
    "velocity_y (m/s)",
    "velocity_z (m/s)",
    "spin_x (rad/s)",
    "spin_y (rad/s)",
    "spin_z (rad/s)",
];

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ListColumn {
    /// Place along an axis, m.
    Place(usize),
    Diameter,
    Radius,
    Density,
    /// Velocity along an axis, m/s.
    Velocity(usize),
    /// Angular velocity about an axis, rad/s.
    Spin(usize),
}

impl ListColumn {
    /// Its own name and unit.
    pub fn title(self) -> &'static str {
        match self {
            ListColumn::Place(axis) => COLUMNS[axis],
            ListColumn::Diameter => COLUMNS[3],
            ListColumn::Radius => "radius (m)",
            ListColumn::Density => COLUMNS[4],
            ListColumn::Velocity(axis) => MOTION_COLUMNS[axis],
            ListColumn::Spin(axis) => MOTION_COLUMNS[3 + axis],
        }
    }
}

/// A column that is read.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ReadColumn {
    pub what: ListColumn,
    /// How the file calls it.
    pub name: String,
    /// The unit of its numbers in SI.
    pub si_unit: f64,
}

/// Where a line has what; `None` for a column that is left out.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Layout {
    pub columns: Vec<Option<ReadColumn>>,
    pub delimiter: DelimiterName,
}

impl Layout {
    /// That of a list of our own, by its first line.
    pub fn own(line: &str) -> Result<Self, Fault> {
        let read = |what: ListColumn| {
            Some(ReadColumn { what, name: what.title().to_owned(), si_unit: 1.0 })
        };
        let columns = columns(line)?.into_iter().map(read).collect();
        Ok(Layout { columns, delimiter: DelimiterName::Comma })
    }
}

/// The first line as it should be.
pub(super) fn wanted() -> String {
    COLUMNS[..4].join(",")
}

/// The columns that a first line names, in any order.
fn columns(line: &str) -> Result<Vec<ListColumn>, Fault> {
    let names = cells(line);
    separators(line, names.len())?;
    if names.iter().all(|name| is_number(name)) {
        let remedy = format!("put this line above them: {}", wanted());
        return Err((
            "it begins with numbers: the names of the columns are missing".into(),
            remedy,
        ));
    }
    let mut columns = Vec::new();
    for (number, name) in names.iter().enumerate() {
        let column = column(number, name)?;
        if columns.contains(&column) {
            let problem = format!("{} is there twice", quoted(name));
            return Err((problem, "keep one of the columns".to_owned()));
        }
        columns.push(column);
    }
    let missing = (0..3).map(ListColumn::Place).position(|place| !columns.contains(&place));
    let missing = missing.map(|axis| COLUMNS[axis]);
    let sizes = [ListColumn::Diameter, ListColumn::Radius].map(|size| columns.contains(&size));
    match (missing, sizes) {
        (Some(missing), _) => Err((
            format!("there is no column \"{missing}\""),
            format!("let the first line be {} and perhaps ,{}", wanted(), COLUMNS[4]),
        )),
        (None, [false, false]) => Err((
            "there is no column \"diameter (m)\"".to_owned(),
            "add it, or a column \"radius (m)\"".to_owned(),
        )),
        (None, [true, true]) => Err((
            "there are columns for the diameter and for the radius".to_owned(),
            "keep one of them".to_owned(),
        )),
        _ => whole_vectors(columns),
    }
}

/// The columns, if all three of each vector are there or none.
fn whole_vectors(columns: Vec<ListColumn>) -> Result<Vec<ListColumn>, Fault> {
    let vectors = [[0, 1, 2].map(ListColumn::Velocity), [0, 1, 2].map(ListColumn::Spin)];
    for (vector, names) in vectors.iter().zip(MOTION_COLUMNS.chunks(3)) {
        let is_there = vector.map(|column| columns.contains(&column));
        if let (true, Some(missing)) =
            (is_there.contains(&true), is_there.iter().position(|there| !there))
        {
            let problem = format!("there is no column \"{}\"", names[missing]);
            let remedy = format!("add it (0 where it is 0): {} belong together", names.join(","));
            return Err((problem, remedy));
        }
    }
    Ok(columns)
}

/// Errors if the columns are separated by something else than commas.
fn separators(line: &str, commas: usize) -> Result<(), Fault> {
    let (name, command) = if line.matches(';').count() >= 3 {
        ("semicolons", "sed 's/,/./g; s/;/,/g' old.csv > new.csv")
    } else if line.matches('\t').count() >= 3 {
        ("tabulators", "tr '\\t' ',' < old.csv > new.csv")
    } else if commas == 1 && line.split_whitespace().count() >= 4 {
        ("blanks", "write the file anew with commas, the first line too")
    } else {
        return Ok(());
    };
    let remedy = format!(
        "separate them by commas, and write decimals with points (0.5, not 0,5): {command}; or say in the scene what \
         separates them: `columns.delimiter`"
    );
    Err((format!("its columns are separated by {name}"), remedy))
}

fn column(number: usize, cell: &str) -> Result<ListColumn, Fault> {
    let at = number + 1;
    let (name, unit) = match cell.split_once(['(', '[']) {
        Some((name, unit)) => (name, unit.trim_end().trim_end_matches([')', ']']).trim()),
        None => (cell, ""),
    };
    let (column, proper) = match name.trim().to_lowercase().as_str() {
        "x" => (ListColumn::Place(0), COLUMNS[0]),
        "y" => (ListColumn::Place(1), COLUMNS[1]),
        "z" => (ListColumn::Place(2), COLUMNS[2]),
        "diameter" | "d" => (ListColumn::Diameter, COLUMNS[3]),
        "radius" | "r" => (ListColumn::Radius, "radius (m)"),
        "density" | "rho" => (ListColumn::Density, COLUMNS[4]),
        name if MOTION_COLUMNS.iter().any(|known| is_called(known, name)) => {
            let place = MOTION_COLUMNS.iter().position(|known| is_called(known, name)).unwrap_or(0);
            let axis = place % 3;
            let column =
                if place < 3 { ListColumn::Velocity(axis) } else { ListColumn::Spin(axis) };
            (column, MOTION_COLUMNS[place])
        }
        "" => {
            let problem = format!("column {at} has no name");
            return Err((problem, "remove the empty column: commas at the end of lines".into()));
        }
        _ => {
            let problem = format!("there is a column too many, {}, column {at}", quoted(cell));
            let remedy = format!(
                "keep {} and perhaps ,{}, or say in the scene which column is what: `columns`",
                wanted(),
                COLUMNS[4]
            );
            return Err((problem, remedy));
        }
    };
    let factor = match (column, unit) {
        (ListColumn::Density, "kg/m3" | "kg/m^3" | "kg/m³" | "kg m-3") => return Ok(column),
        (ListColumn::Density, "g/cm3" | "g/cm^3" | "g/cm³" | "g/cc") => {
            Some("multiply it by 1000")
        }
        (ListColumn::Velocity(_), "m/s") | (ListColumn::Spin(_), "rad/s") => return Ok(column),
        (ListColumn::Density | ListColumn::Velocity(_) | ListColumn::Spin(_), _) => None,
        (_, "m") => return Ok(column),
        (_, "mm") => Some("divide it by 1000"),
        (_, "cm") => Some("divide it by 100"),
        (_, "um" | "µm" | "μm" | "micron" | "microns") => Some("divide it by 1e6"),
        _ => None,
    };
    let problem = format!("column {at} is {}, not \"{proper}\"", quoted(cell));
    let remedy = match factor {
        Some(factor) => format!("lists are in SI units: {factor} and call it \"{proper}\""),
        None => {
            format!("let the first line be {} and perhaps ,{}, in SI units", wanted(), COLUMNS[4])
        }
    };
    Err((problem, remedy))
}

/// Whether a title of a column is this name with a unit.
fn is_called(title: &str, name: &str) -> bool {
    title.split(' ').next() == Some(name)
}
