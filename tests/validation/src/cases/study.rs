//! Tables of longer studies, which grow run by run, each row under the program that made it.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use psmrt::provenance;

/// A CSV file that rows are added to as they are made.
#[derive(Debug)]
pub struct Study {
    path: PathBuf,
    /// The line above the rows of this program.
    signature: String,
}

impl Study {
    /// The file; it must be there, with the names of its columns.
    pub fn new(path: impl AsRef<Path>) -> Self {
        let (program, day) = (provenance::program(), provenance::today());
        let signature = format!("# From here on made at {program}, {day}.");
        Study { path: path.as_ref().to_owned(), signature }
    }

    /// The first row that starts with these values, if there is one. Errors if the file cannot be read.
    pub fn row(&self, start: &str) -> io::Result<Option<String>> {
        let text = fs::read_to_string(&self.path)?;
        Ok(text.lines().find(|line| line.starts_with(start)).map(str::to_owned))
    }

    /// Adds rows, one a line; before the first ones a comment that says who makes them. Errors if the file
    /// cannot be written.
    pub fn add(&self, rows: &str) -> io::Result<()> {
        let text = fs::read_to_string(&self.path)?;
        let last = text.lines().rfind(|line| line.starts_with('#'));
        let signature = match last {
            Some(line) if line == self.signature => String::new(),
            _ => format!("{}\n", self.signature),
        };
        let mut file = OpenOptions::new().append(true).open(&self.path)?;
        file.write_all(format!("{signature}{}\n", rows.trim_end()).as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::Study;
    use psmrt::table::Table;

    #[test]
    fn rows_that_are_added_stand_under_the_program_that_made_them() {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), "# Rows committed in a1.\nx,y\n1,2\n").unwrap();
        let study = Study::new(file.path());
        study.add("3,4\n").unwrap();
        Study::new(file.path()).add("5,6").unwrap();
        let text = std::fs::read_to_string(file.path()).unwrap();
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(
            [&lines[..3], &lines[4..]].concat().join(" "),
            "# Rows committed in a1. x,y 1,2 3,4 5,6"
        );
        assert!(
            lines[3].starts_with("# From here on made at ") && lines[3].contains("commit"),
            "{text}"
        );
        assert_eq!(Table::read(file.path()).unwrap().rows.len(), 3, "comments are no rows");
        assert_eq!(study.row("3,").unwrap().as_deref(), Some("3,4"));
        assert_eq!(study.row("7,").unwrap(), None);
    }
}
