//! `cargo validate golden`: the oracle's own results, compared with the reviewed ones or written anew.

use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;

use clap::Subcommand;

use crate::cases::{Bench, CASES, Case, DRIFT_WORDS, Drift, Golden, drifts};
use crate::failure::Failure;
use psmrt::command::execute::interruption;
use psmrt::command::progress::ProgressLine;
use psmrt::command::say::{say, tell};
use psmrt::command::write;
use psmrt::engine::EngineName;
use psmrt::output::atomic;
use psmrt::provenance;

/// What `cargo validate golden` is asked for.
#[derive(Clone, Debug, Subcommand)]
pub enum GoldenCommand {
    /// Shows how the oracle's results differ from the reviewed ones; fails if some do
    Diff(GoldenRequest),
    /// Shows it and writes the new ones; review them before they are committed
    Write(GoldenRequest),
}

/// Which cases.
#[derive(clap::Args, Clone, Debug)]
pub struct GoldenRequest {
    /// One case; all that run scenes where it is absent
    case: Option<String>,
    /// Folder of the cases
    #[arg(long, value_name = "DIR", default_value = "golden")]
    golden: PathBuf,
}

/// Does it.
pub fn golden(command: &GoldenCommand) -> Result<(), Failure> {
    let (request, writes) = match command {
        GoldenCommand::Diff(request) => (request, false),
        GoldenCommand::Write(request) => (request, true),
    };
    let runs = |case: &&Case| !case.scenes.is_empty();
    let wanted = |case: &&Case| request.case.as_ref().is_none_or(|name| name == case.name);
    let cases: Vec<_> = CASES.iter().filter(runs).filter(wanted).collect();
    if cases.is_empty() {
        let names: Vec<_> = CASES.iter().filter(runs).map(|case| case.name).collect();
        let wanted = request.case.as_deref().unwrap_or_default();
        let problem =
            format!("{wanted}: no case of that name runs scenes; there are {}", names.join(", "));
        return Err(Failure::usage(problem));
    }
    let interrupted = interruption();
    let mut differing = 0;
    for case in cases {
        let golden = Golden::of(case, &request.golden);
        let path = golden.path(case.rows);
        let interrupted = Arc::clone(&interrupted);
        let mut bench = Bench::new(&request.golden, EngineName::Reference, None, |what| {
            tell(&format!("  {what}"));
        })
        .watched(Box::new(move |scene| {
            Box::new(ProgressLine::new(scene, false, Arc::clone(&interrupted)))
        }));
        let new = bench.measure(case)?;
        let old = if path.exists() { Some(golden.table(case.rows)?) } else { None };
        match &old {
            None => say(&format!("{}: no {} yet", case.name, case.rows)),
            Some(old) => {
                let found = drifts(old, &new);
                say(&format!("{}: {} values differ", case.name, found.len()));
                for Drift { row, column, old, new, change } in &found {
                    say(&format!("  row {row}, {column}: {old} -> {new} ({change})"));
                }
                differing += found.len();
            }
        }
        if writes {
            let text = header(case, &golden) + &new.to_csv();
            write(&path, |path| atomic::write(path, |out| out.write_all(text.as_bytes())))?;
            say(&format!("{} written", path.display()));
        } else if old.is_none() {
            differing += 1;
        }
    }
    if differing > 0 && !writes { Err(Failure::GoldenDiffers) } else { Ok(()) }
}

/// What a reader of the file must know.
fn header(case: &Case, golden: &Golden) -> String {
    let read: Vec<_> = [case.scenes, case.literature].concat();
    format!(
        "# {}. The oracle's own results, against drift only: the truth is what the claims compare with.\n\
         # Made by: {} golden write {}, at {}, {}; engine reference.\n\
         # Units: {}. A value may change by {}.\n",
        case.title,
        crate::PROGRAM,
        case.name,
        provenance::program_and_files(&golden.path(""), &read),
        provenance::today(),
        case.units,
        DRIFT_WORDS,
    )
}
