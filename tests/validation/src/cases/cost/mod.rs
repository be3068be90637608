//! What each model costs where a scene has it, from the committed table: `cargo run -p psmrt-validation --example model_cost`.

use psmrt_report::{Axis, Figure, Series, Style};

use super::{Case, CaseError, Claim, Golden};
use psmrt::table::{Table, TableError};

/// What each model costs.
pub const CASE: Case = Case {
    name: "cost",
    title: "What each model costs, switched on alone",
    about: &[
        "What a scene does not name costs nothing: it is not computed and has no memory. What it does name costs what \
         this table says: the time of a cell update with that model alone over that of the bare fluid, and the bytes \
         per cell, on both engines. Each model was timed in turn with the fluid that it is added to, many times over, \
         on one thread, by the processor's own count; the ratio is that of the shortest times. The kernel ran on a software adapter (the \
         processor): on a GPU, which waits for its memory, models that compute more and read no more cost less.",
    ],
    scenes: &[],
    literature: &[],
    rows: "cost.csv",
    studies: &[],
    units: "time_ratio without units; ns_per_cell_update in nanoseconds; bytes_per_cell in bytes",
    full: "cargo run --release -p psmrt-validation --example model_cost made these rows; minutes",
    measure: |bench| bench.literature(CASE.name, CASE.rows),
    judge,
    draw,
};

fn judge(_: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    for (engine, bytes) in [("reference", 304.0), ("wgpu", 152.0)] {
        let own = |model| rows.with(&[("engine", engine), ("model", model)]);
        for model in ["SRT", "MRT"] {
            claims.push(Claim {
                what: format!("{engine}: bytes per cell of the bare fluid, {model}"),
                measured: own(model)?.number("bytes_per_cell")?,
                allowed: 0.98 * bytes..=1.05 * bytes,
                why: "two copies of 19 populations of 8 or 4 bytes; measured in pages, by the growth of a process from a \
                      small box to a large one, which takes off what is not of the cells (11 MB of shaders and more)",
            });
        }
        let is_kernel = engine == "wgpu";
        claims.push(Claim {
            what: format!("{engine}: time with the guard over that without"),
            measured: own("guard")?.number("time_ratio")?,
            allowed: if is_kernel { 0.9..=1.25 } else { 0.9..=1.1 },
            why: "a look at every cell every 16 steps costs half a percent of the oracle's time; the kernel's waits for \
                  the device, which counts on these 32^3 cells and not on large boxes; the rest is noise",
        });
    }
    Ok(claims)
}

fn draw(_: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    // From the top down as in the table.
    let mut models = rows.with(&[("engine", "reference")])?.values("model")?;
    models.retain(|model| model != "SRT");
    models.reverse();
    let label = |model: &String| if model == "MRT" { "MRT, against SRT" } else { model }.to_owned();
    let labels: Vec<String> = models.iter().map(label).collect();
    let names: Vec<&str> = labels.iter().map(String::as_str).collect();
    let engines = [("reference", "oracle"), ("wgpu", "kernel, on a software adapter")];
    let figure = |title: &str, x: Axis, column: &str| -> Result<Figure, CaseError> {
        let mut figure = Figure::new(title, x, Axis::of_names(&names)).size(800, 480);
        for (engine, words) in engines {
            let value =
                |model: &String| rows.with(&[("engine", engine), ("model", model)])?.number(column);
            let values: Vec<f64> = models.iter().map(value).collect::<Result<_, TableError>>()?;
            let points = values.into_iter().zip((1..).map(f64::from));
            let points = points.collect();
            figure = figure.with(Series::points(words, points));
        }
        Ok(figure)
    };
    let time = figure(
        "What a model adds to the time of a cell update",
        Axis::log("time with the model over that of the bare fluid"),
        "time_ratio",
    )?;
    let ends = vec![(1.0, 0.5), (1.0, names.len() as f64 + 0.5)];
    let memory = figure(
        "Memory of a scene with one model",
        Axis::linear("bytes per cell").range(0.0, most(rows)?),
        "bytes_per_cell",
    )?;
    Ok(vec![
        time.with(Series::new("costs nothing", Style::Reference, ends)).note(
            "the bare fluid is MRT in a periodic box of 32³ cells; one thread, processor time",
        ),
        memory.note(
            "two copies of 19 populations alone: 304 bytes in double precision, 152 in single",
        ),
    ])
}

/// A tenth more than the most bytes per cell.
fn most(rows: &Table) -> Result<f64, CaseError> {
    Ok(1.1 * rows.numbers("bytes_per_cell")?.into_iter().fold(0.0, f64::max))
}
