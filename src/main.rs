//! The command line; what the commands do is in `command/`.

#![warn(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::io::IsTerminal;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;
use psmrt::command::check::CheckRequest;
use psmrt::command::oracle::OracleCommand;
use psmrt::command::resume::ResumeRequest;
use psmrt::command::run::RunRequest;
use psmrt::command::{self, CommandError};

/// Grains and water, resolved grain by grain: lattice Boltzmann with a verified oracle.
#[derive(Parser)]
#[command(
    version,
    arg_required_else_help = true,
    after_help = "Examples:
  psmrt check golden/poiseuille/scene.toml
  psmrt run golden/poiseuille/scene.toml
  psmrt resume out/poiseuille"
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Prints one JSON object, errors too
    #[arg(long, global = true)]
    json: bool,
}

#[derive(Subcommand)]
enum Command {
    /// Says what a scene will be, cost and risk, without running it
    #[command(after_help = "Examples:
  psmrt check golden/poiseuille/scene.toml
  psmrt check golden/poiseuille/scene.toml --set time.tau=0.6 --json")]
    Check {
        /// Scene file (TOML)
        scene: PathBuf,
        /// Changes a value of the scene; can be given several times
        #[arg(long, value_name = "KEY=VALUE")]
        set: Vec<String>,
    },
    /// Runs a scene
    #[command(after_help = "Ctrl-C saves the state; `psmrt resume` goes on from it.

Examples:
  psmrt run golden/poiseuille/scene.toml
  psmrt run golden/poiseuille/scene.toml --set time.tau=0.6 --out out/tau_0.6")]
    Run {
        /// Scene file (TOML)
        scene: PathBuf,
        /// Folder for the results, empty or absent [default: out/<name of the scene>, numbered]
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// Changes a value of the scene; can be given several times
        #[arg(long, value_name = "KEY=VALUE")]
        set: Vec<String>,
    },
    /// Goes on with a run from its newest checkpoint
    #[command(after_help = "Example:
  psmrt resume out/poiseuille")]
    Resume {
        /// Folder of the run
        dir: PathBuf,
        /// Another checkpoint than the newest
        #[arg(long, value_name = "FILE")]
        checkpoint: Option<PathBuf>,
    },
    /// Problems for other people's kernels, a verdict and a diagnosis back
    Oracle {
        #[command(subcommand)]
        command: OracleCommand,
    },
    /// Says what this program is and what it runs on
    Info,
    /// Prints the JSON schema of scene files, for editors
    #[command(after_help = "Example:
  psmrt schema > scene.schema.json")]
    Schema {
        /// Prints the reference for people instead
        #[arg(long)]
        markdown: bool,
    },
    /// Prints completions for a shell
    #[command(after_help = "Example:
  psmrt completions bash > ~/.local/share/bash-completion/completions/psmrt")]
    Completions {
        /// The shell
        shell: Shell,
    },
}

fn main() -> ExitCode {
    let Arguments { command, json } = Arguments::parse();
    match dispatch(command, json) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            report(&error, json);
            ExitCode::from(error.exit_code())
        }
    }
}

fn dispatch(command: Command, json: bool) -> Result<(), CommandError> {
    match command {
        Command::Check { scene, set } => command::check::check(&CheckRequest { scene, set, json }),
        Command::Run { scene, out, set } => {
            command::run::run(&RunRequest { scene, set, out, json })
        }
        Command::Resume { dir, checkpoint } => {
            command::resume::resume(&ResumeRequest { folder: dir, checkpoint, json })
        }
        Command::Oracle { command } => command::oracle::oracle(&command, json),
        Command::Info => {
            command::info::info(json);
            Ok(())
        }
        Command::Schema { markdown } => {
            command::info::schema(markdown);
            Ok(())
        }
        Command::Completions { shell } => {
            let mut command = Arguments::command();
            clap_complete::generate(shell, &mut command, "psmrt", &mut std::io::stdout());
            Ok(())
        }
    }
}

/// Says what went wrong: as JSON, in colour on a terminal, or plainly.
fn report(error: &CommandError, json: bool) {
    if matches!(error, CommandError::CandidateFailed) {
        return; // the verdict is the report
    }
    if json {
        println!("{}", error.to_json());
        return;
    }
    match error {
        CommandError::Scene(error) if std::io::stderr().is_terminal() => {
            eprintln!("{}", error.render(&annotate_snippets::Renderer::styled()));
        }
        CommandError::Scene(error) => eprintln!("{error}"),
        CommandError::Interrupted { .. } => eprintln!("{error}"),
        error => eprintln!("error: {error}"),
    }
}
