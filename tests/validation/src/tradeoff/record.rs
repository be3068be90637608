//! The rows of a sweep in a CSV file that grows row by row.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::cases::CaseError;
use crate::tradeoff::parameters::Parameters;
use crate::tradeoff::row::Row;
use psmrt::table::{Table, TableError};

/// A file of rows that new ones are added to.
#[derive(Debug)]
pub struct SweepLog {
    path: PathBuf,
    /// All rows in it, in their order.
    pub rows: Vec<Row>,
}

impl SweepLog {
    /// Opens a file, or begins it with `header` (lines that start with `#`). A last line that was cut
    /// off is dropped. Errors if the file holds anything else than rows of a sweep.
    pub fn open(path: &Path, header: &str) -> Result<Self, CaseError> {
        if !path.exists() {
            if let Some(folder) = path.parent() {
                fs::create_dir_all(folder)?;
            }
            fs::write(path, format!("{header}{}\n", Row::columns().join(",")))?;
        }
        let text = fs::read_to_string(path)?;
        let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
        if whole.len() < text.len() {
            fs::write(path, whole)?;
        }
        let named = |error: TableError| TableError(format!("{}: {error}", path.display()));
        let table = Table::parse(&path.display().to_string(), whole)?;
        Ok(SweepLog { path: path.to_owned(), rows: Row::of_table(&table).map_err(named)? })
    }

    /// Whether a run with these parameters is there already.
    pub fn holds(&self, parameters: &Parameters) -> bool {
        self.rows.iter().any(|row| row.parameters == *parameters)
    }

    /// Adds a row at the end of the file.
    pub fn add(&mut self, row: Row) -> io::Result<()> {
        let mut file = OpenOptions::new().append(true).open(&self.path)?;
        file.write_all(row.to_line().as_bytes())?;
        self.rows.push(row);
        Ok(())
    }
}
