//! What the committed reports have found, claim by claim: whether psmrt gets better or worse.

use std::path::Path;
use std::process::Command;

use psmrt::table::Table;

/// The table of claims beside the committed page.
pub const CLAIMS: &str = "report/validation/claims.csv";

/// One committed report.
#[derive(Clone, Debug)]
pub struct Past {
    /// Its commit, shortened.
    pub commit: String,
    /// The day of that.
    pub day: String,
    /// Its claims.
    pub claims: Table,
}

/// The committed reports, the oldest first.
#[derive(Clone, Debug, Default)]
pub struct History(pub Vec<Past>);

impl History {
    /// All that have a table of claims; none where there is no repository, or no git.
    pub fn committed() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let Some(log) = git(&root, &["log", "--reverse", "--format=%h %cs", "--", CLAIMS]) else {
            return History::default();
        };
        let past = |line: &str| {
            let (commit, day) = line.split_once(' ')?;
            let text = git(&root, &["show", &format!("{commit}:{CLAIMS}")])?;
            let claims = Table::parse(CLAIMS, &text).ok()?;
            Some(Past { commit: commit.to_owned(), day: day.to_owned(), claims })
        };
        History(log.lines().filter_map(past).collect())
    }

    /// What they found for a claim of a case and an engine (empty: none), where they have it.
    pub fn of(&self, case: &str, claim: &str, engine: &str) -> Vec<f64> {
        let wanted = [("case", case), ("claim", claim), ("engine", engine)];
        let found = |past: &Past| past.claims.with(&wanted).ok()?.number("measured").ok();
        self.0.iter().filter_map(found).collect()
    }
}

/// What git says; `None` if it fails or is not there.
fn git(root: &Path, arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").current_dir(root).args(arguments).output().ok()?;
    output.status.success().then(|| String::from_utf8(output.stdout).ok()).flatten()
}

#[cfg(test)]
mod tests {
    use super::{History, Past};
    use psmrt::table::Table;

    #[test]
    fn a_claim_has_the_values_of_the_reports_that_made_it_and_no_others() {
        let report = |value: &str, claim: &str| Past {
            commit: "a1".to_owned(),
            day: "2026-11-30".to_owned(),
            claims: Table::parse(
                "test",
                &format!("case,claim,engine,measured\nduct,{claim},cpu,{value}\n"),
            )
            .unwrap(),
        };
        let history =
            History(vec![report("1", "error"), report("2", "other"), report("3", "error")]);
        assert_eq!(history.of("duct", "error", "cpu"), [1.0, 3.0]);
        assert!(history.of("duct", "error", "wgpu").is_empty());
    }
}
