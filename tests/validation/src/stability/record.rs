//! The file of a flow's runs: read at the start, and a row added after each run.

use std::collections::HashMap;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use super::{Flow, Found, LabError, Line, Outcome};
use psmrt::table::Table;

/// The columns; the parameter's name stands in a comment.
const COLUMNS: [&str; 11] = [
    "engine",
    "collision",
    "weight",
    "variant",
    "tau",
    "value",
    "outcome",
    "steps",
    "error",
    "reynolds",
    "how",
];

/// The runs of a flow that have been made.
pub struct RunLog {
    path: PathBuf,
    known: HashMap<String, Outcome>,
}

impl RunLog {
    /// Opens the record of a flow in a folder, with its head if it is new. Errors if there is something
    /// else.
    pub fn open(flow: &Flow, folder: &Path) -> Result<Self, LabError> {
        let path = folder.join(format!("{}.csv", flow.name));
        let wrong =
            |problem: String| LabError::RunLog { file: path.display().to_string(), problem };
        if !path.exists() {
            fs::create_dir_all(folder).map_err(|error| wrong(error.to_string()))?;
            fs::write(&path, head(flow)).map_err(|error| wrong(error.to_string()))?;
        }
        let table = Table::read(&path).map_err(|error| wrong(error.to_string()))?;
        if table.columns != COLUMNS {
            return Err(wrong(
                "it is not a record of this program: name another folder".to_owned(),
            ));
        }
        let mut known = HashMap::new();
        for row in &table.rows {
            let outcome =
                Outcome::of(&row[6]).ok_or_else(|| wrong(format!("outcome {:?}", row[6])))?;
            known.insert(row[..6].join(","), outcome);
        }
        Ok(RunLog { path, known })
    }

    /// The outcome of a run, if it has been made.
    pub fn outcome(&self, line: &Line, value: f64) -> Option<Outcome> {
        self.known.get(&key(line, value)).copied()
    }

    /// Adds a run; returns its row.
    pub fn add(&mut self, line: &Line, value: f64, found: &Found) -> Result<String, LabError> {
        let wrong = |error: std::io::Error| LabError::RunLog {
            file: self.path.display().to_string(),
            problem: error.to_string(),
        };
        let number =
            |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |v| format!("{v:.4e}"));
        let key = key(line, value);
        let row = format!(
            "{key},{},{},{},{},{}",
            found.outcome.word(),
            found.steps,
            number(found.error),
            number(found.reynolds),
            found.how.unwrap_or("-")
        );
        let mut file = OpenOptions::new().append(true).open(&self.path).map_err(wrong)?;
        file.write_all(format!("{row}\n").as_bytes()).map_err(wrong)?;
        self.known.insert(key, found.outcome);
        Ok(row)
    }
}

fn key(line: &Line, value: f64) -> String {
    let variant = if line.variant.is_empty() { "-" } else { line.variant };
    let Line { engine, model, tau, .. } = line;
    format!("{},{},{},{variant},{tau},{value}", engine.word(), model.word(), line.weight_word())
}

/// The head of a new record.
fn head(flow: &Flow) -> String {
    let mut head =
        format!("# cargo validate stability {}; psmrt {}, ", flow.name, env!("CARGO_PKG_VERSION"));
    head += "lattice units. Engine reference: double precision, wgpu: single.\n";
    for line in flow.about {
        head += &format!("# {line}\n");
    }
    head += &format!("# value: {}.", flow.parameter);
    if flow.search == super::Search::Frontiers {
        head += " Only the values that find the last that survives and the last that is right, by halving, are run.";
    }
    head += "\n# outcome: right, wrong (lives, but is further from the truth than allowed), unjudged (lives, nothing to hold\n\
             # it to), stopped (not finite, no density, or faster than 1 cell per step; looked at every 16 steps), refused.\n";
    head + &COLUMNS.join(",") + "\n"
}
