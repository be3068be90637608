//! The command line; what the commands do is in `command/`.

#![warn(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![warn(clippy::print_stdout, clippy::print_stderr)] // they panic where nobody reads: see command/say.rs

use std::io::IsTerminal;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::builder::PossibleValuesParser;
use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;
use psmrt::command::check::CheckRequest;
use psmrt::command::conformance::ConformanceCommand;
use psmrt::command::pack::PackRequest;
use psmrt::command::permeability::PermeabilityRequest;
use psmrt::command::plan::{PlanRequest, Wanted};
use psmrt::command::resume::ResumeRequest;
use psmrt::command::run::RunRequest;
use psmrt::command::say::{say, say_bytes, tell};
use psmrt::command::sweep::SweepRequest;
use psmrt::command::{self, CommandError};
use psmrt::engine::EngineName;
use psmrt::quote;

/// Particle-resolved simulation of grains in water: lattice Boltzmann with a verified oracle.
#[derive(Parser)]
#[command(
    version,
    arg_required_else_help = true,
    after_help = "Examples:
  psmrt check golden/poiseuille/scene.toml
  psmrt run golden/poiseuille/scene.toml
  psmrt resume out/poiseuille      (after Ctrl-C, a crash or a full disk)"
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
    /// Shows what a scene is, what it will cost and what may go wrong, without running it
    #[command(after_help = "Examples:
  psmrt check golden/poiseuille/scene.toml
  psmrt check golden/poiseuille/scene.toml --set time.tau=0.6 --json")]
    Check {
        /// Scene file (TOML)
        scene: PathBuf,
        /// Changes a value of the scene; can be given several times
        #[arg(long, value_name = "KEY=VALUE")]
        set: Vec<String>,
        #[command(flatten)]
        engine: EngineArguments,
    },
    /// Runs a scene
    #[command(after_help = "Ctrl-C saves the state; `psmrt resume` continues from it.

Exit codes: 0 done; 1 failed; 2 wrong scene or options; 3 at its limit and not steady
(with `stop.steady`; the results are written all the same); 130 interrupted.

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
        #[command(flatten)]
        engine: EngineArguments,
        /// Prints seconds per step of fluid, forces, grips, grains, coverage and transfers (engines cpu and wgpu)
        #[arg(long)]
        profile: bool,
    },
    /// Continues a run from its newest checkpoint
    #[command(
        after_help = "A run that has finished is left as it is. Nothing is deleted: what a run without a checkpoint has written
is renamed when it starts again.

With --set it goes on from the last state with changed values, in a folder of its own (the first is left as it is),
also if it has finished. What may change: title, stop, records, checkpoint, body_force.acceleration,
gravity.acceleration, velocity and pressure of faces, velocity and spin of prescribed grains, contact, lubrication.
stop counts from the very start; records begin anew; files that --set names lie beside the run's scene.toml.

Examples:
  psmrt resume out/steel
  psmrt resume out/bed --set stop.time=0.1 --set faces.z_low.pressure=12 --out out/bed_12"
    )]
    Resume {
        /// Folder of the run
        dir: PathBuf,
        /// Another checkpoint than the newest
        #[arg(long, value_name = "FILE")]
        checkpoint: Option<PathBuf>,
        /// Changes a value of the scene; can be given several times
        #[arg(long, value_name = "KEY=VALUE")]
        set: Vec<String>,
        /// With --set: folder for the results, empty or absent [default: out/<name of the run>, numbered]
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Packs grains and writes them as a list that scenes read
    #[command(after_help = "Examples:
  psmrt pack --size 1e-3,1e-3,1e-3 --diameter 1e-4 --porosity 0.4 --out packing.csv
  psmrt pack --size 1e-3,1e-3,1e-3 --count 1000 --porosity 0.4 --out packing.csv
  psmrt pack --bed --size 1e-3,1e-3 --diameter 1e-4 --count 500 --walls --out bed.csv")]
    Pack(PackRequest),
    /// Problems for other people's kernels, and a verdict and diagnosis of their answers
    Conformance {
        #[command(subcommand)]
        command: ConformanceCommand,
    },
    /// The former name of `conformance`, for scripts that use it
    #[command(hide = true)]
    Oracle {
        #[command(subcommand)]
        command: ConformanceCommand,
    },
    /// Proposes the cheapest grid, time step, collision and engine for a scene and an error
    #[command(after_help = "Examples:
  psmrt plan golden/stokes_settling/scene.toml --error 5%
  psmrt plan golden/stokes_settling/scene.toml --error 5% --write planned.toml")]
    Plan {
        /// Scene file (TOML)
        scene: PathBuf,
        /// The error that is wanted: 5% or 0.05
        #[arg(long, value_name = "ERROR")]
        error: Wanted,
        /// Writes the planned scene to a new file
        #[arg(long, value_name = "FILE")]
        write: Option<PathBuf>,
        /// Changes a value of the scene; can be given several times
        #[arg(long, value_name = "KEY=VALUE")]
        set: Vec<String>,
        #[command(flatten)]
        engine: EngineArguments,
    },
    /// Runs a scene along its flow, or along three axes, and says how permeable its bed is
    #[command(
        after_help = "Each run is an ordinary one, in a folder of its own inside DIR; its records make way for one of permeability.

Examples:
  psmrt permeability docs/sand.toml
  psmrt permeability docs/sand.toml --tensor
  psmrt permeability docs/sand.toml --refine 2 --out out/sand"
    )]
    Permeability {
        /// Scene file (TOML)
        scene: PathBuf,
        /// Drives the fluid along x, y and z in turn: tensor and principal values of a periodic domain
        #[arg(long)]
        tensor: bool,
        /// Computes on three grids, the finest N times as fine: Richardson's extrapolation and the GCI
        #[arg(long, value_name = "N", value_parser = command::permeability::refinement)]
        refine: Option<usize>,
        /// Folder for the runs, empty or absent [default: out/<name of the scene>-permeability, numbered]
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// Changes a value of the scene; can be given several times
        #[arg(long, value_name = "KEY=VALUE")]
        set: Vec<String>,
        #[command(flatten)]
        engine: EngineArguments,
    },
    /// Runs a scene with each combination of some values, and leaves one table of what the runs have shown
    #[command(
        after_help = "The same command with the --out of a sweep goes on with it, and with more values adds runs.

