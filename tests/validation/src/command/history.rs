//! `cargo validate history`: what the committed reports have found, claim by claim.

use clap::Args;
use psmrt::command::say::{say, tell};
use psmrt::table::Table;

use crate::failure::Failure;
use crate::history::{CLAIMS, History};

/// What `cargo validate history` is asked for.
#[derive(Args, Clone, Debug)]
pub struct HistoryRequest {
    /// Only claims of this case
    #[arg(long, value_name = "CASE")]
    pub case: Option<String>,
    /// Only claims whose text contains this
    #[arg(value_name = "TEXT")]
    pub text: Option<String>,
}

/// Prints a line a claim and report. Errors if no report is committed, or none has such a claim.
pub fn history(request: &HistoryRequest) -> Result<(), Failure> {
    let History(reports) = History::committed();
    if reports.is_empty() {
        return Err(Failure::usage(format!(
            "no committed {CLAIMS} found: `cargo validate report --out report/validation`, then commit it; git and the \
             repository are needed"
        )));
    }
    let mut table = Table::new(&["case", "claim", "engine", "day", "commit", "measured", "holds"]);
    for report in &reports {
        let columns = ["case", "claim", "engine", "measured", "holds"];
        let at = columns.map(|name| report.claims.columns.iter().position(|column| column == name));
        for row in &report.claims.rows {
            let [case, claim, engine, measured, holds] =
                at.map(|column| column.map_or("", |column| row[column].as_str()));
            let is_wanted = request.case.as_ref().is_none_or(|wanted| wanted == case)
                && request.text.as_ref().is_none_or(|text| claim.contains(text.as_str()));
            if is_wanted {
                let row = [case, claim, engine, &report.day, &report.commit, measured, holds];
                table.add(row.map(str::to_owned).to_vec());
            }
        }
    }
    if table.rows.is_empty() {
        return Err(Failure::usage("no committed report has such a claim".to_owned()));
    }
    // The reports of one claim one after the other.
    table.rows.sort_by(|a, b| a[..3].cmp(&b[..3]));
    say(table.to_csv().trim_end());
    tell(&format!(
        "{} reports, {} to {}",
        reports.len(),
        reports[0].day,
        reports[reports.len() - 1].day
    ));
    Ok(())
}
