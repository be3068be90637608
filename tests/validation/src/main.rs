//! `cargo validate`: the report, the reviewed results, the sweeps and the maps.

#![warn(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![warn(clippy::print_stdout, clippy::print_stderr)] // they panic where nobody reads

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use psmrt::command::say::{say, tell};
use psmrt::quote;
use psmrt_validation::command::coefficients::{self, CoefficientsRequest};
use psmrt_validation::command::golden::{self, GoldenCommand};
use psmrt_validation::command::history::{self, HistoryRequest};
use psmrt_validation::command::operators::{self, OperatorsRequest};
use psmrt_validation::command::report;
use psmrt_validation::command::report_request::ReportRequest;
use psmrt_validation::command::speed::{self, SpeedRequest};
use psmrt_validation::command::stability::{self, StabilityRequest};
use psmrt_validation::command::tradeoff::{self, TradeoffRequest};
use psmrt_validation::failure::Failure;

/// Holds psmrt to exact solutions, published tables, experiments and its own reviewed results.
#[derive(Parser)]
#[command(
    name = "cargo validate",
    arg_required_else_help = true,
    after_help = "Examples:
  cargo validate report --open
  cargo validate golden diff"
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
    /// Measures all cases, judges them and draws them on one page
    #[command(after_help = "Examples:
  cargo validate report --open
  cargo validate report --oracle-only --out report/validation")]
    Report(ReportRequest),
    /// Compares the oracle's results with the reviewed ones, or writes them anew
    #[command(after_help = "Examples:
  cargo validate golden diff
  cargo validate golden write poiseuille")]
    Golden {
        #[command(subcommand)]
        command: GoldenCommand,
    },
    /// Lists what the committed reports have found, claim by claim
    #[command(after_help = "Examples:
  cargo validate history --case sphere_arrays
  cargo validate history 'error of the mean'")]
    History(HistoryRequest),
    /// Maps where the method is stable and where it is accurate
    #[command(
        after_help = "Goes on where it was cut off: runs that the records hold are not made again.

Examples:
  cargo validate stability abc
  cargo validate stability --out golden/stability"
    )]
    Stability(StabilityRequest),
    /// Measures what speed costs in accuracy: cells per grain, relaxation time, models, engines
    #[command(
        after_help = "Rows are added to the table as they are made; runs that have one are left out.

Examples:
  cargo validate tradeoff --quick
  cargo validate tradeoff settling --oracle-only
  cargo validate tradeoff --out golden/tradeoff"
    )]
    Tradeoff(TradeoffRequest),
    /// Compares the operators of the solid where flow is not creeping or grains move
    #[command(
        after_help = "Rows are added to the tables as they are made; runs that have one are left out.

Examples:
  cargo validate operators stream
  cargo validate operators --out golden/operators"
    )]
    Operators(OperatorsRequest),
    /// Fits the error models and takes the limits anew that `psmrt check` and `psmrt plan` predict by
    #[command(after_help = "Example:\n  cargo validate coefficients && git diff src/advice")]
    Coefficients(CoefficientsRequest),
    /// Measures cell updates per second of the engines, with the memory bandwidth beside them
    #[command(after_help = "Examples:
  cargo validate speed
  cargo validate speed --side 64 --threads 1 --only bed --wgpu")]
    Speed(SpeedRequest),
}

fn main() -> ExitCode {
    let Arguments { command, json } = Arguments::parse();
    let done = match command {
        Command::Report(request) => report::report(&request, json),
        Command::Golden { command } => golden::golden(&command),
        Command::History(request) => history::history(&request),
        Command::Stability(request) => stability::stability(&request),
        Command::Operators(request) => operators::operators(&request),
        Command::Tradeoff(request) => tradeoff::tradeoff(&request, json),
        Command::Coefficients(request) => coefficients::make(&request, json),
        Command::Speed(request) => speed::speed(&request),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            say_why(&error, json);
            ExitCode::from(error.exit_code())
        }
    }
}

/// Says what went wrong: as JSON, or plainly.
fn say_why(error: &Failure, json: bool) {
    if json {
        say(&error.to_json().to_string());
    } else {
        tell(&quote::lines(&format!("error: {error}")));
    }
}
