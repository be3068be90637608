//! `psmrt conformance`: the conformance kit out, a verdict on a candidate's answers back.

use std::path::{Path, PathBuf};

use clap::Subcommand;
use serde_json::json;

use super::CommandError;
use super::say::say;
use crate::conformance::files::{compare_folders, export, verify};
use crate::conformance::folder;
use crate::conformance::judge::judge_submission;
use crate::conformance::kit::Kit;
use crate::conformance::mistakes::CATALOGUE;

/// What can be done with the conformance kit.
#[derive(Clone, Debug, Subcommand)]
pub enum ConformanceCommand {
    /// Writes the conformance kit: problems, expected answers, and how to answer
    #[command(
        after_help = "Start with kit/README.md: all that it needs is NumPy, or nothing but C.

Example:
  psmrt conformance export --out kit"
    )]
    Export {
        /// Folder for the kit, empty or absent
        #[arg(long, value_name = "DIR")]
        out: PathBuf,
    },
    /// Judges a candidate's answers and says what is wrong with them
    #[command(
        after_help = "Exit code: 0 all that was attempted is right, 1 something is wrong, 2 the folders
cannot be used.

Example:
  psmrt conformance check kit candidate"
    )]
    Check {
        /// Folder of the kit
        kit: PathBuf,
        /// Folder of the answers
        candidate: PathBuf,
    },
    /// Compares two kits, made on different machines perhaps
    #[command(after_help = "Example:
  psmrt conformance compare kit kit_from_elsewhere")]
    Compare {
        /// Folder of a kit
        kit: PathBuf,
        /// Folder of another
        other: PathBuf,
    },
    /// Lists the mistakes that the diagnosis knows
    Mistakes,
}

/// Does it.
pub fn conformance(command: &ConformanceCommand, json: bool) -> Result<(), CommandError> {
    match command {
        ConformanceCommand::Export { out } => {
            let (files, bytes) = export(out)?;
            if json {
                say(
                    &json!({ "folder": out.display().to_string(), "files": files, "bytes": bytes })
                        .to_string(),
                );
            } else {
                let folder = out.display();
                say(&format!("{files} files, {:.1} MB, in {folder}", bytes as f64 / 1e6));
                say(&format!(
                    "read {folder}/README.md; judge answers with `psmrt conformance check {folder} DIR`"
                ));
            }
            Ok(())
        }
        ConformanceCommand::Check { kit, candidate } => check(kit, candidate, json),
        ConformanceCommand::Compare { kit, other } => {
            let largest = compare_folders(kit, other)?;
            if json {
                say(&json!({ "same": true, "largest_difference": largest }).to_string());
            } else {
                say(&format!(
                    "the same kit: largest difference {largest:.2} double-precision epsilon times gauge"
                ));
            }
            Ok(())
        }
        ConformanceCommand::Mistakes => {
            mistakes(json);
            Ok(())
        }
    }
}

fn check(kit_folder: &Path, candidate: &Path, json: bool) -> Result<(), CommandError> {
    let kit = Kit::make().map_err(crate::conformance::files::FilesError::from)?;
    verify(&kit, kit_folder)?;
    let submission = folder::read(&kit, candidate)?;
    let verdict = judge_submission(&kit, &submission);
    if verdict.attempted() == 0 {
        return Err(CommandError::NoAnswers { folder: candidate.display().to_string() });
    }
    say(&if json { verdict.to_json().to_string() } else { verdict.to_string() });
    if verdict.passed() { Ok(()) } else { Err(CommandError::CandidateFailed) }
}

fn mistakes(json: bool) {
    if json {
        let list = CATALOGUE.iter().map(
            |entry| json!({ "mistake": entry.name, "what": entry.what, "look_at": entry.look_at }),
        );
        say(&list.collect::<serde_json::Value>().to_string());
        return;
    }
    for entry in &CATALOGUE {
        say(&format!("{:<30}{}\n{:<30}look at: {}", entry.name, entry.what, "", entry.look_at));
    }
}
