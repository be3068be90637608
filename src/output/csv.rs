//! Tables as CSV: the first line names each column with its unit, `time (s)`.

use std::fmt;
use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::hashed::Hashed;
use crate::scene::columns::Column;

/// One value of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A whole number.
    Whole(u64),
    /// A number with all its digits: it reads back as the same bits.
    Real(f64),
    /// A name without commas or quotes.
    Word(&'static str),
}

impl fmt::Display for Value {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Whole(value) => write!(out, "{value}"),
            Value::Real(value) => write!(out, "{value:?}"),
            Value::Word(word) => out.write_str(word),
        }
    }
}

/// What a table held at some moment: enough to know the same bytes again.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct Mark {
    /// Length in bytes.
    pub length: u64,
    /// XXH3 of the bytes.
    pub hash: u64,
}

/// A CSV file that is being written.
pub struct TableFile {
    writer: ::csv::Writer<Hashed<File>>,
}

impl fmt::Debug for TableFile {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("TableFile").field("file", &self.writer.get_ref().inner).finish()
    }
}

impl TableFile {
    /// Makes the file and writes its first line. Errors if it exists.
    pub fn create(path: &Path, columns: &[Column]) -> io::Result<Self> {
        let file = OpenOptions::new().read(true).write(true).create_new(true).open(path)?;
        let mut writer = ::csv::Writer::from_writer(Hashed::new(file));
        writer.write_record(columns.iter().map(Column::title))?;
        writer.flush()?;
        Ok(TableFile { writer })
    }

    /// Opens a file that begins with the bytes of `mark`, to go on after them. Errors if it begins with
    /// others. Nothing is changed yet: [`TableFile::cut`] drops what came after.
    pub fn reopen(path: &Path, mark: Mark) -> io::Result<Self> {
        let mut out = Hashed::new(OpenOptions::new().read(true).write(true).open(path)?);
        let mut left = mark.length;
        let mut buffer = vec![0; 1 << 16];
        while left > 0 {
            let wanted = usize::try_from(left).unwrap_or(usize::MAX).min(buffer.len());
            let read = out.inner.read(&mut buffer[..wanted])?;
            if read == 0 {
                return Err(io::Error::other(format!(
                    "it is shorter than the {} bytes that it had when the checkpoint was written",
                    mark.length
                )));
            }
            out.count(&buffer[..read]);
            left -= read as u64;
        }
        if out.digest() != mark.hash {
            return Err(io::Error::other(format!(
                "its first {} bytes have been changed since the checkpoint was written",
                mark.length
            )));
        }
        Ok(TableFile { writer: ::csv::Writer::from_writer(out) })
    }

    /// Drops what comes after the bytes that [`TableFile::reopen`] has found.
    pub fn cut(&mut self) -> io::Result<()> {
        let out = self.writer.get_ref();
        out.inner.set_len(out.length())
    }

    /// Adds a row.
    pub fn add(&mut self, row: &[Value]) -> io::Result<()> {
        self.writer.write_record(row.iter().map(Value::to_string))?;
        Ok(())
    }

    /// Hands what has been added to the operating system.
    pub fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }

    /// Waits until all rows are on the disk; returns what the file holds.
    pub fn sync(&mut self) -> io::Result<Mark> {
        self.writer.flush()?;
        let out = self.writer.get_ref();
        out.inner.sync_data()?;
        Ok(Mark { length: out.length(), hash: out.digest() })
    }

    /// Copies all rows into a new file, also after this one has lost its name. No row may follow.
    pub fn copy_to(&mut self, path: &Path) -> io::Result<()> {
        self.writer.flush()?;
        let mut own = &self.writer.get_ref().inner;
        own.rewind()?;
        let mut copy = File::create_new(path)?;
        io::copy(&mut own, &mut copy)?;
        copy.sync_all()
    }
}

/// Writes a whole table of numbers.
pub fn write<const N: usize>(
    out: &mut impl Write,
    columns: &[Column; N],
    rows: &[[f64; N]],
) -> io::Result<()> {
    let mut writer = ::csv::Writer::from_writer(out);
    writer.write_record(columns.iter().map(Column::title))?;
    for row in rows {
        writer.write_record(row.iter().map(|&value| Value::Real(value).to_string()))?;
    }
    writer.flush()
}

/// The rows of a table of numbers.
pub fn read(path: &Path) -> io::Result<Vec<Vec<f64>>> {
    let mut reader = ::csv::Reader::from_path(path)?;
    let number = |text: &str| text.parse::<f64>().map_err(io::Error::other);
    reader.records().map(|row| row?.iter().map(number).collect()).collect()
}