Examples:
  psmrt sweep docs/sand.toml --over time.tau=0.55,0.6,0.8 --out out/sand_tau
  psmrt sweep scene.toml --over fluid.kinematic_viscosity=1e-6,2e-6 --over collision.model=mrt,srt"
    )]
    Sweep {
        /// Scene file (TOML)
        scene: PathBuf,
        /// A key and its values; can be given several times, for all combinations
        #[arg(long, value_name = "KEY=VALUE,VALUE,...", required = true)]
        over: Vec<String>,
        /// Folder for the table and the runs [default: out/<name of the scene>-sweep, numbered]
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// Changes a value of all runs; can be given several times
        #[arg(long, value_name = "KEY=VALUE")]
        set: Vec<String>,
        #[command(flatten)]
        engine: EngineArguments,
    },
    /// Now `cargo validate report`
    #[command(hide = true)]
    Report(Former),
    /// Now `cargo validate golden`
    #[command(hide = true)]
    Golden(Former),
    /// Now `cargo validate stability`
    #[command(hide = true)]
    Stability(Former),
    /// Now `cargo validate tradeoff`
    #[command(hide = true)]
    Tradeoff(Former),
    /// Shows what this program is and what it runs on
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

/// What followed the name of a command that another program has now; it is not looked at.
#[derive(clap::Args)]
struct Former {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    _arguments: Vec<String>,
}

/// The words that `--engine` takes.
fn engine_words() -> impl Iterator<Item = &'static str> {
    EngineName::ALL.into_iter().map(EngineName::word).chain(["auto"])
}

/// What computes; the same as `--set engine.kind=...` and `--set engine.adapter=...`.
#[derive(clap::Args)]
struct EngineArguments {
    /// What computes: `reference`, the oracle; `cpu` and `cpu_single`, fast on the CPU; `wgpu` in single precision on an
    /// adapter; `auto` wgpu where there is a GPU in hardware, else cpu [default: the scene's, else cpu]
    #[arg(long, value_parser = PossibleValuesParser::new(engine_words()))]
    engine: Option<String>,
    /// A part of the adapter's name, see `psmrt info`; alone it stands for `--engine wgpu` too
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

impl EngineArguments {
    /// The changes of the scene with these among them.
    fn added_to(self, mut set: Vec<String>) -> Result<Vec<String>, CommandError> {
        set.extend(command::engine_changes(self.engine.as_deref(), self.adapter.as_deref())?);
        psmrt::scene::differ(&set)?;
        Ok(set)
    }
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
        Command::Check { scene, set, engine } => {
            let set = engine.added_to(set)?;
            command::check::check(&CheckRequest { scene, set, json })
        }
        Command::Run { scene, out, set, engine, profile } => {
            let set = engine.added_to(set)?;
            command::run::run(&RunRequest { scene, set, out, profile, json })
        }
        Command::Resume { dir, checkpoint, set, out } => {
            psmrt::scene::differ(&set)?;
            command::resume::resume(&ResumeRequest { folder: dir, checkpoint, set, out, json })
        }
        Command::Pack(request) => command::pack::pack(&request, json),
        Command::Report(_) => Err(CommandError::Moved("report")),
        Command::Golden(_) => Err(CommandError::Moved("golden")),
        Command::Stability(_) => Err(CommandError::Moved("stability")),
        Command::Tradeoff(_) => Err(CommandError::Moved("tradeoff")),
        Command::Plan { scene, error, write, set, engine } => {
            let set = engine.added_to(set)?;
            command::plan::plan(&PlanRequest { scene, set, error, write, json })
        }
        Command::Permeability { scene, tensor, refine, out, set, engine } => {
            let set = engine.added_to(set)?;
            let request = PermeabilityRequest { scene, set, out, tensor, refine, json };
            command::permeability::permeability(&request)
        }
        Command::Sweep { scene, over, out, set, engine } => {
            let set = engine.added_to(set)?;
            command::sweep::sweep(&SweepRequest { scene, set, over, out, json })
        }
        Command::Conformance { command } => command::conformance::conformance(&command, json),
        Command::Oracle { command } => {
            tell("psmrt oracle is now called psmrt conformance; it takes the same arguments");
            command::conformance::conformance(&command, json)
        }
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
            // Generated into memory: that panics where it cannot be written.
            let mut text = Vec::new();
            clap_complete::generate(shell, &mut command, "psmrt", &mut text);
            say_bytes(&text);
            Ok(())
        }
    }
}

/// Says what went wrong: as JSON, in colour on a terminal, or plainly.
fn report(error: &CommandError, json: bool) {
    if matches!(error, CommandError::CandidateFailed | CommandError::NotSteady) {
        return; // the verdict is the report
    }
    if json {
        say(&error.to_json().to_string());
        return;
    }
    tell(&match error {
        CommandError::Scene(error) if std::io::stderr().is_terminal() => {
            error.render(&annotate_snippets::Renderer::styled())
        }
        CommandError::Scene(error) => error.to_string(),
        CommandError::Interrupted { .. } => quote::lines(&error.to_string()),
        error => quote::lines(&format!("error: {error}")),
    });
}
