//! A run of the sweep, as a row of its table.

use super::parameters::{COLUMNS, Parameters};
use psmrt::table::{Table, TableError};

/// What a run gave.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// How it was computed.
    pub parameters: Parameters,
    /// Exact drag over Stokes' drag; 1 between plates.
    pub drag: f64,
    /// Relative error; `None` for a run that broke or did not become steady.
    pub error: Option<f64>,
    /// How the run ended: `steady`, `limit` or `broken: why`.
    pub end: String,
    /// Cells of the box that was computed.
    pub cells: u64,
    /// Steps made.
    pub steps: u64,
    /// Seconds that it took.
    pub seconds: f64,
    /// Memory of the populations, MiB.
    pub mebibytes: f64,
    /// Processor and threads.
    pub machine: String,
}

/// Names of the columns after the parameters.
const RESULTS: [&str; 10] = [
    "cells_per_diameter",
    "drag",
    "error",
    "end",
    "box_cells",
    "steps",
    "cell_updates",
    "seconds",
    "MiB",
    "machine",
];

impl Row {
    /// Names of all columns.
    pub fn columns() -> Vec<&'static str> {
        COLUMNS.iter().chain(&RESULTS).copied().collect()
    }

    /// Cell updates made.
    pub fn cell_updates(&self) -> u64 {
        self.cells * self.steps
    }

    /// The row as a line of a file.
    pub fn to_line(&self) -> String {
        let mut fields = self.parameters.row();
        let diameter = self.parameters.cells_per_diameter();
        fields.extend([
            diameter.map_or_else(String::new, |d| format!("{d:.4}")),
            format!("{}", self.drag),
            self.error.map_or_else(String::new, |error| format!("{error:.6e}")),
            self.end.clone(),
            self.cells.to_string(),
            self.steps.to_string(),
            self.cell_updates().to_string(),
            format!("{:.3}", self.seconds),
            format!("{:.4}", self.mebibytes),
            self.machine.clone(),
        ]);
        fields.join(",") + "\n"
    }

    /// The rows of a table. Errors if one cannot be read.
    pub fn of_table(table: &Table) -> Result<Vec<Self>, TableError> {
        let expected = Self::columns();
        if table.columns != expected {
            let problem = format!("its columns are {:?}, not {expected:?}", table.columns);
            return Err(TableError(problem));
        }
        let wrong = |name: &str, value: &str| {
            TableError(format!("column {name} of a sweep holds {value:?}"))
        };
        let row = |fields: &Vec<String>| {
            let result = |i: usize| fields[COLUMNS.len() + i].as_str();
            let number = |i: usize| result(i).parse().map_err(|_| wrong(RESULTS[i], result(i)));
            let whole = |i: usize| result(i).parse().map_err(|_| wrong(RESULTS[i], result(i)));
            Ok(Row {
                parameters: Parameters::from_row(&fields[..COLUMNS.len()])?,
                drag: number(1)?,
                error: if result(2).is_empty() { None } else { Some(number(2)?) },
                end: result(3).to_owned(),
                cells: whole(4)?,
                steps: whole(5)?,
                seconds: number(7)?,
                mebibytes: number(8)?,
                machine: result(9).to_owned(),
            })
        };
        table.rows.iter().map(row).collect()
    }
}
