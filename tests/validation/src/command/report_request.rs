//! What `cargo validate report` is asked for.

use std::path::PathBuf;

use clap::Args;

/// What `cargo validate report` is asked for.
#[derive(Args, Clone, Debug)]
pub struct ReportRequest {
    /// Folder for the page, its figures and tables; earlier ones there are replaced
    #[arg(long, value_name = "DIR", default_value = "out/report")]
    pub out: PathBuf,
    /// Folder of the cases
    #[arg(long, value_name = "DIR", default_value = "golden")]
    pub golden: PathBuf,
    /// Only this case; can be given several times
    #[arg(long = "case", value_name = "NAME")]
    pub cases: Vec<String>,
    /// At the full scale: hours; runs are kept in `runs` in the folder, and a report that was cut off
    /// goes on from their checkpoints
    #[arg(long)]
    pub full: bool,
    /// Only the oracle, even where there is an adapter
    #[arg(long)]
    pub oracle_only: bool,
    /// Opens the page in a browser
    #[arg(long)]
    pub open: bool,
}
