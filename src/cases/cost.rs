//! What each model costs where a scene has it, from the committed table: `cargo run --example model_cost`.

use psmrt_report::{Axis, Figure, Series, Style};

use super::{Case, CaseError, Claim, Golden, Table};

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
    full: "cargo run --release --example model_cost made these rows; minutes",
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
                allowed: 0.98 * bytes..=1.35 * bytes,
                why: "two copies of 19 populations of 8 or 4 bytes; a process also grows by the shaders, their compiler \
                      and what it keeps of the memory that it used while setting up, some 40 bytes for each of 96^3 cells",
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
    let mut figure = Figure::new(
        "Time of a cell update over that of the bare fluid",
        Axis::log("oracle, double precision"),
        Axis::log("kernel, single precision (software adapter)"),
    );
    let (mut low, mut high) = (1.0_f64, 1.0_f64);
    for model in rows.values("model")? {
        let ratio =
            |engine| rows.with(&[("engine", engine), ("model", &model)])?.number("time_ratio");
        let (x, y) = (ratio("reference")?, ratio("wgpu")?);
        (low, high) = (low.min(x.min(y)), high.max(x.max(y)));
        let against = if model == "MRT" { " (against SRT)" } else { "" };
        if model != "SRT" {
            figure = figure.with(Series::points(format!("{model}{against}"), vec![(x, y)]));
        }
    }
    let equal = Series::new("the same on both", Style::Reference, vec![(low, low), (high, high)]);
    Ok(vec![
        figure.with(equal).note("1: costs nothing; all but MRT itself are added to MRT; 32³ cells"),
    ])
}
