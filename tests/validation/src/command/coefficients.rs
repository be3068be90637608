//! `cargo validate coefficients`: makes the tables by which the product predicts from the golden ones.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use psmrt::command::say::say;
use psmrt::command::write;
use psmrt::output::atomic;
use serde_json::json;

use crate::failure::Failure;
use crate::tradeoff::coefficients::{HEADER, coefficients, runs};

/// What `cargo validate coefficients` is asked for.
#[derive(Args, Clone, Debug)]
pub struct CoefficientsRequest {
    /// Folder for coefficients.csv and runs.csv, which are replaced
    #[arg(long, value_name = "DIR", default_value = "src/advice")]
    pub out: PathBuf,
}

/// Makes both tables. Errors if a golden table cannot be read, or a file not written.
pub fn make(request: &CoefficientsRequest, json: bool) -> Result<(), Failure> {
    for (name, table) in [("coefficients.csv", coefficients()?), ("runs.csv", runs()?)] {
        let (file, text) = (request.out.join(name), format!("{HEADER}{}", table.to_csv()));
        write(&file, |path| atomic::write(path, |out| out.write_all(text.as_bytes())))?;
        let (file, rows) = (file.display().to_string(), table.rows.len());
        say(&if json {
            json!({ "file": file, "rows": rows }).to_string()
        } else {
            format!("{file}: {rows} rows")
        });
    }
    Ok(())
}
