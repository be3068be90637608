//! `cargo validate tradeoff`: sweeps the parameters of scenes on flows with known answers.

use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use psmrt_report::write_svg;
use serde_json::json;

use crate::cases::CaseError;
use crate::failure::Failure;
use crate::tradeoff::fitting::Fits;
use crate::tradeoff::measure::Runner;
use crate::tradeoff::parameters::{Flow, Parameters};
use crate::tradeoff::record::SweepLog;
use crate::tradeoff::row::Row;
use crate::tradeoff::sweep::{operators, runs};
use crate::tradeoff::trial::trials;
use crate::tradeoff::{cost, effects, figures, tables};
use psmrt::command::say::{say, tell};
use psmrt::command::write;
use psmrt::kernel::Gpu;
use psmrt::output::atomic;
use psmrt::table::Table;

/// What `cargo validate tradeoff` is asked for.
#[derive(Args, Clone, Debug)]
pub struct TradeoffRequest {
    /// One flow: poiseuille, sc, bcc, fcc, sphere_drag, settling, seepage or random [default: all]
    pub case: Option<String>,
    /// A handful of runs for each flow
    #[arg(long)]
    pub quick: bool,
    /// Only the configurations that are held back from the fits (golden/tradeoff/held_back.csv)
    #[arg(long, conflicts_with_all = ["case", "quick"])]
    pub held_back: bool,
    /// Only the runs that compare the operators of the solid in fixed beds
    #[arg(long, conflicts_with_all = ["case", "quick", "held_back"])]
    pub operators: bool,
    /// Folder for the rows, which are added to those that are there, and for what is made of them
    #[arg(long, value_name = "DIR", default_value = "out/tradeoff")]
    pub out: PathBuf,
    /// Folder of the cases
    #[arg(long, value_name = "DIR", default_value = "golden")]
    pub golden: PathBuf,
    /// Only the oracle, even where there is an adapter
    #[arg(long)]
    pub oracle_only: bool,
}

/// Makes the runs that are not there yet. Errors if one cannot be made.
pub fn tradeoff(request: &TradeoffRequest, json: bool) -> Result<(), Failure> {
    let wanted = wanted(request)?;
    let gpu = if request.oracle_only { None } else { Gpu::open(None).ok() };
    let mut runner = Runner::new(&request.golden, gpu.clone())?;
    let (file, what) = if request.held_back {
        ("held_back_results.csv", " --held-back")
    } else if request.operators {
        ("operators.csv", " --operators")
    } else {
        ("sweep.csv", "")
    };
    let header = format!(
        "# Error and cost of runs with known answers: cargo validate tradeoff{what} --out DIR\n\
         # Lattice units. error: relative, of the superficial velocity under a given force (arrays, sphere\n\
         # drag, seepage), of the settling velocity, or of the profile (poiseuille, L2). drag: exact drag over\n\
         # Stokes'. seconds: of one run on a machine that may be shared; compare cell_updates.\n"
    );
    let mut record = SweepLog::open(&request.out.join(file), &header)?;
    let todo: Vec<_> = wanted.into_iter().filter(|parameters| !record.holds(parameters)).collect();
    let (can, cannot): (Vec<_>, Vec<_>) =
        todo.into_iter().partition(|parameters| runner.can(parameters));
    if !cannot.is_empty() {
        tell(&format!("{} runs need an adapter and are left out", cannot.len()));
    }
    let all = can.len();
    for (number, parameters) in can.into_iter().enumerate() {
        let row = runner.measure(&parameters)?;
        if !json {
            say(&format!("{}/{all} {}", number + 1, words(&row)));
        }
        record.add(row).map_err(CaseError::from)?;
    }
    if !request.held_back && !request.operators {
        summarise(request, gpu.as_ref(), &record.rows)?;
    }
    let (folder, rows) = (request.out.display(), record.rows.len());
    say(&if json {
        json!({ "folder": request.out.display().to_string(), "runs": all, "rows": rows, "left_out": cannot.len() })
            .to_string()
    } else {
        format!("{rows} rows, {all} of them new, and what is made of them in {folder}")
    });
    Ok(())
}

/// Writes what is made of the rows, replacing what was made of fewer.
fn summarise(
    request: &TradeoffRequest,
    gpu: Option<&Arc<Gpu>>,
    rows: &[Row],
) -> Result<(), Failure> {
    let file = |name: &str| request.out.join(name);
    let save = |name: &str, comment: &str, table: &Table| {
        let text = format!("# {comment}: cargo validate tradeoff --out DIR\n{}", table.to_csv());
        write(&file(name), |path| atomic::write(path, |out| out.write_all(text.as_bytes())))
    };
    let costs = if file("cost.csv").exists() {
        Table::read(&file("cost.csv"))?
    } else {
        tell("measuring what a cell update costs");
        let costs = cost::measure(&request.golden, gpu)?;
        save("cost.csv", "Cost of a cell update, the best of 80 rounds of 15 ms", &costs)?;
        costs
    };
    let fits = Fits::of(rows)?;
    save(
        "fits.csv",
        "Error models (src/advice/tradeoff/model.rs) and their bands",
        &tables::fits(&fits),
    )?;
    save(
        "front.csv",
        "The runs that no other beats in error and cost",
        &tables::fronts(rows, &costs),
    )?;
    let effects = effects::to_table(&effects::effects(rows));
    save("effects.csv", "What one parameter alone does to the error", &effects)?;
    let results = file("held_back_results.csv");
    if results.exists() {
        let trials = trials(&fits.models(), &Row::of_table(&Table::read(&results)?)?)?;
        save(
            "held_back_check.csv",
            "What was held back from the fits, predicted and measured",
            &tables::check(&trials),
        )?;
        if let Some(figure) = figures::held_back(&trials) {
            write(&file("held_back.svg"), |path| write_svg(&figure, path))?;
        }
    }
    for problem in figures::problems(rows) {
        if let Some(figure) = figures::error_against_time(&problem, rows, &costs) {
            let name = format!("{}_{}.svg", problem.0.word(), problem.1).replace("_.", ".");
            write(&file(&name), |path| write_svg(&figure, path))?;
        }
    }
    Ok(())
}

/// A row in one line.
fn words(row: &Row) -> String {
    let error =
        row.error.map_or_else(|| row.end.clone(), |error| format!("{:+.3} %", 100.0 * error));
    format!(
        "{}: {error}, {:.2e} cell updates, {:.1} s",
        row.parameters.row().join(" "),
        row.cell_updates() as f64,
        row.seconds
    )
}

fn wanted(request: &TradeoffRequest) -> Result<Vec<Parameters>, Failure> {
    if request.held_back {
        let table = Table::read(&request.golden.join("tradeoff/held_back.csv"))?;
        return Ok(table
            .rows
            .iter()
            .map(|row| Parameters::from_row(row))
            .collect::<Result<_, _>>()?);
    }
    if request.operators {
        return Ok(operators());
    }
    let flows = match &request.case {
        None => Flow::ALL.to_vec(),
        Some(word) => vec![Flow::from_word(word).ok_or_else(|| {
            let names = Flow::ALL.map(Flow::word).join(", ");
            Failure::usage(format!("case {word:?}: there is no such flow; there are {names}"))
        })?],
    };
    Ok(flows.into_iter().flat_map(|flow| runs(flow, request.quick)).collect())
}
