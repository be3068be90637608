//! Tables as CSV: the first line names each column with its unit, `time (s)`.

use std::fs::{File, OpenOptions};
use std::io::{self, Seek, SeekFrom};
use std::path::Path;

/// A column of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// Its unit; empty for a bare number.
    pub unit: &'static str,
}

impl Column {
    /// A column of that name and unit.
    pub const fn new(name: &'static str, unit: &'static str) -> Self {
        Column { name, unit }
    }

    /// Name and unit, as the first line of a table has them.
    pub fn title(&self) -> String {
        match self.unit {
            "" => self.name.to_owned(),
            unit => format!("{} ({unit})", self.name),
        }
    }
}

/// One value of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A whole number.
    Whole(u64),
    /// A number with all its digits: it reads back as the same bits.
    Real(f64),
}

/// A CSV file that is being written.
#[derive(Debug)]
pub struct Table {
    writer: ::csv::Writer<File>,
}

impl Table {
    /// Makes the file and writes its first line. Errors if it exists.
    pub fn create(path: &Path, columns: &[Column]) -> io::Result<Self> {
        Self::begin(File::create_new(path)?, columns)
    }

    /// The same, but a file that exists is replaced.
    pub fn replace(path: &Path, columns: &[Column]) -> io::Result<Self> {
        Self::begin(File::create(path)?, columns)
    }

    fn begin(file: File, columns: &[Column]) -> io::Result<Self> {
        let mut writer = ::csv::Writer::from_writer(file);
        writer.write_record(columns.iter().map(Column::title))?;
        writer.flush()?;
        Ok(Table { writer })
    }

    /// Goes on with a file at `length` bytes; what came after is dropped. Errors if it is shorter.
    pub fn reopen(path: &Path, length: u64) -> io::Result<Self> {
        let mut file = OpenOptions::new().write(true).open(path)?;
        let found = file.metadata()?.len();
        if found < length {
            let problem =
                format!("{} has {found} bytes; the checkpoint knows {length}", path.display());
            return Err(io::Error::other(problem));
        }
        file.set_len(length)?;
        file.seek(SeekFrom::End(0))?;
        Ok(Table { writer: ::csv::Writer::from_writer(file) })
    }

    /// Adds a row.
    pub fn add(&mut self, row: &[Value]) -> io::Result<()> {
        self.writer.write_record(row.iter().map(|value| match value {
            Value::Whole(value) => value.to_string(),
            Value::Real(value) => format!("{value:?}"),
        }))?;
        Ok(())
    }

    /// Hands what has been added to the operating system.
    pub fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }

    /// Waits until all rows are on the disk; returns the length of the file in bytes.
    pub fn sync(&mut self) -> io::Result<u64> {
        self.writer.flush()?;
        let file = self.writer.get_ref();
        file.sync_data()?;
        Ok(file.metadata()?.len())
    }
}

/// The rows of a table of numbers.
pub fn read(path: &Path) -> io::Result<Vec<Vec<f64>>> {
    let mut reader = ::csv::Reader::from_path(path)?;
    let number = |text: &str| text.parse::<f64>().map_err(io::Error::other);
    reader.records().map(|row| row?.iter().map(number).collect()).collect()
}
