//! A table of the case, made by one command that goes on where it was cut off.

use std::fs;
use std::path::Path;

use crate::cases::CaseError;

/// Makes runs: the folder `golden`, the file that they are added to, who is told of each row.
pub type Make = fn(&Path, &Path, &dyn Fn(&str)) -> Result<(), CaseError>;

/// A table of runs.
pub struct Set {
    /// Its name, and that of its file.
    pub name: &'static str,
    /// What it holds, for the head of its file: a line each.
    pub about: &'static [&'static str],
    /// Makes the runs that the file lacks.
    pub make: Make,
}

impl Set {
    /// Its name, as a file.
    pub fn file(&self) -> String {
        format!("{}.csv", self.name)
    }

    /// The lines above the columns.
    pub fn head(&self) -> String {
        let command = format!("# cargo validate operators {} --out DIR\n", self.name);
        self.about.iter().fold(command, |head, line| head + "# " + line + "\n")
    }
}

/// Begins a file that is not there yet.
pub(super) fn begin(set: &Set, file: &Path, columns: &[&str]) -> Result<(), CaseError> {
    if !file.exists() {
        fs::write(file, set.head() + &columns.join(",") + "\n")?;
    }
    Ok(())
}
